import type { ReactNode } from "react";
import type { Desk } from "../../preview/backdrop.js";
import { deskOf, followPen } from "../../preview/desk.js";
import { PenGlide } from "../../preview/pen/pen-glide.js";
import { ZoomTools } from "../../preview/preview-tools.js";
import { Sheet, type SheetKind } from "../../preview/sheet.js";
import type { FrameLook, Stage } from "../../preview/stage.js";
import { mmFromScreen } from "../../scene/view.js";
import type { PageState, PageStore } from "../../state/store.js";
import { FullScreenButton } from "../watch-sheet.js";
import type { HandDrawing } from "./hand-drawing.js";
import { HandPicture, inkUntil } from "./picture.js";
import { PenPointer } from "./pen-pointer.js";
import { drawText as words } from "./text.js";

/** The sheet on the plotter, which is drawn on. */
export const HandSheet = ({ kind, foot, children }: HandSheetProps) => (
  <Sheet
    kind={kind}
    label={words.sheet}
    pictureLabel={words.canvas}
    foot={(stage) => (
      <>
        {foot}
        <div className="preview-tools">
          <ZoomTools stage={stage} className="tool-zoom" />
          <FullScreenButton />
        </div>
      </>
    )}
  >
    {children}
  </Sheet>
);

interface HandSheetProps {
  readonly kind: SheetKind;
  readonly foot: ReactNode;
  /** Shown over the sheet. */
  readonly children: ReactNode;
}

/** One sheet, even if the drawing in Prepare is spread over several. */
const deskOfState = ({ settings, view }: PageState): Desk => {
  const prepare = { ...settings.prepare, tileColumns: 1, tileRows: 1 };
  return deskOf({ ...settings, prepare }, view);
};

/** The strokes are painted over the sheet, not planned. */
const NO_LOOK: FrameLook = {
  colorBy: "layer",
  showTravel: false,
  layerColors: [],
  layerWidthsMm: [],
  untilS: null,
};

export const sheetOf = (drawing: HandDrawing): SheetKind => ({
  desk: deskOfState,
  look: () => NO_LOOK,
  keptFree: { abovePx: 0, belowPx: 0 },
  show: (stage, store) => show(stage, store, drawing),
  hand: (stage) => {
    const pointer = new PenPointer({
      begin: () => drawing.begin(stage.view.scale),
      add: ({ x, y }, atMs) => drawing.add(...mmFromScreen(stage.view, x, y), atMs),
      finish: () => drawing.finishStroke(),
    });
    return {
      grab: () => null,
      nudge: () => false,
      hover: () => undefined,
      tap: () => undefined,
      draws: (event, placeOf) => pointer.take(event, placeOf),
    };
  },
});

const show = (stage: Stage, store: PageStore, drawing: HandDrawing): (() => void) => {
  const glide = new PenGlide();
  const picture = new HandPicture(drawing.strokes);
  let request = 0;
  const repaint = (): void => {
    cancelAnimationFrame(request);
    request = 0;
    stage.setPainter((context, view) => {
      const pen = glide.at(performance.now());
      picture.paint(context, view, inkUntil(drawing.strokes, drawing.drawnTo, pen));
      // The line grows with each frame in which the pen moves.
      if (pen?.isMoving && request === 0) request = requestAnimationFrame(repaint);
    }, null);
  };
  const showState = (state: PageState, before: PageState | null): void => {
    followPen(glide, state, before, performance.now());
    stage.setPen({ at: (nowMs) => glide.at(nowMs), colors: [], isDrawing: false });
    if (state.settings !== before?.settings || state.view !== before.view) stage.setDesk(deskOfState(state));
    if (state.view.theme !== before?.view.theme) stage.recolor();
    if (state.live !== before?.live) repaint();
  };
  showState(store.getState(), null);
  const stops = [store.subscribe(showState), drawing.onChange(repaint)];
  return () => {
    cancelAnimationFrame(request);
    for (const stop of stops) stop();
  };
};
