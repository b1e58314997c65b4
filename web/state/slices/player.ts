/** The moment of the plan that the preview shows. Its actions: ../player-actions.ts. */

export interface PlayerSlice {
  /** The shown moment of the plan, s; null for the whole plot (or the live one). */
  readonly momentS: number | null;
  readonly isPlaying: boolean;
  /** A drawing that was just opened appears in the order of its strokes. */
  readonly isDrawingItself: boolean;
  readonly playRate: number;
}

export const PLAYER_AT_FIRST = {
  momentS: null,
  isPlaying: false,
  isDrawingItself: false,
  playRate: 10,
} as const satisfies Partial<PlayerSlice>;
