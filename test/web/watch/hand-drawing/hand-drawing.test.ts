/** A drawing by hand: what the plotter gets of it, how far the pen may be behind, undo, and its end. */
import { describe, expect, it, vi } from "vitest";
import { importDrawing, prepare } from "../../../../src/index.js";
import { prepareSettingsOf } from "../../../../src/internal.js";
import { DEFAULT_PLOT_SETTINGS, type Job, type LiveUndone } from "../../../../src/schema/index.js";
import type { GestureTarget } from "../../../../web/preview/gestures.js";
import type { Stage } from "../../../../web/preview/stage.js";
import { screenPoint, type View } from "../../../../web/scene/view.js";
import type { Page } from "../../../../web/state/page-action.js";
import { DEFAULT_VIEW } from "../../../../web/state/persist.js";
import { createPageStore } from "../../../../web/state/store.js";
import { HandDrawing, handDrawingOf } from "../../../../web/watch/hand-drawing/hand-drawing.js";
import { sheetOf } from "../../../../web/watch/hand-drawing/hand-sheet.js";
import { makeJob, makePlotter } from "../../../support/jobs/jobs-on-page.js";

type Line = [x: number, y: number][];

/** A plotter that takes strokes, and reports what a test says. */
const fakePlotter = () => {
  const got: Line[] = [];
  let isDown = false;
  let report: (report: object) => void = () => undefined;
  let end: { resolve(job: Job): void; reject(error: Error): void };
  const undone: LiveUndone = { takenBack: 0, left: 0 };
  const seen = { ends: 0, undos: 0, undone };
  const sender = {
    job: makeJob("live", { state: "plotting" }),
    ended: new Promise<Job>((resolve, reject) => (end = { resolve, reject })),
    onReport: (listener: typeof report) => {
      report = listener;
      return () => undefined;
    },
    lineTo: (x: number, y: number) => {
      if (!isDown) got.push([]);
      isDown = true;
      got[got.length - 1].push([x, y]);
    },
    penUp: () => void (isDown = false),
    undo: () => {
      seen.undos++;
      return Promise.resolve(seen.undone);
    },
    end: () => void seen.ends++,
  };
  return {
    got,
    seen,
    sender,
    drawn: (strokeIndex: number, alongMm: number, lagS: number, state = "drawing"): void =>
      report({ type: "progress", drawnTo: { strokeIndex, alongMm }, lagMs: 1_000 * lagS, state }),
    end: (job: Job): void => end.resolve(job),
    lose: (error: Error): void => end.reject(error),
  };
};

const open = (view: View = { scale: 2, offsetX: 0, offsetY: 0 }, smoothingPct = 0) => {
  const store = createPageStore({ settings: DEFAULT_PLOT_SETTINGS, view: { ...DEFAULT_VIEW, smoothingPct } });
  const plotter = fakePlotter();
  const live = vi.fn((): Promise<unknown> => Promise.resolve(plotter.sender));
  const openDrawing = vi.fn<(name: string, text: string) => void>();
  const actions = {
    attempt: (_name: string, request: () => Promise<unknown>) => request().catch(() => null),
    openDrawing,
  };
  store.setState({
    link: "connected",
    plotters: [makePlotter("virtual")],
    plotterId: "virtual",
    handDrawing: "opening",
  });
  const page = { store, backend: { live }, actions } as unknown as Page;
  const drawing = new HandDrawing(page);
  drawing.open();
  const { draws } = sheetOf(drawing).hand({ view } as Stage, store, actions as never) as GestureTarget;
  let nowMs = 0;
  const point = (type: string, xMm: number, yMm: number): void => {
    const [x, y] = screenPoint(view, xMm, yMm);
    const event = {
      type: `pointer${type}`,
      pointerId: 1,
      pointerType: "mouse",
      button: 0,
      timeStamp: (nowMs += 8),
    };
    draws!(event as PointerEvent, () => ({ x, y }));
  };
  return {
    store,
    plotter,
    live,
    openDrawing,
    drawing,
    state: () => handDrawingOf(store.getState())!,
    stroke: (line: Line): void => {
      point("down", ...line[0]);
      for (const at of line.slice(1)) point("move", ...at);
      point("up", ...line[line.length - 1]);
    },
    point,
  };
};

const LINE: Line = [
  [20, 30],
  [40, 30],
  [40, 60],
];
const OTHER: Line = [
  [100, 100],
  [150, 100],
];
const settled = (): Promise<void> => new Promise((resolve) => setTimeout(resolve));
const close = (lines: readonly Line[]): Line[] =>
  lines.map((line) => line.map(([x, y]) => [Math.round(x * 1e6) / 1e6, Math.round(y * 1e6) / 1e6]));

describe("a drawing by hand", () => {
  it.each([0, 1, 2, 3])(
    "is where the pointer was on the paper, with the desk turned by %i quarters",
    async (turn) => {
      const { stroke, plotter } = open({ scale: 3.7, offsetX: 210, offsetY: 90, turn });
      stroke(LINE);
      await settled();
      expect(close(plotter.got)).toEqual([LINE]);
    },
  );

  it("begins with the first stroke, and loses nothing that is drawn until the plotter answers", async () => {
    const { stroke, point, plotter, live, state } = open();
    expect(live).not.toHaveBeenCalled();
    stroke(LINE);
    point("down", ...OTHER[0]);
    await settled();
    point("move", ...OTHER[1]);
    point("up", ...OTHER[1]);
    expect(live).toHaveBeenCalledOnce();
    expect(state().jobId).toBe("live");
    expect(close(plotter.got)).toEqual([LINE, OTHER]);
  });

  it("keeps what is drawn when the plotter can't begin, and the next stroke tries again with all of it", async () => {
    const { stroke, plotter, live } = open();
    live.mockRejectedValueOnce(new Error("busy"));
    stroke(LINE);
    await settled();
    expect(plotter.got).toEqual([]);
    stroke(OTHER);
    await settled();
    expect(close(plotter.got)).toEqual([LINE, OTHER]);
  });

  it("is smoothed as the page's setting says", async () => {
    const { stroke, plotter } = open(undefined, 60);
    stroke(LINE);
    await settled();
    expect(plotter.got[0].length).toBeGreaterThan(LINE.length);
    expect(close(plotter.got)[0].at(-1)).toEqual([40, 60]);
  });

  it("is split where it leaves the paper, and says so", async () => {
    const { stroke, plotter, state } = open();
    stroke([
      [10, 20],
      [-10, 20],
      [-10, 40],
      [10, 40],
    ]);
    await settled();
    expect(close(plotter.got)).toEqual([
      [
        [10, 20],
        [0, 20],
      ],
      [
        [0, 40],
        [10, 40],
      ],
    ]);
    expect(state().hasLeftPaper).toBe(true);
    stroke(LINE);
    expect(state().hasLeftPaper).toBe(false);
  });

  it("shows how far the pen is behind, and what is left to draw", async () => {
    const { stroke, plotter, state } = open();
    stroke(LINE);
    stroke(OTHER);
    await settled();
    expect(state().waitingMm).toBeCloseTo(100, 6);
    plotter.drawn(0, 15, 1.2);
    expect(state()).toMatchObject({ lagS: 1.2, isBehind: false });
    expect(state().waitingMm).toBeCloseTo(85, 6);
    plotter.drawn(2, 0, 0);
    expect(state().waitingMm).toBe(0);
  });

  it("takes no new stroke while the pen is too far behind, but the stroke that is being drawn", async () => {
    const { stroke, point, plotter, state } = open();
    stroke(LINE);
    await settled();
    point("down", ...OTHER[0]);
    plotter.drawn(0, 15, 11);
    point("move", ...OTHER[1]);
    point("up", ...OTHER[1]);
    expect(state()).toMatchObject({ isBehind: true, hasRefused: false });
    stroke(LINE);
    expect(close(plotter.got)).toEqual([LINE, OTHER]);
    expect(state().hasRefused).toBe(true);
    plotter.drawn(0, 20, 7);
    stroke(LINE);
    expect(plotter.got.length).toBe(2);
    plotter.drawn(1, 20, 4);
    expect(state()).toMatchObject({ isBehind: false, hasRefused: false });
    stroke(LINE);
    expect(close(plotter.got)).toEqual([LINE, OTHER, LINE]);
  });

  it("is taken as long as the user likes while the plot is paused", async () => {
    const { stroke, point, plotter, state } = open();
    stroke(LINE);
    await settled();
    plotter.drawn(0, 10, 60, "paused");
    expect(state()).toMatchObject({ isBehind: false, lagS: 60 });
    point("down", ...OTHER[0]);
    plotter.drawn(0, 10, 61, "paused");
    point("move", ...OTHER[1]);
    point("up", ...OTHER[1]);
    expect(close(plotter.got)).toEqual([LINE, OTHER]);
    plotter.drawn(0, 11, 62);
    expect(state().isBehind).toBe(true);
  });

  it("ends even a stroke that is being drawn before the pen is too far behind for its memory", async () => {
    const { point, plotter, state } = open();
    point("down", ...LINE[0]);
    await settled();
    point("move", ...LINE[1]);
    plotter.drawn(0, 1, 31);
    point("move", ...LINE[2]);
    point("up", ...LINE[2]);
    expect(close(plotter.got)).toEqual([LINE.slice(0, 2)]);
    expect(state()).toMatchObject({ isBehind: true, hasRefused: true });
  });
});

describe("undo of a drawing by hand", () => {
  it("takes back what the plotter could still leave out, on the page too", async () => {
    const { stroke, plotter, drawing, state } = open();
    stroke(LINE);
    stroke(OTHER);
    await settled();
    plotter.drawn(0, 5, 1);
    plotter.seen.undone = { takenBack: 2, left: 0 };
    await drawing.undo();
    expect(plotter.seen.undos).toBe(1);
    expect(state().waitingMm).toBeCloseTo(45, 6);
    // Of a stroke that is half drawn, the rest.
    plotter.drawn(0, 10, 1);
    plotter.seen.undone = { takenBack: 1, left: 2 };
    await drawing.undo();
    expect(state().waitingMm).toBeCloseTo(10, 6);
    plotter.drawn(1, 0, 0);
    expect(state().canUndo).toBe(false);
    await drawing.undo();
    expect(plotter.seen.undos).toBe(2);
  });

  it("ends the stroke under the pointer, and what is drawn meanwhile comes after it", async () => {
    const { stroke, point, plotter, drawing } = open();
    stroke(LINE);
    await settled();
    point("down", ...OTHER[0]);
    point("move", ...OTHER[1]);
    plotter.seen.undone = { takenBack: 2, left: 0 };
    const undone = drawing.undo();
    point("up", ...OTHER[1]);
    stroke(LINE);
    expect(plotter.got.length).toBe(2);
    await undone;
    expect(close(plotter.got)).toEqual([LINE, OTHER, LINE]);
    expect(drawing.strokes.count).toBe(2);
  });

  it("loses nothing that is drawn before it is answered, if the drawing has ended meanwhile", async () => {
    const { stroke, plotter, drawing } = open();
    stroke(LINE);
    await settled();
    const ended = new Error("ended");
    plotter.sender.undo = () => Promise.reject(ended);
    plotter.sender.lineTo = () => {
      throw ended;
    };
    plotter.end(makeJob("live", { state: "cancelled" }));
    const undone = drawing.undo();
    stroke(OTHER);
    await undone;
    expect(drawing.strokes.count).toBe(2);
  });
});

describe("the end of a drawing by hand", () => {
  it("closes the mode with its job when the pen has drawn the rest, and takes no stroke until then", async () => {
    const { stroke, plotter, drawing, store, state } = open();
    stroke(LINE);
    await settled();
    drawing.finish();
    expect(plotter.seen.ends).toBe(1);
    expect(state().phase).toBe("finishing");
    stroke(OTHER);
    expect(plotter.got.length).toBe(1);
    plotter.end(makeJob("live", { state: "done" }));
    await settled();
    expect(store.getState()).toMatchObject({ handDrawing: null, watchedId: "live" });
  });

  it("ends the job even if it is finished before the plotter has answered", async () => {
    const { stroke, plotter, drawing, state } = open();
    stroke(LINE);
    drawing.finish();
    expect(state().phase).toBe("finishing");
    await settled();
    expect(close(plotter.got)).toEqual([LINE]);
    expect(plotter.seen.ends).toBe(1);
  });

  it("opens in Prepare what the plotter could not begin with", async () => {
    const { stroke, drawing, store, live, openDrawing } = open();
    live.mockRejectedValue(new Error("busy"));
    stroke(LINE);
    await settled();
    drawing.finish();
    expect(openDrawing).toHaveBeenCalledOnce();
    expect(store.getState().handDrawing).toBeNull();
  });

  it("leaves without a job if nothing was drawn", () => {
    const { drawing, store, live } = open();
    drawing.finish();
    expect(live).not.toHaveBeenCalled();
    expect(store.getState().handDrawing).toBeNull();
  });

  it.each([
    ["the connection is lost", (plotter: ReturnType<typeof fakePlotter>) => plotter.lose(new Error("Gone."))],
    [
      "the plot is interrupted",
      (plotter: ReturnType<typeof fakePlotter>) =>
        plotter.end(makeJob("live", { state: "interrupted", message: "Gone." })),
    ],
  ])("keeps the whole drawing when %s, says why, and opens it in Prepare", async (_when, fail) => {
    const { stroke, plotter, drawing, state, store, openDrawing } = open();
    stroke(LINE);
    await settled();
    fail(plotter);
    await settled();
    expect(state().phase).toBe("broken");
    expect(state().fault).toMatch(/^Gone\. .*plotted again/);
    stroke(OTHER);
    drawing.keep();
    expect(store.getState().handDrawing).toBeNull();
    const [, svg] = openDrawing.mock.calls[0];
    const { xy } = prepare(await importDrawing("", svg), prepareSettingsOf(DEFAULT_PLOT_SETTINGS)).strokes;
    expect([...xy].map(Math.round)).toEqual(LINE.flat());
  });
});
