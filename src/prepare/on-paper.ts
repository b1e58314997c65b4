/** What reaches the paper: the size of the drawing on it, and lines that leave it. */
import { PlotwrightError } from "../errors.js";
import { boxContains, boxOfPoints, hasRoom, isEmptyBox } from "../geometry/box.js";
import { lineBox, lineCount, type Lines } from "../geometry/polyline.js";
import type { OutsideMode } from "../settings/prepare.js";
import { ROUNDING_MM, withTolerance, type Placement } from "./place.js";

/** The drawing's size on the paper. */
export interface DrawnSize {
  /** The box of all strokes; 0 × 0 if there are none. */
  readonly widthMm: number;
  readonly heightMm: number;
  /** The scale along the page's width and height: 1 is the size in the file. */
  readonly scaleX: number;
  readonly scaleY: number;
  /** The drawing was turned by this because its page fits the paper only that way; otherwise 0. */
  readonly turnedDeg: number;
}

/** Strokes that leave the paper. */
export interface OutsidePaper {
  /** How many strokes leave it, completely or in part. */
  readonly strokeCount: number;
  /** By how much they leave it at each edge, mm; 0 for an edge that they do not cross. */
  readonly leftMm: number;
  readonly topMm: number;
  readonly rightMm: number;
  readonly bottomMm: number;
  /** The drawing is small enough to be moved onto the paper. */
  readonly canMove: boolean;
}

/** `lines`: where the ink lies, without the offsets of pens. */
export function drawnSizeOf(lines: Lines, { map, layout }: Placement, isTurnChosen: boolean): DrawnSize {
  const box = boxOfPoints(lines.xy);
  const isEmpty = isEmptyBox(box);
  return {
    widthMm: isEmpty ? 0 : box.x1 - box.x0,
    heightMm: isEmpty ? 0 : box.y1 - box.y0,
    scaleX: Math.hypot(map.a, map.b),
    scaleY: Math.hypot(map.c, map.d),
    turnedDeg: isTurnChosen ? 0 : layout.rotateDeg,
  };
}

/** Null if all lines are on the paper. `lines` as for `drawnSizeOf`. */
export function outsidePaper(lines: Lines, { paper, content }: Placement): OutsidePaper | null {
  const box = boxOfPoints(lines.xy);
  const sheet = withTolerance(paper);
  if (isEmptyBox(box) || boxContains(sheet, box)) return null;
  let strokeCount = 0;
  for (let i = 0; i < lineCount(lines); i++) if (!boxContains(sheet, lineBox(lines, i))) strokeCount++;
  return {
    strokeCount,
    leftMm: Math.max(0, paper.x0 - box.x0),
    topMm: Math.max(0, paper.y0 - box.y0),
    rightMm: Math.max(0, box.x1 - paper.x1),
    bottomMm: Math.max(0, box.y1 - paper.y1),
    canMove: hasRoom(paper, content),
  };
}

/** The square root of the factor by which areas grow. */
export const meanScaleOf = ({ scaleX, scaleY }: DrawnSize): number => Math.sqrt(scaleX * scaleY);

/** "drawn 267 × 178 mm, 267 %, turned by 90°". */
export function sizeInWords({ widthMm, heightMm, scaleX, scaleY, turnedDeg }: DrawnSize): string {
  const percents = [...new Set([scaleX, scaleY].map(percentInWords))].join(" × ");
  const turned = turnedDeg === 0 ? "" : `, turned by ${turnedDeg}°`;
  return `drawn ${mmInWords(widthMm)} × ${mmInWords(heightMm)} mm, ${percents} %${turned}`;
}

const mmInWords = (mm: number): string => String(Math.round(mm * 10) / 10);
const percentInWords = (factor: number): string =>
  String(factor < 0.1 ? Math.round(factor * 1_000) / 10 : Math.round(factor * 100));

const CHOICES: Readonly<Record<Exclude<OutsideMode, "refuse">, string>> = {
  cut: "cut (at the paper's edge)",
  move: "move (onto the paper)",
  fit: "fit (to the paper)",
  allow: "allow (draw it there)",
};

/**
 * Throws unless everything is on the paper, or the user has allowed more.
 *
 * @throws PlotwrightError "out-of-bounds", with the figures and the choices
 */
export function checkPaper(
  outside: OutsidePaper | null,
  mode: OutsideMode,
  paper: { readonly widthMm: number; readonly heightMm: number },
): void {
  if (outside === null || mode === "allow") return;
  const edges = (["left", "upper", "right", "lower"] as const).flatMap((edge) => {
    const mm = outside[MM_OF_EDGE[edge]];
    return mm > ROUNDING_MM ? [`${mmInWords(Math.max(mm, 0.1))} mm over its ${edge} edge`] : [];
  });
  const { strokeCount: count } = outside;
  const choices = Object.entries(CHOICES).flatMap(([choice, words]) =>
    choice === mode || (choice === "move" && !outside.canMove) ? [] : [words],
  );
  throw new PlotwrightError(
    "out-of-bounds",
    `The drawing leaves the paper of ${mmInWords(paper.widthMm)} × ${mmInWords(paper.heightMm)} mm: ` +
      `${count === 1 ? "1 stroke reaches" : `${count} strokes reach`} up to ${edges.join(" and ")}. ` +
      `Choose what happens to it with --outside, or "outside" in the settings: ${choices.join(", ")}. ` +
      `Or choose another paper.`,
  );
}

const MM_OF_EDGE = { left: "leftMm", upper: "topMm", right: "rightMm", lower: "bottomMm" } as const;
