/** One connected EiBotBoard as a `Machine`: its carriage and its operations. */
import { machineOf } from "../../../machines/profiles.js";
import type { ConsoleAnswer, Machine, MachineRun, RunRequest } from "../../driver.js";
import type { MachineSettings } from "../../machine-job.js";
import type { Clock } from "../../transport.js";
import { ebbOf } from "../protocol/ebb-controller.js";
import { Carriage } from "./carriage.js";
import { sendLine } from "./console.js";
import { EbbRun } from "./ebb-run.js";
import { seekHome } from "./homing.js";

export class EbbMachine extends Carriage implements Machine {
  get firmware(): string {
    return this.connection.features.version;
  }

  get name(): string | null {
    return this.connection.boardName;
  }

  get clock(): Clock {
    return this.connection.boardClock;
  }

  get speed(): number {
    return this.connection.speed;
  }

  async findHome(settings: MachineSettings): Promise<boolean> {
    const { homing } = ebbOf(machineOf(settings));
    if (!homing) return false;
    await seekHome(this, settings, homing);
    return true;
  }

  command(line: string): Promise<ConsoleAnswer> {
    return sendLine(this, line);
  }

  log(): string {
    return this.connection.session.log.text();
  }

  startRun(request: RunRequest): MachineRun {
    return new EbbRun(this, request);
  }

  async close(): Promise<void> {
    await this.connection.session.close();
  }
}
