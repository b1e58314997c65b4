/**
 * Messages between the page and the worker that simulates the pen. A worker answers one request, then it is
 * terminated.
 */
import type { StrokeSet, Trajectory } from "../../src/index.js";
import type { Springs } from "../../src/internal.js";
import type { SwingPicture } from "../scene/swing-scene.js";

export interface SwingRequest {
  readonly strokes: StrokeSet;
  readonly trajectory: Trajectory;
  readonly springs: Springs;
}

export type SwingReply =
  | { readonly type: "share"; readonly share: number }
  | { readonly type: "done"; readonly picture: SwingPicture };
