/**
 * An exact model of the board's step generator, without simulating every tick.
 *
 * Every tick (40 µs) the interrupt adds a rate to each motor's 31-bit accumulator and steps when it
 * overflows. A command loads three registers, and the rate of tick k = 1, 2, … is
 *
 *   r(k) = rate + k accel + jerk k(k+1)/2           sum of ticks 1 … t:
 *   S(t) = t rate + accel t(t+1)/2 + jerk t(t+1)(t+2)/6
 *   net steps = floor((acc + S)/2^31),  accumulator afterwards = (acc + S) mod 2^31
 *
 * Firmware generations differ in how a command's arguments R, A, J become registers:
 *
 *   late   (to 2.6)      rate = R − A           accel = A        magnitudes; direction from the steps
 *   half   (2.7 – 2.8)   rate = R − A/2         accel = A        magnitudes; direction from the steps or rate
 *   signed (3.0 on)      rate = R − A/2 + J/6   accel = A − J    signed, 32 bits, division towards zero
 *
 * Source: ebb.c of each generation (evil-mad/EggBot). Exact in doubles: while |r| ≤ 2^31 every term of S stays below
 * 2^53 up to MAX_PIECE_TICKS ticks; longer commands are split into pieces. A rate that leaves its range wraps, as in
 * the board's registers: the piece ends there, and the next one continues with the wrapped rate.
 */
import { firstWhere } from "../../../geometry/binary-search.js";
import { ACCUMULATOR_RANGE } from "../../../units.js";
import type { TickArithmetic } from "../protocol/firmware.js";

const RANGE = ACCUMULATOR_RANGE;
const WORD = 2 ** 32;
const MAX_PIECE_TICKS = 2 ** 16;
/** A command that wraps its registers more often than this is treated as never ending. */
const MAX_PIECES = 100_000;

/** One motor's registers; see the legend above. `forward` = false: steps count down (late and half only). */
export interface Registers {
  readonly rate: number;
  readonly accel: number;
  readonly jerk: number;
  readonly forward: boolean;
}

/** Registers that a command's signed arguments load. For late and half, the sign of `rate` is the direction. */
export function registersFor(arithmetic: TickArithmetic, rate: number, accel: number, jerk = 0): Registers {
  if (arithmetic === "signed") {
    const loaded = rate - Math.trunc(accel / 2) + Math.trunc(jerk / 6);
    return { rate: int32(loaded), accel: int32(accel - jerk), jerk, forward: true };
  }
  const magnitude = Math.abs(rate);
  const taken = arithmetic === "late" ? accel : Math.trunc(accel / 2);
  return { rate: magnitude - taken, accel, jerk: 0, forward: rate >= 0 && !Object.is(rate, -0) };
}

/** Rate of tick k. */
export const rateAt = (k: number, rate: number, accel: number, jerk: number): number =>
  rate + k * accel + jerk * ((k * (k + 1)) / 2);

/** S(t): the sum of the rates of ticks 1 … t. Exact up to MAX_PIECE_TICKS while rates stay in range. */
export const sumOfRates = (t: number, rate: number, accel: number, jerk: number): number =>
  t * rate + accel * ((t * (t + 1)) / 2) + jerk * ((t * (t + 1) * (t + 2)) / 6);

/** A range of ticks in which the rate keeps its sign and stays in range. */
interface Piece {
  /** Ticks of the command before this piece. */
  readonly fromTick: number;
  readonly ticks: number;
  readonly rate: number;
  readonly accel: number;
  readonly jerk: number;
  /** Accumulator and net steps at its start. */
  readonly acc: number;
  readonly net: number;
}

/** State of one motor after some ticks of a command. */
export interface AxisState {
  /** Signed steps since the command began. */
  net: number;
  acc: number;
}

/**
 * One motor during one command, from its first tick to its last.
 * `stepLimit`: the motor stops after that many steps in either direction (LM, L3, SM).
 * `tickLimit`: it stops after that many ticks (LT, T3). One of the two is Infinity.
 */
export class AxisMotion {
  /** Ticks until this motor is done; Infinity if it never is. */
  readonly ticks: number;
  /** Steps made in either direction. */
  readonly stepsMade: number;
  /** Signed steps. */
  readonly net: number;
  /** Accumulator when done. */
  readonly acc: number;
  /** Rate of the last tick. */
  readonly lastRate: number;
  private readonly pieces: Piece[] = [];
  private readonly forward: boolean;

  constructor(
    arithmetic: TickArithmetic,
    registers: Registers,
    acc: number,
    stepLimit: number,
    tickLimit: number,
  ) {
    this.forward = registers.forward;
    const jerk = registers.jerk;
    let { rate, accel } = registers;
    let tick = 0;
    let made = 0;
    let net = 0;
    let lastRate = rate;
    let endless = false;
    while (tick < tickLimit && made < stepLimit) {
      if (arithmetic === "signed") accel = int32(accel);
      rate = normalRate(arithmetic, rate, accel, jerk);
      const isConstant = accel === 0 && jerk === 0;
      if ((isConstant && rate === 0 && tickLimit === Infinity) || this.pieces.length >= MAX_PIECES) {
        endless = true;
        break;
      }
      const limit = isConstant ? longestConstantTicks(rate) : MAX_PIECE_TICKS;
      let ticks = sameSignTicks(arithmetic, rate, accel, jerk, Math.min(limit, tickLimit - tick));
      let steps = stepsAfter(ticks, rate, accel, jerk, acc);
      if (made + Math.abs(steps) >= stepLimit) {
        ticks = tickOfStep(stepLimit - made, ticks, rate, accel, jerk, acc);
        steps = stepsAfter(ticks, rate, accel, jerk, acc);
      }
      this.pieces.push({ fromTick: tick, ticks, rate, accel, jerk, acc, net });
      acc += sumOfRates(ticks, rate, accel, jerk) - steps * RANGE;
      net += steps;
      made += Math.abs(steps);
      tick += ticks;
      lastRate = rateAt(ticks, rate, accel, jerk);
      rate = lastRate;
      accel += ticks * jerk;
    }
    this.ticks = endless ? Infinity : tick;
    this.stepsMade = made;
    this.net = this.signed(net);
    this.acc = acc;
    this.lastRate = lastRate;
  }

  /** The state after `tick` ticks; after the last tick, the final state. */
  placeAt(tick: number, out: AxisState): AxisState {
    const piece = this.pieceAt(tick);
    if (piece === undefined || tick >= this.ticks) {
      out.net = this.net;
      out.acc = this.acc;
      return out;
    }
    const t = Math.max(0, Math.min(tick - piece.fromTick, piece.ticks));
    const steps = stepsAfter(t, piece.rate, piece.accel, piece.jerk, piece.acc);
    out.net = this.signed(piece.net + steps);
    out.acc = piece.acc + sumOfRates(t, piece.rate, piece.accel, piece.jerk) - steps * RANGE;
    return out;
  }

  /**
   * Signed rate (counts per tick) during tick `tick` = 1 … ticks; 0 if the motor is done or has not started.
   */
  rateDuring(tick: number): number {
    if (tick < 1 || tick > this.ticks) return 0;
    const piece = this.pieceAt(tick - 1);
    if (piece === undefined) return 0;
    return this.signed(rateAt(tick - piece.fromTick, piece.rate, piece.accel, piece.jerk));
  }

  /** The registers after `tick` ticks, from which the motion can be continued. */
  registersAfter(tick: number): Registers {
    const piece = this.pieceAt(tick);
    if (piece === undefined) return { rate: 0, accel: 0, jerk: 0, forward: this.forward };
    const t = tick - piece.fromTick;
    const rate = rateAt(t, piece.rate, piece.accel, piece.jerk);
    return { rate, accel: piece.accel + t * piece.jerk, jerk: piece.jerk, forward: this.forward };
  }

  /** Steps in either direction within the first `tick` ticks. */
  stepsMadeAfter(tick: number): number {
    let made = 0;
    for (const piece of this.pieces) {
      if (piece.fromTick >= tick) break;
      const t = Math.min(piece.ticks, tick - piece.fromTick);
      made += Math.abs(stepsAfter(t, piece.rate, piece.accel, piece.jerk, piece.acc));
    }
    return made;
  }

  /** Late and half count magnitudes. 0 − n avoids −0. */
  private signed(value: number): number {
    return this.forward ? value : 0 - value;
  }

  private pieceAt(tick: number): Piece | undefined {
    const { pieces } = this;
    return pieces[firstWhere(1, pieces.length, (i) => pieces[i].fromTick > tick) - 1];
  }
}

/** Number of ticks for which the sum of a constant rate is exact. */
const longestConstantTicks = (rate: number): number => Math.floor(2 ** 52 / Math.max(1, Math.abs(rate)));

/** Net steps within a piece after t of its ticks, with the sign of the rate. */
const stepsAfter = (t: number, rate: number, accel: number, jerk: number, acc: number): number =>
  Math.floor((acc + sumOfRates(t, rate, accel, jerk)) / RANGE);

/** First tick of a piece at which `steps` steps were made. The piece must make at least that many. */
function tickOfStep(
  steps: number,
  ticks: number,
  rate: number,
  accel: number,
  jerk: number,
  acc: number,
): number {
  return firstWhere(1, ticks, (tick) => Math.abs(stepsAfter(tick, rate, accel, jerk, acc)) >= steps);
}

/** Wraps the rate register so that the next tick's rate is in range. */
function normalRate(arithmetic: TickArithmetic, rate: number, accel: number, jerk: number): number {
  const first = rate + accel + jerk;
  if (arithmetic === "signed") return rate - first + int32(first);
  return rate - first + (((first % RANGE) + RANGE) % RANGE);
}

/** For how many ticks (1 … limit) the rate stays in range and keeps the sign of the first tick. */
function sameSignTicks(
  arithmetic: TickArithmetic,
  rate: number,
  accel: number,
  jerk: number,
  limit: number,
): number {
  const negative = rate + accel + jerk < 0;
  const low = negative ? -RANGE : 0;
  const high = negative ? -1 : RANGE - 1;
  const inside = (k: number): boolean => {
    const r = rateAt(k, rate, accel, jerk);
    return r >= low && r <= high;
  };
  // The rate is monotone up to its vertex.
  let end = limit;
  if (jerk !== 0) {
    const vertex = -accel / jerk - 0.5;
    if (vertex > 1 && vertex < end) end = Math.max(1, Math.floor(vertex));
    if (arithmetic === "signed") end = Math.min(end, ticksBeforeAccelWraps(accel, jerk));
  }
  return firstWhere(2, end + 1, (k) => !inside(k)) - 1;
}

/** The acceleration register has 32 bits too. */
function ticksBeforeAccelWraps(accel: number, jerk: number): number {
  const room = jerk > 0 ? RANGE - 1 - accel : accel + RANGE;
  return Math.max(1, Math.floor(room / Math.abs(jerk)));
}

function int32(value: number): number {
  const wrapped = ((value % WORD) + WORD) % WORD;
  return wrapped >= RANGE ? wrapped - WORD : wrapped;
}
