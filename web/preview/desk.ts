/** The desk of the preview: paper, margins and the machine's reach, from a job's settings, and the plotter's pen. */
import { findMachine, mmFromLength, orientedPaper, type LengthUnit } from "../../src/internal.js";
import type { PlotSettings } from "../../src/schema/index.js";
import { formatSize } from "../ui/format.js";
import type { Desk } from "./backdrop.js";
import { previewText } from "./text.js";
import { currentPlotter, type PageState } from "../state/store.js";
import type { Marker } from "./overlay.js";

export const deskOf = (settings: PlotSettings, unit: LengthUnit): Desk => {
  const { paper, landscape, margins, marginMm } = settings.prepare;
  const { widthMm, heightMm } = orientedPaper(paper, landscape);
  const machine = findMachine(settings);
  return {
    paperMm: { width: widthMm, height: heightMm },
    margins: margins ?? { topMm: marginMm, rightMm: marginMm, bottomMm: marginMm, leftMm: marginMm },
    reach: machine && {
      width: machine.widthMm,
      height: machine.heightMm,
      label: previewText.reach(machine.name, formatSize(machine.widthMm, machine.heightMm, unit)),
    },
    unitMm: mmFromLength(1, unit),
  };
};

/** Where the plotter's pen is on the paper; null: unknown. */
export const plotterMarker = (state: PageState): Marker | null => {
  const plotter = currentPlotter(state);
  if (state.link !== "connected" || !plotter) return null;
  const { xMm, yMm, penUp, penMoving } = plotter;
  return xMm === null || yMm === null ? null : { xMm, yMm, penDown: penUp === false && !penMoving };
};
