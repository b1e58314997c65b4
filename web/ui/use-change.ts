import type { PlotSettings } from "../../src/schema/index.js";
import { useActions } from "../state/use-store.js";

type Part = "prepare" | "motion" | "pen";

/** Changes one part of the settings, as an undo step for each thing that is changed: `what`. */
const useChange = <P extends Part>(part: P) => {
  const { changeSettings } = useActions();
  return (what: string, change: Partial<PlotSettings[P]>): void =>
    changeSettings(`${part} ${what}`, (settings) => ({
      ...settings,
      [part]: { ...settings[part], ...change },
    }));
};

export const usePrepareChange = () => useChange("prepare");
export const useMotionChange = () => useChange("motion");

/** As an undo step for each setting. */
export const usePenChange = () => {
  const change = useChange("pen");
  return (part: Partial<PlotSettings["pen"]>): void => change(Object.keys(part).join(), part);
};
