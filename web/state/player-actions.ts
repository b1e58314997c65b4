/** Plays the plan in the preview: moves the shown moment at a multiple of real time, on every animation frame. */
import type { PageStore } from "./store.js";

export const createPlayerActions = (store: PageStore) => {
  let request = 0;
  let lastMs = 0;
  const totalS = (): number => store.getState().planned?.trajectory.totalS ?? 0;

  const onFrame = (nowMs: number): void => {
    const { momentS, playRate, isPlaying } = store.getState();
    if (!isPlaying) return;
    const next = (momentS ?? 0) + (Math.max(0, nowMs - lastMs) / 1_000) * playRate;
    lastMs = nowMs;
    if (next >= totalS()) {
      store.setState({ momentS: null, isPlaying: false });
      return;
    }
    store.setState({ momentS: next });
    request = requestAnimationFrame(onFrame);
  };

  const play = (): void => {
    const { planned, momentS } = store.getState();
    if (!planned) return;
    store.setState({ isPlaying: true, momentS: momentS ?? 0 });
    lastMs = performance.now();
    request = requestAnimationFrame(onFrame);
  };
  const stopPlaying = (): void => {
    cancelAnimationFrame(request);
    store.setState({ isPlaying: false });
  };

  return {
    togglePlaying: (): void => (store.getState().isPlaying ? stopPlaying() : play()),
    stopPlaying,
    setPlayRate: (playRate: number): void => store.setState({ playRate }),
    /** Shows the moment `tS`; null, or the end, shows the whole plot. */
    seek: (tS: number | null): void =>
      store.setState({ momentS: tS === null || tS >= totalS() ? null : Math.max(0, tS) }),
  };
};
