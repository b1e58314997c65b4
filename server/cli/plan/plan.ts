/** `plotwright plan FILE.svg`: time, distance and commands of a plot, without a board. Runs in a thread: see plan-thread.ts. */
import { basename } from "node:path";
import {
  PlotwrightError,
  importDrawing,
  planJob,
  trajectoryStats,
  toSvg,
  type Drawing,
  type ImportOptions,
  type MachineProfile,
  type Trajectory,
} from "../../../src/index.js";
import {
  penError,
  meanScaleOf,
  printableJson,
  prepareJob,
  sizeInWords,
  type DrawnSize,
  type PenError,
  type PreparedJob,
  boxOfPoints,
  machineOf,
  penOf,
  pointCount,
  settingsIdOf,
  shownLayerName,
  timesByLayer,
  type TimesByKind,
  strokeCount,
  trajectoryToSvg,
  svgOptionsOf,
  toJson,
} from "../../../src/internal.js";
import type { PlotSettings } from "../../../src/schema/index.js";
import { withLayerPens, withOnlyLayers, type PenChoice } from "../../planning/layers-by-name.js";
import { readDrawing } from "../../planning/read-drawing.js";
import { writeOut } from "../files.js";
import { minutes, printed } from "../io.js";

export interface PlanCommandOptions {
  readonly json?: boolean;
  readonly penError?: boolean;
  /** The machine's commands. */
  readonly commands?: string;
  readonly firmware: string;
  readonly preview?: string;
  /** The prepared drawing, as SVG and as JSON of polylines. */
  readonly svg?: string;
  readonly strokes?: string;
  readonly only?: readonly string[];
  readonly pen?: readonly PenChoice[];
  /** 0: endless. */
  readonly copies: number;
  readonly font?: string;
}

/** The object of `--json`: scripts depend on these keys. Lengths mm, speeds mm/s, mm/s². */
export interface PlanReport {
  /** The drawing's size on the paper, and its scale: 1 is the size in the file. If stretched, the mean of both scales. */
  readonly widthMm: number;
  readonly heightMm: number;
  readonly scale: number;
  readonly strokes: number;
  readonly points: number;
  readonly blocks: number;
  readonly commands: number;
  readonly drawMm: number;
  readonly travelMm: number;
  readonly travelMmUnordered: number;
  readonly penLifts: number;
  readonly durationS: number;
  readonly maxSpeed: number;
  readonly maxAccel: number;
  readonly importMs: number;
  readonly prepareMs: number;
  readonly orderMs: number;
  readonly planMs: number;
  readonly compileMs: number;
  readonly warnings: readonly string[];
  /** Where the drawing lies on the paper, mm from its top left corner. */
  readonly box: {
    readonly xMm: number;
    readonly yMm: number;
    readonly widthMm: number;
    readonly heightMm: number;
  };
  readonly size: DrawnSize;
  readonly paper: { readonly widthMm: number; readonly heightMm: number };
  readonly machine: Pick<MachineProfile, "id" | "name" | "widthMm" | "heightMm">;
  /** `durationS` by what the machine does. */
  readonly times: TimesByKind;
  /** In the order of drawing. The way home belongs to no layer. */
  readonly layers: readonly LayerReport[];
  /** 0: endless. The other figures are those of one. */
  readonly copies: number;
  /** With `--pen-error`. */
  readonly penError?: PenError;
}

interface LayerReport extends TimesByKind {
  readonly id: string;
  readonly name: string;
  /** The pen that draws it; null for the one in the holder. */
  readonly pen: string | null;
  readonly strokes: number;
  readonly drawMm: number;
  readonly durationS: number;
}

interface PlannedFile {
  readonly report: PlanReport;
  readonly settings: PlotSettings;
  readonly job: PreparedJob;
  readonly trajectory: Trajectory;
  /** All commands of the plot, from motors-on to motors-off. */
  readonly lines: readonly string[];
}

/** Output of a plan, provided by its thread. */
export interface PlanOutput {
  out(text: string): void;
  err(text: string): void;
  /** Called when the file is read; may throw to refuse the drawing. */
  imported(drawing: Drawing): void;
  /** Called when a step begins. */
  begin(step: PlanStep): void;
}

export type PlanStep = "prepare" | "plan";

/** @param font as `inFont` has read it */
export async function runPlan(
  file: string,
  base: PlotSettings,
  options: PlanCommandOptions,
  io: PlanOutput,
  font: Pick<ImportOptions, "text" | "font"> = {},
): Promise<void> {
  const toStdout = [
    ...(options.json === true ? ["--json"] : []),
    ...(["commands", "preview", "svg", "strokes"] as const)
      .filter((name) => options[name] === "-")
      .map((name) => `--${name} -`),
  ];
  if (toStdout.length > 1) {
    throw new PlotwrightError(
      "bad-setting",
      `${toStdout.join(" and ")} both write to stdout: give one of them a file.`,
    );
  }
  const { report, settings, job, trajectory, lines } = await planFile(file, base, options, io, font);
  const { prepared } = job;
  const paper = { widthMm: prepared.paperWidthMm, heightMm: prepared.paperHeightMm };
  if (options.commands !== undefined) writeOut(options.commands, `${lines.join("\n")}\n`, io);
  if (options.preview !== undefined) writeOut(options.preview, trajectoryToSvg(trajectory, paper), io);
  if (options.svg !== undefined) {
    writeOut(options.svg, toSvg(prepared.strokes, svgOptionsOf(prepared, settings)), io);
  }
  if (options.strokes !== undefined) {
    writeOut(options.strokes, `${printableJson(toJson(prepared.strokes, paper))}\n`, io);
  }
  if (options.json === true) io.out(`${printableJson(report)}\n`);
  else if (toStdout.length === 0) io.out(words(report, prepared.size));
  else io.err(`${sizeInWords(prepared.size)}\n`);
}

async function planFile(
  file: string,
  base: PlotSettings,
  options: PlanCommandOptions,
  io: PlanOutput,
  font: Pick<ImportOptions, "text" | "font">,
): Promise<PlannedFile> {
  const machine: MachineProfile = machineOf(base);
  const clock = stopwatch();
  const drawing = await importDrawing(basename(file), readDrawing(file), font);
  const importMs = clock();
  io.imported(drawing);
  io.begin("prepare");
  const settings = withLayerPens(drawing, withOnlyLayers(drawing, base, options.only), options.pen);
  clock();
  let orderingFrom = performance.now();
  const job = prepareJob(drawing, settings, machine, {
    onProgress: (_done, step) => {
      if (step === "ordering") orderingFrom = performance.now();
    },
  });
  const orderMs = performance.now() - orderingFrom;
  const prepareMs = clock() - orderMs;
  io.begin("plan");
  const { firmware } = options;
  const planned = planJob(job.prepared, settings, machine, { firmware, liftFirst: true });
  const { trajectory } = planned;
  const planMs = clock();
  const commands = planned.commands();
  const compileMs = clock();
  const lines = planned.lines();
  const stats = trajectoryStats(trajectory);
  const { widthMm, heightMm } = job.prepared.size;
  const report: PlanReport = {
    widthMm: rounded(widthMm),
    heightMm: rounded(heightMm),
    scale: rounded(meanScaleOf(job.prepared.size)),
    strokes: strokeCount(job.prepared.strokes),
    points: pointCount(job.prepared.strokes),
    blocks: trajectory.blockCount,
    commands: lines.length,
    drawMm: rounded(stats.drawMm),
    travelMm: rounded(stats.travelMm),
    travelMmUnordered: rounded(job.prepared.travelMmUnordered),
    penLifts: stats.penLiftCount,
    durationS: rounded(stats.durationS),
    maxSpeed: rounded(stats.maxSpeed),
    maxAccel: rounded(stats.maxAccel),
    importMs: rounded(importMs),
    prepareMs: rounded(prepareMs),
    orderMs: rounded(orderMs),
    planMs: rounded(planMs),
    compileMs: rounded(compileMs),
    warnings: [...job.warnings, ...commands.warnings],
    box: boxOf(job),
    size: roundedAll(job.prepared.size),
    paper: { widthMm: job.prepared.paperWidthMm, heightMm: job.prepared.paperHeightMm },
    machine: {
      id: machine.id,
      name: machine.name,
      widthMm: machine.widthMm,
      heightMm: machine.heightMm,
    },
    ...timesOf(job, trajectory, settings),
    copies: options.copies,
    ...(options.penError ? { penError: penErrorOf(job, trajectory, machine) } : {}),
  };
  return { report, settings, job, trajectory, lines };
}

function boxOf({ prepared: { strokes } }: PreparedJob): PlanReport["box"] {
  const { x0, y0, x1, y1 } = boxOfPoints(strokes.xy);
  return roundedAll({ xMm: x0, yMm: y0, widthMm: x1 - x0, heightMm: y1 - y0 });
}

function timesOf(
  { prepared: { strokes } }: PreparedJob,
  trajectory: Trajectory,
  settings: PlotSettings,
): Pick<PlanReport, "times" | "layers"> {
  const { layers, home } = timesByLayer(trajectory, strokes.layer);
  const sum = (kind: keyof TimesByKind): number =>
    [...layers, home].reduce((total, one) => total + one[kind], 0);
  const counts = new Uint32Array(strokes.layers.length);
  for (const layer of strokes.layer) counts[layer]++;
  const reports = layers.map(({ layer: index, drawMm, drawS, travelS, penS }) => {
    const layer = strokes.layers[index];
    return {
      id: settingsIdOf(layer),
      name: shownLayerName(layer.name),
      pen: penOf(settings, layer)?.name ?? null,
      strokes: counts[index],
      ...roundedAll({ drawMm, drawS, travelS, penS, durationS: drawS + travelS + penS }),
    };
  });
  return {
    times: roundedAll({ drawS: sum("drawS"), travelS: sum("travelS"), penS: sum("penS") }),
    layers: reports,
  };
}

function penErrorOf({ prepared }: PreparedJob, trajectory: Trajectory, machine: MachineProfile): PenError {
  if (!machine.springs) {
    throw new PlotwrightError(
      "bad-setting",
      `--pen-error: ${machine.name} was not measured; give --spring-x and --spring-y.`,
    );
  }
  const { maxMm, p99Mm, rmsMm } = penError(prepared.strokes, trajectory, machine.springs);
  return { maxMm: rounded(maxMm), p99Mm: rounded(p99Mm), rmsMm: rounded(rmsMm) };
}

function words(report: PlanReport, size: DrawnSize): string {
  const lines = [
    `${sizeInWords(size)}, on paper of ${report.paper.widthMm} × ${report.paper.heightMm} mm`,
    printed`for the ${report.machine.name} (${report.machine.id})`,
    [many(report.strokes, "stroke"), many(report.points, "point"), many(report.penLifts, "pen lift")].join(
      ", ",
    ),
    `draws ${metres(report.drawMm)}, travels ${metres(report.travelMm)} (${metres(report.travelMmUnordered)} in the file's order)`,
    `takes ${minutes(report.durationS)}: ${timesInWords(report.times)}; up to ${Math.round(report.maxSpeed)} mm/s`,
    ...layersInWords(report.layers),
    ...copiesInWords(report),
    ...(report.penError ? [penErrorInWords(report.penError)] : []),
    ...report.warnings.map((warning) => printed`note: ${warning}`),
  ];
  return `${lines.join("\n")}\n`;
}

const timesInWords = ({ drawS, travelS, penS }: TimesByKind): string =>
  `${minutes(drawS)} drawing, ${minutes(travelS)} travel, ${minutes(penS)} pen`;

/** Nothing for a single layer without a pen of its own. */
function layersInWords(layers: readonly LayerReport[]): string[] {
  if (layers.length === 1 && layers[0].pen === null) return [];
  return layers.map((layer) => {
    const pen = layer.pen === null ? "" : printed`, pen ${layer.pen}`;
    const name = printed`layer ${layer.name === "" ? layer.id : layer.name}`;
    return `${name}${pen}: ${minutes(layer.durationS)}, ${many(layer.strokes, "stroke")}, ${metres(layer.drawMm)}`;
  });
}

function copiesInWords({ copies, durationS }: PlanReport): string[] {
  if (copies === 1) return [];
  if (copies === 0) return ["endless copies, until you stop it"];
  return [`${copies} copies: ${minutes(copies * durationS)}, without the changes of paper`];
}

const penErrorInWords = ({ maxMm, p99Mm, rmsMm }: PenError): string =>
  `pen beside the drawing by up to ${maxMm} mm, 99 % of the time less than ${p99Mm} mm, rms ${rmsMm} mm`;

const many = (count: number, what: string): string => `${count} ${what}${count === 1 ? "" : "s"}`;
const metres = (mm: number): string => `${(mm / 1000).toFixed(2)} m`;
/** An object of numbers. */
const roundedAll = <T extends object>(values: T): T =>
  Object.fromEntries(Object.entries(values).map(([key, value]) => [key, rounded(value as number)])) as T;

const rounded = (value: number): number => Math.round(value * 1000) / 1000;

/** Milliseconds since the last call. */
function stopwatch(): () => number {
  let last = performance.now();
  return () => {
    const now = performance.now();
    const ms = now - last;
    last = now;
    return ms;
  };
}
