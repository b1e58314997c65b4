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

/** A rate and how it changes; see the legend above. */
export interface Rates {
  readonly rate: number;
  readonly accel: number;
  readonly jerk: number;
}

/** One motor's registers. `forward` = false: steps count down (late and half only). */
export interface Registers extends Rates {
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
export const rateAt = (k: number, { rate, accel, jerk }: Rates): number =>
  rate + k * accel + jerk * ((k * (k + 1)) / 2);

/** S(t): the sum of the rates of ticks 1 … t. Exact up to MAX_PIECE_TICKS while rates stay in range. */
export const sumOfRates = (t: number, { rate, accel, jerk }: Rates): number =>
  t * rate + accel * ((t * (t + 1)) / 2) + jerk * ((t * (t + 1) * (t + 2)) / 6);

/** State of one motor after some ticks of a command. */
interface AxisState {
  /** Signed steps since the command began. */
  readonly net: number;
  readonly acc: number;
}

/** The state after `t` ticks in which the rate keeps its sign and stays in range. `net` has the sign of the rate. */
export function stateAfter(t: number, rates: Rates, acc: number): AxisState {
  const sum = acc + sumOfRates(t, rates);
  const net = Math.floor(sum / RANGE);
  return { net, acc: sum - net * RANGE };
}

/** A range of ticks in which the rate keeps its sign and stays in range. */
interface Piece extends Rates {
  /** Ticks of the command before this piece. */
  readonly fromTick: number;
  readonly ticks: number;
  /** Accumulator and net steps at its start. */
  readonly acc: number;
  readonly net: number;
}

/**
 * One motor during one command, from its first tick to its last.
 * `stepLimit`: the motor stops after that many steps in either direction (LM, L3, SM).
 * `tickLimit`: it stops after that many ticks (LT, T3). One of the two is Infinity.
 */
export class AxisMotion {
  /** Ticks until this motor is done; Infinity if it never is. */
  readonly ticks: number;
  /** Signed steps. */
  readonly net: number;
  /** Accumulator when done. */
  readonly acc: number;
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
    const { jerk } = registers;
    let { rate, accel } = registers;
    let tick = 0;
    let made = 0;
    let net = 0;
    let endless = false;
    while (tick < tickLimit && made < stepLimit) {
      if (arithmetic === "signed") accel = int32(accel);
      rate = normalRate(arithmetic, { rate, accel, jerk });
      const rates = { rate, accel, jerk };
      const isConstant = accel === 0 && jerk === 0;
      if ((isConstant && rate === 0 && tickLimit === Infinity) || this.pieces.length >= MAX_PIECES) {
        endless = true;
        break;
      }
      const limit = isConstant ? longestConstantTicks(rate) : MAX_PIECE_TICKS;
      let ticks = sameSignTicks(arithmetic, rates, Math.min(limit, tickLimit - tick));
      let after = stateAfter(ticks, rates, acc);
      if (made + Math.abs(after.net) >= stepLimit) {
        ticks = tickOfStep(stepLimit - made, ticks, rates, acc);
        after = stateAfter(ticks, rates, acc);
      }
      this.pieces.push({ fromTick: tick, ticks, ...rates, acc, net });
      acc = after.acc;
      net += after.net;
      made += Math.abs(after.net);
      tick += ticks;
      rate = rateAt(ticks, rates);
      accel += ticks * jerk;
    }
    this.ticks = endless ? Infinity : tick;
    this.net = this.signed(net);
    this.acc = acc;
  }

  /** The state after `tick` ticks; after the last tick, the final state. */
  stateAfterTicks(tick: number): AxisState {
    const piece = this.pieceAt(tick);
    if (piece === undefined || tick >= this.ticks) return { net: this.net, acc: this.acc };
    const t = Math.max(0, Math.min(tick - piece.fromTick, piece.ticks));
    const { net, acc } = stateAfter(t, piece, piece.acc);
    return { net: this.signed(piece.net + net), acc };
  }

  /**
   * Signed rate (counts per tick) during tick `tick` = 1 … ticks; 0 if the motor is done or has not started.
   */
  rateDuring(tick: number): number {
    if (tick < 1 || tick > this.ticks) return 0;
    const piece = this.pieceAt(tick - 1);
    if (piece === undefined) return 0;
    return this.signed(rateAt(tick - piece.fromTick, piece));
  }

  /** The registers after `tick` ticks, from which the motion can be continued. */
  registersAfter(tick: number): Registers {
    const piece = this.pieceAt(tick);
    if (piece === undefined) return { rate: 0, accel: 0, jerk: 0, forward: this.forward };
    const t = tick - piece.fromTick;
    return {
      rate: rateAt(t, piece),
      accel: piece.accel + t * piece.jerk,
      jerk: piece.jerk,
      forward: this.forward,
    };
  }

  /** Steps in either direction within the first `tick` ticks. */
  stepsMadeAfter(tick: number): number {
    let made = 0;
    for (const piece of this.pieces) {
      if (piece.fromTick >= tick) break;
      const t = Math.min(piece.ticks, tick - piece.fromTick);
      made += Math.abs(stateAfter(t, piece, piece.acc).net);
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

/** First of `ticks` ticks at which `steps` steps were made; at the latest the last one. */
export const tickOfStep = (steps: number, ticks: number, rates: Rates, acc: number): number =>
  firstWhere(1, ticks, (tick) => Math.abs(stateAfter(tick, rates, acc).net) >= steps);

/** Wraps the rate register so that the next tick's rate is in range. */
function normalRate(arithmetic: TickArithmetic, { rate, accel, jerk }: Rates): number {
  const first = rate + accel + jerk;
  if (arithmetic === "signed") return rate - first + int32(first);
  return rate - first + (((first % RANGE) + RANGE) % RANGE);
}

/** For how many ticks (1 … limit) the rate stays in range and keeps the sign of the first tick. */
function sameSignTicks(arithmetic: TickArithmetic, rates: Rates, limit: number): number {
  const { rate, accel, jerk } = rates;
  const negative = rate + accel + jerk < 0;
  const low = negative ? -RANGE : 0;
  const high = negative ? -1 : RANGE - 1;
  const inside = (k: number): boolean => {
    const r = rateAt(k, rates);
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
