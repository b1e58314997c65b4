/** The pen of one Grbl while nothing is plotted. */
import type { MachineProfile } from "../../../machines/profile.js";
import { machineOf } from "../../../machines/profiles.js";
import type { HeightPart } from "../../driver.js";
import type { MachineSettings } from "../../machine-job.js";
import { SYNC } from "../grbl-job.js";
import { penLiftOf, waitAfter, type PenLift } from "../model/pen-lift.js";
import type { GrblSession } from "./session.js";

/** Heights that differ by less are the same, mm. */
const SAME_MM = 0.001;

export class GrblPen implements HeightPart {
  /** Null: unknown. */
  isUp: boolean | null = null;
  /** It is still moving to that state. */
  isMoving = false;
  /** Where the profile's Z is 0, in machine coordinates; null: where the Grbl's own is. */
  zeroMm: number | null = null;
  /** Until the user says that the pen is at its height, or begins a new plot with it. */
  isUnsure = false;
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

  /** Z counts from its switch again. */
  foundSwitch(): void {
    this.zeroMm = null;
    this.isUnsure = false;
  }

  async isAsSwitchedOn(): Promise<void> {
    if (!this.isUnsure) return;
    const { at, machineAt } = await this.session.status();
    this.zeroMm = Math.abs(at[2]) < SAME_MM ? null : machineAt[2];
    this.isUnsure = false;
    this.setState(null);
    this.changed();
  }

  /**
   * After a restart: the current height is that of a pen that is up, or down. One of which that is unknown (null) counts as
   * down, so that it is not pushed into the paper. Returns false if the height is lost.
   */
  async countFrom(up: boolean | null, settings: MachineSettings): Promise<boolean> {
    const lift = penLiftOf(machineOf(settings));
    if (lift.kind !== "z") return true;
    const { upPct, downPct } = settings.pen;
    this.zeroMm = (await this.session.status()).machineAt[2] - lift.valueAt(up === true ? upPct : downPct);
    const isLost = up === null && !this.session.findsHome;
    this.isUnsure ||= isLost;
    return !isLost;
  }
}
