/** Plays the plan in the preview: moves the shown moment at a multiple of real time, on every animation frame. */
import type { PageStore } from "../state/store.js";

export const PLAY_RATES = [1, 2, 5, 10, 20, 50, 100] as const;

export class Player {
  readonly #store: PageStore;
  #request = 0;
  #lastMs = 0;

  constructor(store: PageStore) {
    this.#store = store;
  }

  toggle(): void {
    if (this.#store.getState().isPlaying) this.pause();
    else this.#play();
  }

  pause(): void {
    cancelAnimationFrame(this.#request);
    this.#store.setState({ isPlaying: false });
  }

  /** Shows the moment `tS`; null, or the end, shows the whole plot. */
  seek(tS: number | null): void {
    const totalS = this.#totalS();
    this.#store.setState({ momentS: tS === null || tS >= totalS ? null : Math.max(0, tS) });
  }

  #play(): void {
    const { planned, momentS } = this.#store.getState();
    if (!planned) return;
    this.#store.setState({ isPlaying: true, momentS: momentS ?? 0 });
    this.#lastMs = performance.now();
    this.#request = requestAnimationFrame(this.#onFrame);
  }

  #totalS(): number {
    return this.#store.getState().planned?.trajectory.totalS ?? 0;
  }

  readonly #onFrame = (nowMs: number): void => {
    const { momentS, playRate, isPlaying } = this.#store.getState();
    if (!isPlaying) return;
    const next = (momentS ?? 0) + (Math.max(0, nowMs - this.#lastMs) / 1_000) * playRate;
    this.#lastMs = nowMs;
    if (next >= this.#totalS()) {
      this.#store.setState({ momentS: null, isPlaying: false });
      return;
    }
    this.#store.setState({ momentS: next });
    this.#request = requestAnimationFrame(this.#onFrame);
  };
}
