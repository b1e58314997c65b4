/** The pen of one Grbl while nothing is plotted. */
import type { MachineProfile } from "../../../machines/profile.js";
import { machineOf } from "../../../machines/profiles.js";
import type { MachineSettings } from "../../machine-job.js";
import { SYNC } from "../grbl-job.js";
import { penLiftOf, waitAfter, type PenLift } from "../model/pen-lift.js";
import type { GrblSession } from "./session.js";

export class GrblPen {
  /** Null: unknown. */
  isUp: boolean | null = null;
  /** It is still moving to that state. */
  isMoving = false;
  /** Where the profile's Z is 0, in machine coordinates; null: where the Grbl's own is. */
  zeroMm: number | null = null;
  /** Where the last move by hand has brought it, percent; null: something else has moved it since. */
  private heightPct: number | null = null;

  constructor(
    private readonly session: GrblSession,
    private readonly changed: () => void,
  ) {}

  setState(isUp: boolean | null): void {
    this.isUp = isUp;
    this.heightPct = null;
  }

  /** The profile's Z 0 in work coordinates. */
  get zeroInWorkMm(): number {
    return this.zeroMm === null ? 0 : this.zeroMm - this.session.offset[2];
  }

  liftOf(profile: MachineProfile): PenLift {
    return penLiftOf(profile, this.session.settings.limitsFor(profile), this.zeroInWorkMm);
  }

  /** Lifts or lowers the pen of a Grbl that accepts moves; resolves when it has arrived. */
  async move(up: boolean, settings: MachineSettings, heightPct?: number): Promise<void> {
    const { upPct, downPct } = settings.pen;
    const pct = heightPct ?? (up ? upPct : downPct);
    const lift = this.liftOf(machineOf(settings));
    const lines = [SYNC, ...lift.lines(up, pct), waitAfter(lift, this.heightPct, pct, up, settings.pen)];
    this.session.settings.mustPerform(lines, this.session.offset);
    this.isUp = up;
    this.heightPct = pct;
    this.isMoving = true;
    this.changed();
    try {
      // The profile's own lines may move by a distance.
      const lostTries = lift.kind === "lines" ? 1 : undefined;
      for (const line of lines) await this.session.sendSurely(line, lostTries);
    } catch (error) {
      this.setState(null);
      throw error;
    } finally {
      this.isMoving = false;
      this.changed();
    }
  }

  /** After a restart: the current height is that of a pen that is up, or down. */
  async countFrom(up: boolean, settings: MachineSettings): Promise<void> {
    const lift = penLiftOf(machineOf(settings));
    if (lift.kind !== "z") return;
    const { upPct, downPct } = settings.pen;
    this.zeroMm = (await this.session.status()).machineAt[2] - lift.valueAt(up ? upPct : downPct);
  }
}
