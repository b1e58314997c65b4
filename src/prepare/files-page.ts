/**
 * How the file's page lies on the paper, unless the user has chosen a place: a file made for this paper keeps its true size,
 * and the paper is turned to an orientation that the machine reaches.
 */
import { PAPER_SIZES, type PaperSize } from "../drawing/paper.js";
import type { Box } from "../geometry/box.js";
import { DEFAULT_PREPARE, PAPER_TABLE, type FourMargins, type PrepareSettings } from "../settings/prepare.js";
import { orientedPaper } from "./place.js";

/** Width and height as they lie. */
type Size = PaperSize;

/** mm. Programs that write pages in whole pixels are off by a quarter of it. */
const SAME_PAGE_MM = 1;

const turned = ({ widthMm, heightMm }: Size): Size => ({ widthMm: heightMm, heightMm: widthMm });

const isAbout = (a: Size, b: Size): boolean =>
  Math.abs(a.widthMm - b.widthMm) < SAME_PAGE_MM && Math.abs(a.heightMm - b.heightMm) < SAME_PAGE_MM;

const isSameSheet = (a: Size, b: Size): boolean => isAbout(a, b) || isAbout(a, turned(b));

const reaches = (machine: Size, { widthMm, heightMm }: Size): boolean =>
  widthMm <= machine.widthMm && heightMm <= machine.heightMm;

/** False for a page that no paper setting holds. */
export const canBePaper = ({ widthMm, heightMm }: Size): boolean =>
  [widthMm, heightMm].every((mm) => mm >= PAPER_TABLE.widthMm.min && mm <= PAPER_TABLE.widthMm.max);

/** The page corner on the paper's corner at true size, cut off only where the page ends. */
const isPageOnCorner = ({ fit, place, cropToPage, clipToMargins }: PrepareSettings): boolean =>
  !fit && place === null && cropToPage && !clipToMargins;

/** Whether `onFilesPage` has nothing to add. */
export const isOnFilesPage = (settings: PrepareSettings, page: Size): boolean =>
  isPageOnCorner(settings) && isSameSheet(settings.paper, page);

/** The paper is the file's page, at true size; page and paper are turned together if the machine needs it. */
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

/** For a drawing that is opened. What was chosen by hand stays. */
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

/** How far from home a drawing inside the margins goes. */
function insideOf({ paper, margins, marginMm }: PrepareSettings, landscape: boolean): Size {
  const { widthMm, heightMm } = orientedPaper(paper, landscape);
  return {
    widthMm: widthMm - (margins?.rightMm ?? marginMm),
    heightMm: heightMm - (margins?.bottomMm ?? marginMm),
  };
}

/** For the drawing after one that lay on its own page: as if nothing had been chosen. */
export const withoutFilesPage = <S extends PrepareSettings>(settings: S): S =>
  isPageOnCorner(settings) ? { ...settings, ...NOT_CHOSEN } : settings;

/**
 * Paper and drawing together a quarter clockwise, so that the plot is the same on a sheet that lies the other way.
 * `frame`: the drawing's own box on the paper, before a placed box is turned.
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

/** The same for a box on a sheet of that height. */
export const quarterTurnedBox = ({ x0, y0, x1, y1 }: Box, heightMm: number): Box => ({
  x0: heightMm - y1,
  y0: x0,
  x1: heightMm - y0,
  y1: x1,
});
