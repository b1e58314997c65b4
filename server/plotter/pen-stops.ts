/**
 * Where a plot waits for another pen, and which of these stops have been answered.
 *
 * The drawing is planned from stop to stop, so that each part ends at home with the pen up. A stop is due when the
 * plot is about to go on at its stroke or behind it, and is answered by going on.
 */
import { penStopsOf, type PenStop, type Place, type StrokeSet } from "../../src/index.js";
import type { PlotSettings, PlotWait } from "../../src/schema/index.js";

export class PenStops {
  private readonly stops: readonly PenStop[];
  /** Stops at this stroke and before have been answered. */
  private answeredTo: number;

  /** `from`: where the plot was taken up. Whoever takes up a job answers the stop that it had come to. */
  constructor(strokes: StrokeSet, settings: PlotSettings, from: Place | null) {
    this.stops = penStopsOf(strokes, settings);
    this.answeredTo = from?.stroke ?? -1;
  }

  /** The strokes before which the plot walks home and waits. */
  get strokes(): readonly number[] {
    return this.stops.map(({ strokeIndex }) => strokeIndex);
  }

  /** What has to be put in before the plot goes on at a place; null for nothing. */
  due(place: Place | null): PlotWait | null {
    const stroke = place?.stroke ?? 0;
    const stop = this.stops.filter(({ strokeIndex }) => strokeIndex <= stroke).at(-1);
    if (stop === undefined || stop.strokeIndex <= this.answeredTo) return null;
    const { layerName, penName, color } = stop;
    return { kind: "pen", layerName, penName, color };
  }

  /** The user has done what was due at a place. */
  answer(place: Place | null): void {
    this.answeredTo = Math.max(this.answeredTo, place?.stroke ?? 0);
  }

  /** The place was moved by the user: a stop that lies ahead again will be asked for again. */
  moved(place: Place): void {
    this.answeredTo = Math.min(this.answeredTo, place.stroke);
  }

  /** The stroke before which a plot from a place waits next; null when it goes through to the end. */
  nextAfter(place: Place | null): number | null {
    const stroke = place?.stroke ?? 0;
    return this.stops.find(({ strokeIndex }) => strokeIndex > stroke)?.strokeIndex ?? null;
  }
}
