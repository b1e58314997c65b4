/** What the colours of the strokes mean. */
export const COLOR_MODES = ["speed", "ink", "layer", "order", "pen", "swing"] as const;
export type ColorMode = (typeof COLOR_MODES)[number];
