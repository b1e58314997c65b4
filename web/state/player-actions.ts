/** Plays the plan in the preview: moves the shown moment at a multiple of real time, on every animation frame. */
import type { PageStore } from "./store.js";

/** In this time a drawing that was opened draws itself. */
const DRAWS_ITSELF_MS = 2_500;

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
    store.setState({ isPlaying: true, isDrawingItself: false, momentS: momentS ?? 0 });
    lastMs = performance.now();
    request = requestAnimationFrame(onFrame);
  };
  const stopPlaying = (): void => {
    cancelAnimationFrame(request);
    store.setState({ isPlaying: false });
  };

  const drawItself = (): void => {
    const beganMs = performance.now();
    const { planned } = store.getState();
    const show = (nowMs: number): void => {
      const state = store.getState();
      if (!state.isDrawingItself || state.planned !== planned) return;
      const share = Math.max(0, nowMs - beganMs) / DRAWS_ITSELF_MS;
      if (share >= 1) return restAtEnd();
      store.setState({ momentS: share * totalS() });
      requestAnimationFrame(show);
    };
    store.setState({ isDrawingItself: true });
    show(beganMs);
  };
  const restAtEnd = (): void => {
    if (store.getState().isDrawingItself) store.setState({ isDrawingItself: false, momentS: null });
  };

  return {
    drawItself,
    /** Shows the whole drawing at once if it is still drawing itself. */
    restAtEnd,
    togglePlaying: (): void => (store.getState().isPlaying ? stopPlaying() : play()),
    stopPlaying,
    setPlayRate: (playRate: number): void => store.setState({ playRate }),
    /** Shows the moment `tS`; null, or the end, shows the whole plot. */
    seek: (tS: number | null): void =>
      store.setState({
        isDrawingItself: false,
        momentS: tS === null || tS >= totalS() ? null : Math.max(0, tS),
      }),
  };
};
