import { useEffect, useRef, useState, type ReactNode, type RefObject } from "react";
import type { PageState, PageStore } from "../state/store.js";
import { useActions, usePageState, usePageStore } from "../state/use-store.js";
import type { Actions } from "../state/actions.js";
import type { Desk } from "./backdrop.js";
import { listenForGestures, type GestureTarget } from "./gestures.js";
import { Stage, type FrameLook, type KeptFree } from "./stage.js";
import { TURN_DESK } from "./preview-actions.js";
import { previewText } from "./text.js";
import { ActionButton } from "../ui/action-button.js";

/** What a sheet shows, and its gestures besides moving the view. Must be the same object on every render. */
export interface SheetKind {
  desk(state: PageState): Desk;
  look(state: PageState): FrameLook;
  readonly keptFree: KeptFree;
  /** Shows each change of the state, until the returned function is called. */
  show(stage: Stage, store: PageStore): () => void;
  hand(stage: Stage, store: PageStore, actions: Actions): Omit<GestureTarget, "view" | "setView" | "fit">;
}

interface SheetProps {
  readonly kind: SheetKind;
  readonly label: string;
  /** Accessible name of the strokes canvas. */
  readonly pictureLabel: string;
  /** Shown over the sheet. */
  readonly children: ReactNode;
  /** Controls under the sheet. */
  foot(stage: RefObject<Stage | null>): ReactNode;
}

/** Turns the desk, and points to where its upper edge is. */
const Compass = () => {
  const turn = usePageState((state) => state.view.deskTurn);
  return (
    <div className="compass" data-turn={turn}>
      <ActionButton action={TURN_DESK} kind="tool" icon="compass" />
    </div>
  );
};

/** Paper with strokes, which can be moved and zoomed. Used in Prepare and in Watch. */
export const Sheet = ({ kind, label, pictureLabel, children, foot }: SheetProps) => {
  const box = useRef<HTMLDivElement>(null);
  const desk = useRef<HTMLCanvasElement>(null);
  const strokes = useRef<HTMLCanvasElement>(null);
  const pen = useRef<HTMLCanvasElement>(null);
  const overlay = useRef<HTMLCanvasElement>(null);
  const stage = useRef<Stage | null>(null);
  const [hasFault, setHasFault] = useState(false);
  const store = usePageStore();
  const actions = useActions();
  useEffect(() => {
    if (!box.current || !desk.current || !strokes.current || !pen.current || !overlay.current) return;
    const canvases = {
      box: box.current,
      desk: desk.current,
      strokes: strokes.current,
      pen: pen.current,
      overlay: overlay.current,
    };
    const state = store.getState();
    const onFault = (): void => setHasFault(true);
    const made = new Stage(canvases, kind.desk(state), kind.look(state), kind.keptFree, onFault);
    const stopShowing = kind.show(made, store);
    const stopGestures = listenForGestures(box.current, {
      view: () => made.view,
      setView: (view) => made.setView(view),
      fit: () => made.fit(),
      ...kind.hand(made, store, actions),
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
  }, [kind, store, actions]);
  return (
    <section className="preview" aria-label={label}>
      <div className="canvas">
        <div className="stage" ref={box} tabIndex={0} role="group" aria-label={previewText.hint}>
          <canvas ref={desk} aria-hidden="true" />
          <canvas ref={strokes} role="img" aria-label={pictureLabel} />
          <canvas ref={overlay} aria-hidden="true" />
          <canvas ref={pen} className="pen-canvas" aria-hidden="true" />
        </div>
        {hasFault && (
          <p className="paper-message paper-message-error" role="alert">
            {previewText.cannotShow}
          </p>
        )}
        <Compass />
        {children}
      </div>
      <div className="preview-foot">{foot(stage)}</div>
    </section>
  );
};
