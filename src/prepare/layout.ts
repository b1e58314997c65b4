/**
 * Places the drawing on the paper: one map from the file's page to the machine frame.
 *
 *   home ┌──────────────── x        paper    top left corner at home, oriented by `landscape`
 *        │  ┌───────────┐           inside   the paper minus its margins
 *        │  │  inside   │           fit      the drawing's content fills `inside`, centred
 *        y  └───────────┘           corner   true size, page corner on paper corner
 *                                   middle   true size, centred: a file without a page
 *                                   box      the content in the given box, then turned about its centre
 *
 * A tiled drawing is laid out on its poster in place of the paper (tiles.ts).
 *
 * The setting `fit` chooses between fit and corner; "auto" chooses by the file's page. A drawing that leaves the paper is
 * moved or fitted if the setting `outside` asks for it.
 */
import { curveBoxOf } from "../drawing/curve-box.js";
import { curvesOf, isBackground, type Drawing } from "../drawing/drawing.js";
import {
  IDENTITY,
  compose,
  mapAround,
  rotation,
  scaling,
  translation,
  type Affine,
} from "../geometry/affine.js";
import {
  EMPTY_BOX,
  boxContains,
  boxOfPoints,
  hasRoom,
  intersectBoxes,
  isEmptyBox,
  mappedCorners,
  uniteBoxes,
  type Box,
} from "../geometry/box.js";
import type { MirrorMode, PlacedBox } from "../settings/placement.js";
import type { PrepareSettings } from "../settings/prepare.js";
import { sheetOf } from "./tiles.js";

export interface Layout {
  /** Page mm to machine mm. */
  readonly map: Affine;
  readonly paper: Box;
  readonly inside: Box;
  /** How the drawing is laid out: settings that are "auto" are decided. */
  readonly choice: LayoutChoice;
  /** Box of the content on the paper; empty for an empty drawing. */
  readonly content: Box;
  /** The same before a placed box is turned. */
  readonly frame: Box;
  /** Box of all shapes on the paper, before any clipping; infinite if a shape draws nothing. */
  readonly whole: Box;
  /** Box of each shape on the paper; empty for a shape that draws nothing. */
  readonly shapeBoxes: () => readonly Box[];
}

/** See the picture above. */
export interface LayoutChoice {
  readonly how: "fit" | "corner" | "middle" | "box";
  readonly rotateDeg: number;
}

/** What the pen's width and the rounding of pages to whole pixels may exceed the paper by, mm. */
const PEN_WIDTH_MM = 0.5;
export const ROUNDING_MM = 0.01;

/** What counts as paper. Left and top are at home, where the carriage can't go any further. */
export const withTolerance = ({ x0, y0, x1, y1 }: Box): Box => ({
  x0: x0 - ROUNDING_MM,
  y0: y0 - ROUNDING_MM,
  x1: x1 + PEN_WIDTH_MM,
  y1: y1 + PEN_WIDTH_MM,
});

/** Throws `bad-setting` if the margins leave no room. */
export function layOutDrawing(drawing: Drawing, settings: PrepareSettings): Layout {
  const layout = laidOut(drawing, settings);
  const { paper, inside, content, choice } = layout;
  if (isEmptyBox(content) || boxContains(withTolerance(paper), content)) return layout;
  if (settings.outside === "move" && hasRoom(paper, content)) {
    return movedBy(layout, shiftOnto(content, inside, paper));
  }
  if (settings.outside !== "fit") return layout;
  const turnDeg = settings.layout?.turnDeg ?? 0;
  return laidOut(drawing, { ...settings, fit: true, layout: null, rotateDeg: choice.rotateDeg + turnDeg });
}

/** The layout by the settings, whether or not it leaves the paper. */
function laidOut(drawing: Drawing, settings: PrepareSettings): Layout {
  const { paper, inside } = sheetOf(settings);
  const choice = choiceOf(drawing, settings, paper, inside);
  const turn = turnOf(choice.rotateDeg, settings.mirror);
  const { boxes: turned, whole } = shapeBoxes(drawing, turn);
  const content = contentBox(drawing, turned, whole, turn, settings.cropToPage);
  const after = settings.layout
    ? placed(content, settings.layout)
    : choice.how === "fit"
      ? fitted(content, inside)
      : choice.how === "middle"
        ? toMiddle(content, inside, 1)
        : onCorner(pageBox(drawing, turn));
  const frame = isEmptyBox(content) ? content : movedBox(content, after);
  const common = { paper, inside, choice, frame };
  const turnInBox = aboutCentre(frame, settings.layout?.turnDeg ?? 0);
  if (turnInBox === null) {
    return {
      ...common,
      map: compose(after, turn),
      content: frame,
      whole: movedBox(whole, after),
      shapeBoxes: () => turned.map((box) => movedBox(box, after)),
    };
  }
  const map = compose(turnInBox, compose(after, turn));
  const moved = shapeBoxes(drawing, map);
  return {
    ...common,
    map,
    content: contentBox(drawing, moved.boxes, moved.whole, map, settings.cropToPage),
    whole: moved.whole,
    shapeBoxes: () => moved.boxes,
  };
}

function choiceOf(drawing: Drawing, settings: PrepareSettings, paper: Box, inside: Box): LayoutChoice {
  const { fit, rotateDeg, mirror, layout } = settings;
  const turns = rotateDeg === "auto" ? [0, 90] : [rotateDeg];
  const [unturned] = turns;
  if (layout !== null) return { how: "box", rotateDeg: unturned };
  if (fit === true) return { how: "fit", rotateDeg: unturned };
  // Such a page has no margins of its own.
  const isExtent = drawing.pageFrom === "extent" && fit === "auto";
  const room = isExtent ? inside : withTolerance(paper);
  const fitting = turns.find((deg) => hasRoom(room, pageBox(drawing, turnOf(deg, mirror))));
  if (fit === false) return { how: "corner", rotateDeg: fitting ?? unturned };
  if (fitting === undefined || drawing.pageFrom === "proportions") return { how: "fit", rotateDeg: unturned };
  return { how: isExtent ? "middle" : "corner", rotateDeg: fitting };
}

const turnOf = (rotateDeg: number, mirror: MirrorMode): Affine =>
  compose(rotation((rotateDeg * Math.PI) / 180), MIRRORS[mirror]);

/** The shortest way inside the margins, where there is room, otherwise onto the paper, which has room. */
function shiftOnto(content: Box, inside: Box, paper: Box): { readonly x: number; readonly y: number } {
  const { x0, y0, x1, y1 } = content;
  type Room = readonly [from: number, to: number];
  const along = (from: number, to: number, ...rooms: readonly [inside: Room, paper: Room]): number => {
    const [low, high] = rooms.find(([least, most]) => to - from <= most - least) ?? rooms[1];
    return Math.max(low - from, Math.min(0, high - to));
  };
  return {
    x: along(x0, x1, [inside.x0, inside.x1], [paper.x0, paper.x1]),
    y: along(y0, y1, [inside.y0, inside.y1], [paper.y0, paper.y1]),
  };
}

function movedBy(layout: Layout, { x, y }: { readonly x: number; readonly y: number }): Layout {
  const by = translation(x, y);
  return {
    ...layout,
    map: compose(by, layout.map),
    content: movedBox(layout.content, by),
    frame: movedBox(layout.frame, by),
    whole: movedBox(layout.whole, by),
    shapeBoxes: () => layout.shapeBoxes().map((box) => movedBox(box, by)),
  };
}

/** A turn about the centre of the box; null for no turn. */
function aboutCentre(box: Box, turnDeg: number): Affine | null {
  if (turnDeg === 0 || isEmptyBox(box)) return null;
  return mapAround((box.x0 + box.x1) / 2, (box.y0 + box.y1) / 2, rotation((turnDeg * Math.PI) / 180));
}

const MIRRORS: Readonly<Record<MirrorMode, Affine>> = {
  none: IDENTITY,
  leftRight: scaling(-1, 1),
  upDown: scaling(1, -1),
};

const EVERYTHING: Box = { x0: -Infinity, y0: -Infinity, x1: Infinity, y1: Infinity };

/** Boxes for `Layout`. */
function shapeBoxes(drawing: Drawing, map: Affine): { readonly boxes: readonly Box[]; readonly whole: Box } {
  const boxes: Box[] = [];
  let whole = EMPTY_BOX;
  let hasEmpty = false;
  for (let i = 0; i < drawing.paths.count; i++) {
    const box = curveBoxOf(curvesOf(drawing.paths, i), map);
    boxes.push(box);
    if (isEmptyBox(box)) hasEmpty = true;
    whole = uniteBoxes(whole, box);
  }
  return { boxes, whole: hasEmpty ? EVERYTHING : whole };
}

/** Box of everything that the file draws, including hidden layers, so that layers plotted one at a time still align. */
function contentBox(drawing: Drawing, boxes: readonly Box[], whole: Box, map: Affine, onPage: boolean): Box {
  const page = onPage ? pageBox(drawing, map) : null;
  const clipBoxes = drawing.clips.map((clip) => curveBoxOf(clip, map));
  // A shape that draws nothing makes `whole` infinite, so it counts as far away too.
  const isWhole = drawing.paths.background === undefined && page === null && clipBoxes.length === 0;
  if (isWhole && !isFarAway(whole)) return whole;
  let content = EMPTY_BOX;
  boxes.forEach((shapeBox, shape) => {
    if (isBackground(drawing.paths, shape)) return;
    let box = page ? intersectBoxes(shapeBox, page) : shapeBox;
    for (let clip = drawing.paths.clip[shape]; clip >= 0; clip = drawing.clips[clip].parent) {
      box = intersectBoxes(box, clipBoxes[clip]);
    }
    if (!isEmptyBox(box) && !isFarAway(box)) content = uniteBoxes(content, box);
  });
  return content;
}

/** mm. Anything beyond this (a thousand kilometres) is an error in the file. */
const FAR_AWAY = 1e9;

/** True for boxes much larger than any paper, which must not determine the scale. */
export const isFarAway = ({ x0, y0, x1, y1 }: Box): boolean =>
  !(x0 > -FAR_AWAY && y0 > -FAR_AWAY && x1 < FAR_AWAY && y1 < FAR_AWAY);

/** Slightly below 1, so that rounding does not move a line on the border across it, where it would be cropped. */
const FIT_SHARE = 1 - 1e-11;

function fitted(content: Box, inside: Box): Affine {
  if (isEmptyBox(content)) return IDENTITY;
  const width = content.x1 - content.x0;
  const height = content.y1 - content.y0;
  const scale = FIT_SHARE * Math.min((inside.x1 - inside.x0) / width, (inside.y1 - inside.y0) / height);
  // A lone dot has no size to scale by.
  return toMiddle(content, inside, Number.isFinite(scale) ? scale : 1);
}

function toMiddle(content: Box, inside: Box, scale: number): Affine {
  if (isEmptyBox(content)) return IDENTITY;
  const to = translation((inside.x0 + inside.x1) / 2, (inside.y0 + inside.y1) / 2);
  const from = translation(-(content.x0 + content.x1) / 2, -(content.y0 + content.y1) / 2);
  return compose(to, compose(scaling(scale), from));
}

/** Moves the content's top left corner to x, y and scales it to the given size. */
function placed(content: Box, place: PlacedBox): Affine {
  if (isEmptyBox(content)) return IDENTITY;
  const ratio = (wanted: number | null, have: number): number | null =>
    wanted !== null && have > 0 ? wanted / have : null;
  const sx = ratio(place.widthMm, content.x1 - content.x0);
  const sy = ratio(place.heightMm, content.y1 - content.y0);
  const size = scaling(sx ?? sy ?? 1, sy ?? sx ?? 1);
  return compose(translation(place.xMm, place.yMm), compose(size, translation(-content.x0, -content.y0)));
}

const onCorner = (page: Box): Affine => translation(-page.x0, -page.y0);

/** Corners of the file's page under a map, x, y, x, y … clockwise or counter-clockwise. */
export const pageCorners = ({ widthMm, heightMm }: Drawing, map: Affine): number[] =>
  mappedCorners(map, { x0: 0, y0: 0, x1: widthMm, y1: heightMm });

const pageBox = (drawing: Drawing, map: Affine): Box => boxOfPoints(pageCorners(drawing, map));

/** Only for maps that scale and translate. */
const movedBox = (box: Box, map: Affine): Box => ({
  x0: map.a * box.x0 + map.e,
  y0: map.d * box.y0 + map.f,
  x1: map.a * box.x1 + map.e,
  y1: map.d * box.y1 + map.f,
});
