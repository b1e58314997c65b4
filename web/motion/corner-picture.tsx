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
      <path d={PATHS[mode]} />
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

const PATHS: Record<MotionMode, string> = {
  junction: `M${START_X} ${CORNER[1]}H${CORNER[0]}V${END_Y}`,
  blend: `M${START_X} ${CORNER[1]}H${CURVE_FROM_X}Q${CORNER[0]} ${CORNER[1]} ${CORNER[0]} ${CURVE_TO_Y}V${END_Y}`,
  scurve: `M${START_X} ${CORNER[1]}H${CURVE_FROM_X}Q${CORNER[0]} ${CORNER[1]} ${CORNER[0]} ${CURVE_TO_Y}V${END_Y}`,
};

/** Shares of the way from an end to the corner (or to the curve) at equal times. */
const SHARES: Record<MotionMode, readonly number[]> = {
  junction: [0, 0.36, 0.64, 0.84, 0.96],
  blend: [0, 0.45, 0.85],
  scurve: [0, 0.42, 0.72, 0.91],
};

const dotsOf = (mode: MotionMode): [number, number][] => {
  const [cornerX, cornerY] = CORNER;
  const endX = mode === "junction" ? cornerX : CURVE_FROM_X;
  const startY = mode === "junction" ? cornerY : CURVE_TO_Y;
  const before = SHARES[mode].map((share): [number, number] => [START_X + share * (endX - START_X), cornerY]);
  const after = SHARES[mode].map((share): [number, number] => [cornerX, END_Y + share * (startY - END_Y)]);
  return [...before, ...after, ...curveDots(mode)];
};

const curveDots = (mode: MotionMode): [number, number][] => {
  if (mode === "junction") return [];
  const shares = mode === "blend" ? [0.18, 0.5, 0.82] : [0.1, 0.3, 0.5, 0.7, 0.9];
  return shares.map((t) => [
    (1 - t) ** 2 * CURVE_FROM_X + (1 - (1 - t) ** 2) * CORNER[0],
    (1 - t * t) * CORNER[1] + t * t * CURVE_TO_Y,
  ]);
};
