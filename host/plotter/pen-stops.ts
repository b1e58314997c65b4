/**
 * The places where a plot stops for a pen change, and which of these stops have been answered.
 *
 * The drawing is planned from stop to stop, so that each part ends at home with the pen up. A stop is due
 * when the plot is about to start or resume at or after its stroke. It is answered when the user resumes.
 */
import type { Place, StrokeSet } from "../../src/index.js";
import { penStopsOf, type PenStop } from "../../src/internal.js";
import type { PlotSettings, PlotWait } from "../../src/schema/index.js";

export class PenStops {
  readonly #stops: readonly PenStop[];
  /** Stops at or before this stroke have been answered. */
  #answeredTo: number;

  /** `from`: where an interrupted plot continues. Continuing answers the stop that the plot had reached. */
  constructor(strokes: StrokeSet, settings: PlotSettings, from: Place | null) {
    this.#stops = penStopsOf(strokes, settings);
    this.#answeredTo = from?.stroke ?? -1;
  }

  /** The strokes before which the plot goes home and waits. */
  get strokes(): readonly number[] {
    return this.#stops.map(({ strokeIndex }) => strokeIndex);
  }

  /** The pen to insert before the plot continues at a place; null if none. */
  due(place: Place | null): PlotWait | null {
    const stroke = place?.stroke ?? 0;
    const stop = this.#stops.filter(({ strokeIndex }) => strokeIndex <= stroke).at(-1);
    if (stop === undefined || stop.strokeIndex <= this.#answeredTo) return null;
    const { layerName, penName, color } = stop;
    return { kind: "pen", layerName, penName, color };
  }

  /** The user has inserted the pen that was due at a place. */
  answer(place: Place | null): void {
    this.#answeredTo = Math.max(this.#answeredTo, place?.stroke ?? 0);
  }

  /** The user has moved the place: a stop that is ahead again becomes due again. */
  moved(place: Place): void {
    this.#answeredTo = Math.min(this.#answeredTo, place.stroke);
  }

  /** The next stroke at which a plot from a place will wait; null if it runs to the end. */
  nextAfter(place: Place | null): number | null {
    const stroke = place?.stroke ?? 0;
    return this.#stops.find(({ strokeIndex }) => strokeIndex > stroke)?.strokeIndex ?? null;
  }
}
