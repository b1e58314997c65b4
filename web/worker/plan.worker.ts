/**
 * Text -> drawing -> strokes -> trajectory -> scene, outside the page's thread.
 *
 * Only the newest request counts. Between two stages the worker receives messages, and drops its work if there is a
 * newer request. Each stage stores its last result, so that a change of speed or margin does not import the file again.
 */
import {
  planJob,
  prepare,
  trajectoryStats,
  type Drawing,
  type Prepared,
  type StrokeSet,
  type Trajectory,
} from "../../src/index.js";
import {
  boxOfPoints,
  combine,
  compose,
  hasFill,
  inPageWords,
  unreachedCount,
  machineOf,
  otherPapers,
  penStopsOf,
  layOutDrawing,
  prepareSettingsOf,
  scaling,
  sheetSize,
  tileCount,
  paperAndMargins,
  strokeCount,
  unusedSettings,
  withPxPerInch,
  type Box,
  type Layout,
  type SheetItem,
  type SheetSource,
} from "../../src/internal.js";
import type { PlotSettings } from "../../src/schema/index.js";
import { buildScene, shiftsOf, type Scene } from "../scene/scene.js";
import { lineGapMm } from "../scene/pick.js";
import type { FrameMm } from "../scene/placing.js";
import type { Picture } from "../scene/renderer.js";
import { cutOffOf, type CutOffPicture } from "./cut-off.js";
import { extentOf, outsideChoices } from "./outside-choices.js";
import { sketchesOf } from "./sketches.js";
import { SentFiles } from "./sent-files.js";
import type {
  ExportRequest,
  MeasureRequest,
  Planned,
  PlannedReply,
  PlanFault,
  SheetOnPaper,
  WorkerFile,
  WorkerPlanRequest,
  SketchRequest,
  StrokesRequest,
  WorkerReply,
  WorkerRequest,
} from "./protocol.js";

interface WorkerScope {
  onmessage: ((event: MessageEvent<WorkerRequest>) => void) | null;
  postMessage(reply: WorkerReply, transfer: Transferable[]): void;
}
const scope = self as unknown as WorkerScope;

let newest: WorkerPlanRequest | null = null;
let isRunning = false;
const files = new SentFiles();
/** The drawing of the last plan, as it was read. */
let imported: Drawing | null = null;
let prepared: {
  key: string;
  result: Prepared;
  placement: Layout;
  cutOff: CutOffPicture | null;
  besidePaper: CutOffPicture | null;
  settings: PlotSettings;
} | null = null;

/** The plan that was answered last. */
let answered: { id: number; strokes: StrokeSet } | null = null;

scope.onmessage = (event) => {
  if (event.data.type === "export") return void exportAs(event.data);
  if (event.data.type === "strokes") return sendStrokes(event.data);
  if (event.data.type === "sketches") return sendSketches(event.data);
  if (event.data.type === "measure") return void sendMeasured(event.data);
  newest = event.data;
  files.keep(newest.files);
  if (!isRunning) void run();
};

async function run(): Promise<void> {
  isRunning = true;
  while (newest) {
    const request = newest;
    newest = null;
    scope.postMessage({ type: "started", id: request.id }, []);
    const reply = await answer(request);
    if (reply) scope.postMessage(reply, reply.type === "planned" ? transferables(reply) : []);
  }
  isRunning = false;
}

/** Null if there is a newer request. */
async function answer(request: WorkerPlanRequest): Promise<WorkerReply | null> {
  const { id, drawingKey, settings, firmware } = request;
  let stage: PlanFault["stage"] = "import";
  try {
    const read = await drawingOf(request);
    imported = read;
    scope.postMessage({ type: "imported", id, drawingKey }, []);
    if (await isSuperseded()) return null;
    stage = "plan";
    const drawing = withPxPerInch(read, settings.prepare.pxPerInch);
    const { result: ready, placement, cutOff, besidePaper } = preparedOf(drawing, request);
    if (await isSuperseded()) return null;
    const { trajectory } = planJob(ready, settings, machineOf(settings), { firmware });
    if (await isSuperseded()) return null;
    const scene = buildScene(trajectory, ready.strokes.layer, shiftsOf(ready.strokes.layers));
    const stats = trajectoryStats(trajectory);
    const drawnBox = reachedBoxOf(ready, settings.prepare);
    const planned: Planned = {
      drawingKey,
      settings,
      pageWidthMm: drawing.widthMm,
      pageHeightMm: drawing.heightMm,
      pxPerInch: drawing.pxPerInch ?? null,
      otherPapers: otherPapers(drawing),
      pageToPaper: placement.map,
      fileToPaper: compose(placement.map, scaling(drawing.widthMm / read.widthMm)),
      choice: placement.choice,
      size: ready.size,
      outside: ready.outside,
      outsideChoices:
        ready.outside &&
        outsideChoices({
          drawing,
          settings,
          outside: ready.outside,
          drawnBox,
          sheet: request.sheet && {
            ...(await sheetIn(request.sheet, request.files)),
            map: placement.map,
          },
        }),
      fillCount: drawing.paths.fill.reduce((sum, _, shape) => sum + Number(hasFill(drawing.paths, shape)), 0),
      drawnBox,
      frameMm: frameOf(placement, settings.prepare),
      layers: ready.layers,
      penStops: penStopsOf(ready.strokes, settings),
      drawnLayers: ready.strokes.layers,
      fileWarnings: drawing.warnings.map((warning) => ({
        ...warning,
        message: inPageWords(warning.message),
      })),
      layoutWarnings: [...ready.warnings, ...unusedSettings(settings, machineOf(settings))].map(inPageWords),
      cutOff,
      besidePaper,
      unreachedCount: unreachedCount(ready.strokes, machineOf(settings)),
      strokeCount: strokeCount(ready.strokes),
      stats,
      trajectory,
      scene,
      lineGapMm: lineGapMm(scene.grid, stats.drawMm),
      picture: pictureOf(scene),
    };
    answered = { id, strokes: ready.strokes };
    return { type: "planned", id, planned };
  } catch (error) {
    return { type: "fault", id, fault: { message: messageOf(error), stage } };
  }
}

/** On a sheet, the page is the paper. */
async function drawingOf({ files: wanted, sheet, settings }: WorkerPlanRequest): Promise<Drawing> {
  if (sheet === null) return files.read(wanted[0].key);
  const { sources, items } = await sheetIn(sheet, wanted);
  return combine(sources, items, sheetSize(settings.prepare));
}

async function sheetIn(
  { names, items }: SheetOnPaper,
  wanted: readonly WorkerFile[],
): Promise<{ readonly sources: readonly SheetSource[]; readonly items: readonly SheetItem[] }> {
  const sources: SheetSource[] = [];
  for (const [index, { key }] of wanted.entries()) {
    sources.push({ ...names[index], drawing: await files.read(key) });
  }
  return { sources, items };
}

/** Of several sheets none is drawn on more than the space inside its margins, and what leaves all of them together. */
function reachedBoxOf({ strokes: { xy }, outside }: Prepared, settings: PlotSettings["prepare"]): Box {
  if (xy.length === 0 || settings.tile > 0 || tileCount(settings) === 1) return boxOfPoints(xy);
  const { inside } = paperAndMargins(settings);
  return {
    x0: inside.x0 - (outside?.leftMm ?? 0),
    y0: inside.y0 - (outside?.topMm ?? 0),
    x1: inside.x1 + (outside?.rightMm ?? 0),
    y1: inside.y1 + (outside?.bottomMm ?? 0),
  };
}

async function sendMeasured({ file }: MeasureRequest): Promise<void> {
  files.add(file);
  const measured = await files.read(file.key).then(extentOf, (error) => ({ fault: messageOf(error) }));
  scope.postMessage({ type: "measured", key: file.key, measured }, []);
}

function preparedOf(
  drawing: Drawing,
  { drawingKey, sheet, settings }: WorkerPlanRequest,
): NonNullable<typeof prepared> {
  const wanted = prepareSettingsOf(settings);
  const key = `${drawingKey} ${JSON.stringify([wanted, sheet])}`;
  if (prepared?.key !== key) {
    const result = prepare(drawing, wanted);
    const placement = layOutDrawing(drawing, wanted);
    const cutOff = cutOffOf(drawing, wanted, placement);
    const isBeside = result.outside !== null;
    const besidePaper = isBeside ? cutOffOf(drawing, { ...wanted, outside: "cut" }, placement) : null;
    prepared = { key, result, placement, cutOff, besidePaper, settings };
  }
  prepared.settings = settings;
  return prepared;
}

/** The box that keeps the drawing where it is when it becomes its place. A turn made by itself is the box's then. */
function frameOf(
  { frame: { x0, y0, x1, y1 }, choice }: Layout,
  { layout, rotateDeg }: PlotSettings["prepare"],
): FrameMm | null {
  if (!(x1 >= x0 && y1 >= y0)) return null;
  const [widthMm, heightMm] = [x1 - x0, y1 - y0];
  const turnDeg = rotateDeg === "auto" ? choice.rotateDeg : 0;
  if (turnDeg === 0) return { xMm: x0, yMm: y0, widthMm, heightMm, turnDeg: layout?.turnDeg ?? 0 };
  const inset = (widthMm - heightMm) / 2;
  return { xMm: x0 + inset, yMm: y0 - inset, widthMm: heightMm, heightMm: widthMm, turnDeg };
}

const pictureOf = ({ draw, travel, totalS }: Scene): Picture => ({
  draw: { ...draw, bytes: draw.bytes.slice(0) },
  travel: { ...travel, bytes: travel.bytes.slice(0) },
  totalS,
});

/** Does not answer for a plan that is not the last one: a newer one is being made. */
function sendStrokes({ id }: StrokesRequest): void {
  if (answered?.id !== id) return;
  const { xy, offsets, layer, layers } = answered.strokes;
  const strokes = { xy: xy.slice(), offsets: offsets.slice(), layer: layer.slice(), layers };
  scope.postMessage({ type: "strokes", id, strokes }, [
    strokes.xy.buffer,
    strokes.offsets.buffer,
    strokes.layer.buffer,
  ]);
}

function sendSketches({ id, changes }: SketchRequest): void {
  if (answered?.id !== id || !prepared || !imported) return;
  const { prepare: wanted } = prepared.settings;
  const drawing = withPxPerInch(imported, wanted.pxPerInch);
  const sketches = sketchesOf(drawing, prepareSettingsOf(prepared.settings), changes);
  scope.postMessage(
    { type: "sketches", id, sketches },
    sketches.flatMap(({ xy, offsets }) => [xy.buffer, offsets.buffer]) as Transferable[],
  );
}

async function exportAs({ format, firmware }: ExportRequest): Promise<void> {
  if (!prepared) return;
  const { result, settings } = prepared;
  try {
    const { exportText } = await import("./exports.js");
    scope.postMessage({ type: "exported", format, text: exportText(result, settings, format, firmware) }, []);
  } catch (error) {
    scope.postMessage({ type: "export-failed", message: messageOf(error) }, []);
  }
}

/** Receives waiting messages. True if one of them was a newer request. */
const isSuperseded = async (): Promise<boolean> => {
  await new Promise((resolve) => setTimeout(resolve, 0));
  return newest !== null;
};

const messageOf = (error: unknown): string =>
  inPageWords(error instanceof Error ? error.message : String(error));

/** The trajectory's columns and the scene's buffers, each once. */
function transferables({ planned: { trajectory, scene, picture } }: PlannedReply): Transferable[] {
  const buffers = new Set<ArrayBufferLike>([
    scene.draw.bytes,
    scene.travel.bytes,
    picture.draw.bytes,
    picture.travel.bytes,
    scene.grid.starts.buffer,
    scene.grid.items.buffer,
  ]);
  for (const part of [trajectory, trajectory.planned?.trajectory]) {
    for (const column of part ? columnsOf(part) : []) buffers.add(column.buffer);
  }
  return [...buffers] as ArrayBuffer[];
}

const columnsOf = (trajectory: Trajectory): ArrayBufferView[] =>
  [trajectory, trajectory.runs, trajectory.penMoves]
    .flatMap((columns) => Object.values(columns) as unknown[])
    .filter((value) => ArrayBuffer.isView(value));
