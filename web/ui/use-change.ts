import type { PlotSettings } from "../../src/schema/index.js";
import { useActions } from "../state/use-store.js";

/** A change of the settings that undo knows by `what`. */
export const useChange = () => {
  const { changeSettings } = useActions();
  return (what: string, change: (settings: PlotSettings) => PlotSettings): void =>
    changeSettings(what, change);
};
