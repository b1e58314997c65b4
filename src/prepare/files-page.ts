/**
 * Places the file's page on the paper unless the user has chosen a place. A file made for this paper keeps its true size,
 * and the paper is turned so that the machine reaches it.
 */
import { PAPER_SIZES, type PaperSize } from "../drawing/paper.js";
import type { Box } from "../geometry/box.js";
import { DEFAULT_PREPARE, PAPER_TABLE, type FourMargins, type PrepareSettings } from "../settings/prepare.js";
import { orientedPaper } from "./place.js";

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

/** True if the page's corner is on the paper's corner, at true size, and lines are cut off only at the page's edge. */
const isPageOnCorner = ({ fit, place, cropToPage, clipToMargins }: PrepareSettings): boolean =>
  !fit && place === null && cropToPage && !clipToMargins;

/** Whether `onFilesPage` would change nothing. */
export const isOnFilesPage = (settings: PrepareSettings, page: Size): boolean =>
  isPageOnCorner(settings) && isSameSheet(settings.paper, page);

/** Makes the paper the file's page, at true size. Turns both by 90° if the machine reaches the page only that way. */
export function onFilesPage<S extends PrepareSettings>(settings: S, page: Size, machine: Size | null): S {
  const { widthMm, heightMm } = page;
  const portrait = widthMm > heightMm ? turned(page) : page;
  const sheets = [settings.paper, ...Object.values(PAPER_SIZES)];
  const isTurned = machine !== null && !reaches(machine, page) && reaches(machine, turned(page));
  return {
    ...settings,
    paper: sheets.find((sheet) => isSameSheet(sheet, page)) ?? portrait,
    landscape: widthMm > heightMm !== isTurned,
    fit: false,
    place: null,
    rotateDeg: isTurned ? 90 : 0,
    clipToMargins: false,
    cropToPage: true,
  };
}

const NOT_CHOSEN = {
  fit: DEFAULT_PREPARE.fit,
  place: null,
  rotateDeg: DEFAULT_PREPARE.rotateDeg,
  clipToMargins: DEFAULT_PREPARE.clipToMargins,
  cropToPage: DEFAULT_PREPARE.cropToPage,
};

const isChosen = (settings: PrepareSettings): boolean =>
  Object.entries(NOT_CHOSEN).some(([key, value]) => settings[key as keyof PrepareSettings] !== value);

/** The settings for a newly opened drawing. Settings that the user has changed stay unchanged. */
export function placedForPage<S extends PrepareSettings>(settings: S, page: Size, machine: Size | null): S {
  if (isChosen(settings)) return settings;
  if (isSameSheet(settings.paper, page)) return onFilesPage(settings, page, machine);
  const { landscape } = settings;
  const isBetterTurned =
    machine !== null &&
    !reaches(machine, insideOf(settings, landscape)) &&
    reaches(machine, insideOf(settings, !landscape));
  return isBetterTurned ? { ...settings, landscape: !landscape } : settings;
}

/** The farthest point from home of a drawing inside the margins. */
function insideOf({ paper, margins, marginMm }: PrepareSettings, landscape: boolean): Size {
  const { widthMm, heightMm } = orientedPaper(paper, landscape);
  return {
    widthMm: widthMm - (margins?.rightMm ?? marginMm),
    heightMm: heightMm - (margins?.bottomMm ?? marginMm),
  };
}

/** Undoes `onFilesPage`, for the next drawing. */
export const withoutFilesPage = <S extends PrepareSettings>(settings: S): S =>
  isPageOnCorner(settings) ? { ...settings, ...NOT_CHOSEN } : settings;

/**
 * Turns paper and drawing together by 90° clockwise, so that the plot is the same on a sheet in the other orientation.
 * `frame`: the drawing's box on the paper, before a placed box is turned.
 */
export function quarterTurned<S extends PrepareSettings>(settings: S, frame: Box): S {
  const { paper, landscape, margins, place, rotateDeg } = settings;
  const { heightMm } = orientedPaper(paper, landscape);
  return {
    ...settings,
    landscape: !landscape,
    rotateDeg: (rotateDeg + 90) % 360,
    margins: margins && turnedMargins(margins),
    place: place && {
      ...place,
      xMm: heightMm - frame.y1,
      yMm: frame.x0,
      widthMm: place.heightMm,
      heightMm: place.widthMm,
    },
  };
}

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
