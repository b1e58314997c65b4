/**
 * How long each step of planning may take, and how much memory. Files of 25 MB are read in 2 s on a desk machine, a million segments planned in
 * as much; the limits leave room for far larger ones on a small computer, and end what would never end.
 */
import { totalmem } from "node:os";
import { PlotwrightError, type PrepareSettings } from "../../src/index.js";
import type { TimeLimit } from "./bounded-thread.js";

export interface PlanningLimits {
  readonly importS: number;
  /** Without the time that the user gives to the search for an order. */
  readonly prepareS: number;
  /** Planning and compiling. */
  readonly planS: number;
  /** Of JavaScript heap; typed arrays come on top of it. */
  readonly heapMb: number;
  /** By which the whole process may grow meanwhile: nothing less can be measured of a thread's typed arrays. */
  readonly growthMb: number;
}

export const PLANNING_LIMITS: PlanningLimits = {
  importS: 120,
  prepareS: 300,
  planS: 300,
  // A part of a small computer's memory: the thread must end before the system ends the server.
  heapMb: Math.round(Math.min(1_024, Math.max(256, totalmem() / 4e6))),
  growthMb: Math.min(1_500, totalmem() / 2e6),
};

/** For what is planned for its user alone, or was planned before and is on the plotter now: it must not fail for others. */
export const OWN_PLANNING_LIMITS: PlanningLimits = { ...PLANNING_LIMITS, growthMb: Infinity };

/** The search counts its work, not its time: a small computer takes this many times longer for it than a desk machine. */
const SLOWEST_SEARCH = 5;

export const importLimit = ({ importS }: PlanningLimits): TimeLimit => ({
  s: importS,
  error: new PlotwrightError(
    "bad-file",
    `This file takes too long to read: more than ${importS} s. It may be damaged. Simplify it, or export it again.`,
  ),
});

export const prepareLimit = (
  { prepareS }: PlanningLimits,
  { order, orderS }: Pick<PrepareSettings, "order" | "orderS">,
): TimeLimit => ({
  s: prepareS + (order === "best" ? SLOWEST_SEARCH * orderS : 0),
  error: new PlotwrightError(
    "too-large",
    `This drawing takes too long to prepare: more than ${prepareS} s. Simplify it, plot it in parts, or hide and fill less.`,
  ),
});

export const planLimit = ({ planS }: PlanningLimits): TimeLimit => ({
  s: planS,
  error: new PlotwrightError(
    "too-large",
    `This drawing takes too long to plan: more than ${planS} s. Simplify it, or plot it in parts.`,
  ),
});
