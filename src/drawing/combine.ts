/**
 * Several drawings on one sheet, as one drawing: `prepare` and everything after it see no difference.
 *
 * Copies of one drawing share its layers, so that each pen is taken once for all copies. Different drawings keep layers
 * of their own. The shapes stay in paint order: those of a later drawing lie over those of an earlier one.
 */
import { PlotwrightError } from "../errors.js";
import { applyX, applyY, meanScale, type Affine } from "../geometry/affine.js";
import { boxOfPoints, mappedCorners } from "../geometry/box.js";
import {
  curvesOf,
  isBackground,
  RULE_NONZERO,
  VERB_CLOSE,
  VERB_LINE,
  VERB_MOVE,
  mappedDash,
  type ClipRegion,
  type DashPattern,
  type Drawing,
  type DrawingGroup,
  type DrawingWarning,
} from "./drawing.js";
import type { PaperSize } from "./paper.js";
import { PX_NOTE } from "./px-size.js";

/** A drawing that lies on a sheet once or several times. */
export interface SheetSource {
  readonly drawing: Drawing;
  /** Shown behind the names of its layers, if the sheet has several drawings. */
  readonly name: string;
  /** Begins the ids of its layers, so that those of different drawings differ. */
  readonly layerPrefix: string;
}

/** Where a source lies. */
export interface SheetItem {
  /** Index of the source. */
  readonly source: number;
  /** The source's page to the sheet, mm. */
  readonly map: Affine;
  /** What lies outside the source's page is cut off. */
  readonly isCropped?: boolean | undefined;
}

/** More coordinates than this do not fit in memory. */
const MAX_COORDS = 50_000_000;
const MAX_BOXES = 20;

/**
 * The drawing of a sheet: its items in paint order.
 *
 * @throws PlotwrightError "bad-file" if they have too many points together
 */
export function combine(
  sources: readonly SheetSource[],
  items: readonly SheetItem[],
  { widthMm, heightMm }: PaperSize,
): Drawing {
  const usedSources = [...new Set(items.map(({ source }) => sources[source]))];
  const { groups, firstOf } = groupsOf(usedSources);
  const colors = [...new Set(usedSources.flatMap(({ drawing }) => drawing.colors))];
  const colorIndex = new Map(colors.map((hex, index) => [hex, index]));
  const dashes: DashPattern[] = [];
  const clips: ClipRegion[] = [];
  const columns = emptyColumns(
    items.map(({ source }) => sources[source].drawing),
    MAX_COORDS,
  );
  let at = 0;
  for (const { source, map, isCropped = false } of items) {
    const { drawing } = sources[source];
    const page = isCropped ? clips.push(pageRegion(drawing, map)) - 1 : -1;
    const [firstGroup, firstDash, firstClip] = [
      firstOf.get(sources[source]) ?? 0,
      dashes.length,
      clips.length,
    ];
    for (const dash of drawing.dashes) dashes.push(mappedDash(dash, map));
    for (const clip of drawing.clips) {
      const parent = clip.parent < 0 ? page : firstClip + clip.parent;
      clips.push({ ...clip, coords: mapped(clip.coords, map), parent });
    }
    const { paths } = drawing;
    const scale = meanScale(map);
    const colorOf = (index: number): number =>
      index < 0 ? -1 : (colorIndex.get(drawing.colors[index]) ?? -1);
    for (const shape of shapesOf(drawing)) {
      const { verbs, coords } = curvesOf(paths, shape);
      const [verb, coord] = [columns.verbOffsets[at], columns.coordOffsets[at]];
      columns.verbs.set(verbs, verb);
      mapInto(coords, map, columns.coords, coord);
      columns.verbOffsets[at + 1] = verb + verbs.length;
      columns.coordOffsets[at + 1] = coord + coords.length;
      columns.group[at] = firstGroup + paths.group[shape];
      columns.stroke[at] = colorOf(paths.stroke[shape]);
      columns.fill[at] = colorOf(paths.fill[shape]);
      columns.fillRule[at] = paths.fillRule[shape];
      columns.strokeWidth[at] = paths.strokeWidth[shape] * scale;
      columns.dash[at] = paths.dash[shape] < 0 ? -1 : firstDash + paths.dash[shape];
      columns.clip[at] = paths.clip[shape] < 0 ? page : firstClip + paths.clip[shape];
      if (columns.speedFactor) columns.speedFactor[at] = paths.speedFactor?.[shape] ?? 1;
      if (columns.background) columns.background[at] = paths.background?.[shape] ?? 0;
      at++;
    }
  }
  const warnings = warningsOf(sources, items);
  return { widthMm, heightMm, groups, colors, dashes, clips, paths: { ...columns, count: at }, warnings };
}

/** The shapes of a drawing on the sheet: without a background below them, which would only hide other drawings. */
function shapesOf({ paths }: Drawing): number[] {
  let first = 0;
  while (first < paths.count && isBackground(paths, first)) first++;
  return Array.from({ length: paths.count - first }, (_, i) => first + i);
}

/** The layers of all sources, and the index of the first one of each. */
function groupsOf(sources: readonly SheetSource[]): {
  readonly groups: DrawingGroup[];
  readonly firstOf: ReadonlyMap<SheetSource, number>;
} {
  const groups: DrawingGroup[] = [];
  const firstOf = new Map<SheetSource, number>();
  const ids = new Set<string>();
  for (const source of sources) {
    const first = groups.length;
    firstOf.set(source, first);
    for (const { id, name, hidden, parent } of source.drawing.groups) {
      const wanted = `${source.layerPrefix}${id}`;
      let unique = wanted;
      for (let n = 2; ids.has(unique); n++) unique = `${wanted}-${n}`;
      ids.add(unique);
      groups.push({
        id: unique,
        // Behind the name, because codes are at its beginning.
        name: sources.length > 1 ? `${name} (${source.name})` : name,
        hidden,
        ...(parent === undefined ? {} : { parent: first + parent }),
      });
    }
  }
  return { groups, firstOf };
}

/** Columns with room for all shapes of these drawings. */
function emptyColumns(drawings: readonly Drawing[], maxCoords: number) {
  const shapes = drawings.map(shapesOf);
  const count = sum(shapes.map(({ length }) => length));
  const sizeOf = (offsets: "verbOffsets" | "coordOffsets"): number =>
    sum(
      drawings.map(
        ({ paths }, i) => paths[offsets][paths.count] - paths[offsets][shapes[i][0] ?? paths.count],
      ),
    );
  const coordCount = sizeOf("coordOffsets");
  if (coordCount > maxCoords) {
    throw new PlotwrightError(
      "bad-file",
      `The drawings on this sheet have more than ${maxCoords / 2_000_000} million points together. Use fewer copies.`,
    );
  }
  const has = (column: "speedFactor" | "background"): boolean =>
    drawings.some(({ paths }) => paths[column] !== undefined);
  return {
    verbs: new Uint8Array(sizeOf("verbOffsets")),
    coords: new Float64Array(coordCount),
    verbOffsets: new Uint32Array(count + 1),
    coordOffsets: new Uint32Array(count + 1),
    group: new Uint32Array(count),
    stroke: new Int32Array(count),
    fill: new Int32Array(count),
    fillRule: new Uint8Array(count),
    strokeWidth: new Float32Array(count),
    dash: new Int32Array(count),
    clip: new Int32Array(count),
    ...(has("speedFactor") ? { speedFactor: new Float64Array(count) } : {}),
    ...(has("background") ? { background: new Uint8Array(count) } : {}),
  };
}

const sum = (numbers: readonly number[]): number => numbers.reduce((total, number) => total + number, 0);

const mapped = (coords: Float64Array, map: Affine): Float64Array => {
  const to = new Float64Array(coords.length);
  mapInto(coords, map, to, 0);
  return to;
};

function mapInto(from: Float64Array, map: Affine, to: Float64Array, at: number): void {
  for (let i = 0; i < from.length; i += 2) {
    to[at + i] = applyX(map, from[i], from[i + 1]);
    to[at + i + 1] = applyY(map, from[i], from[i + 1]);
  }
}

function pageRegion({ widthMm, heightMm }: Drawing, map: Affine): ClipRegion {
  const coords = Float64Array.from(mappedCorners(map, { x0: 0, y0: 0, x1: widthMm, y1: heightMm }));
  const verbs = Uint8Array.of(VERB_MOVE, VERB_LINE, VERB_LINE, VERB_LINE, VERB_CLOSE);
  return { verbs, coords, rule: Uint8Array.of(RULE_NONZERO), parent: -1 };
}

/** The warnings of each source once, with the places of all its copies. The place on the sheet makes the note on px obsolete. */
function warningsOf(sources: readonly SheetSource[], items: readonly SheetItem[]): DrawingWarning[] {
  const used = new Set(items.map(({ source }) => source));
  return [...used].flatMap((index) => {
    const { drawing, name } = sources[index];
    const maps = items.filter(({ source }) => source === index).map(({ map }) => map);
    return drawing.warnings
      .filter(({ code }) => code !== PX_NOTE)
      .map((warning) => ({
        ...warning,
        message: used.size > 1 ? `${name}: ${warning.message}` : warning.message,
        boxes: maps
          .flatMap((map) =>
            warning.boxes.map(([x0, y0, x1, y1]) => boxOfPoints(mappedCorners(map, { x0, y0, x1, y1 }))),
          )
          .slice(0, MAX_BOXES)
          .map(({ x0, y0, x1, y1 }) => [x0, y0, x1, y1] as const),
      }));
  });
}
