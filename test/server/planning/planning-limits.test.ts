/** Files and settings that would keep a planner busy for hours: each ends with its own error. */
import { mkdtempSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir, totalmem } from "node:os";
import { join } from "node:path";
import { afterAll, beforeAll, describe, expect, it } from "vitest";
import { runPlanInThread } from "../../../server/cli/plan/plan-thread.js";
import { measureDrawing, openPlanner } from "../../../server/planning/planner.js";
import { PLANNING_LIMITS } from "../../../server/planning/planning-limits.js";
import { PlotwrightError } from "../../../src/index.js";
import { ERROR_TABLE, machineOf } from "../../../src/internal.js";
import { DEFAULT_PLOT_SETTINGS, type PlotSettings } from "../../../src/schema/index.js";
import { IS_FULL } from "../../support/runs/full-run.js";

const COUNT = 20_000;
const range = (count: number): number[] => Array.from({ length: count }, (_, i) => i);
/** Many rules to match against each element: reading it takes more than an hour. */
const SLOW_TO_READ = `<svg xmlns="http://www.w3.org/2000/svg" width="9" height="9"><style>${range(COUNT)
  .map((i) => `g:not(.a${i}) g:not(.b${i}) path:not(.c${i}){stroke-width:${i}}`)
  .join("")}</style>${"<g>".repeat(50)}${'<path d="M0 0h9"/>'.repeat(COUNT)}${"</g>".repeat(50)}</svg>`;
const SLOW_TO_ORDER = `<svg xmlns="http://www.w3.org/2000/svg" width="200mm" height="200mm" viewBox="0 0 200 200"><path stroke="black" fill="none" d="${range(
  COUNT,
)
  .map((i) => `M${(i * 7919) % 200} ${(i * 104_729) % 197}h.5`)
  .join("")}"/></svg>`;
const ORDERED: PlotSettings = {
  ...DEFAULT_PLOT_SETTINGS,
  prepare: { ...DEFAULT_PLOT_SETTINGS.prepare, order: "best", orderS: 3_600 },
};

let dir: string;
beforeAll(() => {
  dir = mkdtempSync(join(tmpdir(), "plotwright-limits-"));
});
afterAll(() => rmSync(dir, { recursive: true, force: true }));

function input(text: string, settings = DEFAULT_PLOT_SETTINGS): Parameters<typeof openPlanner>[0] {
  const path = join(dir, "a.svg");
  writeFileSync(path, text);
  return { path, settings, machine: machineOf(settings) };
}

async function failure(work: Promise<unknown>): Promise<PlotwrightError> {
  const error: unknown = await work.then(
    () => new Error("it came to an end"),
    (thrown: unknown) => thrown,
  );
  expect(error).toBeInstanceOf(PlotwrightError);
  return error as PlotwrightError;
}

/** As heap, or in typed arrays. */
const TOO_MUCH = ["too-large", expect.stringContaining("more memory than is available") as string];

describe("a planner", () => {
  it("cancels reading a file that takes too long", async () => {
    const limits = { ...PLANNING_LIMITS, importS: 1 };
    const { code, message } = await failure(openPlanner({ ...input(SLOW_TO_READ), limits }));
    expect(code).toBe("bad-file");
    expect(message).toMatch(/^This file takes too long to read: more than 1 s/);
  });

  it("limits the reading time separately from the time that the user allows for ordering", async () => {
    const limits = { ...PLANNING_LIMITS, importS: 1 };
    const slow = { ...input(SLOW_TO_READ, ORDERED), limits };
    expect((await failure(openPlanner(slow))).message).toMatch(/too long to read/);
  });

  it("lets ordering take as long as the user allows", async () => {
    const settings = { ...ORDERED, prepare: { ...ORDERED.prepare, orderS: 2 } };
    // Less than ordering takes: without the user's limit it would be cancelled. A busy computer needs most of it.
    const limits = { ...PLANNING_LIMITS, prepareS: 1.9 };
    const unordered = await failure(
      openPlanner({
        ...input(SLOW_TO_ORDER, { ...settings, prepare: { ...settings.prepare, orderS: 0 } }),
        limits: { ...limits, prepareS: 0 },
      }),
    );
    expect([unordered.code, unordered.message]).toEqual([
      "too-large",
      expect.stringContaining("takes too long to prepare") as string,
    ]);
    const { stats } = await measureDrawing({ ...input(SLOW_TO_ORDER, settings), limits }, null);
    expect(stats.strokeCount).toBe(COUNT);
  }, 120_000);

  it("cancels planning that takes too long", async () => {
    const limits = { ...PLANNING_LIMITS, planS: 0 };
    const error = await failure(measureDrawing({ ...input(SLOW_TO_ORDER), limits }, null));
    expect([error.code, error.message]).toEqual([
      "too-large",
      expect.stringContaining("too long to plan") as string,
    ]);
  });

  it("fails with its own error if memory would run out", async () => {
    const limits = { ...PLANNING_LIMITS, heapMb: 64 };
    const groups = `0\nSECTION\n2\nENTITIES\n0\nMTEXT\n${"3\nabc\n".repeat(2_000_000)}0\nENDSEC\n0\nEOF\n`;
    const error = await failure(openPlanner({ ...input(groups), limits }));
    expect([error.code, error.message]).toEqual(TOO_MUCH);
  });

  it("refuses a drawing with too many points as soon as it is read, on server and command line alike", async () => {
    // 2 200 000 points: at least 990 MB. The file alone needs less than 400 MB.
    const limits = { ...PLANNING_LIMITS, growthMb: 400 };
    const line = `<path stroke="black" d="M0 0${"l5 5-5-5".repeat(1_100_000)}"/>`;
    const file = input(`<svg xmlns="http://www.w3.org/2000/svg" width="90mm" height="90mm">${line}</svg>`);
    const command = { file: file.path, settings: file.settings, options: { firmware: "3.0.3", copies: 1 } };
    const words =
      /^This drawing has 2\.2 million points\. Planning them needs at least 991 MB .* can give 400 MB\. Simplify/;
    for (const work of [
      () => openPlanner({ ...file, limits }),
      () => runPlanInThread(command, { out: () => undefined, err: () => undefined }, limits),
    ]) {
      const { code, message } = await failure(work());
      expect([code, message]).toEqual(["too-large", expect.stringMatching(words)]);
    }
  }, 120_000);

  it.runIf(IS_FULL).each([
    [
      "one long line",
      () => `<path d="M100 100${"l.7135.3125.1315-.6275-.7425.2215-.1415.1275".repeat(570_000)}"/>`,
    ],
    [
      "hundreds of thousands of short lines",
      () =>
        range(690_000)
          .map((i) => `<path d="M${i % 197}.125 ${(i * 7) % 193}.375l2.125 1.375"/>`)
          .join(""),
    ],
    [
      "circles of curves in groups that are moved",
      () =>
        `<g transform="translate(5 5)">${range(252_000)
          .map(
            (i) =>
              `<g transform="translate(${i % 187} ${(i * 7) % 191})"><path d="M0 1C.55 1 1 .55 1 0S.55-1 0-1-1-.55-1 0-.55 1 0 1z"/></g>`,
          )
          .join("")}</g>`,
    ],
  ])(
    "plans a drawing of 25 MB, on server and command line alike: %s",
    async (_name, content) => {
      const text = `<svg xmlns="http://www.w3.org/2000/svg" width="200mm" height="200mm" viewBox="0 0 200 200" fill="none" stroke="black">${content()}</svg>`;
      expect(text.length).toBeGreaterThan(24_000_000);
      const file = input(text, {
        ...DEFAULT_PLOT_SETTINGS,
        prepare: { ...DEFAULT_PLOT_SETTINGS.prepare, fit: true, order: "none" },
      });
      const { stats } = await measureDrawing(file, null);
      const out: string[] = [];
      const command = {
        file: file.path,
        settings: file.settings,
        options: { firmware: "3.0.3", copies: 1, json: true },
      };
      await runPlanInThread(command, { out: (part) => void out.push(part), err: () => undefined });
      expect(JSON.parse(out.join(""))).toMatchObject({
        strokes: stats.strokeCount,
        points: stats.pointCount,
      });
    },
    900_000,
  );

  it("allows the same memory to an upload and to the command line: at least a quarter of the computer's", () => {
    const heapMb = Math.min(4_096, totalmem() / 4e6);
    expect(PLANNING_LIMITS.heapMb).toBeGreaterThanOrEqual(Math.floor(heapMb));
    expect(PLANNING_LIMITS.growthMb).toBeGreaterThanOrEqual(totalmem() / 4e6);
  });

  it("fails if the process grows too large", async () => {
    const limits = { ...PLANNING_LIMITS, growthMb: 20 };
    const error = await failure(openPlanner({ ...input(SLOW_TO_READ), limits }));
    expect([error.code, error.message]).toEqual(TOO_MUCH);
  });
});

it("the command plan cancels a file that takes too long to read, with exit code 3", async () => {
  const { path, settings } = input(SLOW_TO_READ);
  const out: string[] = [];
  const error = await failure(
    runPlanInThread(
      { file: path, settings, options: { firmware: "3.0.3", copies: 1 } },
      { out: (text) => void out.push(text), err: (text) => void out.push(text) },
      { ...PLANNING_LIMITS, importS: 1 },
    ),
  );
  expect(ERROR_TABLE[error.code].exitCode).toBe(3);
  expect(error.message).toMatch(/takes too long to read/);
  expect(out).toEqual([]);
});
