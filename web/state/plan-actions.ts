/** Planning the drawing, and what the planner answers. */
import type { StrokeSet } from "../../src/index.js";
import type { Planner } from "../worker/planner.js";
import type { ExportFormat, PlanFault, Planned } from "../worker/protocol.js";
import { boardFirmware, type PageStore } from "./store.js";

/** Reset with each new plan, because its times and positions differ. */
const NOTHING_SELECTED = {
  momentS: null,
  isPlaying: false,
  isDrawingItself: false,
  hover: null,
  noteBoxes: [],
};

export const createPlanActions = (
  store: PageStore,
  planner: Pick<Planner, "request" | "export" | "strokes" | "sketches">,
) => ({
  replan: (): void => {
    const state = store.getState();
    const { drawing, settings } = state;
    if (!drawing) return;
    store.setState({ isPlanning: true });
    planner.request({ drawing, settings, firmware: boardFirmware(state) });
  },
  showPlan: (planned: Planned): void =>
    store.setState({ planned, isPlanning: false, fault: null, ...NOTHING_SELECTED }),
  showFault: (fault: PlanFault): void =>
    store.setState({ fault, isPlanning: false, planned: null, ...NOTHING_SELECTED }),
  /** Gets the strokes of the current plan, to simulate the pen on them. Not answered while another plan is made. */
  askStrokes: (take: (strokes: StrokeSet) => void): void => planner.strokes(take),
  /** Gets small pictures of the current plan's drawing with other settings. Not answered while another plan is made. */
  askSketches: (...asked: Parameters<Planner["sketches"]>): void => planner.sketches(...asked),
  exportAs: (format: ExportFormat, firmware: string): void => planner.export(format, firmware),
});
