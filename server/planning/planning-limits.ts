/**
 * Limits of time and memory for each step of planning. On a desktop computer a 25 MB file is read in 2 s, and
 * a million segments are planned in the same time. The limits leave room for far larger drawings on a small
 * computer, and end work that would never finish. Server and command line have the same ones, so that a drawing
 * is planned by both or by neither.
 */
import { totalmem } from "node:os";
import { PlotwrightError, type Drawing, type PrepareSettings } from "../../src/index.js";
import type { TimeLimit } from "./bounded-thread.js";

export interface PlanningLimits {
  readonly importS: number;
  /** Excluding the time that the user allows for the search for a stroke order. */
  readonly prepareS: number;
  /** Planning and compiling. */
  readonly planS: number;
  /** Limit of the JavaScript heap, which does not include typed arrays. */
  readonly heapMb: number;
  /** How much the whole process may grow. The typed arrays of a single thread can't be measured. */
  readonly growthMb: number;
}

/** Node reserves no more for a thread on any computer. */
const MAX_HEAP_MB = 4_096;

export const PLANNING_LIMITS: PlanningLimits = {
  importS: 120,
  prepareS: 300,
  planS: 300,
  // Only a part of a small computer's memory: the thread must be ended before the system ends the server.
  heapMb: Math.round(Math.min(MAX_HEAP_MB, Math.max(256, totalmem() / 4e6))),
  growthMb: totalmem() / 2e6,
};

/** For the plot that is on the plotter: it must not fail because others use memory. */
export const OWN_PLANNING_LIMITS: PlanningLimits = { ...PLANNING_LIMITS, growthMb: Infinity };

/**
 * The search is limited by work, not by time: a small computer takes up to this many times longer than a
 * desktop.
 */
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

/**
 * How much the process grows at least for each point, from reading to commands. Measured with files of 25 MB: docs/import.md
 * has the figures.
 */
const BYTES_PER_POINT = 450;

/** Throws "too-large" once the drawing is read, if planning it would run out of memory after a long time. */
export function mustFitMemory({ paths }: Drawing, growthMb: number): void {
  const points = paths.coords.length / 2;
  const neededMb = (points * BYTES_PER_POINT) / 1e6;
  if (neededMb <= growthMb) return;
  throw new PlotwrightError(
    "too-large",
    `This drawing has ${(points / 1e6).toFixed(1)} million points. Planning them needs at least ${Math.ceil(neededMb)} MB of memory, and this computer can give ${Math.floor(growthMb)} MB. Simplify the drawing so that it has fewer points, or plot it in parts.`,
  );
}
