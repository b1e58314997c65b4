/**
 * Draws the newest frame that was asked for, in parts small enough that neither the page nor a newer frame waits:
 *
 *   quick enough            whole
 *   not quick enough        coarse ── rest ── whole, in parts       a newer frame ends the rest and the whole, not
 *                                                                   the coarse: under a moving hand it is always shown
 *
 * At most one part is with the card at a time. Runs in the drawing worker, or on the page where there can be none.
 */
import { Pace } from "./pace.js";
import type { Detail, Frame, Picture, SceneRenderer } from "./renderer.js";

/** A view that has not been moved for so long rests. */
const REST_MS = 120;

export interface PainterClock {
  nowMs(): number;
  /** Lets messages in; resolves at the earliest after `ms`. */
  wait(ms: number): Promise<void>;
}

export class Painter {
  readonly #clock: PainterClock;
  readonly #onPicture: (frame: Frame, isWhole: boolean) => void;
  readonly #pace = new Pace();
  #renderer: SceneRenderer | null = null;
  #scene: Picture | null = null;
  /** Not handed to the renderer yet. */
  #isSceneNew = false;
  #wanted: Frame | null = null;
  #newest: Frame | null = null;
  #isRunning = false;

  /** `onPicture` is called when the renderer has put a picture on its canvas. */
  constructor(clock: PainterClock, onPicture: (frame: Frame, isWhole: boolean) => void) {
    this.#clock = clock;
    this.#onPicture = onPicture;
  }

  /** Drawn with the next frame. */
  setScene(scene: Picture | null): void {
    this.#scene = scene;
    this.#isSceneNew = true;
  }

  show(frame: Frame): void {
    this.#newest = this.#wanted = frame;
    if (!this.#isRunning) void this.#run();
  }

  /** A renderer, or none for a while: what was asked for last is drawn with it. */
  setRenderer(renderer: SceneRenderer | null): void {
    this.#renderer = renderer;
    this.#isSceneNew = true;
    if (this.#newest && renderer) this.show(this.#newest);
  }

  close(): void {
    this.#wanted = null;
    this.#renderer?.close();
    this.#renderer = null;
  }

  async #run(): Promise<void> {
    this.#isRunning = true;
    try {
      while (this.#wanted && this.#renderer) {
        const frame = this.#wanted;
        this.#wanted = null;
        if (this.#isSceneNew) this.#renderer.setScene(this.#scene);
        this.#isSceneNew = false;
        await this.#paint(this.#renderer, frame);
      }
    } finally {
      this.#isRunning = false;
    }
  }

  async #paint(renderer: SceneRenderer, frame: Frame): Promise<void> {
    const isOver = (): boolean => this.#renderer !== renderer || this.#isSceneNew;
    const isOld = (): boolean => isOver() || this.#wanted !== null;
    const count = renderer.begin(frame, "whole");
    if (this.#pace.isQuick(count)) return this.#draw(renderer, frame, "whole", isOver);
    if (renderer.begin(frame, "coarse") === count) return this.#draw(renderer, frame, "whole", isOver);
    await this.#draw(renderer, frame, "coarse", isOver);
    await this.#rest(isOld);
    if (isOld()) return;
    renderer.begin(frame, "whole");
    await this.#draw(renderer, frame, "whole", isOld);
  }

  /** Draws what the renderer has begun, and shows it unless that is given up. */
  async #draw(
    renderer: SceneRenderer,
    frame: Frame,
    detail: Detail,
    isGivenUp: () => boolean,
  ): Promise<void> {
    do {
      const beganMs = this.#clock.nowMs();
      const drawn = renderer.advance(this.#pace.part);
      do await this.#clock.wait(0);
      while (!renderer.isIdle());
      if (isGivenUp()) return;
      this.#pace.took(drawn, this.#clock.nowMs() - beganMs);
    } while (!renderer.isFinished);
    renderer.present();
    this.#onPicture(frame, detail === "whole");
  }

  async #rest(isEnded: () => boolean): Promise<void> {
    const untilMs = this.#clock.nowMs() + REST_MS;
    while (!isEnded() && this.#clock.nowMs() < untilMs) await this.#clock.wait(16);
  }
}
