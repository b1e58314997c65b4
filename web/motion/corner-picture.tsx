import { CORNER_RULES, type MotionMode } from "../../src/internal.js";

/**
 * A picture of how a mode draws a corner: the line, and dots at equal times. Close dots mean slow.
 *
 *   junction   slows down at the corner, almost to a stop          dots close together at the corner
 *   blend      a curve with constant acceleration                  dots evenly spaced along it
 *   scurve     the same curve, and the acceleration ramps          the spacing of the dots changes smoothly
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

/** Positions at equal times: on the straight from its end to the corner (or the curve), and along the curve, 0 … 1. */
interface Shares {
  readonly straight: readonly number[];
  readonly curve: readonly number[];
}
const ROUNDED: Shares = { straight: [0, 0.45, 0.85], curve: [0.18, 0.5, 0.82] };
const EXACT: Shares = { straight: [0, 0.36, 0.64, 0.84, 0.96], curve: [] };
/** Modes that differ from these two. */
const SHARES: Partial<Record<MotionMode, Shares>> = {
  scurve: { straight: [0, 0.42, 0.72, 0.91], curve: [0.1, 0.3, 0.5, 0.7, 0.9] },
};

const isExact = (mode: MotionMode): boolean => !CORNER_RULES[mode].isRounded;

const dotsOf = (mode: MotionMode): [number, number][] => {
  const [cornerX, cornerY] = CORNER;
  const { straight, curve } = SHARES[mode] ?? (isExact(mode) ? EXACT : ROUNDED);
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
