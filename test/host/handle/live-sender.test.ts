/** The sender of a live drawing, when the plotter no longer answers it. */
import { describe, expect, it } from "vitest";
import { LiveSender } from "../../../host/handle/live-sender.js";
import { PlotwrightError } from "../../../src/index.js";
import type { LiveMessage, LiveReport } from "../../../src/schema/index.js";
import { makeJob } from "../../support/jobs/jobs-on-page.js";

/** A plotter that has begun, and answers nothing but what a test says. */
async function begun() {
  const got: LiveMessage[] = [];
  let report: (one: LiveReport) => void = () => undefined;
  let lose: (error: PlotwrightError) => void = () => undefined;
  const sender = await LiveSender.begin(
    (to, lost) => {
      report = to;
      lose = lost;
      const send = (message: LiveMessage): void => {
        got.push(message);
        if ("begin" in message) to({ type: "begun", job: makeJob("live"), room: 100 });
      };
      return Promise.resolve({ send, close: () => undefined });
    },
    { name: "Dance" },
  );
  return { sender, got, report, lose };
}

const failed = (promise: Promise<unknown>): Promise<unknown> => promise.catch((error: unknown) => error);

describe("the sender of a live drawing", () => {
  it("answers an undo with the reason if the connection is lost, or the drawing ends, before the plotter has answered", async () => {
    const ways: readonly ((to: Awaited<ReturnType<typeof begun>>) => void)[] = [
      ({ lose }) => lose(new PlotwrightError("disconnected", "gone")),
      ({ report }) => report({ type: "error", code: "busy", message: "gone" }),
      ({ report }) => report({ type: "ended", job: makeJob("live", { state: "cancelled" }) }),
      ({ report }) => report({ type: "ended", job: makeJob("live", { state: "done" }) }),
    ];
    const codes = ["disconnected", "busy", "cancelled", "conflict"];
    for (const [k, way] of ways.entries()) {
      const on = await begun();
      on.sender.stroke([[10, 10]]);
      const undone = failed(on.sender.undo());
      expect(on.got.at(-1)).toEqual({ undo: true });
      way(on);
      expect(await undone).toMatchObject({ code: codes[k] });
    }
  });

  it("sends nothing more after that, and keeps the first reason", async () => {
    const { sender, got, lose } = await begun();
    sender.lineTo(10, 10);
    lose(new PlotwrightError("disconnected", "gone"));
    const count = got.length;
    sender.close();
    await new Promise((resolve) => setTimeout(resolve, 5));
    expect(got.length).toBe(count);
    expect(await failed(sender.room())).toMatchObject({ message: "gone" });
    expect(() => sender.lineTo(20, 20)).toThrow("gone");
  });
});
