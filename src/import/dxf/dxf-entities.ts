/**
 * The table of all entities of a DXF (AutoCAD DXF reference, ENTITIES): how each one is drawn, or that it is
 * only reported, and how it is read from its groups.
 */
import { RAD_PER_DEG } from "../../units.js";
import { aciColor } from "./aci-color.js";
import { IDENTITY, type Affine } from "../../geometry/affine.js";
import { readDimension, readLeader, readMultiLeader } from "./dxf-dimensions.js";
import {
  bulgedVertices,
  hasFlag,
  keyOf,
  nameIn,
  numberIn,
  OddValue,
  pointIn,
  requiredIn,
  requiredPoint,
  textIn,
  type DxfGroup,
  type DxfRecord,
} from "./dxf-groups.js";
import { readHatchLoops } from "./dxf-hatch.js";
import type { BlockCopy, Content } from "./dxf-content.js";
import type { DxfParagraphs } from "./dxf-paragraphs.js";
import { readPattern } from "./dxf-pattern.js";
import { angleInPlane, planeAtPlace, planeOf, vectorIn } from "./dxf-plane.js";
import {
  arc,
  IS_3D,
  IS_MESH,
  polyline,
  readEllipse,
  readFace,
  readMesh,
  readMultiLine,
  readPolyline,
  readSolid,
  turnBetween,
  type Outline,
} from "./dxf-shapes.js";
import { readSpline } from "./dxf-spline.js";
import type { DxfWriting } from "./dxf-text.js";
import { clamp } from "../../geometry/polyline.js";

export interface DxfEntity {
  readonly type: string;
  readonly layer: string;
  readonly isVisible: boolean;
  readonly inPaperSpace: boolean;
  /** Undefined: by layer. */
  readonly colorIndex: number | undefined;
  /** 0xrrggbb */
  readonly color: number | undefined;
  /** Key of its linetype; "" for by layer. */
  readonly linetype: string;
  readonly linetypeScale: number;
  /** Maps its coordinates to those of the drawing. */
  readonly plane: Affine;
  /** Empty for a part of another entity, and for what is never on paper. */
  readonly contents: readonly Content[];
  /** Values that cannot be used. If `contents` is null the whole entity is left out. */
  readonly odd: readonly string[];
  readonly isUnreadable: boolean;
}

type Reader = (groups: readonly DxfGroup[], vertices: readonly (readonly DxfGroup[])[]) => readonly Content[];

interface EntityKind {
  /** Drawn as CAD programs do; drawn with simplifications that docs/import.md names; or only reported. */
  readonly how: "drawn" | "alike" | "reported";
  readonly read?: Reader;
  /** Left out: its coordinates are those of its own plane. */
  readonly plane?: (groups: readonly DxfGroup[]) => Affine;
}

const lines = (outline: Outline): readonly Content[] => [{ kind: "lines", outline }];
const drawn = (read: Reader): EntityKind => ({ how: "drawn", read });
const inWorld = (kind: EntityKind): EntityKind => ({ ...kind, plane: () => IDENTITY });
const alike = (read: Reader): EntityKind => ({ how: "alike", read });
const reported: EntityKind = { how: "reported" };

const text =
  (valignCode: number): Reader =>
  (groups) => [{ kind: "text", writing: readWriting(groups, textIn(groups, 1), valignCode) }];
const solid: Reader = (groups) => [
  { kind: "lines", outline: readSolid(groups), isFilled: true, isNeverDashed: true },
];
const endless =
  (isBothWays: boolean): Reader =>
  (groups) => [
    { kind: "endless", at: requiredPoint(groups, 10), along: requiredPoint(groups, 11), isBothWays },
  ];
const IS_INVISIBLE = 1;
const IS_CONSTANT = 2;

export const DXF_ENTITIES: ReadonlyMap<string, EntityKind> = new Map<string, EntityKind>([
  ["3DFACE", inWorld(drawn((groups) => lines(readFace(groups))))],
  ["3DSOLID", reported],
  ["ACAD_PROXY_ENTITY", reported],
  ["ACAD_TABLE", alike((groups) => [{ kind: "insert", copy: { ...copyOf(groups), xScale: 1, yScale: 1 } }])],
  ["ARC", drawn((groups) => lines(readArc(groups)))],
  ["ARC_DIMENSION", inWorld(alike(readDimension))],
  ["ATTDEF", drawn(readAttributeDefinition)],
  ["ATTRIB", drawn((groups) => (hasFlag(groups, 70, IS_INVISIBLE) ? [] : text(74)(groups, [])))],
  ["BODY", reported],
  ["CIRCLE", drawn((groups) => lines(readCircle(groups)))],
  ["COORDINATION MODEL", reported],
  ["DGNUNDERLAY", reported],
  ["DIMENSION", inWorld(alike(readDimension))],
  ["DWFUNDERLAY", reported],
  ["ELLIPSE", inWorld(drawn((groups) => lines(readEllipse(groups))))],
  ["EXTRUDEDSURFACE", reported],
  ["GEOPOSITIONMARKER", reported],
  [
    "HATCH",
    drawn((groups) => [
      {
        kind: "hatch",
        // A fill from one colour to another is solid too.
        isSolid: numberIn(groups, 70) === 1 && numberIn(groups, 450) !== 1,
        loops: readHatchLoops(groups),
        pattern: readPattern(groups),
      },
    ]),
  ],
  ["HELIX", inWorld(drawn((groups) => lines(readSpline(beforeSubclass(groups, "AcDbHelix")))))],
  ["IMAGE", reported],
  ["INSERT", drawn((groups) => [{ kind: "insert", copy: copyOf(groups) }])],
  ["LARGE_RADIAL_DIMENSION", inWorld(alike(readDimension))],
  ["LEADER", inWorld(alike(readLeader))],
  ["LIGHT", reported],
  [
    "LINE",
    inWorld(
      drawn((groups) => lines(polyline([requiredPoint(groups, 10), requiredPoint(groups, 11)], false))),
    ),
  ],
  ["LOFTEDSURFACE", reported],
  ["LWPOLYLINE", drawn((groups) => lines(polyline(bulgedVertices(groups), hasFlag(groups, 70, 1))))],
  ["MESH", inWorld(alike((groups) => lines(readMesh(groups))))],
  ["MLEADER", inWorld(alike(readMultiLeader))],
  ["MLINE", inWorld(alike((groups) => lines(readMultiLine(groups))))],
  [
    "MTEXT",
    {
      how: "drawn",
      read: (groups) => [{ kind: "paragraphs", paragraphs: readParagraphs(groups) }],
      plane: planeAtPlace,
    },
  ],
  ["MULTILEADER", inWorld(alike(readMultiLeader))],
  ["NURBSURFACE", reported],
  ["OLE2FRAME", reported],
  ["OLEFRAME", reported],
  ["PDFUNDERLAY", reported],
  ["PLANESURFACE", reported],
  [
    "POINT",
    inWorld(
      drawn((groups) => {
        const at = requiredPoint(groups, 10);
        return [{ kind: "lines", outline: polyline([at, at], false), isNeverDashed: true }];
      }),
    ),
  ],
  [
    "POLYLINE",
    {
      how: "drawn",
      read: (groups, vertices) => lines(readPolyline(groups, vertices)),
      plane: (groups) => (hasFlag(groups, 70, IS_3D | IS_MESH) ? IDENTITY : planeOf(groups)),
    },
  ],
  ["RAY", inWorld(alike(endless(false)))],
  ["REGION", reported],
  ["REVOLVEDSURFACE", reported],
  ["SECTION", reported],
  // The end of the vertices of a POLYLINE, or of the attributes of an INSERT.
  ["SEQEND", { how: "drawn", read: () => [] }],
  ["SHAPE", reported],
  ["SOLID", drawn(solid)],
  ["SPLINE", inWorld(drawn((groups) => lines(readSpline(groups))))],
  ["SUN", reported],
  ["SURFACE", reported],
  ["SWEPTSURFACE", reported],
  ["TEXT", drawn(text(73))],
  ["TOLERANCE", reported],
  ["TRACE", drawn(solid)],
  // A part of a POLYLINE, which reads it; alone it is a fault of the file.
  ["VERTEX", { how: "drawn" }],
  // Number 1 is the sheet of paper itself.
  [
    "VIEWPORT",
    {
      how: "reported",
      read: (groups) => (numberIn(groups, 69) === 1 ? [] : [{ kind: "not drawn", name: "VIEWPORT" }]),
    },
  ],
  ["WIPEOUT", reported],
  ["XLINE", inWorld(alike(endless(true)))],
]);

function readAttributeDefinition(groups: readonly DxfGroup[]): readonly Content[] {
  if (hasFlag(groups, 70, IS_INVISIBLE)) return [];
  const isConstant = hasFlag(groups, 70, IS_CONSTANT);
  const tag = {
    kind: "text",
    writing: readWriting(groups, textIn(groups, 2), 74),
    only: "outside blocks",
  } as const;
  const value = {
    kind: "text",
    writing: readWriting(groups, textIn(groups, 1), 74),
    only: "in blocks",
  } as const;
  return isConstant ? [tag, value] : [tag];
}

/** An entity that cannot be read is left out and reported; an odd common value is only ignored. */
export function readEntity(
  { type, groups: all }: DxfRecord,
  vertices: readonly (readonly DxfGroup[])[],
): DxfEntity {
  // An embedded object repeats the entity's own groups with other values.
  const groups = before(all, ({ code }) => code === 101);
  const kind = DXF_ENTITIES.get(type);
  const odd: string[] = [];
  let contents: readonly Content[] = [];
  let plane = IDENTITY;
  let isUnreadable = false;
  try {
    plane = (kind?.plane ?? planeOf)(groups);
    contents = kind?.read?.(groups, vertices) ?? [{ kind: "not drawn", name: type }];
  } catch (error) {
    if (!(error instanceof OddValue)) throw error;
    odd.push(error.message);
    isUnreadable = true;
  }
  const common = (code: number): number | undefined => {
    try {
      return numberIn(groups, code);
    } catch (error) {
      if (!(error instanceof OddValue)) throw error;
      odd.push(error.message);
      return undefined;
    }
  };
  const colorIndex = common(62);
  const trueColor = common(420);
  return {
    type,
    layer: nameIn(groups, 8) || "0",
    isVisible: (common(60) ?? 0) === 0,
    inPaperSpace: (common(67) ?? 0) !== 0,
    colorIndex,
    color: trueColor ?? (colorIndex === undefined ? undefined : aciColor(Math.abs(colorIndex))),
    linetype: keyOf(nameIn(groups, 6)),
    linetypeScale: common(48) ?? 1,
    plane,
    contents,
    odd,
    isUnreadable,
  };
}

function before(groups: readonly DxfGroup[], isEnd: (group: DxfGroup) => boolean): readonly DxfGroup[] {
  const end = groups.findIndex(isEnd);
  return end < 0 ? groups : groups.slice(0, end);
}

const beforeSubclass = (groups: readonly DxfGroup[], name: string): readonly DxfGroup[] =>
  before(groups, ({ code, value }) => code === 100 && value === name);

function readCircle(groups: readonly DxfGroup[]): Outline {
  const radius = requiredIn(groups, 40);
  return arc(requiredPoint(groups, 10), radius, radius, 0, 0, 2 * Math.PI);
}

function readArc(groups: readonly DxfGroup[]): Outline {
  const radius = requiredIn(groups, 40);
  const start = (numberIn(groups, 50) ?? 0) * RAD_PER_DEG;
  const end = (numberIn(groups, 51) ?? 360) * RAD_PER_DEG;
  return arc(requiredPoint(groups, 10), radius, radius, 0, start, turnBetween(start, end));
}

function copyOf(groups: readonly DxfGroup[]): BlockCopy {
  const [xScale, yScale] = [41, 42].map((code) => numberIn(groups, code) ?? 1);
  if (xScale === 0 || yScale === 0) throw new OddValue("its scale is 0");
  const copies = (code: number): number => clamp(Math.trunc(numberIn(groups, code) ?? 1), 1, 1000);
  return {
    name: nameIn(groups, 2),
    at: pointIn(groups, 10) ?? { x: 0, y: 0 },
    xScale,
    yScale,
    angleRad: (numberIn(groups, 50) ?? 0) * RAD_PER_DEG,
    columns: copies(70),
    rows: copies(71),
    columnSpacing: numberIn(groups, 44) ?? 0,
    rowSpacing: numberIn(groups, 45) ?? 0,
    instead: null,
  };
}

function readWriting(groups: readonly DxfGroup[], content: string, valignCode: number): DxfWriting {
  const flags = numberIn(groups, 71) ?? 0;
  return {
    text: content,
    style: textIn(groups, 7),
    height: numberIn(groups, 40) ?? 1,
    widthFactor: numberIn(groups, 41) ?? 1,
    angleDeg: numberIn(groups, 50) ?? 0,
    obliqueDeg: numberIn(groups, 51) ?? 0,
    isBackward: (flags & 2) !== 0,
    isUpsideDown: (flags & 4) !== 0,
    start: pointIn(groups, 10) ?? { x: 0, y: 0 },
    end: pointIn(groups, 11) ?? null,
    halign: numberIn(groups, 72) ?? 0,
    valign: numberIn(groups, valignCode) ?? 0,
  };
}

function readParagraphs(groups: readonly DxfGroup[]): DxfParagraphs {
  const along = pointIn(groups, 11);
  const turned = along === undefined ? undefined : angleInPlane(groups, vectorIn(groups, 11)) / RAD_PER_DEG;
  return {
    // Long texts are split into pieces; the last has code 1.
    text: groups
      .filter(({ code }) => code === 1 || code === 3)
      .map(({ value }) => value)
      .join(""),
    style: textIn(groups, 7),
    height: numberIn(groups, 40) ?? 1,
    width: numberIn(groups, 41) ?? 0,
    angleDeg: turned ?? numberIn(groups, 50) ?? 0,
    at: pointIn(groups, 10) ?? { x: 0, y: 0 },
    attachment: numberIn(groups, 71) ?? 1,
    lineSpacing: numberIn(groups, 44) ?? 1,
  };
}
