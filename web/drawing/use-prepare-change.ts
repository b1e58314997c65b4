import type { PlotSettings } from "../../src/schema/index.js";
import { useActions } from "../state/use-store.js";

/** A change of the prepare settings that undo knows by `what`. */
export const usePrepareChange = () => {
  const { changeSettings } = useActions();
  return (what: string, change: Partial<PlotSettings["prepare"]>): void =>
    changeSettings(what, (settings) => ({ ...settings, prepare: { ...settings.prepare, ...change } }));
};
