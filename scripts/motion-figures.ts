/** Draws the figures of docs/motion.md with the planner: `npx tsx scripts/motion-figures.ts`. */
import { mkdirSync, writeFileSync } from "node:fs";
import path from "node:path";
import {
  DEFAULT_PEN,
  machineById,
  plan,
  stateAt,
  type MachineProfile,
  type MotionSettings,
  type StrokeSet,
  type Trajectory,
} from "../src/index.js";
import { DEFAULT_FIT, MOTION_MODES, swingPen, type MotionMode, type Shaper } from "../src/internal.js";
import { cornersOf, type Point } from "../test/support/reference-planners/polyline.js";
import { junctionDeviation } from "../test/support/reference-planners/systems.js";

const FOLDER = path.join(import.meta.dirname, "..", "docs", "figures");
const COLORS = ["#1b6ca8", "#c1440e", "#2f7d32"];
const DRAW = { speedMmPerS: 50, accelMmPerS2: 500, cornerMm: 0.05, jerkMmPerS3: 10_000 };

interface Series {
  readonly label: string;
  readonly color: string;
  readonly points: readonly Point[];
  readonly dots?: boolean;
}

interface Chart {
  readonly title: string;
  readonly xLabel: string;
  readonly yLabel: string;
  readonly series: readonly Series[];
  /** Same scale on both axes: a picture of the paper. */
  readonly square?: boolean;
}

mkdirSync(FOLDER, { recursive: true });
save("corner-deviations", [cornerChart()]);
save("three-modes", [overTime("speed"), overTime("acceleration")]);
save("circle-resampling", [resamplingChart()]);
save("swinging-pen", [swingChart("none", "not shaped"), swingChart("zv", "shaped by zv")]);
save("merged-pieces", [fitChart(null, "as planned"), fitChart(DEFAULT_FIT, "merged")]);

function cornerChart(): Chart {
  const corner: Point[] = [
    [0, 3],
    [0, 0],
    [3, 0],
  ];
  const series = [0.1, 0.25, 0.5].map((cornerMm, i): Series => {
    const t = planned(corner, "blend", { draw: { ...DRAW, cornerMm } });
    return { label: `δ = ${cornerMm} mm`, color: COLORS[i], points: along(t, ({ x, y }) => [x, y]) };
  });
  const drawing = { label: "drawing", color: "#999", points: corner };
  return {
    title: "A right angle in blend mode",
    xLabel: "mm",
    yLabel: "mm",
    square: true,
    series: [drawing, ...series],
  };
}

/** Two corners as the carriage takes them, and as a pen on springs draws them. */
function swingChart(shaper: Shaper, label: string): Chart {
  const springs = { xHz: 15, yHz: 25, damping: 0.05 };
  const corners: Point[] = [
    [10, 10],
    [10, 14],
    [18, 14],
    [18, 10],
  ];
  const draw = { ...DRAW, speedMmPerS: 80, accelMmPerS2: 1_750, cornerMm: 0.022 };
  const t = planned(corners, "blend", { draw, shaper }, { ...machineById("axidraw-v3"), springs });
  const pen: Point[] = [];
  swingPen(t, springs, 0.0005, ({ x, y, stroke }) => stroke >= 0 && pen.push([x, y]));
  return {
    title: `A = 1750 mm/s², 15 and 25 Hz, ${label}`,
    xLabel: "mm",
    yLabel: "mm",
    square: true,
    series: [
      { label: "drawing", color: "#999", points: corners },
      { label: "carriage", color: COLORS[2], points: along(t, ({ x, y }) => [x, y]) },
      { label: "pen", color: COLORS[1], points: pen },
    ],
  };
}

function overTime(what: "speed" | "acceleration"): Chart {
  const corner: Point[] = [
    [0, 0],
    [8, 0],
    [8, 8],
  ];
  const series = MOTION_MODES.map((mode, i): Series => {
    const t = planned(corner, mode);
    const start = t.runs.startS[0];
    return {
      label: mode,
      color: COLORS[i],
      points: along(t, (s, time) => [
        time - start,
        what === "speed" ? Math.hypot(s.vx, s.vy) : Math.hypot(s.ax, s.ay),
      ]),
    };
  });
  const unit = what === "speed" ? "mm/s" : "mm/s²";
  return { title: `Two sides of 8 mm: ${what}`, xLabel: "s", yLabel: unit, series };
}

function resamplingChart(): Chart {
  const radius = 5;
  const steps = Array.from({ length: 24 }, (_, i) => 2 * 0.82 ** i);
  const limits = { speed: 200, accel: DRAW.accelMmPerS2, deviation: DRAW.cornerMm };
  const alone = steps.map((step): Point => {
    const [corner] = cornersOf(circle(radius, step, 1));
    return [Math.log10(step), Math.min(limits.speed, junctionDeviation(corner, limits))];
  });
  const draw = { ...DRAW, speedMmPerS: limits.speed };
  const ours = steps.map((step): Point => {
    const t = planned(circle(radius, step, 2), "junction", { draw });
    return [Math.log10(step), Math.max(...along(t, (s) => [0, Math.hypot(s.vx, s.vy)]).map(([, v]) => v))];
  });
  const bound = Math.sqrt(limits.accel * radius);
  return {
    title: `A circle of ${radius} mm radius, V = ${limits.speed} mm/s`,
    xLabel: "log10 of the distance between samples, mm",
    yLabel: "mm/s",
    series: [
      { label: "junction deviation alone", color: COLORS[1], points: alone },
      { label: "with the tangent circle", color: COLORS[0], points: ours },
      { label: "√(A r)", color: "#999", points: steps.map((step) => [Math.log10(step), bound]) },
    ],
  };
}

function fitChart(fit: MotionSettings["fit"], label: string): Chart {
  const wave = Array.from({ length: 500 }, (_, i): Point => [i * 0.08, 6 * Math.sin(i / 40)]);
  const t = planned(wave, "blend", { fit });
  const ends: Point[] = [];
  for (let k = t.runs.firstBlock[0]; k < t.runs.firstBlock[1]; k++) ends.push([t.x[k], t.y[k]]);
  return {
    title: `A line of 500 points, ${label}: ${ends.length} pieces`,
    xLabel: "mm",
    yLabel: "mm",
    square: true,
    series: [
      { label: "drawing", color: "#999", points: wave },
      { label: "where a piece begins", color: COLORS[1], points: ends, dots: true },
    ],
  };
}

function planned(
  points: readonly Point[],
  mode: MotionMode,
  other: Partial<MotionSettings> = {},
  machine?: MachineProfile,
): Trajectory {
  const strokes: StrokeSet = {
    xy: Float64Array.from(points.flat()),
    offsets: Uint32Array.of(0, points.length),
    layer: new Uint16Array(1),
    layers: [{ id: "all", name: "All", color: null }],
  };
  const [startX, startY] = points[0];
  const motion: MotionSettings = { mode, draw: DRAW, travel: DRAW, fit: null, ...other };
  return plan(strokes, motion, DEFAULT_PEN, { startX, startY, returnHome: false, machine });
}

/** Samples of the first run, each as the point that `pointOf` makes of it. */
function along(t: Trajectory, pointOf: (state: ReturnType<typeof stateAt>, tS: number) => Point): Point[] {
  const start = t.runs.startS[0];
  const end = t.penMoves.startS[1] - 1e-9;
  const count = 1500;
  return Array.from({ length: count + 1 }, (_, i) => {
    const tS = start + ((end - start) * i) / count;
    return pointOf(stateAt(t, tS), tS);
  });
}

function circle(radius: number, step: number, turns: number): Point[] {
  const count = Math.max(3, Math.round((2 * Math.PI * radius) / step));
  return Array.from({ length: turns * count + 1 }, (_, i): Point => [
    radius * Math.cos((2 * Math.PI * i) / count),
    radius * Math.sin((2 * Math.PI * i) / count),
  ]);
}

function save(name: string, charts: readonly Chart[]): void {
  // Narrow, with the legend above: the words are readable on a phone too.
  const [width, height] = [480, 320];
  const body = charts.map((chart, i) => `<g transform="translate(0 ${i * height})">${drawn(chart)}</g>`);
  const svg =
    `<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 ${width} ${height * charts.length}" ` +
    `font-family="sans-serif" font-size="14">\n<rect width="100%" height="100%" fill="#fff"/>\n${body.join("\n")}\n</svg>\n`;
  writeFileSync(path.join(FOLDER, `${name}.svg`), svg);
}

function drawn(chart: Chart): string {
  const box = { left: 60, top: 52, width: 400, height: 220 };
  const all = chart.series.flatMap((s) => s.points);
  const [x0, x1] = [Math.min(...all.map((p) => p[0])), Math.max(...all.map((p) => p[0]))];
  const [low, y1] = [Math.min(...all.map((p) => p[1])), Math.max(...all.map((p) => p[1]))];
  const y0 = chart.square ? low : Math.min(0, low);
  const fitX = box.width / (x1 - x0);
  const fitY = box.height / (y1 - y0);
  const [sx, sy] = chart.square ? [Math.min(fitX, fitY), Math.min(fitX, fitY)] : [fitX, fitY];
  const at = ([x, y]: Point): string =>
    `${(box.left + (x - x0) * sx).toFixed(1)} ${(box.top + box.height - (y - y0) * sy).toFixed(1)}`;
  const ticks = [0, 0.5, 1].flatMap((share) => {
    const [x, y] = [x0 + share * (x1 - x0), y0 + share * (y1 - y0)];
    const [px, py] = at([x, y]).split(" ");
    return [
      `<text x="${px}" y="${box.top + box.height + 18}" text-anchor="middle">${short(x, x1 - x0)}</text>`,
      `<text x="${box.left - 6}" y="${py}" text-anchor="end" dominant-baseline="middle">${short(y, y1 - y0)}</text>`,
    ];
  });
  const lines = chart.series.map(({ points, color, dots }) =>
    dots
      ? points.map((p) => `<circle cx="${at(p).replace(" ", '" cy="')}" r="2" fill="${color}"/>`).join("")
      : `<path d="M${points.map(at).join("L")}" fill="none" stroke="${color}" stroke-width="1.4"/>`,
  );
  const names = chart.series.map(({ label, color }) => `<tspan fill="${color}" dx="12">${label}</tspan>`);
  const legend = `<text x="${box.left - 12}" y="40">${names.join("")}</text>`;
  return [
    `<text x="${box.left}" y="18" font-weight="bold">${chart.title}</text>`,
    `<path d="M${box.left} ${box.top}V${box.top + box.height}H${box.left + box.width}" fill="none" stroke="#333"/>`,
    ...ticks,
    `<text x="${box.left + box.width / 2}" y="${box.top + box.height + 38}" text-anchor="middle">${chart.xLabel}</text>`,
    `<text x="8" y="18">${chart.yLabel}</text>`,
    ...lines,
    legend,
  ].join("\n");
}

/** To three digits of the axis' range. */
function short(value: number, span: number): string {
  return Number(value.toFixed(Math.max(0, 2 - Math.floor(Math.log10(span))))).toString();
}
