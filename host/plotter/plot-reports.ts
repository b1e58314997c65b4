/** What a running plot reports: its progress to the listeners, its place to the journal, a blot to the user. */
import type { StrokePosition } from "../../src/index.js";
import {
  AHEAD_STEP_MS,
  machineOf,
  type Machine,
  type Playback,
  type PlotProgress,
} from "../../src/internal.js";
import { BLOT_S, restedWhileStalled } from "./plotter-state.js";
import type { JournalEntry, PlotStart, ReportedProgress } from "./plotter-port.js";
import { JOURNAL_S, PROGRESS_S, SENT_SINCE_S } from "./resume-position.js";
import type { LiveSettings } from "./live-settings.js";

/** Moments in a report of progress: enough until the next one arrives. */
const AHEAD_COUNT = 20;

export class PlotReports {
  private readonly listeners: ((report: ReportedProgress) => void)[] = [];
  private journalDueS = -Infinity;
  private stopTicking: () => void = () => undefined;

  constructor(
    private readonly machine: Machine,
    private readonly stream: Playback,
    private readonly settings: LiveSettings,
    private readonly start: Pick<PlotStart, "journal" | "noted"> & { readonly run: number },
  ) {}

  /** If there has been progress already, the listener learns the latest now. */
  onProgress(listener: (report: ReportedProgress) => void): void {
    this.listeners.push(listener);
    if (this.stream.progress.latest) listener(this.reportOf(this.stream.progress.latest));
  }

  progressed(progress: PlotProgress, ahead?: ReportedProgress["ahead"]): void {
    const report = this.reportOf(progress, ahead);
    for (const listener of this.listeners) listener(report);
  }

  /** The machine begins to play a plan: from now on the plot no longer rests at the journal's place. */
  streamBegun(): void {
    this.journalDueS = -Infinity;
    this.stopTicking = this.tick();
  }

  /** `place`: the first one not drawn, if the machine knows it. */
  streamEnded(place: StrokePosition | null): void {
    this.stopTicking();
    const left = place ?? this.stream.progress.place;
    // A board that still knows its position is at rest there.
    this.writeJournal(left, this.machine.state ? undefined : this.stream.receivedPlace);
  }

  /** `received`: as in a `JournalEntry`. Without a place nothing is written. */
  writeJournal(place: StrokePosition | null, received?: StrokePosition): void {
    const { latest } = this.stream.progress;
    const { clock, speed } = this.machine;
    this.journalDueS = clock.nowS() + JOURNAL_S * speed;
    if (!place) return;
    const { xMm, yMm, penUp, elapsedS } = latest ?? this.initialProgress();
    const aheadS = this.stream.sentAheadS?.(SENT_SINCE_S * speed);
    const { run } = this.start;
    this.start.journal?.record({ place, received, aheadS, run, xMm, yMm, penUp, elapsedS });
  }

  /** The progress before anything has been streamed. */
  initialProgress(): Omit<JournalEntry, "place"> {
    const { x, y } = this.machine.positionMm(machineOf(this.settings.current)) ?? { x: 0, y: 0 };
    return { xMm: x, yMm: y, penUp: this.machine.penUp ?? true, elapsedS: 0 };
  }

  private reportOf(progress: PlotProgress, ahead: ReportedProgress["ahead"] = []): ReportedProgress {
    const { clock, speed } = this.machine;
    return { ...progress, atMs: (1_000 * clock.nowS()) / speed, ahead };
  }

  private tick(): () => void {
    const { clock, speed } = this.machine;
    let cancel = (): void => undefined;
    let lastS = clock.nowS();
    const next = (): void => {
      const now = this.stream.now();
      const stalledS = (clock.nowS() - lastS) / speed;
      lastS = clock.nowS();
      if (now) {
        // The replies that came meanwhile are read first: they tell how far the board has drawn.
        if (!now.penUp && stalledS >= BLOT_S) clock.after(0, () => this.noteStall(stalledS));
        this.progressed(now, this.stream.ahead((AHEAD_STEP_MS / 1_000) * speed, AHEAD_COUNT));
        if (clock.nowS() >= this.journalDueS) {
          this.writeJournal(this.stream.progress.place, this.stream.receivedPlace);
        }
      }
      cancel = clock.after(PROGRESS_S * speed, next);
    };
    next();
    return () => cancel();
  }

  private noteStall(stalledS: number): void {
    const now = this.stream.now();
    if (now && !now.penUp) this.start.noted?.(restedWhileStalled(now, stalledS));
  }
}
