import type { PlotSettings } from "../../src/schema/index.js";
import { useActions } from "../state/use-store.js";

/** Changes the settings as an undo step called `what`. */
export const useChange = () => useActions().changeSettings;

/** Changes settings of the pen's motion, as an undo step for each of them. */
export const usePenChange = () => {
  const change = useChange();
  return (part: Partial<PlotSettings["pen"]>): void =>
    change(`pen ${Object.keys(part).join()}`, (settings) => ({
      ...settings,
      pen: { ...settings.pen, ...part },
    }));
};
