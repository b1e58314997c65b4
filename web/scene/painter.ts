/**
 * Draws the newest requested frame, in parts so small that they do not delay the page or a newer frame:
 *
 *   quick drawing     whole
 *   slow drawing      coarse ── rest ── whole, in parts
 *
 * A newer frame ends the rest and the whole picture, but not the coarse one, which is always shown while the view
 * moves. At most one part at a time is sent to the card. Runs in the drawing worker, or on the page if workers can't
 * draw.
 */
import type { Detail, Frame, Picture, SceneRenderer } from "./renderer.js";

/** The view rests when it has not moved for this time. */
const REST_MS = 120;

export interface PainterClock {
  nowMs(): number;
  /** Resolves after `ms` or later. Messages are handled meanwhile. */
  wait(ms: number): Promise<void>;
}

export class Painter {
  private readonly pace = new Pace();
  private renderer: SceneRenderer | null = null;
  private scene: Picture | null = null;
  /** The scene was not passed to the renderer yet. */
  private isSceneNew = false;
  private wanted: Frame | null = null;
  private newest: Frame | null = null;
  private isRunning = false;

  /** `onPicture` is called when a picture is on the canvas. */
  constructor(
    private readonly clock: PainterClock,
    private readonly onPicture: (frame: Frame, isWhole: boolean) => void,
  ) {}

  /** The scene is drawn with the next frame. */
  setScene(scene: Picture | null): void {
    this.scene = scene;
    this.isSceneNew = true;
  }

  show(frame: Frame): void {
    this.newest = this.wanted = frame;
    if (!this.isRunning) void this.run();
  }

  /** Sets the renderer, which draws the last requested frame; null: none for a while. */
  setRenderer(renderer: SceneRenderer | null): void {
    this.renderer = renderer;
    this.isSceneNew = true;
    if (this.newest && renderer) this.show(this.newest);
  }

  close(): void {
    this.wanted = null;
    this.renderer?.close();
    this.renderer = null;
  }

  private async run(): Promise<void> {
    this.isRunning = true;
    try {
      while (this.wanted && this.renderer) {
        const frame = this.wanted;
        this.wanted = null;
        if (this.isSceneNew) this.renderer.setScene(this.scene);
        this.isSceneNew = false;
        await this.paint(this.renderer, frame);
      }
    } finally {
      this.isRunning = false;
    }
  }

  private async paint(renderer: SceneRenderer, frame: Frame): Promise<void> {
    const isOver = (): boolean => this.renderer !== renderer || this.isSceneNew;
    const isOld = (): boolean => isOver() || this.wanted !== null;
    const count = renderer.begin(frame, "whole");
    if (this.pace.isQuick(count)) return this.draw(renderer, frame, "whole", isOver);
    if (renderer.begin(frame, "coarse") === count) return this.draw(renderer, frame, "whole", isOver);
    await this.draw(renderer, frame, "coarse", isOver);
    await this.rest(isOld);
    if (isOld()) return;
    renderer.begin(frame, "whole");
    await this.draw(renderer, frame, "whole", isOld);
  }

  /** Draws the picture that the renderer has begun, and shows it unless `isGivenUp`. */
  private async draw(
    renderer: SceneRenderer,
    frame: Frame,
    detail: Detail,
    isGivenUp: () => boolean,
  ): Promise<void> {
    do {
      const beganMs = this.clock.nowMs();
      const drawn = renderer.advance(this.pace.part);
      do await this.clock.wait(0);
      while (!renderer.isIdle());
      if (isGivenUp()) return;
      this.pace.took(drawn, this.clock.nowMs() - beganMs);
    } while (!renderer.isFinished);
    renderer.present();
    this.onPicture(frame, detail === "whole");
  }

  private async rest(isEnded: () => boolean): Promise<void> {
    const untilMs = this.clock.nowMs() + REST_MS;
    while (!isEnded() && this.clock.nowMs() < untilMs) await this.clock.wait(16);
  }
}

/** Target time of a part: short enough not to delay the page or a newer picture. */
const PART_MS = 30;
/** A picture that takes no longer is drawn in one part. */
const QUICK_MS = 45;
const FIRST_GUESS = 400;
const MIN_PIECES_PER_MS = 10;
/** One measurement changes the estimate by at most this factor, because something else may have disturbed it. */
const MAX_STEP = 4;

/**
 * Measures how many pieces are drawn in a given time. Decides whether a picture is drawn in one part, and how large its
 * parts are otherwise. Has to be measured, because it varies by a factor of a thousand with the graphics card.
 */
class Pace {
  private piecesPerMs = FIRST_GUESS;

  /** The number of pieces for one part. */
  get part(): number {
    return Math.round(this.piecesPerMs * PART_MS);
  }

  isQuick(pieceCount: number): boolean {
    return pieceCount <= this.piecesPerMs * QUICK_MS;
  }

  /**
   * Reports that a part of so many pieces took `ms`. A short time that is slower than the estimate is ignored, because
   * even one piece takes a turn of the event loop.
   */
  took(pieceCount: number, ms: number): void {
    const measured = pieceCount / Math.max(ms, 0.1);
    if (pieceCount === 0 || (measured < this.piecesPerMs && ms <= PART_MS)) return;
    const bounded = Math.min(this.piecesPerMs * MAX_STEP, Math.max(this.piecesPerMs / MAX_STEP, measured));
    this.piecesPerMs = Math.max(MIN_PIECES_PER_MS, bounded);
  }
}
