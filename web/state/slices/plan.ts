/** The plan of the drawing, and what the preview marks on it. Its actions: ../plan-actions.ts. */
import type { Springs } from "../../../src/internal.js";
import type { Hover } from "../../scene/hover.js";
import type { SnapLines } from "../../scene/placing.js";
import type { Picture } from "../../scene/renderer.js";
import type { SwingPicture } from "../../scene/swing-scene.js";
import type { PlanFault, Planned } from "../../worker/protocol.js";

export interface Selected {
  readonly of: Planned;
  readonly hover: Hover;
}

/** The simulated pen on a plan. */
export interface Swing {
  readonly of: Planned;
  /** The frequencies and damping used. */
  readonly springs: Springs;
  /** The machine was not measured. */
  readonly isAssumed: boolean;
  /** How much of the plot is simulated, 0 … 1. */
  readonly share: number;
  /** Null until the simulation is complete. */
  readonly picture: Picture | null;
  readonly result: Pick<SwingPicture, "error" | "topMm"> | null;
  readonly fault: string | null;
}

export interface PlanSlice {
  readonly planned: Planned | null;
  readonly isPlanning: boolean;
  readonly fault: PlanFault | null;
  readonly hover: Hover | null;
  /** The clicked stroke and its plan: another plan may number the strokes differently. */
  readonly selected: Selected | null;
  /** Set while the simulated pen is shown. */
  readonly swing: Swing | null;
  /** Places on the file's page that the user wants to see for a warning; mm x0 y0 x1 y1. */
  readonly noteBoxes: readonly (readonly [number, number, number, number])[];
  /** The lines that a dragged drawing has snapped to. */
  readonly snapLines: SnapLines | null;
}

export const PLAN_AT_FIRST = {
  planned: null,
  isPlanning: false,
  fault: null,
  hover: null,
  selected: null,
  swing: null,
  noteBoxes: [],
  snapLines: null,
} as const satisfies Partial<PlanSlice>;

/** The selected stroke, if it belongs to the current plan. */
export const selectedStroke = ({ selected, planned }: PlanSlice): Selected | null =>
  selected !== null && selected.of === planned ? selected : null;
