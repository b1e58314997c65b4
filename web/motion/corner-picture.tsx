import type { MotionMode } from "../../src/internal.js";

/**
 * What a mode does to a corner, drawn: the line, and dots at equal times, so that close dots mean slow.
 *
 *   junction   up to the corner, nearly to a stop, and away        dots crowd at a sharp corner
 *   blend      a curve of constant acceleration                    dots thin out evenly along it
 *   scurve     the same curve, speed changing softly               dots crowd and part without a jerk
 */
export const CornerPicture = ({ mode }: { mode: MotionMode }) => {
  const dots = dotsOf(mode);
  return (
    <svg className="corner-picture" viewBox="0 0 60 44" aria-hidden="true">
      <path d={isExact(mode) ? EXACT_PATH : ROUND_PATH} />
      {dots.map(([x, y]) => (
        <circle key={`${x} ${y}`} cx={x} cy={y} r="1.9" />
      ))}
    </svg>
  );
};

const CORNER: readonly [number, number] = [46, 36];
const START_X = 4;
const END_Y = 4;
const CURVE_FROM_X = 30;
const CURVE_TO_Y = 20;

const EXACT_PATH = `M${START_X} ${CORNER[1]}H${CORNER[0]}V${END_Y}`;
const ROUND_PATH = `M${START_X} ${CORNER[1]}H${CURVE_FROM_X}Q${CORNER[0]} ${CORNER[1]} ${CORNER[0]} ${CURVE_TO_Y}V${END_Y}`;

/** Shares of the way from an end to the corner (or to the curve), and along the curve, at equal times. */
interface Shares {
  readonly straight: readonly number[];
  readonly curve: readonly number[];
}
const ROUNDED: Shares = { straight: [0, 0.45, 0.85], curve: [0.18, 0.5, 0.82] };
/** A mode without an entry is drawn as rounded. */
const SHARES: Partial<Record<MotionMode, Shares>> = {
  junction: { straight: [0, 0.36, 0.64, 0.84, 0.96], curve: [] },
  scurve: { straight: [0, 0.42, 0.72, 0.91], curve: [0.1, 0.3, 0.5, 0.7, 0.9] },
};

const isExact = (mode: MotionMode): boolean => mode === "junction";

const dotsOf = (mode: MotionMode): [number, number][] => {
  const [cornerX, cornerY] = CORNER;
  const { straight, curve } = SHARES[mode] ?? ROUNDED;
  const endX = isExact(mode) ? cornerX : CURVE_FROM_X;
  const startY = isExact(mode) ? cornerY : CURVE_TO_Y;
  const before = straight.map((share): [number, number] => [START_X + share * (endX - START_X), cornerY]);
  const after = straight.map((share): [number, number] => [cornerX, END_Y + share * (startY - END_Y)]);
  return [...before, ...after, ...curve.map(onCurve)];
};

const onCurve = (t: number): [number, number] => [
  (1 - t) ** 2 * CURVE_FROM_X + (1 - (1 - t) ** 2) * CORNER[0],
  (1 - t * t) * CORNER[1] + t * t * CURVE_TO_Y,
];
