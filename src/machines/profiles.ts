/**
 * The built-in plotters. Travel limits are the makers' published figures. Home is the corner where x
 * and y are 0.
 *
 * AxiDraw and NextDraw: 200-step motors, 5 full steps per mm along an axis, so 80 at 1/16.
 * Servo ranges: 7500 … 28000 covers a standard servo on RB1; the brushless lift on RB2 takes 5400 … 12600.
 */
import { refuseSetting } from "../check-arguments.js";
import { PlotwrightError } from "../errors.js";
import { HOBBY_SERVO } from "./pen-servo.js";
import type { MachineProfile } from "./profile.js";

const ON_RB1 = {
  kind: "ebb",
  microstepMode: 1,
  servoPosAt0Pct: 7_500,
  servoPosAt100Pct: 28_000,
  servoPin: 4,
};
const ON_RB2 = { ...ON_RB1, servoPosAt0Pct: 5_400, servoPosAt100Pct: 12_600, servoPin: 5 };
/** Normally closed, to ground. */
const NEXTDRAW_SWITCH = { port: "B", pin: 1, pressed: 1 };

/** A profile whose type knows its id. */
interface Named<Id extends string> extends MachineProfile {
  readonly id: Id;
}

const axidraw = <Id extends string>(id: Id, name: string, widthMm: number, heightMm: number): Named<Id> => ({
  id,
  name,
  widthMm,
  heightMm,
  stepsPerMm: 80,
  motors: "mixed",
  controller: ON_RB1,
});
const nextdraw = <Id extends string>(id: Id, name: string, widthMm: number, heightMm: number): Named<Id> => ({
  ...axidraw(id, name, widthMm, heightMm),
  controller: { ...ON_RB2, cornerSwitch: NEXTDRAW_SWITCH },
});

/** An AxiDraw with the maker's brushless pen lift, which is on another servo output. */
const upgraded = <Id extends string>(
  id: Id,
  model: string,
  widthMm: number,
  heightMm: number,
): Named<Id> => ({
  ...axidraw(id, `${model}, brushless upgrade`, widthMm, heightMm),
  controller: ON_RB2,
});

/** 3200 steps turn a 40 mm sphere once; the pen arm's travel is 1/4 of a turn. */
const EGG_STEPS_PER_TURN = 3_200;
const EGG_TURN_MM = Math.PI * 40;

/**
 * Grbl machines. Theirs are the figures for the preview; plans follow the connected Grbl's own settings. DrawCore counts x and
 * y backwards and exchanged, and its Z downwards.
 */
const DRAWCORE = {
  kind: "grbl",
  maxSpeedMmPerS: 250,
  accelMmPerS2: 3_000,
  maxSpeedYMmPerS: 200,
  junctionMm: 0.01,
  penUpZMm: 0.5,
  penDownZMm: 5,
  penMinZMm: 0,
  penMaxZMm: 10,
  penSpeedMmPerS: 83.333,
  penAccelMmPerS2: 3_000,
  penWaitMs: 100,
};
const GENERIC_GRBL = { kind: "grbl", maxSpeedMmPerS: 100, accelMmPerS2: 500, junctionMm: 0.01, arcs: true };
const GRBL_SERVO = { ...GENERIC_GRBL, penUpS: 600, penDownS: 300 };
const GRBL_Z = {
  ...GENERIC_GRBL,
  penUpZMm: 5,
  penDownZMm: 0,
  penSpeedMmPerS: 20,
  penAccelMmPerS2: 200,
};

const idraw = <Id extends string>(id: Id, name: string, widthMm: number, heightMm: number): Named<Id> => ({
  id,
  name,
  widthMm,
  heightMm,
  stepsPerMm: 100,
  motors: "direct",
  swapAxes: true,
  flipX: true,
  flipY: true,
  controller: DRAWCORE,
});

const BUILT_IN = [
  axidraw("axidraw-v3", "AxiDraw V3", 300, 218),
  axidraw("axidraw-v3-a3", "AxiDraw V3/A3", 430, 297),
  axidraw("axidraw-se-a4", "AxiDraw SE/A4", 300, 218),
  axidraw("axidraw-se-a3", "AxiDraw SE/A3", 430, 297),
  axidraw("axidraw-v3-xlx", "AxiDraw V3 XLX", 595, 218),
  axidraw("axidraw-minikit", "AxiDraw MiniKit", 160, 101.6),
  axidraw("axidraw-se-a1", "AxiDraw SE/A1", 864, 594),
  axidraw("axidraw-se-a2", "AxiDraw SE/A2", 594, 432),
  axidraw("axidraw-v3-b6", "AxiDraw V3/B6", 190, 140),
  upgraded("axidraw-v3-brushless", "AxiDraw V3", 300, 218),
  upgraded("axidraw-v3-a3-brushless", "AxiDraw V3/A3", 430, 297),
  upgraded("axidraw-v3-xlx-brushless", "AxiDraw V3 XLX", 595, 218),
  upgraded("axidraw-v3-b6-brushless", "AxiDraw V3/B6", 190, 140),
  nextdraw("nextdraw-8511", "NextDraw 8511", 300, 218),
  nextdraw("nextdraw-1117", "NextDraw 1117", 430, 297),
  nextdraw("nextdraw-2234", "NextDraw 2234", 864, 594),
  {
    id: "eggbot",
    name: "EggBot (40 mm sphere)",
    widthMm: Number(EGG_TURN_MM.toFixed(3)),
    heightMm: Number((EGG_TURN_MM / 4).toFixed(3)),
    stepsPerMm: EGG_STEPS_PER_TURN / EGG_TURN_MM,
    motors: "direct",
    penServo: HOBBY_SERVO,
    controller: ON_RB1,
  },
  {
    id: "watercolorbot",
    name: "WaterColorBot",
    widthMm: 362,
    heightMm: 216,
    stepsPerMm: 80,
    motors: "direct",
    penServo: HOBBY_SERVO,
    controller: ON_RB1,
  },
  idraw("idraw-h-a4", "iDraw H A4", 300, 210),
  idraw("idraw-h-a3", "iDraw H A3", 430, 297),
  idraw("idraw-2-a4", "iDraw 2.0 A4", 300, 210),
  idraw("idraw-2-a3", "iDraw 2.0 A3", 430, 297),
  {
    id: "grbl-servo",
    name: "Plotter with Grbl and a pen servo",
    widthMm: 300,
    heightMm: 210,
    stepsPerMm: 80,
    motors: "direct",
    penServo: HOBBY_SERVO,
    controller: GRBL_SERVO,
  },
  {
    id: "grbl-z",
    name: "Plotter with Grbl and a Z axis",
    widthMm: 300,
    heightMm: 210,
    stepsPerMm: 80,
    motors: "direct",
    controller: GRBL_Z,
  },
  // A Grbl that is built for CoreXY mixes the motors by itself.
  {
    id: "grbl-corexy",
    name: "CoreXY with Grbl and a pen servo",
    widthMm: 300,
    heightMm: 210,
    stepsPerMm: 80,
    motors: "direct",
    penServo: HOBBY_SERVO,
    controller: GRBL_SERVO,
  },
] as const satisfies readonly MachineProfile[];

/** Id of a built-in plotter. */
export type MachineId = (typeof BUILT_IN)[number]["id"];

/** The built-in plotters. */
export const MACHINES: readonly MachineProfile[] = BUILT_IN;

/** Any text. Beside literals, unlike `string`, it leaves editors the literals to offer. */
export type OtherText = string & {};

/**
 * The built-in plotter with that id.
 *
 * @throws PlotwrightError "bad-setting" for an unknown id, with the list of known ids
 */
export function machineById(id: MachineId | OtherText): MachineProfile {
  if (typeof id !== "string")
    refuseSetting(
      "machine",
      id,
      'an id such as "axidraw-v3"; planSvg takes a custom profile as customMachine',
    );
  const machine = MACHINES.find((candidate) => candidate.id === id);
  if (machine === undefined) {
    const known = MACHINES.map((candidate) => candidate.id).join(", ");
    throw new PlotwrightError("bad-setting", `There is no machine "${id}". Known machines: ${known}.`);
  }
  return machine;
}

/** The machine in a job's settings. */
export interface MachineChoice {
  /** Id of a built-in plotter, or of `customMachine`. Default "axidraw-v3". */
  readonly machine: MachineId | OtherText;
  /** A custom profile, used if its id is `machine`. */
  readonly customMachine?: MachineProfile | null | undefined;
}

/**
 * The machine of a job's settings: their custom profile if its id matches, otherwise the built-in one.
 * Throws `bad-setting` for an unknown id.
 */
export const machineOf = (choice: MachineChoice): MachineProfile =>
  findMachine(choice) ?? machineById(choice.machine);

/** As `machineOf`, but null for an unknown id. */
export const findMachine = ({ machine, customMachine }: MachineChoice): MachineProfile | null =>
  customMachine?.id === machine ? customMachine : (MACHINES.find(({ id }) => id === machine) ?? null);

const lettersOf = (text: string): string => text.toLowerCase().replace(/[^a-z0-9]/g, "");

/** The built-in machine that a board's own name tells; null: it tells none. "My NextDraw 8511" is a NextDraw 8511. */
export function machineNamed(boardName: string): MachineProfile | null {
  const letters = lettersOf(boardName);
  const named = MACHINES.filter(({ name }) => letters.includes(lettersOf(name)));
  // "AxiDraw V3/A3" also contains "AxiDraw V3".
  return named.sort((a, b) => b.name.length - a.name.length)[0] ?? null;
}
