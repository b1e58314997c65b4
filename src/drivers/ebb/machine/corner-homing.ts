/**
 * Finds home on a machine with one switch at x = 0 and a stop at y = 0, as a NextDraw has, from anywhere. The sequence
 * is the maker's. Motor 1 turns x + y, motor 2 turns x − y.
 *
 *   1  motor 1 alone, to the left: the carriage moves diagonally to the stop, then along it until the switch is pressed
 *   2  6 mm to the right, 3.5 mm back, then motor 1 alone and slowly: after 2.5 mm the carriage was at the stop; after up
 *      to 5 mm it was not. Then again, from farther right if the stop is far. At the end x + y = 0
 *   3  a motor that is switched on jumps by up to two whole steps, so x − y is not exact yet. Away from the corner, then
 *      motor 2 turns slowly, with both on, until the switch is pressed: x = 0
 *   4  back down by the way up: x = 0, y = 0
 *
 * The board itself stops at the switch, in the same 40 µs (firmware 3.0 and newer).
 */
import { PlotwrightError } from "../../../errors.js";
import type { MachineProfile } from "../../../machines/profile.js";
import { MACHINES, machineOf } from "../../../machines/profiles.js";
import type { StopSignal } from "../../driver.js";
import { stuck } from "../../faults.js";
import type { MachineSettings } from "../../machine-job.js";
import { delay } from "../../transport.js";
import { ebbOf, type SwitchInput } from "../protocol/ebb-controller.js";
import type { Connection } from "./connection.js";
import type { EbbPen } from "./pen.js";
import type { EbbPosition } from "./position.js";
import { generalStatus } from "./readings.js";
import type { EbbUpkeep } from "./upkeep.js";

const COARSE_MM_PER_S = 51;
const FINE_MM_PER_S = 6.4;
/** Of motor 2 in step 3. */
const EXACT_MM_PER_S = 12.8;
const BACK_OFF_MM = 6;
const APPROACH_MM = 3.5;
/** What is left of `BACK_OFF_MM` after the approach, when the carriage is at the stop. */
const LEFT_MM = BACK_OFF_MM - APPROACH_MM;
/** Motor 1 needs twice as much while the carriage moves diagonally. */
const FINE_MM = 7;
/** Allowance for the switch, and for the jump of a motor that is switched on. */
const TOLERANCE_MM = 0.6;
const MORE_THAN_REACH_MM = 13;
/** Motor 1 in step 3, and motor 2 there: half of it before the switch is watched. */
const EXACT_MM = 12;
/** More passes than any start needs. */
const MAX_PASSES = 8;
const POLL_S = 0.02;
/** Tolerated overrun of a move, seconds of this computer. */
const LATE_S = 2;

interface Board {
  readonly connection: Connection;
  readonly position: EbbPosition;
  readonly pen: EbbPen;
  readonly upkeep: EbbUpkeep;
  readonly stopSignal: StopSignal;
  liftAndFreeMotors(settings: MachineSettings): Promise<void>;
}

/** Rejects with what is wrong and what to do; the motors are then off. A stop rejects with `conflict`. */
export async function homeInCorner(
  board: Board,
  settings: MachineSettings,
  input: SwitchInput,
): Promise<void> {
  const { stopSignal, position } = board;
  const machine = machineOf(settings);
  await board.pen.move(true, settings);
  await position.forget();
  try {
    stopSignal.throwIfAborted();
    // A restart of the board clears the mark.
    await position.mark.set(ebbOf(machine).microstepMode, false, false);
    await new CornerHoming(board, machine, input, stopSignal).run();
    if (await position.mark.isGone()) throw boardRestarted();
    await board.connection.session.send("CU,50,1");
  } catch (error) {
    // A board that no longer answers has a fault of its own.
    const isRestarted = !stopSignal.aborted && (await position.mark.isGone().catch(() => false));
    await endMotion(board, settings).catch(() => undefined);
    throw isRestarted ? boardRestarted() : error;
  }
  await position.foundHome(settings);
}

async function endMotion(board: Board, settings: MachineSettings): Promise<void> {
  const { session } = board.connection;
  await session.query("ES");
  for (const line of ["CU,51,0", "CU,50,1"]) await session.send(line);
  await board.liftAndFreeMotors(settings);
}

class CornerHoming {
  private readonly stepsPerMm: number;
  private readonly mode: number;
  /** The switch was seen released, so it is plugged in. */
  private wasReleased = false;

  constructor(
    private readonly board: Board,
    private readonly machine: MachineProfile,
    private readonly input: SwitchInput,
    private readonly stopSignal: StopSignal,
  ) {
    this.stepsPerMm = machine.stepsPerMm;
    this.mode = ebbOf(machine).microstepMode;
  }

  async run(): Promise<void> {
    const { port, pin } = this.input;
    await this.checkSupply();
    // A reading ends what was pressed or has failed before.
    await this.query("QG");
    for (const line of ["CU,51,0", `PD,${port},${pin},1`, `PO,${port},${pin},1`, "CU,50,0"])
      await this.send(line);
    const foundMm = (await this.isPressed()) ? 0 : await this.seekFromAfar();
    await this.reachStop(this.machine.heightMm - foundMm / 2);
    await this.makeExact();
  }

  /** Step 1. Moves on as far as the largest machine reaches, to tell a wrong model from a carriage that is blocked. */
  private async seekFromAfar(): Promise<number> {
    const { widthMm, heightMm } = this.machine;
    const reachMm = widthMm + heightMm + MORE_THAN_REACH_MM;
    const foundMm = await this.seek(COARSE_MM_PER_S, reachMm);
    if (foundMm !== null) return foundMm;
    const moreMm = LARGEST_REACH_MM + MORE_THAN_REACH_MM - reachMm;
    const isLarger = moreMm > 0 && (await this.seek(COARSE_MM_PER_S, moreMm)) !== null;
    throw isLarger ? wrongModel(this.machine, reachMm) : blocked();
  }

  /** Step 2. `aboveMm`: how far away the stop can be. On the way left, motor 1 alone has come nearer by half its turn. */
  private async reachStop(aboveMm: number): Promise<void> {
    const { widthMm, heightMm } = this.machine;
    for (let pass = 0; pass < MAX_PASSES; pass++) {
      await this.switchOn(true);
      await this.moveX(BACK_OFF_MM);
      if (await this.isPressed()) throw this.wasReleased ? blocked() : noSwitch(this.input);
      await this.moveX(-APPROACH_MM);
      // The jump of a motor may have brought the carriage too far; the next pass begins farther right.
      if (await this.isPressed()) continue;
      const foundMm = await this.seek(FINE_MM_PER_S, FINE_MM);
      if (foundMm === null) throw blocked();
      // The carriage may have begun behind the switch, so the first distance shows nothing.
      if (pass === 0) continue;
      if (foundMm <= LEFT_MM + TOLERANCE_MM) return;
      if (foundMm < 2 * LEFT_MM - TOLERANCE_MM) continue;
      const rightMm = Math.min(aboveMm + LEFT_MM, widthMm - LEFT_MM);
      await this.switchOn(true);
      await this.moveX(rightMm);
      aboveMm -= rightMm - LEFT_MM;
      if ((await this.seek(COARSE_MM_PER_S, widthMm + heightMm + MORE_THAN_REACH_MM)) === null)
        throw blocked();
    }
    throw uneven();
  }

  /** Steps 3 and 4. */
  private async makeExact(): Promise<void> {
    await this.switchOn(true);
    await this.move(EXACT_MM, 0, 2 * COARSE_MM_PER_S);
    await this.move(0, -EXACT_MM / 2, 2 * COARSE_MM_PER_S);
    if (await this.isPressed()) throw uneven();
    if (!(await this.moveToSwitch(0, -EXACT_MM, EXACT_MM_PER_S))) throw blocked();
    await this.move(-EXACT_MM, EXACT_MM, COARSE_MM_PER_S);
  }

  /** Motor 1 alone, to the left, until the switch is pressed. Returns how far it turned, mm; null: the switch was not met. */
  private async seek(mmPerS: number, maxMm: number): Promise<number | null> {
    await this.switchOn(false);
    if (!(await this.moveToSwitch(-maxMm, 0, mmPerS))) return null;
    const [steps1 = 0] = (await this.query("QS")).split(",").map(Number);
    return Math.abs(steps1) / this.stepsPerMm;
  }

  private async moveToSwitch(motor1Mm: number, motor2Mm: number, mmPerS: number): Promise<boolean> {
    const bit = 1 << this.input.pin;
    await this.send(`CU,52,${this.input.pressed === 1 ? bit : 0}`);
    await this.send(`CU,51,${bit}`);
    const isMet = await this.move(motor1Mm, motor2Mm, mmPerS);
    await this.send("CU,51,0");
    return isMet;
  }

  /** Motor 2 off: it is dragged along. */
  private async switchOn(both: boolean): Promise<void> {
    await this.send(`EM,${this.mode},${both ? this.mode : 0}`);
  }

  private async moveX(xMm: number): Promise<void> {
    await this.move(xMm, xMm, COARSE_MM_PER_S);
  }

  /** Resolves when the motors rest. Returns whether the watched switch was met. */
  private async move(motor1Mm: number, motor2Mm: number, mmPerS: number): Promise<boolean> {
    const { boardClock, waitSpeed } = this.board.connection;
    const ms = Math.ceil((1_000 * Math.max(Math.abs(motor1Mm), Math.abs(motor2Mm))) / mmPerS);
    const [steps1, steps2] = [motor1Mm, motor2Mm].map((mm) => Math.round(mm * this.stepsPerMm));
    this.stopSignal.throwIfAborted();
    await this.send(`SM,${ms},${steps1},${steps2}`);
    const untilS = boardClock.nowS() + ms / 1_000 + LATE_S * waitSpeed;
    for (let isMet = false; ;) {
      this.stopSignal.throwIfAborted();
      const status = generalStatus(await this.query("QG"));
      if (status.buttonPressed) throw buttonPressed();
      if (status.supplyFailed) throw noSupply();
      isMet ||= status.limitReached;
      if (!status.isMoving) return isMet;
      if (boardClock.nowS() > untilS) throw stuck();
      await delay(boardClock, POLL_S);
    }
  }

  /** Also if it is not plugged in. */
  private async isPressed(): Promise<boolean> {
    const { port, pin, pressed } = this.input;
    const isPressed = Number(await this.query(`PI,${port},${pin}`)) === pressed;
    this.wasReleased ||= !isPressed;
    return isPressed;
  }

  /** A single low reading may be wrong. */
  private async checkSupply(): Promise<void> {
    const { supply } = this.board.upkeep;
    if ((await supply.read()) === "low" && (await supply.read()) === "low") throw noSupply();
  }

  private send(line: string): Promise<void> {
    return this.board.connection.session.send(line);
  }

  private query(line: string): Promise<string> {
    return this.board.connection.session.query(line);
  }
}

const LARGEST_REACH_MM = Math.max(...MACHINES.map(({ widthMm, heightMm }) => widthMm + heightMm));

/** `name`: of the state, the same in all its messages. */
const homingFailed = (name: string, advice: string): PlotwrightError =>
  new PlotwrightError("board-error", `Home was not found (${name}). ${advice} The motors are off.`);

const noSupply = (): PlotwrightError =>
  homingFailed(
    "no motor supply",
    "The motors have no power, or had none for a moment: plug in the plotter's power supply, then press Home again.",
  );

const noSwitch = ({ port, pin }: SwitchInput): PlotwrightError =>
  homingFailed(
    "switch not detected",
    `The home switch (input ${port}${pin}) reads as pressed wherever the carriage is. Check that this plotter is the chosen model: an AxiDraw has no such switch. If it is, check the switch's cable; until it is repaired, push the carriage into its home corner and set home there.`,
  );

const wrongModel = ({ name }: MachineProfile, reachMm: number): PlotwrightError =>
  homingFailed(
    "wrong model",
    `The switch came only after more than ${Math.round(reachMm)} mm, which is more than a ${name} has. Choose this plotter's model, then press Home again.`,
  );

const blocked = (): PlotwrightError =>
  homingFailed(
    "carriage blocked",
    "The motors turned, but the carriage did not move the home switch as it should. Check that nothing is in its way, that it slides freely by hand, and that the switch at its left end moves; then press Home again.",
  );

const uneven = (): PlotwrightError =>
  homingFailed(
    "uneven readings",
    "The home switch came at another place each time. Check that nothing holds the carriage back and that the belt is tight, then press Home again.",
  );

/** Its motors are then off, so the switch is not met where it should be. */
const boardRestarted = (): PlotwrightError =>
  homingFailed(
    "board restarted",
    "Its reset button was pressed, or its supply failed for a moment. Press Home again.",
  );

const buttonPressed = (): PlotwrightError =>
  homingFailed("button pressed", "The plotter's button ended it. Press Home to begin again.");
