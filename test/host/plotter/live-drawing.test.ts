/** What a live drawing puts on the paper, on a board whose time passes only when the test lets it. */
import fc from "fast-check";
import { describe, expect, it } from "vitest";
import { openOwnPlotter } from "../../../host/handle/own-plotter.js";
import type { LiveDrawing, LiveOptions } from "../../../host/handle/plotter-handle.js";
import { livePlanner, LiveStrokes } from "../../../host/plotter/live-strokes.js";
import type { JournalEntry } from "../../../host/plotter/plotter-port.js";
import { DEFAULT_PLOT_SETTINGS, type GivenSettings } from "../../../src/schema/index.js";
import { DEFAULT_MOTION, machineById, strokesOf, VirtualBoard, type Line } from "../../../src/index.js";
import { maxOffDrawingMm } from "../../../src/internal.js";
import { ManualClock } from "../../support/clocks/manual-clock.js";
import { compareDrawn } from "../../support/drawings/drawn-truth.js";
import { inQuality, SPRINGS, swinging } from "../../support/machines/swinging.js";
import { GRBL } from "../../support/machines/machine.js";
import { newPlotter, SETTINGS } from "../../support/plots/grbl-plotter.js";
import { outcome, virtualPlotter } from "../../support/plots/virtual-plotter.js";
import { cases, IS_FULL } from "../../support/runs/full-run.js";

/** Drawing speed, mm/s. */
const SPEED = 40;

async function onBoard({
  firmware = "2.8.1",
  ...settings
}: GivenSettings & { readonly firmware?: string } = {}) {
  const world = new ManualClock();
  const board = new VirtualBoard({ clock: world, firmware });
  const devices = { find: () => Promise.resolve([]), open: () => Promise.resolve(board.transport()) };
  const plotter = await world.run(openOwnPlotter({ device: "port" }, settings, { clock: world, devices }));
  return { world, board, plotter };
}

type OnBoard = Awaited<ReturnType<typeof onBoard>>;

/** A wavy line to the right, with a point every `stepMm`. */
const wave = (yMm: number, lengthMm = 100, stepMm = 0.5): Line =>
  Array.from({ length: Math.round(lengthMm / stepMm) + 1 }, (_, i) => {
    const mm = i * stepMm;
    return [20 + mm, yMm + 4 * Math.sin(mm / 4)] as const;
  });

async function drawLive(
  settings: Parameters<typeof onBoard>[0],
  options: LiveOptions,
  use: (live: LiveDrawing, on: OnBoard) => Promise<void>,
) {
  const on = await onBoard(settings);
  const live = await on.world.run(on.plotter.live(options));
  await use(live, on);
  await on.world.run(live.end());
  const { board } = on;
  expect(board.state()).toMatchObject({ steps1: 0, steps2: 0 });
  return { ...board.statistics(), drawn: board.drawn() };
}

/** Everything is drawn, once, on the line. */
function mustBe(lines: readonly Line[], drawn: ReturnType<VirtualBoard["drawn"]>, besideMm: number): void {
  const { gapMm, overlapMm, awayMm } = compareDrawn(strokesOf(lines), drawn);
  expect(Math.max(gapMm, overlapMm)).toBeLessThan(0.06);
  expect(awayMm).toBeLessThan(besideMm);
}

const BESIDE_MM = maxOffDrawingMm(DEFAULT_MOTION, machineById("axidraw-v3")) + 0.05;

const SHAPED_MACHINE = { ...swinging(SPRINGS[0]), id: "swings", name: "Swings" };
/** Settings of all kinds of motion, and of boards. */
const KINDS: readonly (readonly [name: string, settings: Parameters<typeof onBoard>[0]])[] = [
  ["blend", {}],
  ["junction", { motion: { mode: "junction" } }],
  ["scurve", { motion: { mode: "scurve" } }],
  ["eased", { motion: { ease: { lengthMm: 2, speedMmPerS: 10 } } }],
  ["landing pens", { pen: { overlap: "fast" }, firmware: "3.0.3" }],
  ["waiting pens", { pen: { overlap: "off" } }],
  ["firmware 3", { firmware: "3.0.3" }],
  ["firmware 2.6", { firmware: "2.6.0" }],
  ["firmware 2.4", { firmware: "2.4.0" }],
  ["shaped", { customMachine: SHAPED_MACHINE, motion: inQuality("fast", SPRINGS[0]) }],
];

describe("a live drawing", () => {
  it.each(KINDS)(
    "has the steps of the whole when its strokes come one by one, each before the one before is drawn: %s",
    async (_name, settings) => {
      const lines = [
        wave(20, 40),
        wave(40, 30),
        wave(42, 20),
        wave(60, 50),
        wave(10, 30),
        wave(80, 3),
        wave(90, 40),
      ];
      const { world, board, plotter } = await onBoard(settings);
      // In this order, as they are.
      const prepare = { order: "none", joinMm: 0, simplifyMm: 0 } as const;
      await world.run(plotter.plot(lines, { speed: SPEED, prepare }));
      const whole = { ...board.statistics(), drawn: board.drawn() };
      const inChunks = await drawLive(settings, { speed: SPEED }, async (live, { world }) => {
        for (const [i, line] of lines.entries()) {
          await live.stroke(line);
          if (i > 0) await world.advance(0.45);
        }
      });
      expect(inChunks.drawn).toEqual(whole.drawn);
      expect(inChunks.movingS).toBeCloseTo(whole.movingS, 3);
      expect(inChunks.underrunCount).toBe(0);
      expect(inChunks.busyS).toBeCloseTo(whole.busyS, 3);
    },
    60_000,
  );

  it.each(
    IS_FULL ? KINDS : KINDS.filter(([name]) => ["blend", "scurve", "landing pens", "shaped"].includes(name)),
  )(
    "never stops the pen on a stroke that grows at drawing speed, half a second ahead: %s",
    async (_name, settings) => {
      const line = wave(30, 200, 0.25);
      const ahead = Math.round((0.5 * SPEED) / 0.25);
      const options = { speed: SPEED };
      const whole = await drawLive(settings, options, async (live) => {
        for (const [x, y] of line) await live.lineTo(x, y);
      });
      const growing = await drawLive(settings, options, async (live, { world, board }) => {
        for (const [x, y] of line.slice(0, ahead)) await live.lineTo(x, y);
        for (const [x, y] of line.slice(ahead)) {
          // The pen never comes nearer than 20 mm to the last point.
          while (x - board.state().xMm > 0.5 * SPEED + 0.25) await world.advance(0.01);
          await live.lineTo(x, y);
        }
      });
      mustBe([line], growing.drawn, BESIDE_MM + 0.3);
      expect(growing.movingS / whole.movingS - 1).toBeLessThan(0.002);
      expect(growing).toMatchObject({ penMoveCount: 2, underrunCount: 0 });
    },
    60_000,
  );

  it("draws every point once, however late the points come", async () => {
    const timed = fc.record({
      points: fc.integer({ min: 1, max: 40 }),
      eachS: fc.constantFrom(0, 0, 0.01, 0.02, 0.2),
      delayS: fc.oneof(fc.constant(0), fc.double({ min: 0, max: 1.5, noNaN: true })),
      isWhole: fc.boolean(),
      lifts: fc.boolean(),
    });
    const kind = fc.constantFrom(...KINDS);
    await fc.assert(
      fc.asyncProperty(
        kind,
        fc.array(timed, { minLength: 1, maxLength: 12 }),
        async ([, settings], steps) => {
          const lines: [number, number][][] = [];
          let rest: (readonly [number, number])[] = [];
          const { drawn } = await drawLive(settings, { speed: SPEED }, async (live, { world }) => {
            let isOpen = false;
            for (const { points, eachS, delayS, isWhole, lifts } of steps) {
              if (!isOpen) rest = [...wave(10 + 14 * lines.length, 200, 1)];
              const own = rest
                .splice(0, isOpen ? points : points + 1)
                .map(([x, y]): [number, number] => [x, y]);
              if (isWhole && !isOpen && own.length > 1) {
                lines.push(own);
                await live.stroke(own);
              } else {
                if (!isOpen) lines.push([]);
                lines.at(-1)!.push(...own);
                for (const [x, y] of own) {
                  await live.lineTo(x, y);
                  await world.advance(eachS);
                }
                isOpen = true;
              }
              await world.advance(delayS);
              if (!lifts) continue;
              live.penUp();
              isOpen = false;
            }
          });
          mustBe(lines, drawn, BESIDE_MM + 0.3);
        },
      ),
      { numRuns: cases(200, 8) },
    );
  }, 300_000);

  it("goes on within one long stroke of dense points as if it had been planned as a whole", async () => {
    const line = wave(30, 150, 0.01);
    const whole = await onBoard();
    await whole.world.run(whole.plotter.plot([line], { speed: SPEED }));
    const { drawn, movingS } = await drawLive({}, { speed: SPEED }, async (live, { world, board }) => {
      for (const [x, y] of line) {
        await live.lineTo(x, y);
        while (x - board.state().xMm > 30) await world.advance(0.05);
      }
    });
    mustBe([line], drawn, BESIDE_MM);
    expect(movingS / whole.board.statistics().movingS - 1).toBeLessThan(0.005);
  }, 60_000);

  it("rests on the line when points are late, lifts the pen after a while, and lowers it on the same point", async () => {
    const line = wave(30, 60);
    const { drawn, penMoveCount } = await drawLive({}, { speed: SPEED }, async (live, { world, plotter }) => {
      for (const [x, y] of line.slice(0, 40)) await live.lineTo(x, y);
      await world.run(live.idle());
      await world.advance(0.25);
      expect(plotter.state.penUp).toBe(false);
      for (const [x, y] of line.slice(40, 80)) await live.lineTo(x, y);
      await world.run(live.idle());
      await world.advance(0.29);
      expect(plotter.state.penUp).toBe(false);
      await world.advance(0.3);
      expect(plotter.state).toMatchObject({ penUp: true, activity: "plotting" });
      for (const [x, y] of line.slice(80)) await live.lineTo(x, y);
    });
    expect(penMoveCount).toBe(4);
    mustBe([line], drawn, BESIDE_MM);
  });

  it("lifts the pen at once when a stroke is complete, and waits above its end", async () => {
    await drawLive({}, {}, async (live, { world, plotter, board }) => {
      for (const [x, y] of wave(30, 20)) await live.lineTo(x, y);
      await world.run(live.idle());
      live.penUp();
      await world.advance(0.2);
      expect(plotter.state.penUp).toBe(true);
      await world.advance(60);
      expect(board.state().xMm).toBeCloseTo(40, 1);
    });
  });

  it("can be paused and resumed anywhere, and draws what comes meanwhile", async () => {
    const times = fc.array(
      fc.record({ afterS: fc.double({ min: 0, max: 1.5, noNaN: true }), points: fc.nat(60) }),
      {
        minLength: 1,
        maxLength: 6,
      },
    );
    await fc.assert(
      fc.asyncProperty(fc.constantFrom(...KINDS), times, async ([, settings], pauses) => {
        const line = wave(30, 150);
        const { drawn } = await drawLive(settings, { speed: SPEED }, async (live, { world, plotter }) => {
          let sent = 0;
          const send = async (count: number): Promise<void> => {
            for (const [x, y] of line.slice(sent, sent + count)) await live.lineTo(x, y);
            sent += count;
          };
          await send(60);
          for (const { afterS, points } of pauses) {
            await world.advance(afterS);
            await world.run(plotter.pause());
            expect(plotter.state).toMatchObject({ activity: "held", penUp: true });
            await send(points);
            await world.advance(0.5);
            expect(plotter.state).toMatchObject({ activity: "held", penUp: true });
            await world.run(plotter.resume());
            await send(points);
          }
          await send(line.length);
        });
        mustBe([line], drawn, BESIDE_MM + 0.3);
      }),
      { numRuns: cases(100, 6) },
    );
  }, 300_000);

  it("ends when it is stopped: the pen lifts, the carriage goes home, and all methods reject with the reason", async () => {
    const { world, plotter, board } = await onBoard();
    const live = await world.run(plotter.live());
    for (const [x, y] of wave(30)) await live.lineTo(x, y);
    const idle = live.idle().catch((error: unknown) => error);
    await world.advance(2);
    await world.run(plotter.stop());
    expect(board.state()).toMatchObject({ steps1: 0, steps2: 0, penUp: true });
    expect(await idle).toMatchObject({ code: "cancelled" });
    await expect(live.lineTo(1, 1)).rejects.toMatchObject({ code: "cancelled" });
    await expect(live.end()).rejects.toMatchObject({ code: "cancelled" });
    await world.run(plotter.plot([wave(30, 10)]));
  });

  it("ends with the board's error when it is unplugged, also while the pen rests", async () => {
    for (const waitS of [1.5, 10]) {
      const { world, plotter, board } = await onBoard();
      const live = await world.run(plotter.live({ liftAfterMs: 60_000 }));
      for (const [x, y] of wave(30, 50)) await live.lineTo(x, y);
      await world.advance(waitS);
      board.unplug();
      await expect(world.run(live.end())).rejects.toMatchObject({ code: "disconnected" });
    }
  });

  it("takes no more points than it can hold until some are drawn", async () => {
    const { world, plotter } = await onBoard();
    const live = await world.run(plotter.live());
    let hasRoom = false;
    for (let i = 0; i < 25_000; i++) {
      const added = live.lineTo(20 + i / 500, 20);
      if (i === 24_999)
        added.then(
          () => (hasRoom = true),
          () => undefined,
        );
    }
    await world.advance(1);
    expect(hasRoom).toBe(false);
    await world.advance(0.5);
    expect(hasRoom).toBe(true);
    await world.run(plotter.stop());
  });

  it("refuses what it can't draw, and draws on", async () => {
    const line = wave(30, 20);
    const { drawn } = await drawLive({}, {}, async (live, { plotter }) => {
      await expect(live.lineTo(-5, 10)).rejects.toMatchObject({ code: "out-of-bounds" });
      await expect(
        live.stroke([
          [10, 10],
          [10, 1_000],
        ]),
      ).rejects.toMatchObject({ code: "out-of-bounds" });
      await expect(live.stroke([])).rejects.toThrow(TypeError);
      for (const wrong of [
        [
          [1, 2, 3],
          [4, 5, 6],
        ],
        [[1, 2, 3, 4]],
        [10, 10, 20, 20],
        [[1, 2], , [3, 4]],
        "1 2",
      ]) {
        await expect(live.stroke(wrong as unknown as Line)).rejects.toThrow(TypeError);
      }
      await expect(live.lineTo(NaN, 1)).rejects.toThrow(RangeError);
      await expect(plotter.plot([line])).rejects.toMatchObject({ code: "busy" });
      await live.stroke(Float64Array.from(line.flat()));
    });
    mustBe([line], drawn, BESIDE_MM);
  });

  it("is not possible on a Grbl yet, and says so", async () => {
    const source = new LiveStrokes(GRBL);
    const { world, driver } = await newPlotter();
    expect(await world.run(outcome(driver.plot(livePlanner(source), SETTINGS, { live: source })))).toMatch(
      /bad-setting: .* can't draw live yet/,
    );
  });

  it("goes home at once if it ends without a stroke", async () => {
    const { penMoveCount, drawn } = await drawLive({}, {}, () => Promise.resolve());
    expect([penMoveCount, drawn.filter(({ penDown }) => penDown)]).toEqual([0, []]);
  });

  it("forgets what is drawn, and draws on where it was", async () => {
    const part = fc.record({
      points: fc.integer({ min: 1, max: 60 }),
      waitS: fc.constantFrom(0, 0.3, 1),
      lifts: fc.boolean(),
    });
    await fc.assert(
      fc.asyncProperty(fc.array(part, { minLength: 3, maxLength: 12 }), async (parts) => {
        const { world, driver, board } = await virtualPlotter();
        const source = new LiveStrokes(machineById("axidraw-v3"), 300, 20);
        const places: number[] = [];
        const journal = { record: ({ place }: JournalEntry) => void places.push(place.stroke) };
        const run = await world.run(
          driver.plot(livePlanner(source), DEFAULT_PLOT_SETTINGS, { live: source, journal }),
        );
        const lines: [number, number][][] = [];
        let rest: (readonly [number, number])[] = [];
        for (const { points, waitS, lifts } of parts) {
          if (!source.isOpen) {
            rest = [...wave(10 + 14 * lines.length, 250)];
            lines.push([]);
          }
          for (const [x, y] of rest.splice(0, points + 1)) {
            source.lineTo(x, y);
            lines.at(-1)!.push([x, y]);
          }
          await world.advance(waitS);
          if (lifts) source.penUp();
        }
        source.end();
        await world.run(run.finished);
        mustBe(lines, board.drawn(), BESIDE_MM);
        expect(places).toEqual([...places].sort((a, b) => a - b));
        expect(places.at(-1)).toBeGreaterThanOrEqual(lines.length - 1);
        if (parts.reduce((sum, { points }) => sum + points + 1, 0) > 300)
          expect(source.pointCount).toBeLessThan(300);
      }),
      { numRuns: cases(150, 6) },
    );
  }, 300_000);

  it("goes on after emergency stops and changes of the speed as any plot does", async () => {
    const act = fc.record({
      afterS: fc.double({ min: 0, max: 1.2, noNaN: true }),
      what: fc.constantFrom("stop", "slower", "faster"),
      points: fc.nat(60),
    });
    await fc.assert(
      fc.asyncProperty(fc.array(act, { minLength: 1, maxLength: 5 }), async (acts) => {
        const { world, driver, board } = await virtualPlotter();
        const source = new LiveStrokes(machineById("axidraw-v3"));
        const run = await world.run(
          driver.plot(livePlanner(source), DEFAULT_PLOT_SETTINGS, { live: source }),
        );
        const line = wave(30, 160);
        let sent = 0;
        const send = (count: number): void => {
          for (const [x, y] of line.slice(sent, sent + count)) source.lineTo(x, y);
          sent += count;
        };
        send(80);
        for (const { afterS, what, points } of acts) {
          await world.advance(afterS);
          if (what === "stop") {
            await world.run(run.emergencyStop());
            expect(driver.state.penUp).toBe(true);
            send(points);
            await world.run(run.resume());
          } else {
            const changed = run.change({ speedPct: what === "slower" ? 50 : 150 });
            send(points);
            await world.run(changed);
          }
        }
        send(line.length);
        source.end();
        await world.run(run.finished);
        const { gapMm, overlapMm, awayMm } = compareDrawn(strokesOf([line]), board.drawn());
        expect(Math.max(gapMm, overlapMm)).toBeLessThan(0.3);
        expect(awayMm).toBeLessThan(BESIDE_MM);
      }),
      { numRuns: cases(100, 6) },
    );
  }, 300_000);
});
