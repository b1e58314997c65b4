/** What the colours of the strokes mean. */
export const COLOR_MODES = ["speed", "order", "layer", "pen", "ink"] as const;
export type ColorMode = (typeof COLOR_MODES)[number];
