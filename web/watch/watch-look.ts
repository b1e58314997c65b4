/** The look of the running plot: the pens' colours and widths, and how far it is drawn. */
import { penOf, shownLayerName } from "../../src/internal.js";
import type { Job } from "../../src/schema/index.js";
import { jobUntilS } from "../preview/drawn-until.js";
import type { FrameLook } from "../preview/stage.js";
import { penLooks } from "../preview/view-modes.js";
import { LAYER_SHORT, PIECE_SHORTS } from "../scene/pieces.js";
import { piecesBefore } from "../scene/scene.js";
import type { PageState } from "../state/store.js";
import type { Planned } from "../worker/protocol.js";

export const lookOfJob = (job: Job | null, planned: Planned | null, live: PageState["live"]): FrameLook => {
  const looks = job && planned ? penLooks({ planned, settings: job.settings }) : [];
  return {
    colorBy: "layer",
    showTravel: false,
    layerColors: looks.map(({ color }) => color),
    layerWidthsMm: looks.map(({ widthMm }) => widthMm),
    untilS: job && planned ? jobUntilS(job, planned.trajectory, live) : null,
  };
};

interface LayerNow {
  readonly number: number;
  readonly count: number;
  readonly name: string;
  readonly penName: string | null;
  readonly color: string | null;
}

/** The layer that the pen is drawing; null: unknown. */
export const layerNow = (job: Job, planned: Planned | null, live: PageState["live"]): LayerNow | null => {
  if (!planned || planned.scene.draw.count === 0) return null;
  const { draw } = planned.scene;
  const untilS = jobUntilS(job, planned.trajectory, live);
  const reached = untilS === null ? draw.count : piecesBefore(draw, untilS);
  const piece = Math.min(draw.count - 1, Math.max(0, reached - 1));
  const index = new Uint16Array(draw.bytes)[piece * PIECE_SHORTS + LAYER_SHORT];
  const layer = planned.drawnLayers[index];
  if (!layer) return null;
  const pen = penOf(job.settings, layer);
  return {
    number: index + 1,
    count: planned.drawnLayers.length,
    name: shownLayerName(layer.name),
    penName: pen?.name ?? null,
    color: pen?.color ?? layer.color,
  };
};
