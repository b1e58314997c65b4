/** What the manual moves of all drivers have in common. */
import { strokesOf } from "../drawing/stroke-set.js";
import { machineOf } from "../machines/profiles.js";
import type { Machine, StopSignal } from "./driver.js";
import { moveStopped } from "./faults.js";
import type { MachineSettings, PlanForMachine } from "./machine-job.js";

/** The signal of the moves that begin until the next stop. */
export class MoveSignal implements StopSignal {
  aborted = false;

  throwIfAborted(): void {
    if (this.aborted) throw moveStopped();
  }
}

/** Lifts the pen and moves in a straight line to a position, with a plan of the machine's driver. */
export async function moveTo(
  machine: Machine,
  planJob: PlanForMachine,
  to: { readonly xMm: number; readonly yMm: number },
  settings: MachineSettings,
): Promise<void> {
  const { stopSignal } = machine;
  const board = await machine.prepareMotors(settings);
  if (machine.penUp !== true) await machine.movePen(true, settings);
  // A stop before the carriage moves has no motion to stop.
  stopSignal.throwIfAborted();
  const profile = machineOf(settings);
  const from = machine.positionMm(profile)!;
  const job = planJob(strokesOf([]), settings, profile, {
    startXMm: from.x,
    startYMm: from.y,
    endXMm: to.xMm,
    endYMm: to.yMm,
    firmware: machine.firmware,
    board,
  });
  if (job.trajectory.blockCount === 0) return;
  await machine.perform({ trajectory: job.trajectory, commands: job.commands() }, settings);
}
