import type { Desk } from "../preview/backdrop.js";
import { ZoomTools } from "../preview/preview-tools.js";
import { Sheet, type SheetKind } from "../preview/sheet.js";
import type { OverlayPainter, ShownPen, Stage } from "../preview/stage.js";
import { previewText } from "../preview/text.js";
import { screenPoint } from "../scene/view.js";
import { watchedJob, type PageState, type PageStore } from "../state/store.js";
import { usePageState, usePageStore } from "../state/use-store.js";
import { deskOf, followPen } from "../preview/desk.js";
import { PenGlide } from "../preview/pen/pen-glide.js";
import { lookOfJob } from "./watch-look.js";
import { watchText as words } from "./text.js";
import { useEffect } from "react";
import { IconButton } from "../ui/button.js";

/** The sheet on the plotter: the drawn part in the pens' colours and widths, the rest pale, and the pen. */
export const WatchSheet = () => (
  <Sheet
    kind={WATCHED}
    label={words.sheet}
    pictureLabel={words.canvas}
    foot={(stage) => (
      <div className="preview-tools">
        <ZoomTools stage={stage} className="tool-zoom" />
        <FullScreenButton />
      </div>
    )}
  >
    <Nothing />
  </Sheet>
);

const settingsOf = (state: PageState): PageState["settings"] => watchedJob(state)?.settings ?? state.settings;

const plannedOf = (state: PageState) => (watchedJob(state) ? (state.watchPlan?.planned ?? null) : null);

const lookOf = (state: PageState) => lookOfJob(watchedJob(state), plannedOf(state), state.live);

const penOf = (state: PageState, glide: PenGlide): ShownPen | null => {
  const job = watchedJob(state);
  if (!job) return null;
  const colors = lookOf(state).layerColors;
  return { at: (nowMs) => glide.at(nowMs), colors, isDrawing: job.state === "plotting" };
};

/** Without the machine's reach, because a running plot is within it. */
const watchedDesk = (state: PageState): Desk => ({
  ...deskOf(settingsOf(state), state.view),
  reach: null,
});

const showState = (stage: Stage, store: PageStore): (() => void) => {
  const glide = new PenGlide();
  const show = (state: PageState, before: PageState | null): void => {
    const planned = plannedOf(state);
    stage.setScene(planned?.scene ?? null, planned?.picture ?? null);
    followPen(glide, state, before, performance.now());
    stage.setPen(penOf(state, glide));
    if (!before || settingsOf(state) !== settingsOf(before) || state.view !== before.view)
      stage.setDesk(watchedDesk(state));
    if (state.watchPlan !== before?.watchPlan || state.live !== before?.live || state.jobs !== before.jobs) {
      stage.setLook(lookOf(state));
    }
    if (state.placeMark !== before?.placeMark) stage.setPainter(placePainter(state), null);
    if (state.view.theme !== before?.view.theme) stage.recolor();
  };
  show(store.getState(), null);
  return store.subscribe(show);
};

const MARK_PX = 9;
/** The dark ring and the light ones beside it are seen on any ink. */
const RINGS = [
  ["#ffffff", 6],
  ["#1450ff", 2.5],
] as const;

/** Marks where a button would move the place of the paused plot. */
const placePainter =
  ({ placeMark }: PageState): OverlayPainter =>
  (context, view) => {
    if (!placeMark) return;
    const [x, y] = screenPoint(view, placeMark.xMm, placeMark.yMm);
    for (const [color, widthPx] of RINGS) {
      context.beginPath();
      context.arc(x, y, MARK_PX, 0, 2 * Math.PI);
      context.strokeStyle = color;
      context.lineWidth = widthPx;
      context.stroke();
    }
    context.beginPath();
    context.arc(x, y, 2.5, 0, 2 * Math.PI);
    context.fillStyle = "#1450ff";
    context.fill();
  };

/** Nothing on this sheet can be moved or selected. */
const WATCHED: SheetKind = {
  desk: watchedDesk,
  look: lookOf,
  keptFree: { abovePx: 0, belowPx: 0 },
  show: showState,
  hand: () => ({ grab: () => null, nudge: () => false, hover: () => undefined, tap: () => undefined }),
};

/** Why the sheet is empty. */
const Nothing = () => {
  const job = usePageState(watchedJob);
  const plan = usePageState((state) => state.watchPlan);
  if (!job) {
    return (
      <div className="paper-message paper-hint">
        <strong>{words.nothing}</strong>
        <p>{words.nothingHint}</p>
      </div>
    );
  }
  if (plan?.fault) {
    return (
      <div className="paper-message">
        <p>{words.cannotShow}</p>
        <p className="note">{plan.fault}</p>
      </div>
    );
  }
  if (plan?.planned) return null;
  return (
    <div className="paper-message" role="status">
      <p>{previewText.reading(job.name)}</p>
    </div>
  );
};

/** For a tablet beside the plotter: shows only the status, the sheet and the camera, and keeps the screen on. */
export const FullScreenButton = () => {
  const store = usePageStore();
  const isFull = usePageState((state) => state.isFullScreen);
  useEffect(() => {
    if (!isFull) return;
    // If the browser has no full screen (on a phone), Watch still fills the page.
    void document.documentElement.requestFullscreen?.().catch(() => undefined);
    const lock = "wakeLock" in navigator ? navigator.wakeLock.request("screen").catch(() => null) : null;
    const onChange = (): void => {
      if (document.fullscreenElement === null) store.setState({ isFullScreen: false });
    };
    document.addEventListener("fullscreenchange", onChange);
    return () => {
      document.removeEventListener("fullscreenchange", onChange);
      void lock?.then((held) => held?.release());
      if (document.fullscreenElement !== null) void document.exitFullscreen().catch(() => undefined);
    };
  }, [isFull, store]);
  const label = isFull ? words.endFullScreen : words.fullScreen;
  return (
    <IconButton
      kind="tool"
      icon="full"
      label={label}
      aria-pressed={isFull}
      onClick={() => store.setState({ isFullScreen: !isFull })}
    />
  );
};
