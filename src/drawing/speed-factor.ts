/** How fast a shape or stroke is drawn, as a share of the usual speed. */
export const MIN_SPEED_FACTOR = 0.01;

export const isSpeedFactor = (value: unknown): value is number =>
  typeof value === "number" && value >= MIN_SPEED_FACTOR && value <= 1;
