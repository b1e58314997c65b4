/** Selecting, dragging and painting the drawings of a sheet. Loaded with the first sheet. */
import { boxOf, frameOf, inFrame, movedBy, topmostAt } from "../scene/arrange.js";
import { draggedFrame, framePartAt, snapFrame, snapLinesOf, type SnapLines } from "../scene/placing.js";
import { mmFromPx, mmFromScreen, screenBox, type View } from "../scene/view.js";
import type { Actions } from "../state/actions.js";
import { piecesOnPaper, withPieces } from "../state/sheet-edits.js";
import type { PlacedPiece } from "../state/sheet-settings.js";
import type { PageState, PageStore } from "../state/store.js";
import { KNOB_PX, paintFrame, paintSnapLines, REACH_PX, SNAP_PX } from "./frame.js";
import type { Drag, Point } from "./gestures.js";
import type { OverlayPainter, Stage } from "./stage.js";

const OUTLINE_COLOR = "#2f62d8";
/** Room around a drawing in which a press still means it: a single line has no area. */
const NEAR_PX = 6;

const selectedOf = (state: PageState): readonly PlacedPiece[] =>
  piecesOnPaper(state).filter(({ id }) => state.selectedPieces.includes(id));

/**
 * Begins a drag: of a handle, if one drawing is selected, otherwise of all selected drawings. A drawing that is not
 * selected is selected first, but not by a finger. Null: there is none under the pointer.
 */
export const grabPiece = (
  stage: Stage,
  store: PageStore,
  actions: Actions,
  at: Point,
  isFinger: boolean,
): Drag | null => {
  const state = store.getState();
  const { scale } = stage.view;
  const [x, y] = mmFromScreen(stage.view, at.x, at.y);
  const selected = selectedOf(state);
  const only = selected.length === 1 ? selected[0] : null;
  const part = only && framePartAt(frameOf(only), x, y, REACH_PX / scale, KNOB_PX / scale);
  if (only && part && part !== "move") return dragOf(stage, store, actions, [only], part, { x, y });
  const isSelected = ({ id }: PlacedPiece): boolean => state.selectedPieces.includes(id);
  const under = (part === "move" ? only : null) ?? topmostAt(piecesOnPaper(state), x, y, NEAR_PX / scale);
  if (!under || (isFinger && !isSelected(under))) return null;
  return dragOf(stage, store, actions, isSelected(under) ? selected : [under], "move", { x, y });
};

const dragOf = (
  stage: Stage,
  store: PageStore,
  actions: Actions,
  dragged: readonly PlacedPiece[],
  part: Parameters<typeof draggedFrame>[1],
  from: Point,
): Drag => {
  const { scale } = stage.view;
  const [lead] = dragged;
  const ids = dragged.map(({ id }) => id);
  const frame = frameOf(lead);
  const { paperMm, margins } = stage.desk;
  const others = piecesOnPaper(store.getState()).filter(({ id }) => !ids.includes(id));
  const lines = withEdges(snapLinesOf(paperMm, margins), others);
  return {
    to: (dxPx, dyPx, isFree) => {
      const moved = draggedFrame(frame, part, from, ...mmFromPx(stage.view, dxPx, dyPx));
      const snapped = isFree ? null : snapFrame(moved, part, lines, SNAP_PX / scale);
      const now = snapped?.frame ?? moved;
      store.setState({ snapLines: snapped?.lines ?? null, selectedPieces: ids });
      const byId = new Map(
        part === "move"
          ? dragged.map((piece) => [piece.id, movedBy(piece, now.xMm - frame.xMm, now.yMm - frame.yMm)])
          : [[lead.id, inFrame(lead, now)]],
      );
      change(store, actions, `drag ${ids.join()}`, (piece) => byId.get(piece.id) ?? piece);
    },
    end: () => store.setState({ snapLines: null }),
  };
};

/** Edges and centres of the other drawings too. */
const withEdges = ({ xs, ys }: SnapLines, others: readonly PlacedPiece[]): SnapLines => {
  const boxes = others.map(boxOf);
  return {
    xs: [...xs, ...boxes.flatMap(({ x0, x1 }) => [x0, (x0 + x1) / 2, x1])],
    ys: [...ys, ...boxes.flatMap(({ y0, y1 }) => [y0, (y0 + y1) / 2, y1])],
  };
};

const change = (
  store: PageStore,
  actions: Actions,
  what: string,
  one: (piece: PlacedPiece) => PlacedPiece,
): void => {
  const state = store.getState();
  const sheet = withPieces(state, piecesOnPaper(state).map(one));
  if (sheet) actions.changeSheet(what, sheet);
};

/** Moves the selected drawings. False: none is selected. */
export const nudgePieces = (store: PageStore, actions: Actions, dxMm: number, dyMm: number): boolean => {
  const ids = selectedOf(store.getState()).map(({ id }) => id);
  if (ids.length === 0) return false;
  change(store, actions, `nudge ${ids.join()}`, (piece) =>
    ids.includes(piece.id) ? movedBy(piece, dxMm, dyMm) : piece,
  );
  return true;
};

/**
 * Selects the drawing under a press, or none. `isMore`: besides those that are selected. False: it was selected before,
 * so the press means a stroke of it.
 */
export const tapPiece = (stage: Stage, store: PageStore, at: Point, isMore: boolean): boolean => {
  const state = store.getState();
  const before = state.selectedPieces;
  const [x, y] = mmFromScreen(stage.view, at.x, at.y);
  const id = topmostAt(piecesOnPaper(state), x, y, NEAR_PX / stage.view.scale)?.id;
  if (!isMore && id !== undefined && before.length === 1 && before[0] === id) return false;
  const others = isMore ? before.filter((other) => other !== id) : [];
  const isOff = isMore && id !== undefined && before.includes(id);
  store.setState({ selectedPieces: id === undefined || isOff ? others : [...others, id], selected: null });
  return true;
};

/** Paints handles around a selected drawing, and outlines around several. */
export const piecesPainter = (state: PageState): OverlayPainter | null => {
  const selected = selectedOf(state);
  const { snapLines } = state;
  if (selected.length === 0) return null;
  return (context, view) => {
    if (snapLines) paintSnapLines(context, view, snapLines);
    if (selected.length === 1) paintFrame(context, view, frameOf(selected[0]), state.view.lengthUnit);
    else for (const piece of selected) paintOutline(context, view, piece);
  };
};

const paintOutline = (context: CanvasRenderingContext2D, view: View, piece: PlacedPiece): void => {
  const { x0, y0, x1, y1 } = screenBox(view, boxOf(piece));
  context.strokeStyle = OUTLINE_COLOR;
  context.lineWidth = 1.5;
  context.strokeRect(x0, y0, x1 - x0, y1 - y0);
};
