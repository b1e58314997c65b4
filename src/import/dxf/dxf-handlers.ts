/**
 * Handlers for entities that the DXF parser skips or reads only partly: TEXT, ATTRIB, MTEXT and HATCH; CIRCLE
 * and ELLIPSE, where it skips the extrusion; LWPOLYLINE, where it loses vertices or hangs if other groups are
 * between them; and POLYLINE, where it hangs if another entity takes the place of a VERTEX or SEQEND. They
 * read group by group (AutoCAD DXF reference, ENTITIES) and return entities in the parser's form.
 */
import type { DxfEntity, DxfGroup, DxfHandler, DxfPoint, DxfScanner } from "dxf-parser/dist/dxf-parser.js";
import { aciColor } from "./aci-color.js";
import { bulgedVertices, readHatchLoops } from "./dxf-hatch.js";
import { readPattern } from "./dxf-pattern.js";

/** Flags of a POLYLINE. */
const IS_3D = 8;
const IS_POLYGON_MESH = 16;
const IS_POLYFACE_MESH = 64;

const READERS: Readonly<Record<string, (scanner: DxfScanner) => DxfEntity>> = {
  CIRCLE: (scanner) => {
    const groups = groupsOf(scanner);
    return { ...commonOf("CIRCLE", groups), center: centerIn(groups), radius: numberIn(groups, 40) ?? 0 };
  },
  ELLIPSE: (scanner) => {
    const groups = groupsOf(scanner);
    return {
      ...commonOf("ELLIPSE", groups),
      center: centerIn(groups),
      majorAxisEndPoint: pointIn(groups, 11) ?? { x: 0, y: 0 },
      axisRatio: numberIn(groups, 40) ?? 1,
      startAngle: numberIn(groups, 41) ?? 0,
      endAngle: numberIn(groups, 42) ?? 2 * Math.PI,
    };
  },
  LWPOLYLINE: (scanner) => {
    const groups = groupsOf(scanner);
    return { ...commonOf("LWPOLYLINE", groups), shape: isClosed(groups), vertices: bulgedVertices(groups) };
  },
  POLYLINE: (scanner) => {
    const groups = groupsOf(scanner);
    const vertices: DxfPoint[] = [];
    while (scanner.lastReadGroup.value === "VERTEX") vertices.push(vertexOf(groupsOf(scanner)));
    // Without a SEQEND the line ends where another entity begins.
    if (scanner.lastReadGroup.value === "SEQEND") groupsOf(scanner);
    const flags = numberIn(groups, 70) ?? 0;
    // The vertices of a mesh are not in the order of a line. A type of its own, which is not drawn but reported.
    if ((flags & (IS_POLYGON_MESH | IS_POLYFACE_MESH)) !== 0) return commonOf("POLYLINE mesh", groups);
    return {
      ...commonOf("POLYLINE", groups),
      // A 3D polyline is in world coordinates.
      ...((flags & IS_3D) === 0 ? {} : { extrusionDirectionZ: 1 }),
      shape: isClosed(groups),
      vertices,
    };
  },
  TEXT: (scanner) => textOf("TEXT", groupsOf(scanner), 73),
  ATTRIB: (scanner) => textOf("ATTRIB", groupsOf(scanner), 74),
  MTEXT: (scanner) => mtextOf(groupsOf(scanner)),
  HATCH: (scanner) => {
    const groups = groupsOf(scanner);
    return {
      ...commonOf("HATCH", groups),
      isSolid: numberIn(groups, 70) === 1,
      loops: readHatchLoops(groups),
      pattern: readPattern(groups),
    };
  },
};

export const DXF_HANDLERS: readonly (new () => DxfHandler)[] = Object.entries(READERS).map(
  ([name, read]) =>
    class {
      readonly ForEntityName = name;
      readonly parseEntity = read;
    },
);

/** All groups up to the next entity, where the scanner stops. */
function groupsOf(scanner: DxfScanner): DxfGroup[] {
  const groups: DxfGroup[] = [];
  let group = scanner.next();
  while (group.code !== 0 && !scanner.isEOF()) {
    groups.push(group);
    group = scanner.next();
  }
  // An embedded object repeats the entity's own groups with other values.
  const embedded = groups.findIndex(({ code }) => code === 101);
  return embedded < 0 ? groups : groups.slice(0, embedded);
}

function numberIn(groups: readonly DxfGroup[], code: number): number | undefined {
  const value = groups.find((group) => group.code === code)?.value;
  return typeof value === "number" && Number.isFinite(value) ? value : undefined;
}

const isClosed = (groups: readonly DxfGroup[]): boolean => ((numberIn(groups, 70) ?? 0) & 1) === 1;

const textIn = (groups: readonly DxfGroup[], code: number): string =>
  String(groups.find((group) => group.code === code)?.value ?? "");

function pointIn(groups: readonly DxfGroup[], code: number): DxfPoint | undefined {
  const x = numberIn(groups, code);
  const y = numberIn(groups, code + 10);
  return x === undefined || y === undefined ? undefined : { x, y };
}

const centerIn = (groups: readonly DxfGroup[]): DxfPoint => pointIn(groups, 10) ?? { x: 0, y: 0 };

const vertexOf = (groups: readonly DxfGroup[]): DxfPoint => ({
  x: numberIn(groups, 10) ?? 0,
  y: numberIn(groups, 20) ?? 0,
  bulge: numberIn(groups, 42) ?? 0,
  splineControlPoint: ((numberIn(groups, 70) ?? 0) & 16) !== 0,
});

/** Properties common to all entities, under the parser's names. */
function commonOf(type: string, groups: readonly DxfGroup[]): DxfEntity {
  const colorIndex = numberIn(groups, 62);
  const color =
    numberIn(groups, 420) ?? (colorIndex === undefined ? undefined : aciColor(Math.abs(colorIndex)));
  return {
    type,
    layer: textIn(groups, 8) || "0",
    visible: (numberIn(groups, 60) ?? 0) === 0,
    inPaperSpace: (numberIn(groups, 67) ?? 0) !== 0,
    ...(colorIndex === undefined ? {} : { colorIndex }),
    ...(color === undefined ? {} : { color }),
    extrusionDirectionZ: numberIn(groups, 230) ?? 1,
  };
}

function textOf(type: string, groups: readonly DxfGroup[], valignCode: number): DxfEntity {
  const isInvisible = type === "ATTRIB" && ((numberIn(groups, 70) ?? 0) & 1) === 1;
  const common = commonOf(type, groups);
  const start = pointIn(groups, 10);
  const end = pointIn(groups, 11);
  const flags = numberIn(groups, 71) ?? 0;
  return {
    ...common,
    visible: common.visible === true && !isInvisible,
    writing: {
      text: textIn(groups, 1),
      style: textIn(groups, 7),
      height: numberIn(groups, 40) ?? 1,
      widthFactor: numberIn(groups, 41) ?? 1,
      angleDeg: numberIn(groups, 50) ?? 0,
      obliqueDeg: numberIn(groups, 51) ?? 0,
      isBackward: (flags & 2) !== 0,
      isUpsideDown: (flags & 4) !== 0,
      start: start ?? { x: 0, y: 0 },
      end: end ?? null,
      halign: numberIn(groups, 72) ?? 0,
      valign: numberIn(groups, valignCode) ?? 0,
    },
  };
}

function mtextOf(groups: readonly DxfGroup[]): DxfEntity {
  const along = pointIn(groups, 11);
  const turned = along === undefined ? undefined : (Math.atan2(along.y, along.x) * 180) / Math.PI;
  return {
    ...commonOf("MTEXT", groups),
    paragraphs: {
      // Long texts are split into pieces; the last has code 1.
      text: groups
        .filter(({ code }) => code === 1 || code === 3)
        .map(({ value }) => String(value))
        .join(""),
      style: textIn(groups, 7),
      height: numberIn(groups, 40) ?? 1,
      width: numberIn(groups, 41) ?? 0,
      angleDeg: turned ?? numberIn(groups, 50) ?? 0,
      at: pointIn(groups, 10) ?? { x: 0, y: 0 },
      attachment: numberIn(groups, 71) ?? 1,
      lineSpacing: numberIn(groups, 44) ?? 1,
    },
  };
}
