/** The desk of the preview: paper, margins and the machine's reach, from a job's settings, and where the plotter's pen is. */
import { findMachine, mmFromLength, orientedPaper, sheetSize, tileCount } from "../../src/internal.js";
import type { PlotSettings } from "../../src/schema/index.js";
import { formatSize } from "../ui/format.js";
import type { Desk } from "./backdrop.js";
import { previewText } from "./text.js";
import type { ViewSettings } from "../state/persist.js";
import { currentPlotter, type PageState } from "../state/store.js";
import type { PenGlide } from "./pen/pen-glide.js";

/** A drawing that is spread over several sheets is shown as a whole. */
const NO_MARGINS = { topMm: 0, rightMm: 0, bottomMm: 0, leftMm: 0 };

export const deskOf = (
  settings: PlotSettings,
  { lengthUnit: unit, deskTurn }: Pick<ViewSettings, "lengthUnit" | "deskTurn">,
): Desk => {
  const { paper, landscape, margins, marginMm, tile } = settings.prepare;
  const isPoster = tile === 0 && tileCount(settings.prepare) > 1;
  const { widthMm, heightMm } = isPoster ? sheetSize(settings.prepare) : orientedPaper(paper, landscape);
  const machine = findMachine(settings);
  return {
    paperMm: { width: widthMm, height: heightMm },
    margins: isPoster
      ? NO_MARGINS
      : (margins ?? { topMm: marginMm, rightMm: marginMm, bottomMm: marginMm, leftMm: marginMm }),
    // Of several sheets each one lies at home.
    reach:
      !isPoster && machine
        ? {
            width: machine.widthMm,
            height: machine.heightMm,
            label: previewText.reach(machine.name, formatSize(machine.widthMm, machine.heightMm, unit)),
          }
        : null,
    unitMm: mmFromLength(1, unit),
    turn: deskTurn,
  };
};

/** Tells the glide of a change of the page's state where the plotter's pen is. */
export const followPen = (
  glide: PenGlide,
  state: PageState,
  before: PageState | null,
  nowMs: number,
): void => {
  const { link, live } = state;
  const plotter = currentPlotter(state);
  if (link !== "connected" || !plotter) return glide.forget();
  const { id, xMm, yMm, penUp, penMoving } = plotter;
  if (xMm === null || yMm === null) return glide.forget();
  if (live !== null && live !== before?.live && live.plotterId === id) return glide.report(live, nowMs);
  const old = before?.link === link ? currentPlotter(before) : null;
  const isSame = old?.id === id && old.xMm === xMm && old.yMm === yMm && old.penUp === penUp;
  if (isSame && old.penMoving === penMoving) return;
  glide.put({ xMm, yMm, penUp: penUp !== false, penMoving }, nowMs);
};
