import type { PlotSettings } from "../../src/schema/index.js";
import { useActions } from "../state/use-store.js";

/** Changes the prepare settings as an undo step called `what`. */
export const usePrepareChange = () => {
  const { changeSettings } = useActions();
  return (what: string, change: Partial<PlotSettings["prepare"]>): void =>
    changeSettings(what, (settings) => ({ ...settings, prepare: { ...settings.prepare, ...change } }));
};

/** Changes settings of the pen's motion, as an undo step for each of them. */
export const usePenChange = () => {
  const { changeSettings } = useActions();
  return (part: Partial<PlotSettings["pen"]>): void =>
    changeSettings(`pen ${Object.keys(part).join()}`, (settings) => ({
      ...settings,
      pen: { ...settings.pen, ...part },
    }));
};
