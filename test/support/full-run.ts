/**
 * How much the tests do: `npm test` does a part that takes minutes; PLOTWRIGHT_FULL=1, which `npm run test:full`
 * sets, does all of it. Only counts differ: every test runs either way.
 */
export const IS_FULL = process.env["PLOTWRIGHT_FULL"] === "1";

/** How many cases a property is tried with: `full` in the full run, otherwise at most `short`. */
export const cases = (full = 1_000, short = 150): number => (IS_FULL ? full : Math.min(full, short));

/** The same for a loop whose count can be set on its own by the environment variable `name`. */
export const countFor = (name: string, full: number, short: number): number =>
  Number(process.env[name] ?? cases(full, short));
