/** What the sender of a live drawing is told. */
import { afterEach, expect, it, vi } from "vitest";
import { LiveSession } from "../../../host/operations/live-session.js";
import { LiveStrokes } from "../../../host/plotter/live-strokes.js";
import { machineById } from "../../../src/index.js";
import { liveReportSchema, type LiveReport } from "../../../src/schema/index.js";
import { makeJob } from "../../support/jobs/jobs-on-page.js";

afterEach(() => void vi.useRealTimers());

it("stays what a sender understands when the computer's clock is set back", async () => {
  const reports: LiveReport[] = [];
  const live = {
    job: makeJob("live"),
    strokes: new LiveStrokes(machineById("axidraw-v3")),
    ended: new Promise<never>(() => undefined),
    isPaused: false,
    hold: () => undefined,
    senderLost: () => undefined,
  };
  const session = new LiveSession(
    () => Promise.resolve(live),
    (report) => reports.push(report),
  );
  session.take({ begin: {} });
  await Promise.resolve();
  session.take({ lineTo: [10, 10] });
  session.take({ penUp: true });
  session.take({ lineTo: [20, 10] });
  vi.useFakeTimers({ now: Date.now() - 3_600_000, toFake: ["Date"] });
  session.take({ undo: true });
  session.close();
  expect(reports.map(({ type }) => type)).toEqual(["begun", "undone", "progress"]);
  for (const report of reports) expect(() => liveReportSchema.parse(report)).not.toThrow();
});
