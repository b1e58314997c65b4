/** How the virtual Grbl reads G0 to G3, and queues them; an arc as the straight moves of which Grbl makes it. */
import { cutArc, type Arc } from "../model/arc-cut.js";
import type { Axes } from "../model/planner.js";
import type { Coordinates } from "./coordinates.js";
import { ERROR, type Modes } from "./gcode-words.js";
import type { GrblMotion } from "./motion.js";
import type { VirtualSettings } from "./virtual-settings.js";

type Words = ReadonlyMap<string, number>;

/** The radii at both ends of an arc may differ by less than one of these, and never by more than MAX_RADII_MM. */
const SAME_RADII_MM = 0.005;
const SAME_RADII_SHARE = 0.001;
const MAX_RADII_MM = 0.5;

interface MovesTarget {
  readonly settings: VirtualSettings;
  readonly motion: GrblMotion;
  readonly modes: Modes;
  readonly coordinates: Coordinates;
  /** It stops with ALARM:2. */
  softLimit(): void;
}

export class VirtualMoves {
  /** The moves of the current line that are not yet in the queue, and their feed; null: none. */
  private pending: { readonly ends: Axes[]; readonly feed: number } | null = null;
  /** Where the last line ended, as written. Steps are coarser. */
  private written: Axes = [0, 0, 0];

  constructor(private readonly board: MovesTarget) {}

  /** Returns 0 if the line is queued, an error code if it is refused, null if it has to wait. */
  take(modes: readonly string[], words: Words): number | null {
    const refusal = this.pending ? null : this.begin(modes, words);
    return refusal ?? this.queue(() => this.board.motion.isFull);
  }

  /** For a line that cannot wait. */
  takeAtOnce(modes: readonly string[], words: Words): void {
    if (this.begin(modes, words) === null) this.queue(() => false);
  }

  /** What is not in the queue never will be. */
  forget(): void {
    this.pending = null;
  }

  /** Null: there are moves to queue. */
  private begin(modes: readonly string[], words: Words): number | null {
    const { settings, modes: lasting, coordinates } = this.board;
    const isMove = words.has("X") || words.has("Y") || words.has("Z");
    const motion = lasting.motionOf(modes);
    const isArc = motion === "G2" || motion === "G3";
    if (isArc && !settings.takesArcs) return ERROR.unknown;
    const feed = words.get("F") ?? lasting.feed;
    if (isMove && motion !== "G0" && feed === 0) return ERROR.noFeed;
    if (!isMove && isArc && modes.includes(motion)) return ERROR.noAxis;
    if (!isMove && words.size > (words.has("F") ? 1 : 0)) return ERROR.unused;
    const { from } = this;
    const to = coordinates.target(words, from);
    const arc = isMove && isArc ? arcOf(words, from, to, motion === "G2") : null;
    if (typeof arc === "number") return arc;
    lasting.motion = motion;
    lasting.feed = feed;
    if (!isMove) return 0;
    const ends = arc ? cutArc(arc, from, to, settings.arcToleranceMm) : [to];
    this.pending = { ends, feed: motion === "G0" ? Infinity : feed / 60 };
    return null;
  }

  private queue(isFull: () => boolean): number | null {
    const { pending } = this;
    const { settings, motion, coordinates } = this.board;
    while (pending && pending.ends.length > 0) {
      if (isFull()) return null;
      const to = coordinates.onSteps(pending.ends[0]);
      if (settings.isBeyond(to)) {
        // It comes to rest first; here at once.
        this.board.softLimit();
        return null;
      }
      if (to.some((value, i) => value !== motion.end[i])) motion.queue(to, pending.feed);
      this.written = pending.ends.shift()!;
    }
    this.pending = null;
    return 0;
  }

  /** Where the next move begins. After a stop the carriage is elsewhere. */
  private get from(): Axes {
    const { end } = this.board.motion;
    return this.board.coordinates.onSteps(this.written).every((mm, i) => mm === end[i]) ? this.written : end;
  }
}

/** An error code if Grbl refuses it. */
function arcOf(words: Words, from: Axes, to: Axes, clockwise: boolean): Arc | number {
  if (!words.has("X") && !words.has("Y")) return ERROR.noPlaneAxis;
  const [dx, dy] = [to[0] - from[0], to[1] - from[1]];
  const radius = words.get("R");
  if (radius !== undefined) {
    const chord = Math.hypot(dx, dy);
    if (chord === 0) return ERROR.badTarget;
    const high2 = radius ** 2 - (chord / 2) ** 2;
    if (high2 < 0) return ERROR.badRadius;
    // The centre is to the left of the chord of a short arc that turns to the left. A negative radius means the long arc.
    const left = (Math.sqrt(high2) / chord) * (clockwise === radius > 0 ? -1 : 1);
    return { i: dx / 2 - dy * left, j: dy / 2 + dx * left, clockwise };
  }
  if (!words.has("I") && !words.has("J")) return ERROR.noCentre;
  const [i, j] = [words.get("I") ?? 0, words.get("J") ?? 0];
  const own = Math.hypot(i, j);
  const offMm = Math.abs(Math.hypot(dx - i, dy - j) - own);
  if (offMm > MAX_RADII_MM || (offMm > SAME_RADII_MM && offMm > SAME_RADII_SHARE * own))
    return ERROR.badTarget;
  return { i, j, clockwise };
}
