/**
 * The shapes that resvg, an independent renderer, finds in an SVG: its resolved tree printed as SVG, whose
 * paths are absolute M, L, Q, C and Z. They are read by a separate reader that shares no code with the
 * product.
 */
import { readFileSync } from "node:fs";
import { createRequire } from "node:module";
import { initWasm, Resvg } from "@resvg/resvg-wasm";
import { SaxesParser } from "saxes";

type Map6 = readonly [number, number, number, number, number, number];
export type Polyline = [number, number][];

let ready: Promise<void> | null = null;
export function loadResvg(): Promise<void> {
  const wasm = createRequire(import.meta.url).resolve("@resvg/resvg-wasm/index_bg.wasm");
  ready ??= initWasm(readFileSync(wasm));
  return ready;
}

const STEPS = 40;

const times = (m: Map6, n: Map6): Map6 => [
  m[0] * n[0] + m[2] * n[1],
  m[1] * n[0] + m[3] * n[1],
  m[0] * n[2] + m[2] * n[3],
  m[1] * n[2] + m[3] * n[3],
  m[0] * n[4] + m[2] * n[5] + m[4],
  m[1] * n[4] + m[3] * n[5] + m[5],
];

/** Polylines of each painted path in px, in paint order. */
export function resvgShapes(svg: string): { shapes: Polyline[][]; width: number; height: number } {
  const resvg = new Resvg(svg, { font: { loadSystemFonts: false } });
  const { width, height } = resvg;
  const text = resvg.toString();
  resvg.free();
  const shapes: Polyline[][] = [];
  const maps: Map6[] = [[1, 0, 0, 1, 0, 0]];
  let hidden = 0;
  const parser = new SaxesParser({ xmlns: false });
  parser.on("opentag", (tag) => {
    const attributes = tag.attributes as Record<string, string>;
    const own = /matrix\(([^)]*)\)/.exec(attributes["transform"] ?? "");
    const map =
      own === null
        ? maps[maps.length - 1]
        : times(
            maps[maps.length - 1],
            own[1]
              .trim()
              .split(/[\s,]+/)
              .map(Number) as unknown as Map6,
          );
    maps.push(map);
    if (/^(defs|clipPath|mask|pattern)$/.test(tag.name)) hidden++;
    if (tag.name === "path" && hidden === 0 && attributes["visibility"] !== "hidden") {
      shapes.push(polylines(attributes["d"], map));
    }
  });
  parser.on("closetag", (tag) => {
    maps.pop();
    if (/^(defs|clipPath|mask|pattern)$/.test(tag.name)) hidden--;
  });
  parser.write(text).close();
  return { shapes, width, height };
}

function polylines(d: string, m: Map6): Polyline[] {
  const result: Polyline[] = [];
  let line: Polyline = [];
  let [x, y] = [0, 0];
  const add = (px: number, py: number): void => {
    line.push([m[0] * px + m[2] * py + m[4], m[1] * px + m[3] * py + m[5]]);
  };
  for (const [, letter, body] of d.matchAll(/([MLQCZ])([^MLQCZ]*)/g)) {
    const n =
      body.trim() === ""
        ? []
        : body
            .trim()
            .split(/[\s,]+/)
            .map(Number);
    if (letter === "M") {
      line = [];
      result.push(line);
      add(n[0], n[1]);
    } else if (letter === "L") add(n[0], n[1]);
    else if (letter === "Z") line.push(line[0]);
    else {
      const points = [x, y, ...n];
      for (let i = 1; i <= STEPS; i++) {
        const [px, py] = bezier(points, i / STEPS);
        add(px, py);
      }
    }
    if (letter !== "Z") [x, y] = n.slice(-2);
  }
  return result;
}

/** de Casteljau, any degree. */
function bezier(points: readonly number[], t: number): [number, number] {
  let p = [...points];
  while (p.length > 2) p = p.slice(0, -2).map((v, i) => v + t * (p[i + 2] - v));
  return [p[0], p[1]];
}

/** Max distance from any vertex of `from` to the lines `to`. */
export function farthest(from: readonly Polyline[], to: readonly Polyline[]): number {
  let worst = 0;
  for (const line of from) {
    for (const [x, y] of line) {
      let best = Infinity;
      for (const other of to) {
        for (let k = 0; k < other.length; k++) {
          const [ax, ay] = other[k];
          const [bx, by] = other[Math.min(k + 1, other.length - 1)];
          const [dx, dy] = [bx - ax, by - ay];
          const length2 = dx * dx + dy * dy;
          const t = length2 === 0 ? 0 : Math.min(1, Math.max(0, ((x - ax) * dx + (y - ay) * dy) / length2));
          best = Math.min(best, Math.hypot(x - ax - t * dx, y - ay - t * dy));
        }
      }
      worst = Math.max(worst, best);
    }
  }
  return worst;
}
