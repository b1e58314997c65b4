/**
 * Which slices of constant speed follow a run with the smallest jumps between them.
 *
 * A slice is T whole ms with n₁ and n₂ whole steps, so its speeds n/T are few: at 5 ms there are 2.5 mm/s from one to
 * the next. The nearest step at every cut makes jumps of one or two of these besides what the plan's acceleration
 * makes. What can be chosen is T, and which way to round: a place half a step behind the plan does not show, a speed
 * that goes up and down does. So several ways are followed at once, and the best is taken (a beam search).
 *
 *   steps ^           _o     o  ways kept: place, speed, accumulators, what it cost to get there
 *         |      _o__/ /     ─  slices tried from each: two lengths, each with the whole steps on either side of
 *         |  o__/ __o_/         the plan's place, for both motors
 *         |   \__o_/            of the ways that end in the same 5 ms, the best four are kept
 *         +----|----|----> t
 *
 *   cost   Σ (jump²/J²)⁴ + Σ (twice what a place is off beyond half a step)²; so high a power counts the worst only
 *   J²     2 + (A · 5 ms)² steps², A the run's largest acceleration: what cannot be helped, and a step on each motor
 *   rank   cost + x² + (x + u)²: what it will take to come back from x steps and u steps a 5 ms off the plan
 *
 * Linear in time. A way has its accumulators, so how long a slice takes is known to the tick.
 */
import { ACCUMULATOR_RANGE, TICKS_PER_MS } from "../../../units.js";
import type { TickArithmetic } from "../protocol/firmware.js";
import type { MotorPlace } from "./leg.js";
import { HIGHEST_RATE } from "../protocol/limits.js";
import type { RunSamples } from "./run-samples.js";
import { slowRate } from "../model/slow-rate.js";

const RANGE = ACCUMULATOR_RANGE;

/**
 * The board reads a command in 4 ms (both motors at 2.5 kHz) to 7 ms (at 25 kHz; firmware before 2.7, EBB command
 * reference, "Performance"): at the speeds of a plot, shorter slices would leave it standing between them.
 */
const SHORTEST_MS = 5;
/** As long as the longest command of newer firmware, so that a hold takes effect soon. */
const LONGEST_MS = 150;
/** The last slice of a run: what follows may take its time. */
const SHORTEST_LAST_MS = 2;
/** From here a run may be ended by one slice. */
const MOST_LAST_TICKS = 16 * TICKS_PER_MS;
/** How far ahead the plan's acceleration is looked for. */
const AHEAD_MS = 8;
/** Steps by which a slice may cut a bend of the plan. */
const MOST_SAG_STEPS = 0.25;
/** Steps off that cost nothing. */
const FREE_STEPS = 0.5;
/** The same in the middle of a slice, where acceleration alone makes some. */
const FREE_INSIDE_STEPS = 1;

/** Squares of jumps from and to rest count as this much more: before or after it there may be another, the other way. */
const REST_SHARE = 2;

/** Ways that are kept of those that end in the same slot of time. */
const WAYS = 4;
const SLOT_TICKS = SHORTEST_MS * TICKS_PER_MS;
/** More slots than the longest slice spans. A power of two. */
const SLOTS = 64;
const SLOT_MASK = SLOTS - 1;
/** Slots gone through before the best way is taken for good. */
const HORIZON = 50;
const CAPACITY = 2 + WAYS * (HORIZON + SLOTS);

/** Slices that one motor might do: the whole steps on either side of where it should get to. */
const OPTIONS = 2;

class MotorOptions {
  readonly steps = new Float64Array(OPTIONS);
  readonly ticks = new Float64Array(OPTIONS);
  readonly acc = new Float64Array(OPTIONS);
  /** Steps in 5 ms. */
  readonly speed = new Float64Array(OPTIONS);
  /** Squares of the jump, of what is off beyond what is free, and of what it takes to come back. */
  readonly jump = new Float64Array(OPTIONS);
  readonly off = new Float64Array(OPTIONS);
  readonly back = new Float64Array(OPTIONS);

  constructor(private readonly arithmetic: TickArithmetic) {}

  /**
   * Slices that lead about `way` steps on, to where the plan's speed is `aimSpeed`; `halfWay` is where the plan is
   * in the middle.
   */
  fill(ms: number, way: number, halfWay: number, aimSpeed: number, acc: number, speed: number): void {
    const most = mostSteps(ms);
    const first = Math.max(-most, Math.min(most - 1, Math.floor(way)));
    for (let k = 0; k < OPTIONS; k++) {
      this.set(k, ms, first + k, acc, speed);
      const x = first + k - way;
      const u = this.speed[k]! - aimSpeed;
      const beyond = 2 * Math.max(0, Math.abs(x) - FREE_STEPS);
      const inside = 2 * Math.max(0, Math.abs((first + k) / 2 - halfWay) - FREE_INSIDE_STEPS);
      this.off[k] = beyond * beyond + inside * inside;
      this.back[k] = x * x + (x + u) * (x + u);
    }
  }

  /** A slice of just so many steps. */
  set(k: number, ms: number, steps: number, acc: number, speed: number): void {
    this.steps[k] = steps;
    this.speed[k] = (steps * SHORTEST_MS) / ms;
    const jump = this.speed[k]! - speed;
    this.jump[k] = jump * jump;
    this.ticks[k] = 0;
    this.acc[k] = acc;
    if (steps === 0) return;
    const magnitude = Math.abs(steps);
    const rate = slowRate(this.arithmetic, ms, magnitude);
    const counts = magnitude * RANGE - acc;
    const ticks = Math.ceil(counts / rate);
    this.ticks[k] = ticks;
    this.acc[k] = ticks * rate - counts;
  }
}

/** Ways, each by its last slice and where the motors stand after it. Columns. */
class Ways {
  readonly ms = new Int32Array(CAPACITY);
  readonly ticks = new Float64Array(CAPACITY);
  /** Ticks from the run's start to the slice's end. */
  readonly tick = new Float64Array(CAPACITY);
  readonly steps1 = new Float64Array(CAPACITY);
  readonly steps2 = new Float64Array(CAPACITY);
  readonly acc1 = new Float64Array(CAPACITY);
  readonly acc2 = new Float64Array(CAPACITY);
  /** Steps in 5 ms. */
  readonly speed1 = new Float64Array(CAPACITY);
  readonly speed2 = new Float64Array(CAPACITY);
  readonly cost = new Float64Array(CAPACITY);
  readonly rank = new Float64Array(CAPACITY);
  /** The way that this one goes on from. */
  readonly parent = new Int32Array(CAPACITY);

  copy(from: number, to: number): void {
    for (const column of Object.values(this) as (Float64Array | Int32Array)[]) column[to] = column[from]!;
  }
}

/** The way from which a search sets out. */
const ROOT = 0;
const NONE = -1;

export class SliceSearch {
  readonly ways = new Ways();
  /** The ways along the best one, from its first slice to its last: `pathLength` of them. */
  readonly path = new Int32Array(CAPACITY);
  pathLength = 0;
  /** The ways of each slot, by its number's last bits: how many, which, and the worst rank among them. */
  private readonly counts = new Int32Array(SLOTS);
  private readonly slots = new Int32Array(SLOTS * WAYS);
  private readonly worst = new Float64Array(SLOTS);
  private used = 0;
  /** The slot whose ways are being gone on from. */
  private slot = 0;
  /** The best way to the run's end. */
  private finish = NONE;
  private jumpShare = 1;
  private readonly o1: MotorOptions;
  private readonly o2: MotorOptions;
  /** Lengths of slices to try from this slot, ms. */
  private readonly lengths = new Int32Array(2);
  private readonly at = new Float64Array(4);

  constructor(
    private readonly samples: RunSamples,
    arithmetic: TickArithmetic,
    private readonly idleTicks: number,
  ) {
    this.o1 = new MotorOptions(arithmetic);
    this.o2 = new MotorOptions(arithmetic);
  }

  /**
   * At the run's start, where the motors stand. Where it follows the last run at once, the first jump is from that
   * one's last slice: a rest of no duration is none.
   */
  begin(m1: MotorPlace, m2: MotorPlace, followsAtOnce: boolean): void {
    const { ways, samples, path } = this;
    const last = this.pathLength > 0 ? path[this.pathLength - 1]! : ROOT;
    const accel = samples.peakAccel * SHORTEST_MS * SHORTEST_MS;
    this.jumpShare = 1 / (2 + accel * accel);
    this.pathLength = 0;
    ways.tick[ROOT] = 0;
    ways.steps1[ROOT] = m1.steps;
    ways.steps2[ROOT] = m2.steps;
    ways.acc1[ROOT] = m1.acc;
    ways.acc2[ROOT] = m2.acc;
    ways.speed1[ROOT] = followsAtOnce ? ways.speed1[last]! : samples.startSpeed1 * SHORTEST_MS;
    ways.speed2[ROOT] = followsAtOnce ? ways.speed2[last]! : samples.startSpeed2 * SHORTEST_MS;
  }

  /** Finds the next slices, on from the last ones: `path`. True when they end the run. */
  next(): boolean {
    const { ways, counts, slots } = this;
    if (this.pathLength > 0) ways.copy(this.path[this.pathLength - 1]!, ROOT);
    ways.cost[ROOT] = 0;
    this.used = ROOT + 1;
    this.finish = NONE;
    counts.fill(0);
    this.slot = Math.floor(ways.tick[ROOT]! / SLOT_TICKS);
    counts[this.slot & SLOT_MASK] = 1;
    slots[(this.slot & SLOT_MASK) * WAYS] = ROOT;
    const best = this.follow(this.slot + HORIZON);
    this.trace(best);
    return best === this.finish;
  }

  /** Goes on from slot to slot, to the run's end or so far that the best way can be told. */
  private follow(horizon: number): number {
    const { ways, counts, slots, samples } = this;
    for (; ; this.slot++) {
      const slot = this.slot & SLOT_MASK;
      const base = slot * WAYS;
      const count = counts[slot]!;
      if (this.finish !== NONE && this.slot * SLOT_TICKS > samples.endTick) return this.finish;
      if (count === 0) continue;
      if (this.slot >= horizon && this.finish === NONE) return this.bestOf(base, count);
      counts[slot] = 0;
      samples.reach((this.slot + 1) * SLOT_TICKS + (LONGEST_MS + SHORTEST_MS) * TICKS_PER_MS);
      this.chooseLengths(ways.tick[slots[base]!]!);
      for (let i = 0; i < count; i++) this.goOn(slots[base + i]!);
    }
  }

  private bestOf(base: number, count: number): number {
    const { ways, slots } = this;
    let best = slots[base]!;
    for (let i = 1; i < count; i++) {
      const way = slots[base + i]!;
      if (ways.rank[way]! < ways.rank[best]!) best = way;
    }
    return best;
  }

  private trace(best: number): void {
    const { ways, path } = this;
    let length = 0;
    for (let way = best; way !== ROOT; way = ways.parent[way]!) length++;
    this.pathLength = length;
    for (let way = best; way !== ROOT; way = ways.parent[way]!) path[--length] = way;
  }

  /** A length at which a step of rounding makes as much of a jump as the acceleration does, and one beside it. */
  private chooseLengths(tick: number): void {
    const { samples, at, lengths } = this;
    samples.read(tick, at);
    const v1 = at[2]!;
    const v2 = at[3]!;
    samples.read(tick + AHEAD_MS * TICKS_PER_MS, at);
    const accel = Math.hypot(at[2]! - v1, at[3]! - v2) / AHEAD_MS;
    const most = Math.min(LONGEST_MS, 1 / Math.sqrt(accel));
    let ms = SHORTEST_MS;
    // From short to long, so that no bend within is passed over.
    for (let next = ms; next <= most; next = (4 * next + 2) / 3) {
      const whole = Math.round(next);
      if (samples.sag(tick, whole * TICKS_PER_MS) > MOST_SAG_STEPS) break;
      ms = whole;
    }
    lengths[0] = ms;
    lengths[1] = ms < 2 * SHORTEST_MS ? lengths[0]! + 1 : Math.round(0.8 * ms);
  }

  private goOn(way: number): void {
    const { ways, samples, lengths, idleTicks } = this;
    const left = samples.endTick - ways.tick[way]!;
    if (left < MOST_LAST_TICKS) this.tryLast(way, left);
    // What is left afterwards must be enough for the last one.
    const most = Math.floor((left - idleTicks) / TICKS_PER_MS) - SHORTEST_LAST_MS;
    let before = 0;
    for (let i = 0; i < lengths.length; i++) {
      const ms = Math.min(lengths[i]!, most);
      if (ms < SHORTEST_MS || ms === before) continue;
      before = ms;
      this.trySlices(way, ms);
    }
  }

  private trySlices(way: number, ms: number): void {
    const { ways, samples, o1, o2, at, idleTicks } = this;
    const tick = ways.tick[way]!;
    const ticks = ms * TICKS_PER_MS + idleTicks;
    const steps1 = ways.steps1[way]!;
    const steps2 = ways.steps2[way]!;
    samples.read(tick + ticks / 2, at);
    const half1 = at[0]! - steps1;
    const half2 = at[1]! - steps2;
    samples.read(tick + ticks, at);
    o1.fill(ms, at[0]! - steps1, half1, at[2]! * SHORTEST_MS, ways.acc1[way]!, ways.speed1[way]!);
    o2.fill(ms, at[1]! - steps2, half2, at[3]! * SHORTEST_MS, ways.acc2[way]!, ways.speed2[way]!);
    const share = ways.speed1[way] === 0 && ways.speed2[way] === 0 ? REST_SHARE : 1;
    for (let i = 0; i < OPTIONS; i++) {
      for (let j = 0; j < OPTIONS; j++) {
        const added = this.jumpCost(share * (o1.jump[i]! + o2.jump[j]!)) + o1.off[i]! + o2.off[j]!;
        const cost = ways.cost[way]! + added;
        this.offer(way, ms, i, j, cost, cost + o1.back[i]! + o2.back[j]!);
      }
    }
  }

  /** Of the square of a jump, steps in 5 ms. */
  private jumpCost(square: number): number {
    const part = square * this.jumpShare;
    return part * part * part * part;
  }

  /** Keeps a way if it is one of the best of its slot. */
  private offer(parent: number, ms: number, i: number, j: number, cost: number, rank: number): void {
    const { ways, counts, slots, worst, o1, o2 } = this;
    const ticks = this.ticksOf(ms, i, j);
    // Where an accumulator was all but full, a slice is over almost at once.
    const later = ((ways.tick[parent]! + ticks) / SLOT_TICKS) | 0;
    const slot = (later > this.slot ? later : this.slot + 1) & SLOT_MASK;
    const count = counts[slot]!;
    if (count === WAYS && rank >= worst[slot]!) return;
    const base = slot * WAYS;
    let place = count < WAYS ? NONE : slots[base]!;
    for (let k = 0; k < count; k++) {
      const other = slots[base + k]!;
      const isSame =
        ways.speed1[other] === o1.speed[i] &&
        ways.speed2[other] === o2.speed[j] &&
        ways.steps1[other] === ways.steps1[parent]! + o1.steps[i]! &&
        ways.steps2[other] === ways.steps2[parent]! + o2.steps[j]!;
      if (isSame) {
        if (ways.rank[other]! <= rank) return;
        place = other;
        break;
      }
      if (count === WAYS && ways.rank[other]! > ways.rank[place]!) place = other;
    }
    if (place === NONE) {
      place = this.used++;
      slots[base + count] = place;
      counts[slot] = count + 1;
    }
    this.put(place, parent, ms, i, j, cost, rank);
    if (counts[slot] !== WAYS) return;
    worst[slot] = ways.rank[slots[base]!]!;
    for (let k = 1; k < WAYS; k++) worst[slot] = Math.max(worst[slot]!, ways.rank[slots[base + k]!]!);
  }

  private put(
    place: number,
    parent: number,
    ms: number,
    i: number,
    j: number,
    cost: number,
    rank: number,
  ): void {
    const { ways, o1, o2 } = this;
    const ticks = this.ticksOf(ms, i, j);
    ways.ms[place] = ms;
    ways.ticks[place] = ticks;
    ways.tick[place] = ways.tick[parent]! + ticks;
    ways.steps1[place] = ways.steps1[parent]! + o1.steps[i]!;
    ways.steps2[place] = ways.steps2[parent]! + o2.steps[j]!;
    ways.acc1[place] = o1.acc[i]!;
    ways.acc2[place] = o2.acc[j]!;
    ways.speed1[place] = o1.speed[i]!;
    ways.speed2[place] = o2.speed[j]!;
    ways.cost[place] = cost;
    ways.rank[place] = rank;
    ways.parent[place] = parent;
  }

  /** Without a step it is a plain delay, with no idle tick after it. */
  private ticksOf(ms: number, i: number, j: number): number {
    const ticks = Math.max(this.o1.ticks[i]!, this.o2.ticks[j]!);
    return ticks === 0 ? ms * TICKS_PER_MS : ticks + this.idleTicks;
  }

  /** One slice to the run's end, and rest. */
  private tryLast(way: number, left: number): void {
    const { ways, samples, o1, o2 } = this;
    const steps1 = Math.round(samples.end1.p1) - ways.steps1[way]!;
    const steps2 = Math.round(samples.end2.p1) - ways.steps2[way]!;
    let ms = Math.max(1, Math.round((left - this.idleTicks) / TICKS_PER_MS));
    while (mostSteps(ms) < Math.max(Math.abs(steps1), Math.abs(steps2))) ms++;
    o1.set(0, ms, steps1, ways.acc1[way]!, ways.speed1[way]!);
    o2.set(0, ms, steps2, ways.acc2[way]!, ways.speed2[way]!);
    const toRest = REST_SHARE * (o1.speed[0]! * o1.speed[0]! + o2.speed[0]! * o2.speed[0]!);
    const astrayMs = Math.max(0, Math.abs(left - this.ticksOf(ms, 0, 0)) / TICKS_PER_MS - 0.6);
    const jumps = this.jumpCost(o1.jump[0]! + o2.jump[0]!) + this.jumpCost(toRest);
    const cost = ways.cost[way]! + jumps + astrayMs * astrayMs;
    if (this.finish !== NONE && ways.cost[this.finish]! <= cost) return;
    if (this.finish === NONE) this.finish = this.used++;
    this.put(this.finish, way, ms, 0, 0, cost, cost);
  }
}

/** The most steps that a motor can make in so many ms. */
const mostSteps = (ms: number): number => Math.floor((HIGHEST_RATE / RANGE) * TICKS_PER_MS * ms);
