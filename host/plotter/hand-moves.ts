/**
 * How a machine performs the manual moves of an idle plotter. Every move begins with the pen up and
 * stays within the machine. If the carriage's position is unknown, it is assumed to be at home.
 */
import { planJob, PlotwrightError, strokesOf } from "../../src/index.js";
import type { Line, MachineProfile, StrokeSet } from "../../src/index.js";
import { type Machine, machineOf } from "../../src/internal.js";
import type { BoxMm, HandMove, PlotSettings } from "../../src/schema/index.js";

/** Rejects with `out-of-bounds` before anything moves, or with the board's error. */
export async function moveByHand(plotter: Machine, move: HandMove, settings: PlotSettings): Promise<void> {
  switch (move.kind) {
    case "move-to":
      mustReach(machineOf(settings), move.xMm, move.yMm);
      return plotter.moveTo(move.xMm, move.yMm, settings);
    case "jog":
      return jog(plotter, move.dxMm, move.dyMm, settings);
    case "home":
      if (!(await plotter.homing?.seekHome(settings))) await plotter.moveTo(0, 0, settings);
      return;
    case "set-home":
      return plotter.setHome(settings);
    case "cycle-pen":
      await plotter.movePen(false, settings);
      return plotter.movePen(true, settings);
    case "frame":
      return traceFrame(plotter, move.boxMm, settings);
    case "test-line":
      return drawHere(plotter, testLine(), settings);
    case "test-patch":
      return drawHere(plotter, testPatch(), settings);
    case "square":
      return drawHere(plotter, squareOf(move.sizeMm), settings);
    case "servo":
      if (!plotter.servo) throw noServo(machineOf(settings));
      return plotter.servo.moveTo(move.pos, settings);
  }
}

async function jog(plotter: Machine, dxMm: number, dyMm: number, settings: PlotSettings): Promise<void> {
  const machine = machineOf(settings);
  const { widthMm, heightMm } = machine;
  if (!(Math.abs(dxMm) <= widthMm && Math.abs(dyMm) <= heightMm)) {
    throw new PlotwrightError("out-of-bounds", `A step of ${dxMm}, ${dyMm} mm is longer than the machine.`);
  }
  const { stopSignal } = plotter;
  const { x, y } = await standing(plotter, settings);
  // Home may not be at the machine's corner, but cannot be farther from it than the machine's length.
  const isWithin =
    x + dxMm <= widthMm && x + dxMm >= -widthMm && y + dyMm <= heightMm && y + dyMm >= -heightMm;
  if (!isWithin) throw beyond(machine, x + dxMm, y + dyMm);
  stopSignal.throwIfAborted();
  await plotter.moveTo(x + dxMm, y + dyMm, settings);
}

async function traceFrame(plotter: Machine, box: BoxMm, settings: PlotSettings): Promise<void> {
  const machine = machineOf(settings);
  const [x1, y1] = [box.xMm + box.widthMm, box.yMm + box.heightMm];
  mustReach(machine, box.xMm, box.yMm);
  mustReach(machine, x1, y1);
  const { stopSignal } = plotter;
  const { x, y } = await standing(plotter, settings);
  const corners = [
    [box.xMm, box.yMm],
    [x1, box.yMm],
    [x1, y1],
    [box.xMm, y1],
    [box.xMm, box.yMm],
    [x, y],
  ] as const;
  for (const [cornerX, cornerY] of corners) {
    stopSignal.throwIfAborted();
    await plotter.moveTo(cornerX, cornerY, settings);
  }
}

/** Draws strokes in mm from the carriage's position, and returns there. */
async function drawHere(plotter: Machine, strokes: StrokeSet, settings: PlotSettings): Promise<void> {
  const machine = machineOf(settings);
  const { stopSignal } = plotter;
  const { x, y } = await standing(plotter, settings);
  const { xy } = strokes;
  for (let i = 0; i < xy.length; i += 2) mustReach(machine, x + xy[i], y + xy[i + 1]);
  stopSignal.throwIfAborted();
  if (plotter.penUp !== true) await plotter.movePen(true, settings);
  stopSignal.throwIfAborted();
  const here = { ...strokes, xy: xy.map((value, i) => value + (i % 2 === 0 ? x : y)) };
  const job = planJob({ strokes: here }, settings, machine, {
    startXMm: x,
    startYMm: y,
    endXMm: x,
    endYMm: y,
    firmware: plotter.firmware,
    board: plotter.state!,
  });
  await plotter.perform({ trajectory: job.trajectory, commands: job.commands() }, settings);
}

/** The carriage's position, with the motors on. */
async function standing(plotter: Machine, settings: PlotSettings): Promise<{ x: number; y: number }> {
  await plotter.prepareMotors(settings);
  return plotter.positionMm(machineOf(settings))!;
}

/** Tolerance for positions read from motor steps, mm. */
const SAME_MM = 0.05;

function mustReach(machine: MachineProfile, x: number, y: number): void {
  const { widthMm, heightMm } = machine;
  const isWithin = x >= -SAME_MM && x <= widthMm + SAME_MM && y >= -SAME_MM && y <= heightMm + SAME_MM;
  if (!isWithin) throw beyond(machine, x, y);
}

function beyond({ name, widthMm, heightMm }: MachineProfile, x: number, y: number): PlotwrightError {
  const at = `${Number(x.toFixed(2))}, ${Number(y.toFixed(2))} mm`;
  return new PlotwrightError(
    "out-of-bounds",
    `${at} is beyond the ${name}, which reaches ${widthMm} × ${heightMm} mm from home. Set home first if the carriage is elsewhere. If your plotter is larger, choose its model with --machine.`,
  );
}

const noServo = ({ name }: MachineProfile): PlotwrightError =>
  new PlotwrightError(
    "bad-setting",
    `The ${name} does not lift its pen with a servo: there is none to set up.`,
  );

const oneLayer = (id: string, name: string, ...lines: readonly Line[]): StrokeSet =>
  strokesOf(lines, { id, name, color: null });

const squareLine = (mm: number): Line => [
  [0, 0],
  [mm, 0],
  [mm, mm],
  [0, mm],
  [0, 0],
];

const squareOf = (sizeMm: number): StrokeSet => oneLayer("square", "Square", squareLine(sizeMm));

/** Starts 5 mm right of and below the carriage, so that it is on the paper even if the carriage is at its corner. */
const testLine = (): StrokeSet =>
  oneLayer("line", "Test line", [
    [5, 5],
    [25, 5],
  ]);

/** A square, a circle and a zigzag, 12 mm wide: shows heights, corners and whether the lines meet. */
function testPatch(): StrokeSet {
  const circle = Array.from({ length: 61 }, (_, i) => {
    const angle = (i / 60) * 2 * Math.PI;
    return [6 + 4 * Math.cos(angle), 6 + 4 * Math.sin(angle)] as const;
  });
  const zigzag = [2, 4, 6, 8, 10].map((x, i) => [x, i % 2 === 0 ? 14 : 17] as const);
  return oneLayer("test", "Test patch", squareLine(12), circle, zigzag);
}
