/** What reaches the paper: the size of the drawing on it, lines that leave it, and lines that the machine does not reach. */
import { PlotwrightError } from "../errors.js";
import { boxContains, boxOfPoints, grownBox, hasRoom, isEmptyBox, type Box } from "../geometry/box.js";
import { clipLinesToBox } from "../geometry/cut-line.js";
import { lineBox, lineCount, type Lines } from "../geometry/polyline.js";
import { mmInWords } from "../units.js";
import type { OutsideMode } from "../settings/placement.js";
import { ROUNDING_MM, withTolerance, type Layout } from "./layout.js";
import { checkObject } from "../check-arguments.js";
import { checkStrokes, strokeCount, type StrokeSet } from "../drawing/stroke-set.js";
import type { MachineProfile } from "../machines/profile.js";

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
  /** A part of the drawing is on the paper, and is left if the rest is cut off. */
  readonly canCut: boolean;
  /** The drawing is small enough to be moved onto the paper. */
  readonly canMove: boolean;
}

/** `lines`: where the ink lies, without the offsets of pens. */
export function drawnSizeOf(lines: Lines, { map, choice }: Layout, isTurnChosen: boolean): DrawnSize {
  const box = boxOfPoints(lines.xy);
  const isEmpty = isEmptyBox(box);
  return {
    widthMm: isEmpty ? 0 : box.x1 - box.x0,
    heightMm: isEmpty ? 0 : box.y1 - box.y0,
    scaleX: Math.hypot(map.a, map.b),
    scaleY: Math.hypot(map.c, map.d),
    turnedDeg: isTurnChosen ? 0 : choice.rotateDeg,
  };
}

/** Null if all lines are on the paper. `lines` as for `drawnSizeOf`. */
export function outsidePaper(lines: Lines, { paper, content }: Layout): OutsidePaper | null {
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
    canCut: lineCount(clipLinesToBox(lines, sheet)) > 0,
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

const pointInWords = (x: number, y: number): string => `(${mmInWords(x)}, ${mmInWords(y)})`;
const percentInWords = (factor: number): string =>
  String(factor < 0.1 ? Math.round(factor * 1_000) / 10 : Math.round(factor * 100));

const MODES = ["cut", "move", "fit", "allow"] as const satisfies readonly OutsideMode[];
const CHOICES: Readonly<Record<(typeof MODES)[number], string>> = {
  cut: "cut (at the paper's edge)",
  move: "move (onto the paper)",
  fit: "fit (to the paper)",
  allow: "allow (draw it there)",
};

/**
 * Throws unless everything is on the paper, or the user has allowed more. `isDrawable`: the machine reaches all of it.
 *
 * @throws PlotwrightError "out-of-bounds", with the figures and the choices
 */
export function checkPaper(
  outside: OutsidePaper | null,
  mode: OutsideMode,
  paper: { readonly widthMm: number; readonly heightMm: number },
  isDrawable: boolean,
): void {
  if (outside === null || mode === "allow") return;
  const edges = (["left", "upper", "right", "lower"] as const).flatMap((edge) => {
    const mm = outside[MM_OF_EDGE[edge]];
    return mm > ROUNDING_MM ? [`${mmInWords(Math.max(mm, 0.1))} mm over its ${edge} edge`] : [];
  });
  const { strokeCount: count } = outside;
  const helps = { cut: outside.canCut, move: outside.canMove, fit: true, allow: isDrawable };
  const choices = MODES.flatMap((choice) => (choice === mode || !helps[choice] ? [] : [CHOICES[choice]]));
  throw new PlotwrightError(
    "out-of-bounds",
    `The drawing leaves the paper of ${mmInWords(paper.widthMm)} × ${mmInWords(paper.heightMm)} mm: ` +
      `${count === 1 ? "1 stroke reaches" : `${count} strokes reach`} up to ${edges.join(" and ")}. ` +
      `Choose what happens to it with --outside, or "outside" in the settings: ${choices.join(", ")}. ` +
      `Or choose another paper.`,
  );
}

const MM_OF_EDGE = { left: "leftMm", upper: "topMm", right: "rightMm", lower: "bottomMm" } as const;

/** Whether a machine reaches all of a box, with a tolerance of 0.01 mm for rounding. */
export const isReached = (
  box: Box,
  { widthMm, heightMm }: Pick<MachineProfile, "widthMm" | "heightMm">,
): boolean => boxContains(grownBox({ x0: 0, y0: 0, x1: widthMm, y1: heightMm }, ROUNDING_MM), box);

/** How many strokes the machine does not reach, or reaches only in part. */
export function unreachedCount(
  strokes: StrokeSet,
  machine: Pick<MachineProfile, "widthMm" | "heightMm">,
): number {
  const { xy, offsets } = strokes;
  if (isReached(boxOfPoints(xy), machine)) return 0;
  let count = 0;
  for (let i = 0; i < strokeCount(strokes); i++) {
    if (!isReached(boxOfPoints(xy, 2 * offsets[i], 2 * offsets[i + 1]), machine)) count++;
  }
  return count;
}

/**
 * Checks that a machine reaches every stroke, with a tolerance of 0.01 mm for rounding. `planSvg` calls it; call it
 * yourself if you use the single steps.
 *
 * @throws PlotwrightError "out-of-bounds", with the figures
 */
export function checkBounds(
  strokes: StrokeSet,
  machine: Pick<MachineProfile, "name" | "widthMm" | "heightMm">,
): void {
  checkStrokes("checkBounds", strokes);
  const aMachine = 'a profile, for example machineById("axidraw-v3")';
  checkObject("checkBounds", "the machine", machine, ["widthMm", "heightMm"], aMachine);
  if (strokes.xy.length === 0) return;
  const box = boxOfPoints(strokes.xy);
  if (isReached(box, machine)) return;
  throw new PlotwrightError(
    "out-of-bounds",
    `The drawing reaches from ${pointInWords(box.x0, box.y0)} to ${pointInWords(box.x1, box.y1)} mm, but ${machine.name} ` +
      `can only go from (0, 0) to ${pointInWords(machine.widthMm, machine.heightMm)} mm: choose a smaller paper, ` +
      `turn the paper, or fit the drawing to it. If your plotter is larger, choose its model with --machine, or "machine" in the ` +
      `settings.`,
  );
}
