/** Paper of the size of the file's page, and turning the paper, the drawing, or both. */
import type { Drawing } from "../drawing/drawing.js";
import { PAPER_SIZES, type PaperSize } from "../drawing/paper.js";
import { boxContains, isEmptyBox, type Box } from "../geometry/box.js";
import { PAPER_TABLE } from "../settings/placement.js";
import type { FourMargins, PrepareSettings } from "../settings/prepare.js";
import { layOutDrawing, withTolerance, type LayoutChoice, type Layout } from "./layout.js";
import { orientedPaper } from "./tiles.js";
import { isReached } from "./on-paper.js";

/** Width along x and height along y, unlike `PaperSize`, which is portrait. */
type Size = PaperSize;

/** Tolerance for equal sizes, mm. Programs that write pages in whole pixels are off by about 0.25 mm. */
const SAME_PAGE_MM = 1;

const turned = ({ widthMm, heightMm }: Size): Size => ({ widthMm: heightMm, heightMm: widthMm });

const isAbout = (a: Size, b: Size): boolean =>
  Math.abs(a.widthMm - b.widthMm) < SAME_PAGE_MM && Math.abs(a.heightMm - b.heightMm) < SAME_PAGE_MM;

const isSameSheet = (a: Size, b: Size): boolean => isAbout(a, b) || isAbout(a, turned(b));

const reaches = (machine: Size, { widthMm, heightMm }: Size): boolean =>
  widthMm <= machine.widthMm && heightMm <= machine.heightMm;

/** False for a page that is too small or too large for the paper setting. */
export const canBePaper = ({ widthMm, heightMm }: Size): boolean =>
  [widthMm, heightMm].every((mm) => mm >= PAPER_TABLE.widthMm.min && mm <= PAPER_TABLE.widthMm.max);

/** Whether the paper is the file's page, at true size. */
export const isOnFilesPage = ({ paper, fit, layout }: PrepareSettings, page: Size): boolean =>
  fit !== true && layout === null && isSameSheet(paper, page);

/**
 * Makes the paper the file's page, at true size. The paper lies as the page does, unless the machine reaches it only
 * the other way: then the drawing is turned by itself.
 */
export function onFilesPage<S extends PrepareSettings>(settings: S, page: Size, machine: Size | null): S {
  const { widthMm, heightMm } = page;
  const portrait = widthMm > heightMm ? turned(page) : page;
  const sheets = [settings.paper, ...Object.values(PAPER_SIZES)];
  const isTurned = machine !== null && !reaches(machine, page) && reaches(machine, turned(page));
  return {
    ...settings,
    paper: sheets.find((sheet) => isSameSheet(sheet, page)) ?? portrait,
    landscape: widthMm > heightMm !== isTurned,
    fit: "auto",
    layout: null,
    rotateDeg: "auto",
  };
}

/**
 * Turns paper and drawing together by 90° clockwise, so that the plot is the same on a sheet in the other orientation.
 * `frame`: the drawing's box on the paper, before a placed box is turned. `page`: the file's.
 */
export function quarterTurned<S extends PrepareSettings>(
  settings: S,
  { frame, choice }: Pick<Layout, "frame" | "choice">,
  page: Size,
): S {
  const { paper, landscape, margins, layout } = settings;
  const { heightMm } = orientedPaper(paper, landscape);
  return {
    ...settings,
    landscape: !landscape,
    rotateDeg: turnsByItself(settings, choice, page) ? "auto" : (choice.rotateDeg + 90) % 360,
    margins: margins && turnedMargins(margins),
    layout: layout && {
      ...layout,
      xMm: heightMm - frame.y1,
      yMm: frame.x0,
      widthMm: layout.heightMm,
      heightMm: layout.widthMm,
    },
  };
}

/** Whether the drawing turns with the paper because its page fits only that way. */
const turnsByItself = (
  { rotateDeg, paper, landscape }: PrepareSettings,
  now: LayoutChoice,
  page: Size,
): boolean =>
  rotateDeg === "auto" &&
  now.rotateDeg === 0 &&
  now.how === "corner" &&
  reaches(orientedPaper(paper, landscape), page) &&
  !reaches(orientedPaper(paper, !landscape), page);

const turnedMargins = ({ topMm, rightMm, bottomMm, leftMm }: FourMargins): FourMargins => ({
  topMm: leftMm,
  rightMm: topMm,
  bottomMm: rightMm,
  leftMm: bottomMm,
});

/** The same for a box on a sheet of height `heightMm`. */
export const quarterTurnedBox = ({ x0, y0, x1, y1 }: Box, heightMm: number): Box => ({
  x0: heightMm - y1,
  y0: x0,
  x1: heightMm - y0,
  y1: x1,
});

/**
 * What turns the drawing, or else the paper, by 90° so that the whole drawing lies on the paper at its size; null if
 * neither does. The drawing is moved as well if it lacks only that. `machine`: what it reaches.
 */
export function turnedOntoPaper(
  drawing: Drawing,
  settings: PrepareSettings,
  machine: Size,
): Partial<PrepareSettings> | null {
  const { choice } = layOutDrawing(drawing, { ...settings, outside: "refuse" });
  const { layout, landscape } = settings;
  // It is on the paper, or has no size.
  if (choice.how === "fit") return null;
  const turnedDrawing: Partial<PrepareSettings> = layout
    ? { layout: { ...layout, turnDeg: ((layout.turnDeg ?? 0) + 90) % 360 } }
    : { rotateDeg: (choice.rotateDeg + 90) % 360 };
  for (const turn of [turnedDrawing, { landscape: !landscape }]) {
    for (const outside of ["refuse", "move"] as const) {
      const wanted = { ...settings, ...turn, outside };
      const { content, frame, paper, choice: now } = layOutDrawing(drawing, wanted);
      const isOn = !isEmptyBox(content) && boxContains(withTolerance(paper), content);
      // Another way to lay it out would also change its size.
      if (!isOn || now.how !== choice.how || !isReached(content, machine)) continue;
      if (outside === "refuse") return turn;
      if (!wanted.layout) return { ...turn, outside };
      // The place itself changes, so that the drawing's frame is where it is drawn.
      return { ...turn, layout: { ...wanted.layout, xMm: frame.x0, yMm: frame.y0 } };
    }
  }
  return null;
}
