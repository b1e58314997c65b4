import { useEffect, useRef, type RefObject } from "react";
import { listenForGestures } from "../preview/gestures.js";
import { Stage } from "../preview/stage.js";
import { previewText } from "../preview/text.js";
import { watchedJob, type PageState, type PageStore } from "../state/store.js";
import { usePageState, usePageStore } from "../state/use-store.js";
import { Icon, type IconName } from "../ui/icon.js";
import { deskOf } from "../preview/desk.js";
import { lookOfJob, markerOfJob } from "./watch-look.js";
import { FullScreenButton } from "./full-screen.js";
import { watchText } from "./text.js";

const words = watchText;
const ZOOM_STEP = 1.5;

/** The sheet on the plotter: what is drawn in the pens' colours and widths, what is left pale, and the pen. */
export const WatchSheet = () => {
  const box = useRef<HTMLDivElement>(null);
  const desk = useRef<HTMLCanvasElement>(null);
  const strokes = useRef<HTMLCanvasElement>(null);
  const overlay = useRef<HTMLCanvasElement>(null);
  const stage = useStage(box, desk, strokes, overlay);
  return (
    <section className="preview" aria-label={words.sheet}>
      <div className="stage" ref={box} tabIndex={0} role="group" aria-label={previewText.hint}>
        <canvas ref={desk} aria-hidden="true" />
        <canvas ref={strokes} role="img" aria-label={words.canvas} />
        <canvas ref={overlay} aria-hidden="true" />
      </div>
      <Nothing />
      <div className="preview-tools">
        <Tool icon="minus" label={previewText.zoomOut} onClick={() => stage.current?.zoomBy(1 / ZOOM_STEP)} />
        <Tool icon="plus" label={previewText.zoomIn} onClick={() => stage.current?.zoomBy(ZOOM_STEP)} />
        <Tool icon="fit" label={previewText.fitPaper} onClick={() => stage.current?.fit()} />
        <FullScreenButton />
      </div>
    </section>
  );
};

interface ToolProps {
  readonly icon: IconName;
  readonly label: string;
  onClick(): void;
}

const Tool = ({ icon, label, onClick }: ToolProps) => (
  <button type="button" className="tool" aria-label={label} title={label} onClick={onClick}>
    <Icon name={icon} />
  </button>
);

/** Makes the stage once, and hands it whatever of the state it shows. */
const useStage = (
  box: RefObject<HTMLDivElement | null>,
  desk: RefObject<HTMLCanvasElement | null>,
  strokes: RefObject<HTMLCanvasElement | null>,
  overlay: RefObject<HTMLCanvasElement | null>,
): RefObject<Stage | null> => {
  const store = usePageStore();
  const stage = useRef<Stage | null>(null);
  useEffect(() => {
    if (!box.current || !desk.current || !strokes.current || !overlay.current) return;
    const canvases = {
      box: box.current,
      desk: desk.current,
      strokes: strokes.current,
      overlay: overlay.current,
    };
    const state = store.getState();
    const made = new Stage(canvases, deskOf(settingsOf(state), state.view.lengthUnit), lookOf(state));
    const stopShowing = showState(made, store);
    const stopGestures = listenForGestures(box.current, {
      view: () => made.view,
      setView: (view) => made.setView(view),
      fit: () => made.fit(),
      // Nothing on this sheet can be moved or asked about.
      grab: () => null,
      nudge: () => false,
      hover: () => undefined,
      tap: () => undefined,
    });
    const scheme = matchMedia("(prefers-color-scheme: dark)");
    const recolor = (): void => made.recolor();
    scheme.addEventListener("change", recolor);
    stage.current = made;
    return () => {
      scheme.removeEventListener("change", recolor);
      stopGestures();
      stopShowing();
      made.close();
      stage.current = null;
    };
  }, [store, box, desk, strokes, overlay]);
  return stage;
};

const settingsOf = (state: PageState): PageState["settings"] => watchedJob(state)?.settings ?? state.settings;

const plannedOf = (state: PageState) => (watchedJob(state) ? (state.watchPlan?.planned ?? null) : null);

const lookOf = (state: PageState) => lookOfJob(watchedJob(state), plannedOf(state), state.live);

const showState = (stage: Stage, store: PageStore): (() => void) => {
  const show = (state: PageState, before: PageState | null): void => {
    const planned = plannedOf(state);
    if (!before || planned !== plannedOf(before))
      stage.setScene(planned?.scene ?? null, planned?.picture ?? null);
    if (!before || settingsOf(state) !== settingsOf(before))
      stage.setDesk(deskOf(settingsOf(state), state.view.lengthUnit));
    if (state.watchPlan !== before?.watchPlan || state.live !== before?.live || state.jobs !== before.jobs) {
      stage.setLook(lookOf(state));
    }
    if (state.view.theme !== before?.view.theme) stage.recolor();
    stage.setMarker(markerOfJob(state, watchedJob(state)));
  };
  show(store.getState(), null);
  return store.subscribe(show);
};

/** Why the sheet is empty. */
const Nothing = () => {
  const job = usePageState(watchedJob);
  const plan = usePageState((state) => state.watchPlan);
  if (!job) {
    return (
      <div className="paper-message">
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
