/**
 * DIMENSION, LEADER and MULTILEADER. A dimension usually comes as a block with its lines and text; one without
 * is drawn plainly, from its points. Arrowheads are drawn as their outline.
 */
import { RAD_PER_DEG } from "../../units.js";
import type { Content, DimensionStyle } from "./dxf-content.js";
import {
  hasFlag,
  nameIn,
  numberIn,
  OddValue,
  pointIn,
  pointsIn,
  requiredPoint,
  textIn,
  type DxfGroup,
  type DxfPoint,
  distance,
} from "./dxf-groups.js";
import { polyline, type Outline } from "./dxf-shapes.js";
import { throughPoints } from "./dxf-spline.js";
import { clamp } from "../../geometry/polyline.js";

/** Width of an arrowhead as a share of its length. */
const ARROW_WIDTH = 1 / 3;
const MIDDLE_CENTRE = 5;
const TOP_LEFT = 1;

const line = (...points: DxfPoint[]): Content => ({ kind: "lines", outline: polyline(points, false) });

/** The point at this distance from `from` towards `to`. */
function towards(from: DxfPoint, to: DxfPoint, length: number): DxfPoint {
  const share = length / distance(from, to);
  return { x: from.x + (to.x - from.x) * share, y: from.y + (to.y - from.y) * share };
}

/** An arrowhead at `tip` on a line to `tail`. None on a line that is too short for it, as in CAD programs. */
function arrow(tip: DxfPoint, tail: DxfPoint, length: number): Content[] {
  if (!(length > 0 && distance(tip, tail) >= 2 * length)) return [];
  const foot = towards(tip, tail, length);
  const [dx, dy] = [((foot.x - tip.x) * ARROW_WIDTH) / 2, ((foot.y - tip.y) * ARROW_WIDTH) / 2];
  const corners = [tip, { x: foot.x - dy, y: foot.y + dx }, { x: foot.x + dy, y: foot.y - dx }];
  return [{ kind: "lines", outline: polyline(corners, true), isNeverDashed: true }];
}

const words = (
  text: string,
  at: DxfPoint,
  height: number,
  angleDeg: number,
  attachment: number,
): Content => ({
  kind: "paragraphs",
  paragraphs: { text, style: "", height, width: 0, angleDeg, at, attachment, lineSpacing: 1 },
});

/** Types of dimensions in group 70. */
const TYPE = 7;
const ROTATED = 0;
const ALIGNED = 1;
const DIAMETER = 3;
const RADIUS = 4;

export function readDimension(groups: readonly DxfGroup[]): readonly Content[] {
  return [
    {
      kind: "insert",
      copy: {
        name: nameIn(groups, 2),
        at: { x: 0, y: 0 },
        xScale: 1,
        yScale: 1,
        angleRad: 0,
        columns: 1,
        rows: 1,
        columnSpacing: 0,
        rowSpacing: 0,
        instead: plainOrNull(groups),
      },
    },
  ];
}

/** The block of a dimension is drawn also if the dimension's own values cannot be read. */
function plainOrNull(groups: readonly DxfGroup[]): Content | null {
  try {
    return plainDimension(groups);
  } catch (error) {
    if (error instanceof OddValue) return null;
    throw error;
  }
}

/** Null for angles and ordinates. */
function plainDimension(groups: readonly DxfGroup[]): Content | null {
  const type = (numberIn(groups, 70) ?? 0) & TYPE;
  const at = pointIn(groups, 10);
  const middle = pointIn(groups, 11);
  const measured = numberIn(groups, 42);
  const style = textIn(groups, 3);
  if (at === undefined) return null;
  const label = (
    from: DxfPoint,
    to: DxfPoint,
    sign: string,
    { textHeight, decimals }: DimensionStyle,
  ): Content[] => {
    const value = measured !== undefined && measured >= 0 ? measured : distance(from, to);
    const digits = clamp(Math.trunc(decimals), 0, 8);
    const usual = `${sign}${Number(value.toFixed(digits))}`;
    const given = textIn(groups, 1);
    // A single blank is how a file says that there is no text.
    const text = given === "" ? usual : given.replaceAll("<>", usual);
    const angle = Math.atan2(to.y - from.y, to.x - from.x) / RAD_PER_DEG;
    const upright = angle > 90 + 1e-6 || angle <= -90 + 1e-6 ? angle + 180 : angle;
    const place = middle ?? { x: (from.x + to.x) / 2, y: (from.y + to.y) / 2 };
    return [words(text, place, textHeight, upright, MIDDLE_CENTRE)];
  };
  if (type === ROTATED || type === ALIGNED) {
    const [a, b] = [requiredPoint(groups, 13), requiredPoint(groups, 14)];
    const angle =
      type === ROTATED ? (numberIn(groups, 50) ?? 0) * RAD_PER_DEG : Math.atan2(b.y - a.y, b.x - a.x);
    const [cos, sin] = [Math.cos(angle), Math.sin(angle)];
    const onLine = ({ x, y }: DxfPoint): DxfPoint => {
      const along = (x - at.x) * cos + (y - at.y) * sin;
      return { x: at.x + along * cos, y: at.y + along * sin };
    };
    const [from, to] = [onLine(a), onLine(b)];
    return {
      kind: "styled",
      style,
      contents: (sizes) => [
        line(a, from),
        line(b, to),
        line(from, to),
        ...arrow(from, to, sizes.arrow),
        ...arrow(to, from, sizes.arrow),
        ...label(from, to, "", sizes),
      ],
    };
  }
  if (type !== DIAMETER && type !== RADIUS) return null;
  const rim = requiredPoint(groups, 15);
  return {
    kind: "styled",
    style,
    contents: (sizes) => [
      line(at, rim),
      ...arrow(rim, at, sizes.arrow),
      ...(type === DIAMETER ? arrow(at, rim, sizes.arrow) : []),
      ...label(at, rim, type === DIAMETER ? "Ø" : "R", sizes),
    ],
  };
}

/** A polyline or a smooth curve with an arrow at its first point. Its text is an entity of its own. */
export function readLeader(groups: readonly DxfGroup[]): readonly Content[] {
  const points = pointsIn(groups, 10);
  if (points.length < 2) throw new OddValue("it has fewer than two points");
  const isCurve = numberIn(groups, 72) === 1;
  const hasArrow = (numberIn(groups, 71) ?? 1) !== 0;
  const outline: Outline = isCurve ? throughPoints(points) : polyline(points, false);
  const contents = ({ arrow: size }: DimensionStyle): Content[] => [
    { kind: "lines", outline },
    ...(hasArrow ? arrow(points[0], points[1], size) : []),
  ];
  return [{ kind: "styled", style: textIn(groups, 3), contents }];
}

/** The beginnings of the parts of a MULTILEADER's data, and their names. They end with "}". */
const PARTS: ReadonlyMap<string, string> = new Map([
  ["CONTEXT_DATA{", "context"],
  ["LEADER{", "leader"],
  ["LEADER_LINE{", "line"],
]);

/** Lines with arrows to a common landing, and the text there. A block in place of the text is reported. */
export function readMultiLeader(groups: readonly DxfGroup[]): readonly Content[] {
  const contents: Content[] = [];
  const open: string[] = [];
  const context: DxfGroup[] = [];
  let leader: DxfGroup[] = [];
  let lines: DxfGroup[][] = [];
  const endLeader = (): void => {
    const landing = pointIn(leader, 10);
    const along = pointIn(leader, 11);
    const length = numberIn(leader, 40) ?? 0;
    const size = numberIn(context, 140) ?? 0;
    for (const one of lines) {
      const points = [...pointsIn(one, 10), ...(landing === undefined ? [] : [landing])];
      if (points.length > 1) contents.push(line(...points), ...arrow(points[0], points[1], size));
    }
    if (landing !== undefined && along !== undefined && length > 0)
      contents.push(line(landing, { x: landing.x + along.x * length, y: landing.y + along.y * length }));
    [leader, lines] = [[], []];
  };
  for (const group of groups) {
    const part = PARTS.get(group.value);
    if (part !== undefined && group.code >= 300 && group.code < 306) {
      open.push(part);
      if (part === "line") lines.push([]);
    } else if (group.value === "}" && group.code >= 300 && group.code < 306) {
      if (open.pop() === "leader") endLeader();
    } else if (open.at(-1) === "line") lines.at(-1)?.push(group);
    else if (open.at(-1) === "leader") leader.push(group);
    else if (open.at(-1) === "context") context.push(group);
  }
  if (hasFlag(context, 290, 1)) {
    const along = pointIn(context, 13) ?? { x: 1, y: 0 };
    const angleDeg = Math.atan2(along.y, along.x) / RAD_PER_DEG;
    const align = clamp(numberIn(context, 171) ?? 1, 1, 3) - 1;
    contents.push(
      words(
        textIn(context, 304),
        requiredPoint(context, 12),
        numberIn(context, 41) ?? 1,
        angleDeg,
        TOP_LEFT + align,
      ),
    );
  }
  if (hasFlag(context, 296, 1)) contents.push({ kind: "not drawn", name: "block of a MULTILEADER" });
  if (contents.length === 0) throw new OddValue("it has neither lines nor text");
  return contents;
}
