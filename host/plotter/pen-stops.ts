/**
 * The places where a plot stops for a pen change, and which of these stops have been answered.
 *
 * The drawing is planned from stop to stop, so that each part ends at home with the pen up. A stop is due
 * when the plot is about to start or resume at or after its stroke. It is answered when the user resumes.
 */
import type { StrokePosition, StrokeSet } from "../../src/index.js";
import { penStopsOf, type PenStop } from "../../src/internal.js";
import type { PlotSettings, PlotWait } from "../../src/schema/index.js";

export class PenStops {
  private readonly stops: readonly PenStop[];
  /** The stop answered last: its pen is in the holder. */
  private answered: PenStop | undefined;

  /** `from`: where an interrupted plot continues. Continuing answers the stop that the plot had reached. */
  constructor(strokes: StrokeSet, settings: PlotSettings, from: StrokePosition | null) {
    this.stops = penStopsOf(strokes, settings);
    if (from !== null) this.answer(from);
  }

  /** The strokes before which the plot goes home and waits. */
  get strokes(): readonly number[] {
    return this.stops.map(({ strokeIndex }) => strokeIndex);
  }

  /** The pen to insert before the plot continues at a place; null if none. */
  due(place: StrokePosition | null): PlotWait | null {
    const stop = this.reached(place);
    if (stop === undefined || stop === this.answered) return null;
    const { layerName, penName, color } = stop;
    return { kind: "pen", layerName, penName, color };
  }

  /** The user has inserted the pen that was due at a place. */
  answer(place: StrokePosition | null): void {
    this.answered = this.reached(place);
  }

  /**
   * The user has moved the place. If it moved back past a stop, that stop becomes due again when the plot reaches it,
   * and the pen of the stop before it is due now, unless it is in the holder.
   */
  moved(place: StrokePosition): void {
    const [stop, answered] = [this.reached(place), this.answered];
    if (answered === undefined || place.stroke >= answered.strokeIndex) return;
    if (stop === undefined || hasSamePen(stop, answered)) this.answered = stop;
  }

  /** The next stroke at which a plot from a place will wait; null if it runs to the end. */
  nextAfter(place: StrokePosition | null): number | null {
    const stroke = place?.stroke ?? 0;
    return this.stops.find(({ strokeIndex }) => strokeIndex > stroke)?.strokeIndex ?? null;
  }

  /** The last stop at or before a place. */
  private reached(place: StrokePosition | null): PenStop | undefined {
    const stroke = place?.stroke ?? 0;
    return this.stops.filter(({ strokeIndex }) => strokeIndex <= stroke).at(-1);
  }
}

const hasSamePen = (a: PenStop, b: PenStop): boolean =>
  a.penName === null ? a.layerId === b.layerId : a.penName === b.penName;
