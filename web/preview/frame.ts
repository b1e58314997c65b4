/** The drawing's frame on the paper, for placing it by hand: its handles, dragging it, and moving it by keys. */
import type { Actions } from "../state/actions.js";
import type { PageState, PageStore } from "../state/store.js";
import { formatNumber, formatSize } from "../ui/format.js";
import type { LengthUnit } from "../../src/internal.js";
import type { BoxMm } from "../../src/schema/index.js";
import type { Drag, Point } from "./gestures.js";
import {
  CORNER_PARTS,
  boxAround,
  cornerOf,
  draggedFrame,
  framePartAt,
  knobOf,
  layoutOfFrame,
  snapFrame,
  snapLinesOf,
  type FrameMm,
  type SnapLines,
} from "../scene/placing.js";
import type { OverlayPainter, Stage } from "./stage.js";
import { addCrispLine, DESK_FONT } from "./backdrop.js";
import { mmFromPx, mmFromScreen, screenBox, screenPoint, type View } from "../scene/view.js";

const HANDLE_PX = 10;
export const REACH_PX = 20;
export const KNOB_PX = 30;
export const SNAP_PX = 7;
const BELOW_LABEL_PX = 88;

/** The drawing's frame by the current settings, which may be newer than the plan. Null: not placed by hand. */
export const frameNow = ({ planned, settings: { prepare } }: PageState): FrameMm | null => {
  const frame = planned?.frameMm ?? null;
  const place = prepare.layout;
  if (!frame || !place || prepare.tile > 0) return null;
  const widthMm =
    place.widthMm ??
    (place.heightMm === null ? frame.widthMm : (place.heightMm * frame.widthMm) / frame.heightMm);
  const heightMm = place.heightMm ?? (frame.widthMm > 0 ? (widthMm * frame.heightMm) / frame.widthMm : 0);
  return { xMm: place.xMm, yMm: place.yMm, widthMm, heightMm, turnDeg: place.turnDeg ?? 0 };
};

const setFrame = (actions: Actions, what: string, frame: FrameMm): void =>
  actions.changeSettings(what, (settings) => ({
    ...settings,
    prepare: { ...settings.prepare, layout: layoutOfFrame(frame) },
  }));

/** Begins a drag of the frame. Null: there is none, or it is not under the pointer. */
export const grabFrame = (stage: Stage, store: PageStore, actions: Actions, at: Point): Drag | null => {
  const frame = frameNow(store.getState());
  if (!frame) return null;
  const { scale } = stage.view;
  const [x, y] = mmFromScreen(stage.view, at.x, at.y);
  const part = framePartAt(frame, x, y, REACH_PX / scale, KNOB_PX / scale);
  if (!part) return null;
  const { paperMm, margins } = stage.desk;
  const lines = snapLinesOf(paperMm, margins);
  return {
    to: (dxPx, dyPx, isFree) => {
      const dragged = draggedFrame(frame, part, { x, y }, ...mmFromPx(stage.view, dxPx, dyPx));
      const snapped = isFree ? null : snapFrame(dragged, part, lines, SNAP_PX / scale);
      store.setState({ snapLines: snapped?.lines ?? null });
      setFrame(actions, "drag", snapped?.frame ?? dragged);
    },
    end: () => store.setState({ snapLines: null }),
  };
};

/** Moves a drawing that is placed by hand. False: it is not. */
export const nudgeFrame = (store: PageStore, actions: Actions, dxMm: number, dyMm: number): boolean => {
  const frame = frameNow(store.getState());
  if (!frame) return false;
  setFrame(actions, "nudge", { ...frame, xMm: frame.xMm + dxMm, yMm: frame.yMm + dyMm });
  return true;
};

/** Paints the frame with its handles, and the places of the shown warning. */
export const painterOf = (state: PageState): OverlayPainter | null => {
  const frame = frameNow(state);
  const { noteBoxes, planned, snapLines } = state;
  const { lengthUnit } = state.view;
  if (!frame && noteBoxes.length === 0) return null;
  return (context, view) => {
    if (planned) for (const box of noteBoxes) paintNote(context, view, paperBoxOf(box, planned.pageToPaper));
    if (frame && snapLines) paintSnapLines(context, view, snapLines);
    if (frame) paintFrame(context, view, frame, lengthUnit);
  };
};

type PageMap = NonNullable<PageState["planned"]>["pageToPaper"];

/** The box on the paper around a box of the page, which may be turned. */
export const paperBoxOf = (
  [x0, y0, x1, y1]: readonly [number, number, number, number],
  map: PageMap,
): BoxMm => {
  const corners = [
    [x0, y0],
    [x1, y0],
    [x0, y1],
    [x1, y1],
  ] as const;
  const xs = corners.map(([x, y]) => map.a * x + map.c * y + map.e);
  const ys = corners.map(([x, y]) => map.b * x + map.d * y + map.f);
  const xMm = Math.min(...xs);
  const yMm = Math.min(...ys);
  return { xMm, yMm, widthMm: Math.max(...xs) - xMm, heightMm: Math.max(...ys) - yMm };
};

const FRAME_COLOR = "#2f62d8";
const SNAP_COLOR = "#d2452c";
const NOTE_COLOR = "#b86e00";
const NOTE_PAD_PX = 5;

export const paintFrame = (
  context: CanvasRenderingContext2D,
  view: View,
  frame: FrameMm,
  unit: LengthUnit,
): void => {
  const onScreen = ({ x, y }: Point): Px => screenPoint(view, x, y);
  const [nw, ne, sw, se] = CORNER_PARTS.map((part) => onScreen(cornerOf(frame, part)));
  const knob = onScreen(knobOf(frame, KNOB_PX / view.scale));
  context.strokeStyle = FRAME_COLOR;
  context.lineWidth = 1.5;
  context.beginPath();
  for (const [k, [x, y]] of [nw, ne, se, sw].entries()) {
    if (k === 0) context.moveTo(x, y);
    else context.lineTo(x, y);
  }
  context.closePath();
  context.moveTo((nw[0] + ne[0]) / 2, (nw[1] + ne[1]) / 2);
  context.lineTo(...knob);
  context.stroke();
  context.fillStyle = "#ffffff";
  for (const [x, y] of [nw, ne, sw, se]) {
    context.beginPath();
    context.rect(x - HANDLE_PX / 2, y - HANDLE_PX / 2, HANDLE_PX, HANDLE_PX);
    context.fill();
    context.stroke();
  }
  context.beginPath();
  context.arc(...knob, HANDLE_PX / 2 + 1, 0, 2 * Math.PI);
  context.fill();
  context.stroke();
  paintSize(context, view, frame, unit);
};

type Px = [number, number];

/** Paints a label with size and angle below the frame. */
const paintSize = (context: CanvasRenderingContext2D, view: View, frame: FrameMm, unit: LengthUnit): void => {
  const { x0, x1, y1 } = screenBox(view, boxAround(frame));
  const label = `${formatSize(frame.widthMm, frame.heightMm, unit)}${
    frame.turnDeg === 0 ? "" : `, ${formatNumber(frame.turnDeg, 1)}°`
  }`;
  context.font = DESK_FONT;
  const width = context.measureText(label).width + 14;
  const x = (x0 + x1) / 2;
  // Inside the canvas, above the tools at its lower edge.
  const heightPx = context.canvas.height / context.getTransform().d;
  const y = Math.min(y1 + 12, heightPx - BELOW_LABEL_PX);
  context.fillStyle = FRAME_COLOR;
  context.beginPath();
  context.roundRect(x - width / 2, y, width, 21, 4);
  context.fill();
  context.fillStyle = "#ffffff";
  context.textAlign = "center";
  context.fillText(label, x, y + 15);
};

export const paintSnapLines = (
  context: CanvasRenderingContext2D,
  view: View,
  { xs, ys }: SnapLines,
): void => {
  const { width, height } = context.canvas;
  // Longer than the canvas from anywhere on it.
  const [farX, farY] = mmFromPx({ ...view, turn: 0 }, width + height, width + height);
  const [left, top] = mmFromScreen(view, 0, 0);
  context.strokeStyle = SNAP_COLOR;
  context.lineWidth = 1;
  context.beginPath();
  for (const mm of xs)
    addCrispLine(context, screenPoint(view, mm, top - farY), screenPoint(view, mm, top + farY));
  for (const mm of ys)
    addCrispLine(context, screenPoint(view, left - farX, mm), screenPoint(view, left + farX, mm));
  context.stroke();
};

const paintNote = (context: CanvasRenderingContext2D, view: View, box: BoxMm): void => {
  const { xMm, yMm, widthMm, heightMm } = box;
  const shown = screenBox(view, { x0: xMm, y0: yMm, x1: xMm + widthMm, y1: yMm + heightMm });
  const x = shown.x0 - NOTE_PAD_PX;
  const y = shown.y0 - NOTE_PAD_PX;
  const width = shown.x1 - shown.x0 + 2 * NOTE_PAD_PX;
  const height = shown.y1 - shown.y0 + 2 * NOTE_PAD_PX;
  context.fillStyle = NOTE_COLOR;
  context.globalAlpha = 0.14;
  context.fillRect(x, y, width, height);
  context.globalAlpha = 1;
  context.strokeStyle = NOTE_COLOR;
  context.lineWidth = 2;
  context.strokeRect(x, y, width, height);
};
