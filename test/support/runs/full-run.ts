/**
 * How much the tests do: `npm test` runs a part that takes minutes; PLOTWRIGHT_FULL=1, set by `npm run
 * test:full`, runs all of it. Counts differ, and some tests take only one of their variants in the short run.
 */
export const IS_FULL = process.env["PLOTWRIGHT_FULL"] === "1";

/** No test does more cases than this. `npm run test:mutate` sets it, because it runs each test thousands of times. */
const MOST = Number(process.env["PLOTWRIGHT_MOST_CASES"] ?? Infinity);

/** Number of cases for a property: `full` in the full run, otherwise at most `short`. */
export const cases = (full = 1_000, short = 150): number =>
  Math.min(MOST, IS_FULL ? full : Math.min(full, short));

/** The same for a loop whose count can also be set by the environment variable `name`. */
export const countFor = (name: string, full: number, short: number): number =>
  Number(process.env[name] ?? cases(full, short));
