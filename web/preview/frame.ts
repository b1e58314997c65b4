/** The drawing's frame on the paper: drawn with handles while it is placed by hand, and dragged by them. */
import type { Actions } from "../state/actions.js";
import type { PageState, PageStore } from "../state/store.js";
import { draggedFrame, framePartAt, placeOfFrame, type FrameMm } from "./placing.js";
import type { Stage } from "./stage.js";
import { mmFromScreen, type View } from "./view.js";

const HANDLE_PX = 9;
const REACH_PX = 18;

/** Where the drawing is to stand: as last planned, or as the settings say since. */
const frameNow = ({ planned, settings: { prepare } }: PageState): FrameMm | null => {
  const frame = planned?.frameMm ?? null;
  const place = prepare.place;
  if (!frame || !place) return null;
  const widthMm =
    place.widthMm ??
    (place.heightMm === null ? frame.widthMm : (place.heightMm * frame.widthMm) / frame.heightMm);
  const heightMm = place.heightMm ?? (frame.widthMm > 0 ? (widthMm * frame.heightMm) / frame.widthMm : 0);
  return { xMm: place.xMm, yMm: place.yMm, widthMm, heightMm };
};

/** Begins a drag of the frame, where one is placed by hand and lies under the pointer. */
export const grabFrame = (
  stage: Stage,
  store: PageStore,
  actions: Actions,
  at: { x: number; y: number },
): ((dxPx: number, dyPx: number) => void) | null => {
  const frame = frameNow(store.getState());
  if (!frame) return null;
  const { scale } = stage.view;
  const [xMm, yMm] = mmFromScreen(stage.view, at.x, at.y);
  const part = framePartAt(frame, xMm, yMm, REACH_PX / scale);
  if (!part) return null;
  return (dxPx, dyPx) =>
    actions.changeSettings("drag", (settings) => ({
      ...settings,
      prepare: {
        ...settings.prepare,
        place: placeOfFrame(draggedFrame(frame, part, dxPx / scale, dyPx / scale)),
      },
    }));
};

type Painter = (context: CanvasRenderingContext2D, view: View) => void;

/** The frame with its handles, and the places that a note of the report is about. */
export const painterOf = (state: PageState): Painter | null => {
  const frame = frameNow(state);
  const { noteBoxes, planned } = state;
  if (!frame && noteBoxes.length === 0) return null;
  return (context, view) => {
    if (planned) for (const box of noteBoxes) paintNote(context, view, paperBoxOf(box, planned.pageToPaper));
    if (frame) paintFrame(context, view, frame);
  };
};

type Map = NonNullable<PageState["planned"]>["pageToPaper"];

/** The box around a page box that may have been turned on its way to the paper. */
export const paperBoxOf = (
  [x0, y0, x1, y1]: readonly [number, number, number, number],
  map: Map,
): FrameMm => {
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
const NOTE_COLOR = "#b86e00";
const NOTE_PAD_PX = 5;

const paintFrame = (context: CanvasRenderingContext2D, view: View, frame: FrameMm): void => {
  const x = view.offsetX + frame.xMm * view.scale;
  const y = view.offsetY + frame.yMm * view.scale;
  const width = frame.widthMm * view.scale;
  const height = frame.heightMm * view.scale;
  context.strokeStyle = FRAME_COLOR;
  context.lineWidth = 1.5;
  context.strokeRect(x, y, width, height);
  context.fillStyle = "#ffffff";
  for (const [hx, hy] of [
    [x, y],
    [x + width, y],
    [x, y + height],
    [x + width, y + height],
  ] as const) {
    context.fillRect(hx - HANDLE_PX / 2, hy - HANDLE_PX / 2, HANDLE_PX, HANDLE_PX);
    context.strokeRect(hx - HANDLE_PX / 2, hy - HANDLE_PX / 2, HANDLE_PX, HANDLE_PX);
  }
};

const paintNote = (context: CanvasRenderingContext2D, view: View, box: FrameMm): void => {
  const x = view.offsetX + box.xMm * view.scale - NOTE_PAD_PX;
  const y = view.offsetY + box.yMm * view.scale - NOTE_PAD_PX;
  const width = box.widthMm * view.scale + 2 * NOTE_PAD_PX;
  const height = box.heightMm * view.scale + 2 * NOTE_PAD_PX;
  context.fillStyle = NOTE_COLOR;
  context.globalAlpha = 0.14;
  context.fillRect(x, y, width, height);
  context.globalAlpha = 1;
  context.strokeStyle = NOTE_COLOR;
  context.lineWidth = 2;
  context.strokeRect(x, y, width, height);
};
