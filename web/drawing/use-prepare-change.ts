import type { PlotSettings } from "../../src/schema/index.js";
import { useActions } from "../state/use-store.js";

/** Changes the prepare settings as an undo step called `what`. */
export const usePrepareChange = () => {
  const { changeSettings } = useActions();
  return (what: string, change: Partial<PlotSettings["prepare"]>): void =>
    changeSettings(what, (settings) => ({ ...settings, prepare: { ...settings.prepare, ...change } }));
};
