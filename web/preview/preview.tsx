import { stateAt } from "../../src/index.js";
import { tileWindows, type Box } from "../../src/internal.js";
import { drawnUntilS } from "./drawn-until.js";
import { activeJob, selectedStroke, type PageState, type PageStore } from "../state/store.js";
import { usePageState } from "../state/use-store.js";
import { previewText as words } from "./text.js";
import { deskOf, followPen } from "./desk.js";
import { paintBesidePaper, paintCutOff, paintTiles } from "./overlay.js";
import { PenGlide } from "./pen/pen-glide.js";
import type { Planned } from "../worker/protocol.js";
import { hoverAt, type Hover } from "../scene/hover.js";
import type { Point } from "./gestures.js";
import { HoverTip } from "./hover-tip.js";
import { frameNow, grabFrame, nudgeFrame, painterOf } from "./frame.js";
import { boxAround } from "../scene/placing.js";
import { Legend, PreviewTools, ViewModes } from "./preview-tools.js";
import { Sheet, type SheetKind } from "./sheet.js";
import type { FrameLook, ShownPen, Stage } from "./stage.js";
import { selectionPainter } from "./stroke.js";
import { TimeLine } from "./time-line.js";
import { penLooks, viewModeOf } from "./view-modes.js";
import { mmFromPx, mmFromScreen, type View } from "../scene/view.js";
import { lazyPart } from "../ui/lazy-part.js";

const StrokeCard = lazyPart(async () => (await import("./stroke-card.js")).StrokeCard);

/** The drawing's name above the paper, the legend under it. */
const KEPT_FREE = { abovePx: 26, belowPx: 30 };

/** The paper with the drawing on it, as it will be plotted. */
export const Preview = () => (
  <Sheet
    kind={PREPARED}
    label={words.title}
    pictureLabel={words.canvas}
    foot={(stage) => (
      <>
        <ViewModes />
        <TimeLine />
        <PreviewTools stage={stage} />
      </>
    )}
  >
    <Legend />
    <PaperMessage />
    <HoverTip />
    <SelectedStroke />
  </Sheet>
);

const SelectedStroke = () => {
  const isSelected = usePageState((state) => selectedStroke(state) !== null);
  return isSelected ? <StrokeCard /> : null;
};

/** Selects and moves the drawings of a sheet. Null until there was one. */
let sheetHand: typeof import("./sheet-hand.js") | null = null;

/** The hand for a sheet, if there is one now. A single sheet of a large drawing shows only a part of it. */
const handIn = ({ drawing, settings }: PageState): typeof sheetHand =>
  drawing?.sheet && settings.prepare.tile === 0 ? sheetHand : null;
const handOf = (store: PageStore): typeof sheetHand => handIn(store.getState());

const showState = (stage: Stage, store: PageStore): (() => void) => {
  const glide = new PenGlide();
  let isClosed = false;
  let isLoading = false;
  const loadSheetHand = async (): Promise<void> => {
    isLoading = true;
    // If it can't be loaded now, the next change tries again.
    sheetHand = await import("./sheet-hand.js").catch(() => null);
    isLoading = false;
    if (sheetHand && !isClosed) show(store.getState(), null);
  };
  const show = (state: PageState, before: PageState | null): void => {
    const hasChanged = (...parts: readonly (keyof PageState)[]): boolean =>
      before === null || parts.some((part) => state[part] !== before[part]);
    const picture = viewModeOf(state).picture?.(state);
    if (picture) stage.setScene(picture, null);
    else stage.setScene(state.planned?.scene ?? null, state.planned?.picture ?? null);
    // Another file is seen whole. One that was edited and opened again, or added to the sheet, keeps the view.
    const isOther = state.drawing?.key !== before?.drawing?.key;
    if (before && isOther && state.drawing?.name !== before.drawing?.name) stage.fit();
    followPen(glide, state, before, performance.now());
    stage.setPen(penOf(state, glide));
    if (state.drawing?.sheet && !sheetHand && !isLoading) void loadSheetHand();
    if (hasChanged("settings", "view")) stage.setDesk(deskOfState(state));
    if (
      hasChanged("view", "planned", "live", "jobs", "momentS", "swing", "drawing") ||
      state.settings.pens !== before?.settings.pens ||
      state.settings.layerPens !== before.settings.layerPens
    ) {
      stage.setLook(lookOf(state));
    }
    if (state.view.theme !== before?.view.theme) stage.recolor();
    if (
      hasChanged("planned", "settings", "selected", "noteBoxes", "snapLines", "drawing", "selectedPieces") ||
      state.view.lengthUnit !== before?.view.lengthUnit
    ) {
      const frame = frameNow(state);
      const { cutOff, besidePaper } = state.planned ?? { cutOff: null, besidePaper: null };
      const tiles = tilesShown(state);
      const selection = selectionPainter(state);
      const rest = painterOf(state);
      const pieces = handIn(state)?.piecesPainter(state);
      const paint = (context: CanvasRenderingContext2D, view: View): void => {
        if (tiles.length > 0) paintTiles(context, view, tiles);
        if (cutOff) paintCutOff(context, view, cutOff);
        if (besidePaper) paintBesidePaper(context, view, besidePaper);
        selection?.(context, view);
        rest?.(context, view);
        pieces?.(context, view);
      };
      stage.setPainter(paint, frame && boxAround(frame));
    }
  };
  show(store.getState(), null);
  const stop = store.subscribe(show);
  return () => {
    isClosed = true;
    stop();
  };
};

/** The sheets over which the drawing is spread, once it is planned so. */
const tilesShown = ({ planned }: PageState): readonly Box[] =>
  planned?.settings.prepare.tile === 0 ? tileWindows(planned.settings.prepare) : [];

const hoverUnder = (stage: Stage, planned: Planned, { x, y }: Point): Hover | null => {
  const [xMm, yMm] = mmFromScreen(stage.view, x, y);
  const { width, height } = stage.size;
  const at = { xPx: x, yPx: y, xMm, yMm, isRight: x > width * 0.6, isLow: y > height * 0.6 };
  return hoverAt(planned, at, stage.view.scale);
};

const deskOfState = ({ settings, view }: PageState) => deskOf(settings, view);

const lookOf = (state: PageState): FrameLook => {
  const { planned, settings } = state;
  const { showTravel } = state.view;
  const mode = viewModeOf(state);
  const looks = planned ? mode.layerLooks({ planned, settings }) : [];
  return {
    colorBy: mode.picture?.(state) === null ? "layer" : mode.colorBy,
    showTravel: showTravel || mode.showsTravel === true,
    layerColors: looks.map(({ color }) => color),
    layerWidthsMm: looks.map(({ widthMm }) => widthMm),
    lineGapMm: planned && !mode.isTrueToWidth ? planned.lineGapMm : undefined,
    // If this drawing is being plotted, the rest of it is shown pale.
    untilS: state.momentS ?? drawnUntilS(state),
  };
};

const penOf = (state: PageState, glide: PenGlide): ShownPen | null => {
  const { momentS, planned, settings, isDrawingItself } = state;
  if (isDrawingItself) return null;
  const colors = planned ? penLooks({ planned, settings }).map(({ color }) => color) : [];
  if (momentS !== null && planned) {
    const { x, y, penUp, penMoving } = stateAt(planned.trajectory, momentS);
    const place = { xMm: x, yMm: y, penDown: !penUp && !penMoving, planS: momentS, isMoving: false };
    return { at: () => place, colors, isDrawing: false };
  }
  // The pen of a plot is shown only on that plot's drawing.
  const job = activeJob(state);
  if (job && job.id !== state.drawing?.jobId) return null;
  return { at: (nowMs) => glide.at(nowMs), colors, isDrawing: job?.state === "plotting" };
};

/** The laid-out drawing: its strokes can be pointed at and selected, and it can be placed by hand. */
const PREPARED: SheetKind = {
  desk: deskOfState,
  look: lookOf,
  keptFree: KEPT_FREE,
  show: showState,
  hand: (stage, store, actions) => ({
    grab: (at, isFinger) => (handOf(store)?.grabPiece ?? grabFrame)(stage, store, actions, at, isFinger),
    nudge: (rightMm, downMm) =>
      (handOf(store)?.nudgePieces ?? nudgeFrame)(
        store,
        actions,
        ...mmFromPx({ ...stage.view, scale: 1 }, rightMm, downMm),
      ),
    hover: (at) => {
      const { planned, hover } = store.getState();
      const found = at && planned ? hoverUnder(stage, planned, at) : null;
      if (found !== hover) store.setState({ hover: found });
    },
    tap: (at, isMore) => {
      if (handOf(store)?.tapPiece(stage, store, at, isMore)) return;
      const { planned } = store.getState();
      const hover = planned && hoverUnder(stage, planned, at);
      store.setState({ hover: null, selected: planned && hover ? { of: planned, hover } : null });
    },
  }),
};

/** Shown on the paper while there are no strokes: the file is being read, or what is wrong with it. */
const PaperMessage = () => {
  const drawing = usePageState((state) => state.drawing);
  const fault = usePageState((state) => state.fault);
  const planned = usePageState((state) => state.planned);
  const isPlanning = usePageState((state) => state.isPlanning);
  if (fault) {
    return (
      <div className="paper-message paper-message-error" role="alert">
        <strong>{words.cannotRead(drawing?.name ?? "")}</strong>
        <p>{fault.message}</p>
      </div>
    );
  }
  if (!drawing) return null;
  if (!planned && isPlanning) {
    return (
      <div className="paper-message" role="status">
        <p>{words.reading(drawing.name)}</p>
      </div>
    );
  }
  if (planned?.strokeCount !== 0) return null;
  const isEmptyFile = planned.fileWarnings.some(({ code }) => code === "empty-drawing");
  const isPicture = isEmptyFile && planned.fileWarnings.some(({ code }) => code === "image-not-drawn");
  return (
    <div className="paper-message">
      <strong>{isPicture ? words.onlyPictures : words.nothingToDraw}</strong>
      <p>
        {isPicture ? words.onlyPicturesHint : isEmptyFile ? words.emptyFileHint : words.nothingToDrawHint}
      </p>
    </div>
  );
};
