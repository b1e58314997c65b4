/**
 * Stroke order: 20 000 random short strokes on A4, the pen-up travel and the cost of ordering. Seconds are
 * processor time of this process, so that other work on the machine does not count. `PLOTWRIGHT_ORDER_S=600
 * npm run bench -- order` adds a long run; `PLOTWRIGHT_ORDER_SVG=FILE` writes the strokes for comparison with
 * other programs.
 */
import { writeFileSync } from "node:fs";
import {
  DEFAULT_PREPARE,
  prepare,
  toSvg,
  type Drawing,
  type PrepareSettings,
  type StrokeSet,
} from "../src/index.js";
import { NearestPoints, PointGrid } from "../src/geometry/point-grid.js";
import { randomFrom } from "../src/prepare/work.js";
import { drawingOf } from "../test/support/drawings/drawings.js";

type Report = (section: string, rows: readonly Record<string, string | number>[]) => void;

const STROKES = 20_000;
const PAPER = { widthMm: 297, heightMm: 210 };
const SETTINGS: PrepareSettings = { ...DEFAULT_PREPARE, marginMm: 0, fit: false, clipToMargins: false };

export default async function orderBench(report: Report): Promise<void> {
  const drawing = randomStrokes();
  const file = prepare(drawing, { ...SETTINGS, order: "none" });
  if (process.env["PLOTWRIGHT_ORDER_SVG"]) {
    const apart = prepare(drawing, { ...SETTINGS, order: "none", joinMm: 0 });
    writeFileSync(process.env["PLOTWRIGHT_ORDER_SVG"], toSvg(apart.strokes, PAPER));
  }
  const fast = measured(drawing, { ...SETTINGS, order: "fast" });
  const row = (order: string, mm: number, s: number | string): Record<string, string | number> => ({
    order,
    "travel mm": Math.round(mm),
    "of fast": (mm / fast.mm).toFixed(3),
    "CPU s": s,
  });
  const rows = [
    row("as in the file", file.travelMm, ""),
    row("greedy, no reversal", greedyForwards(fast.strokes), ""),
    row("fast", fast.mm, fast.orderS),
  ];
  const budgets = [2, 5, DEFAULT_PREPARE.orderS, Number(process.env["PLOTWRIGHT_ORDER_S"] ?? 0)];
  for (const orderS of budgets.filter((s) => s > 0)) {
    const best = measured(drawing, { ...SETTINGS, order: "best", orderS });
    rows.push(row(`best, ${orderS} s`, best.mm, best.orderS));
  }
  // In the file's order only neighbours are joined, so it has more strokes.
  report(`Ordering ${fast.strokes.layer.length} strokes`, rows);
}

function randomStrokes(): Drawing {
  const random = randomFrom(STROKES);
  const shapes = Array.from({ length: STROKES }, () => {
    const x = 10 + 277 * random();
    const y = 10 + 190 * random();
    const angle = 2 * Math.PI * random();
    const length = 0.5 + 4.5 * random();
    return `M${x} ${y}L${x + length * Math.cos(angle)} ${y + length * Math.sin(angle)}`;
  });
  return drawingOf(shapes, PAPER);
}

const cpuS = (): number => {
  const { user, system } = process.cpuUsage();
  return (user + system) / 1e6;
};

/** Travel, and the processor time between the steps "ordering" and "done". */
function measured(
  drawing: Drawing,
  settings: PrepareSettings,
): { strokes: StrokeSet; mm: number; orderS: number } {
  let from = 0;
  const prepared = prepare(drawing, settings, {
    nowS: cpuS,
    onProgress: (_, step) => {
      if (step === "ordering" && from === 0) from = cpuS();
    },
  });
  const { strokes, travelMm } = prepared;
  return { strokes, mm: travelMm, orderS: Number((cpuS() - from).toFixed(2)) };
}

/** A program that always goes to the nearest start point and never reverses a stroke. */
function greedyForwards({ xy, offsets }: StrokeSet): number {
  const count = offsets.length - 1;
  const starts = Float64Array.from({ length: 2 * count }, (_, k) => xy[2 * offsets[k >> 1] + (k & 1)]);
  const points = new PointGrid(starts);
  const nearest = new NearestPoints(1);
  let [x, y, travel] = [0, 0, 0];
  for (let k = 0; k < count; k++) {
    points.find(x, y, Infinity, nearest);
    const [i] = nearest.ids;
    points.remove(i);
    travel += Math.hypot(starts[2 * i] - x, starts[2 * i + 1] - y);
    const last = offsets[i + 1] - 1;
    [x, y] = [xy[2 * last], xy[2 * last + 1]];
  }
  return travel + Math.hypot(x, y);
}
