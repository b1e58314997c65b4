/** Closing a plotter: in the middle of an action, with its board lost, or with two requests at once. */
import { describe, expect, it } from "vitest";
import { NodePlotter } from "../../../support/plots/node-plotter.js";
import type { JournalEntry } from "../../../../host/plotter/plotter-port.js";
import { DRAWING, expectDrawn, plotting, settingsOf } from "../../../support/plots/live-plot.js";
import { LocalPlanner } from "../../../support/plots/local-planner.js";
import { ManualClock } from "../../../support/clocks/manual-clock.js";
import { outcome, virtualPlotter } from "../../../support/plots/virtual-plotter.js";

async function idle() {
  return virtualPlotter();
}

/** A plot with its journal. */
async function recorded() {
  const { world, driver, board } = await idle();
  const journal: JournalEntry[] = [];
  const record = (entry: JournalEntry): void => void journal.push(entry);
  const settings = settingsOf("scurve");
  const run = await world.run(driver.plot(new LocalPlanner(DRAWING), settings, { journal: { record } }));
  return { world, driver, board, run, journal };
}

describe("a plotter that is closed", () => {
  it.each([0.4, 1.9, 3.3, 5.2, 9.7])(
    "lifts the pen and leaves no timer if it is closed in the middle of a plot, after %s s",
    async (s) => {
      const { world, driver, board, run } = await plotting("scurve");
      await world.advance(s);
      const ended = outcome(run.finished);
      await world.run(driver.close());
      expect(await ended).toMatch(/^disconnected/);
      expect(board.state()).toMatchObject({ penUp: true, isBusy: false });
      expect(world.timerCount).toBe(0);
    },
  );

  it("lifts the pen and leaves no timer if it is closed in the middle of a move by hand", async () => {
    const { world, driver, board } = await idle();
    const drawn = outcome(driver.drawTestPatch());
    while (board.state().penUp) await world.advance(0.1);
    await world.run(driver.close());
    await drawn;
    expect(board.state()).toMatchObject({ penUp: true, isBusy: false });
    expect(world.timerCount).toBe(0);
  });

  it("starts nothing from the first instant on, and is not idle again when its move has ended", async () => {
    const { world, driver } = await idle();
    const moved = outcome(driver.moveTo(100, 100));
    await world.advance(0.5);
    const closing = driver.close();
    expect(driver.state).toMatchObject({ connection: "absent", message: null });
    expect(await outcome(world.run(driver.moveTo(10, 10)))).toMatch(/^disconnected/);
    await world.run(closing);
    await moved;
    expect(driver.state.connection).toBe("absent");
  });

  it("does not become idle if it is closed while it connects", async () => {
    const world = new ManualClock();
    const driver = new NodePlotter({ device: "virtual", clock: world });
    const states: string[] = [];
    const started = driver.start();
    // The board has answered, and is being taken over.
    while (driver.log() === "") await world.advance(0.001);
    driver.onChange(({ connection }) => states.push(connection));
    const closing = driver.close();
    await world.advance(1);
    await Promise.all([started, closing]);
    expect(states).toEqual(["absent"]);
    expect(world.timerCount).toBe(0);
  });

  it("does not go home any more, even if that was requested while the pen is lifted", async () => {
    const { world, driver, board, run } = await plotting("junction", DRAWING, "3.0.3");
    await world.advance(3);
    const stopped = outcome(run.emergencyStop());
    await world.advance(0.1);
    expect(driver.state.activity).toBe("plotting");
    const requested = [outcome(run.cancel()), outcome(run.finished), stopped];
    const { xMm, yMm } = board.state();
    await world.run(driver.close());
    await world.advance(2);
    expect(board.state()).toMatchObject({ xMm, yMm, penUp: true });
    await Promise.all(requested);
  });

  it("ends a held plot when it is closed", async () => {
    const { world, driver, run } = await plotting("junction");
    await world.advance(2);
    await world.run(run.pause());
    const ended = outcome(run.finished);
    await world.run(driver.close());
    expect(await ended).toMatch(/^disconnected/);
    expect(world.timerCount).toBe(0);
  });

  it("stops searching for a lost board when it is closed", async () => {
    const { world, driver, board } = await idle();
    const moved = outcome(driver.moveTo(100, 100));
    await world.advance(0.5);
    board.unplug();
    expect(await world.run(moved)).toMatch(/^disconnected/);
    await world.run(driver.close());
    expect(world.timerCount).toBe(0);
  });
});

describe("a plot that is interrupted", () => {
  it.each([0, 0.4, 1.9, 3.3, 5.2, 9.7])(
    "lifts its pen, stays where it was interrupted after %s s, and is resumed from there",
    async (afterS) => {
      const { world, driver, board, run, journal } = await recorded();
      await world.advance(afterS);
      await world.run(run.interrupt());
      expect(await world.run(run.finished)).toEqual({ kind: "cancelled" });
      expect(board.state()).toMatchObject({ penUp: true, isBusy: false });
      const { xMm, yMm } = board.state();
      const { place: from, received } = journal.at(-1) ?? { place: null, received: undefined };
      expect(received).toBeUndefined();
      const begun = board.drawn().length;
      await world.advance(5);
      expect([board.drawn().length, board.state()]).toEqual([begun, expect.objectContaining({ xMm, yMm })]);
      const resumed = await world.run(
        driver.plot(new LocalPlanner(DRAWING), settingsOf("scurve"), { from, held: false }),
      );
      expect(await world.run(resumed.finished)).toEqual({ kind: "done" });
      expectDrawn(board, DRAWING, 0.05);
    },
  );

  it("does not wait for the plan of its next part when it is interrupted", async () => {
    const { world, driver, board, run, journal } = await recorded();
    await world.advance(3);
    await world.run(run.pause());
    const { place } = journal.at(-1)!;
    const endless = new LocalPlanner(DRAWING);
    endless.plan = () => new Promise(() => undefined);
    await world.run(run.interrupt());
    const next = await world.run(
      driver.plot(endless, settingsOf("scurve"), {
        from: place,
        held: false,
        journal: { record: (entry) => journal.push(entry) },
      }),
    );
    await world.advance(2);
    await world.run(next.interrupt());
    expect(await world.run(next.finished)).toEqual({ kind: "cancelled" });
    expect(journal.at(-1)).toMatchObject({ place, received: undefined });
    expect(board.state()).toMatchObject({ penUp: true, isBusy: false });
  });

  it("goes home if it was being cancelled", async () => {
    const { world, board, run } = await recorded();
    await world.advance(3);
    const cancelled = run.cancel();
    await world.run(run.interrupt());
    await world.run(cancelled);
    expect(board.state()).toMatchObject({ steps1: 0, steps2: 0, penUp: true });
  });
});

describe("a board that is lost while the plot is held", () => {
  it("ends the plot at once, so that it can be resumed when the board is back", async () => {
    const { world, board, run } = await plotting("junction");
    await world.advance(2);
    await world.run(run.pause());
    board.unplug();
    expect(await world.run(outcome(run.finished), 0.1)).toMatch(/^disconnected/);
  });
});

describe("two requests at once", () => {
  it("are not both started: the second is refused", async () => {
    const { world, driver, board } = await idle();
    const [first, second] = [outcome(driver.moveTo(30, 0)), outcome(driver.moveTo(0, 30))];
    expect(await world.run(second)).toMatch(/^busy/);
    await world.run(first);
    expect(board.state()).toMatchObject({ xMm: 30, yMm: 0 });
  });

  it("the view of the hold point ends before the plot resumes", async () => {
    const { world, board, run } = await plotting("junction");
    await world.advance(5);
    await world.run(run.pause());
    run.moveHoldPlace({ mm: -20 });
    const looked = Promise.all([run.checkHoldPlace(), run.checkHoldPlace()]);
    await world.advance(0.2);
    await world.run(run.resume());
    await looked;
    expect(await world.run(run.finished)).toEqual({ kind: "done" });
    expect(board.state()).toMatchObject({ steps1: 0, steps2: 0, penUp: true });
    expectDrawn(board, DRAWING, 0.05);
  });

  it("an emergency stop during a view of the hold point also ends the views that wait for it", async () => {
    const { world, driver, board, run } = await plotting("junction", DRAWING, "3.0.3");
    await world.advance(5);
    await world.run(run.pause());
    run.moveHoldPlace({ mm: -20 });
    const looked = [outcome(run.checkHoldPlace()), outcome(run.checkHoldPlace())];
    await world.advance(0.2);
    await world.run(run.emergencyStop());
    expect(await world.run(Promise.all(looked))).toEqual([
      "conflict: The move was stopped at once.",
      "conflict: The move was stopped at once.",
    ]);
    const { steps1, steps2 } = board.state();
    await world.advance(5);
    expect(board.state()).toMatchObject({ steps1, steps2, isBusy: false });
    expect(driver.state.activity).toBe("held");
    await world.run(run.checkHoldPlace());
    expect(board.state()).not.toMatchObject({ steps1, steps2 });
    await world.run(run.resume());
    expect(await world.run(run.finished)).toEqual({ kind: "done" });
    expectDrawn(board, DRAWING, 0.05);
  });

  it("a stop at once also holds on the way home, and the position is still known", async () => {
    const { world, driver, board, run } = await plotting("junction", DRAWING, "3.0.3");
    await world.advance(5);
    const cancelled = run.cancel();
    while (!board.state().penUp || !board.state().isBusy) await world.advance(0.05);
    await world.advance(0.4);
    await world.run(run.emergencyStop());
    expect(await world.run(run.finished)).toEqual({ kind: "cancelled" });
    await cancelled;
    const { xMm } = board.state();
    expect(xMm).toBeGreaterThan(1);
    await world.advance(1);
    expect(board.state()).toMatchObject({ xMm, isBusy: false });
    await world.run(driver.home());
    expect(board.state()).toMatchObject({ steps1: 0, steps2: 0 });
  });
});
