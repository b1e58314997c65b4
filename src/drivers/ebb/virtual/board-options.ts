/** What can be chosen about a virtual board, and what it tells about itself. */
import type { MachineProfile, Springs } from "../../../machines/profile.js";
import type { Clock } from "../../transport.js";
import type { VirtualServo } from "./core.js";

/** Which board to simulate, and how fast. Only the clock is required. */
export interface VirtualBoardOptions {
  /** Counts real seconds. */
  readonly clock: Clock;
  /** Default "2.8.1", or "3.0.3" for a machine that finds home by itself. */
  readonly firmware?: string | undefined;
  /** Idle ticks after LT and T3. Default: as the firmware is known to have. To try a plot on a board that differs. */
  readonly idleTicksTimed?: number | undefined;
  /** Board seconds per clock second. Infinity: every move is over as soon as it is sent. Default 1. */
  readonly speed?: number;
  /** Default AxiDraw V3. */
  readonly machine?: MachineProfile;
  /** Record the drawn line. Default true. */
  readonly recordLine?: boolean;
  /** Board time to parse a command. Default 0. */
  readonly parseMs?: number;
  /** Max unparsed bytes before the board stops reading. Default 256. */
  readonly inputBytes?: number;
  /** Simulate the time that the pen's servo takes. Default: the tip touches and leaves the paper with the command. */
  readonly servo?: VirtualServo;
  /**
   * Simulate a gantry on which the pen swings, so that the drawn line rings. Reported positions and steps are still
   * those of the motors. Default: the pen is exactly where the motors are.
   */
  readonly springs?: Springs | undefined;
  /** Size of the host system's buffer for bytes from `transport()`. Default 4096. */
  readonly systemBytes?: number;
}

/** A board at one instant. */
export interface VirtualBoardState {
  readonly firmware: string;
  readonly steps1: number;
  readonly steps2: number;
  readonly xMm: number;
  readonly yMm: number;
  readonly penUp: boolean;
  /** Current servo position. */
  readonly penPct: number;
  readonly motorsOn: boolean;
  readonly isBusy: boolean;
  /** Number of orders waiting behind the running one. */
  readonly waitingCount: number;
  /** Board seconds since the virtual board was created. */
  readonly boardS: number;
}
