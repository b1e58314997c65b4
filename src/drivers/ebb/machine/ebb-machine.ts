/** One connected EiBotBoard as a `Machine`: its carriage, and the parts that this board has. */
import { PlotwrightError } from "../../../errors.js";
import type { MachineProfile } from "../../../machines/profile.js";
import { machineOf } from "../../../machines/profiles.js";
import type { ConsoleAnswer, FoundMidPlot, Machine, Playback, PlaybackRequest } from "../../driver.js";
import type { MachineSettings } from "../../machine-job.js";
import { moveTo } from "../../move-to.js";
import type { Clock } from "../../transport.js";
import type { BoardState } from "../compile/command-stream.js";
import { planEbbJob } from "../compile/ebb-job.js";
import { ebbOf, findsHome } from "../protocol/ebb-controller.js";
import { Carriage } from "./carriage.js";
import { sendLine } from "./console.js";
import { homeInCorner } from "./corner-homing.js";
import { EbbPlayback } from "./ebb-playback.js";
import { seekHome } from "./homing.js";

export class EbbMachine extends Carriage implements Machine {
  readonly servo = this.pen;
  readonly supply = this.upkeep.supply;
  readonly console = { send: (line: string): Promise<ConsoleAnswer> => sendLine(this, line) };
  readonly homing = {
    seekHome: async (settings: MachineSettings): Promise<boolean> => {
      const machine = machineOf(settings);
      const { homing, cornerSwitch } = ebbOf(machine);
      if (!findsHome(machine)) return false;
      if (homing) await seekHome(this, settings, homing);
      else if (this.connection.features.hasLimitSwitches) await homeInCorner(this, settings, cornerSwitch!);
      else throw tooOldToHome(this.firmware);
      return true;
    },
  };

  /** A machine that can find home does so first, if its position is unknown. */
  async prepareMotors(settings: MachineSettings): Promise<BoardState> {
    const { homing } = ebbOf(machineOf(settings));
    const canHome = homing || this.connection.features.hasLimitSwitches;
    if (!this.position.state && canHome) await this.homing.seekHome(settings);
    return this.switchMotorsOn(settings);
  }

  get name(): string | null {
    return this.connection.boardName;
  }

  get firmware(): string {
    return this.connection.features.version;
  }

  get clock(): Clock {
    return this.connection.boardClock;
  }

  get speed(): number {
    return this.connection.speed;
  }

  get penUp(): boolean | null {
    return this.pen.isUp;
  }

  get penMoving(): boolean {
    return this.pen.isMoving;
  }

  get motorsOn(): boolean | null {
    return this.position.motorsOn;
  }

  get foundMidPlot(): FoundMidPlot | null {
    return this.position.foundMidPlot;
  }

  get state(): BoardState | null {
    return this.position.state;
  }

  positionMm(profile: MachineProfile): { x: number; y: number } | null {
    return this.position.mm(profile);
  }

  forgetPosition(): Promise<void> {
    return this.position.forget();
  }

  motorsOff(): Promise<void> {
    return this.position.motorsOff();
  }

  movePen(up: boolean, settings: MachineSettings, heightPct?: number): Promise<void> {
    return this.pen.move(up, settings, heightPct);
  }

  moveTo(xMm: number, yMm: number, settings: MachineSettings): Promise<void> {
    return moveTo(this, planEbbJob, { xMm, yMm }, settings);
  }

  emergencyStopMs(settings: MachineSettings): number {
    return this.upkeep.emergencyStopMs(settings);
  }

  startPlayback(request: PlaybackRequest): Playback {
    return new EbbPlayback(this, request);
  }

  log(): string {
    return this.connection.session.log.text();
  }

  close(): Promise<void> {
    return this.connection.session.close();
  }
}

const tooOldToHome = (firmware: string): PlotwrightError =>
  new PlotwrightError(
    "board-error",
    `Firmware ${firmware} cannot stop at the home switch: update it to 3.0.0 or newer. Until then push the carriage into its home corner and set home there.`,
  );
