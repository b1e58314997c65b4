/**
 * A drawing that is made on the page while the plotter draws it. The page has all strokes, and what the pen has drawn of
 * them; the plotter gets them over a live connection, which begins with the first stroke.
 *
 *   pointer ──> SmoothStroke ──> PaperEdge ──> strokes of this page, and of the plotter
 */
import { toSvg, type StrokePosition } from "../../../src/index.js";
import { machineOf, orientedPaper, type Box } from "../../../src/internal.js";
import type { Job, LiveProgress } from "../../../src/schema/index.js";
import type { Backend } from "../../backend/backend.js";
import type { Page } from "../../state/page-action.js";
import { currentPlotter, type HandDrawingState, type HandPen, type PageState } from "../../state/store.js";
import { formatClockIn } from "../../ui/format.js";
import { HandStrokes } from "./hand-strokes.js";
import { PaperEdge } from "./paper-edge.js";
import { SmoothStroke } from "./smooth-stroke.js";
import { drawText as words } from "./text.js";

const AT_FIRST: Omit<HandDrawingState, "pen"> = {
  phase: "ready",
  jobId: null,
  lagS: 0,
  waitingMm: 0,
  isBehind: false,
  hasRefused: false,
  hasLeftPaper: false,
  canUndo: false,
  fault: null,
};

type LiveConnection = Awaited<ReturnType<Backend["live"]>>;

/** No stroke begins while the pen is farther behind than this, until it is nearer than the second one, s. */
export const BEHIND_S = { most: 10, again: 5 } as const;
/** A stroke that is being drawn ends when the pen is so far behind, s. */
const STROKE_BEHIND_S = 30;

export class HandDrawing implements HandPen {
  /** What was drawn on the page, smoothed, within what the pen reaches. */
  readonly strokes = new HandStrokes();
  /** The first place that the pen has not drawn. */
  drawnTo: StrokePosition = { stroke: 0, alongMm: 0 };
  private readonly reach: Box;
  private live: LiveConnection | null = null;
  private isBeginning = false;
  /** The stroke under the pointer. */
  private hand: { readonly smooth: SmoothStroke; readonly edge: PaperEdge } | null = null;
  /** What was drawn while an undo is being answered. */
  private later: (() => void)[] | null = null;
  private readonly listeners = new Set<() => void>();

  constructor(private readonly page: Page) {
    this.reach = reachOf(page.store.getState());
  }

  /** Shows the mode, unless it was left while this part of the page was loaded. */
  open(): void {
    const { store } = this.page;
    if (store.getState().handDrawing === "opening")
      store.setState({ handDrawing: { ...AT_FIRST, pen: this } });
  }

  /** Calls `listener` after each change of what is drawn. Returns a function that stops this. */
  onChange(listener: () => void): () => void {
    this.listeners.add(listener);
    return () => this.listeners.delete(listener);
  }

  /** A stroke begins. False: it is refused, and the page says why. `pxPerMm`: of the sheet on the screen. */
  begin(pxPerMm: number): boolean {
    const { store } = this.page;
    const { phase, isBehind } = this.state;
    if (phase !== "ready" || isBehind) {
      this.show({ hasRefused: isBehind });
      return false;
    }
    const edge = new PaperEdge(this.reach, {
      lineTo: (x, y) => this.inOrder(() => this.lineTo(x, y)),
      penUp: () => this.inOrder(() => this.penUp()),
    });
    const level = store.getState().view.smoothingPct / 100;
    this.hand = { smooth: new SmoothStroke(level, pxPerMm, (x, y) => edge.lineTo(x, y)), edge };
    if (!this.live && !this.isBeginning) void this.beginLive();
    return true;
  }

  add(xMm: number, yMm: number, atMs: number): void {
    this.hand?.smooth.add(xMm, yMm, atMs);
    this.changed();
  }

  /** The pointer is up. */
  finishStroke(): void {
    if (!this.hand) return;
    const { smooth, edge } = this.hand;
    this.hand = null;
    smooth.finish();
    edge.penUp();
    this.show({ hasLeftPaper: edge.hasLeft });
  }

  /** Takes back the last stroke, as far as the pen has not drawn it. */
  async undo(): Promise<void> {
    this.finishStroke();
    const { live, strokes } = this;
    if (this.later || !this.canUndo) return;
    if (!live) {
      // Nothing is drawn yet, and what is left is sent when the drawing begins.
      strokes.takeBack(0);
      return this.show({});
    }
    this.later = [];
    try {
      const { takenBack, left } = await live.undo();
      if (takenBack > 0) strokes.takeBack(left);
    } catch {
      // The drawing has ended, which is shown.
    }
    const { later } = this;
    this.later = null;
    for (const one of later ?? []) one();
    this.show({});
  }

  /** The drawing is complete: the plotter draws the rest. */
  finish(): void {
    this.finishStroke();
    const hasBegun = this.live !== null || this.isBeginning;
    // What the plotter has refused to begin with is not lost.
    if (!hasBegun) return this.strokes.count > 0 ? this.keep() : this.leave();
    this.show({ phase: "finishing" });
    this.inOrder(() => this.live?.end());
  }

  /** Closes the mode. */
  leave(): void {
    this.page.store.setState({ handDrawing: null });
  }

  /** The whole drawing, with what did not reach the plotter, as a drawing in Prepare. */
  keep(): void {
    const { settings } = this.page.store.getState();
    const { widthMm, heightMm } = orientedPaper(settings.prepare.paper, settings.prepare.landscape);
    this.page.actions.openDrawing(jobName(), toSvg(this.strokes.drawing, { widthMm, heightMm }));
    this.leave();
  }

  private get state(): HandDrawingState {
    return handDrawingOf(this.page.store.getState()) ?? { ...AT_FIRST, pen: this };
  }

  private get canUndo(): boolean {
    const { strokes, drawnTo } = this;
    const last = strokes.count - 1;
    if (last < 0 || drawnTo.stroke > last) return false;
    return drawnTo.stroke < last || drawnTo.alongMm === 0 || drawnTo.alongMm < strokes.lengthOf(last);
  }

  private get waitingMm(): number {
    const { strokes, drawnTo } = this;
    let mm = -drawnTo.alongMm;
    for (let stroke = drawnTo.stroke; stroke < strokes.count; stroke++) mm += strokes.lengthOf(stroke);
    return Math.max(0, mm);
  }

  private inOrder(one: () => void): void {
    if (this.later) this.later.push(one);
    else one();
  }

  private lineTo(x: number, y: number): void {
    if (this.strokes.lineTo(x, y)) this.live?.lineTo(x, y);
  }

  private penUp(): void {
    this.strokes.penUp();
    this.live?.penUp();
  }

  /** The plotter begins with what is drawn until then. */
  private async beginLive(): Promise<void> {
    const { actions, backend, store } = this.page;
    const { settings } = store.getState();
    const plotterId = currentPlotter(store.getState())?.id;
    this.isBeginning = true;
    const live =
      plotterId === undefined
        ? null
        : await actions.attempt("draw", () => backend.live(plotterId, { name: jobName(), settings }));
    this.isBeginning = false;
    // Why it can't begin is shown. What is drawn stays on the page, and the next stroke tries again.
    if (!live) return this.show({ phase: "ready" });
    this.live = live;
    live.onReport((report) => {
      if (report.type === "progress") this.progressed(report);
    });
    this.show({ jobId: live.job.id });
    this.sendAll(live);
    if (this.state.phase === "finishing") live.end();
    live.ended.then(
      (job) => this.ended(job),
      (error: unknown) => this.broken(error instanceof Error ? error.message : String(error)),
    );
  }

  private sendAll(live: LiveConnection): void {
    const { strokes } = this;
    for (let stroke = 0; stroke < strokes.count; stroke++) {
      const isLast = stroke === strokes.count - 1;
      for (const [x, y] of strokes.pointsOf(stroke)) live.lineTo(x, y);
      if (!isLast || !strokes.isOpen) live.penUp();
    }
  }

  private progressed({ drawnTo, lagMs, state }: LiveProgress): void {
    const lagS = lagMs / 1_000;
    this.drawnTo = { stroke: drawnTo.strokeIndex, alongMm: drawnTo.alongMm };
    // A pen that the user has stopped is not too slow.
    const isPaused = state === "paused";
    const isBehind = !isPaused && lagS > (this.state.isBehind ? BEHIND_S.again : BEHIND_S.most);
    const isTooFar = !isPaused && this.hand !== null && lagS > STROKE_BEHIND_S;
    if (isTooFar) this.finishStroke();
    this.show({
      lagS,
      isBehind,
      ...(isTooFar && { hasRefused: true }),
      ...(!isBehind && { hasRefused: false }),
    });
  }

  private ended(job: Job): void {
    if (job.state === "interrupted" || job.state === "failed") return this.broken(job.message ?? "");
    this.live = null;
    this.page.store.setState({ watchedId: job.id });
    this.leave();
  }

  private broken(fault: string): void {
    this.finishStroke();
    this.live = null;
    this.show({ phase: "broken", fault: words.ended(fault) });
  }

  private show(change: Partial<HandDrawingState>): void {
    const { store } = this.page;
    const { canUndo, waitingMm } = this;
    if (handDrawingOf(store.getState()))
      store.setState({ handDrawing: { ...this.state, canUndo, waitingMm, ...change } });
    this.changed();
  }

  private changed(): void {
    for (const listener of this.listeners) listener();
  }
}

/** Null: it is not shown. */
export const handDrawingOf = ({ handDrawing }: PageState): HandDrawingState | null =>
  handDrawing === "opening" ? null : handDrawing;

/** The part of the paper that the machine reaches, mm from home. */
const reachOf = ({ settings }: PageState): Box => {
  const { widthMm, heightMm } = orientedPaper(settings.prepare.paper, settings.prepare.landscape);
  const machine = machineOf(settings);
  return { x0: 0, y0: 0, x1: Math.min(widthMm, machine.widthMm), y1: Math.min(heightMm, machine.heightMm) };
};

const jobName = (): string => words.jobName(formatClockIn(Date.now(), 0));
