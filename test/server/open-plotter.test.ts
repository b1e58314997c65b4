/** The entry plotwright/plotter: a plotter of this program, and one of a running server, by the same calls. */
import { connect, createServer as createTcpServer, type AddressInfo, type Socket } from "node:net";
import { afterEach, beforeEach, describe, expect, it, vi } from "vitest";
import { openPlotter, type PlotterChoice, type PlotterHandle } from "../../server/plotter/open-plotter.js";
import { createServer, type PlotwrightServer } from "../../server/index.js";
import { PlotwrightError, type Line } from "../../src/index.js";
import { folderOfTest } from "../support/processes/folders.js";

const SPEED = 100;
const circle = (xMm: number, yMm: number, radiusMm = 3): Line =>
  Array.from({ length: 41 }, (_, i) => {
    const angle = (2 * Math.PI * i) / 40;
    return [xMm + radiusMm * Math.cos(angle), yMm + radiusMm * Math.sin(angle)];
  });
const ROW = Array.from({ length: 10 }, (_, i) => circle(20 + 10 * i, 40));
/** Some minutes of plotting: it never ends by itself during a test. */
const LONG: Line[] = Array.from({ length: 400 }, (_, i) => [
  [10, 10 + i / 4],
  [200, 10 + i / 4],
]);
const TWO_PENS = `<svg xmlns="http://www.w3.org/2000/svg" xmlns:inkscape="http://www.inkscape.org/namespaces/inkscape"
  width="60mm" height="60mm" viewBox="0 0 60 60" fill="none" stroke="black">
  <g inkscape:groupmode="layer" inkscape:label="One"><path d="M5 5h20"/></g>
  <g inkscape:groupmode="layer" inkscape:label="!Two"><path d="M5 15h20"/></g></svg>`;

const codeOf = (promise: Promise<unknown>): Promise<unknown> =>
  promise.then(
    () => "done",
    (error: unknown) => (error instanceof PlotwrightError ? error.code : error),
  );
const until = async (isTrue: () => boolean): Promise<void> => {
  while (!isTrue()) await new Promise((resolve) => setTimeout(resolve, 10));
};

const WAYS = [
  ["of this program", null],
  ["of a running server", "url"],
] as const;

describe.each(WAYS)("a plotter %s", (_, way) => {
  let server: PlotwrightServer | null = null;
  let choice: PlotterChoice;
  let plotter: PlotterHandle;

  beforeEach(async () => {
    if (way === "url")
      server = await createServer({
        port: 0,
        device: "virtual",
        virtualSpeed: SPEED,
        dataDir: folderOfTest(),
      });
    choice = server === null ? { virtual: { speed: SPEED } } : { url: server.url };
    plotter = await openPlotter(choice);
  });
  afterEach(async () => {
    await plotter.close();
    await server?.close();
    server = null;
  });

  it("plots lines where they are on the paper, and tells how far it is", async () => {
    const shares: number[] = [];
    const { plottedS, warnings } = await plotter.plot(ROW, {
      paper: "A5",
      speed: 40,
      onProgress: ({ progress }) => shares.push(progress),
    });
    expect(warnings).toEqual([]);
    expect(plottedS).toBeGreaterThan(0);
    expect(shares.length).toBeGreaterThan(1);
    expect(shares).toEqual([...shares].sort((a, b) => a - b));
    expect(plotter.state).toMatchObject({ plot: null, wait: null });
  });

  it("is at home with its pen up after a plot, and moves by hand", async () => {
    await plotter.moveTo(30, 20);
    expect(plotter.state).toMatchObject({ xMm: 30, yMm: 20, penUp: true });
    await plotter.pen("down");
    expect(plotter.state.penUp).toBe(false);
    await plotter.pen("up");
    expect(plotter.state.penUp).toBe(true);
    await plotter.home();
    expect(plotter.state).toMatchObject({ xMm: 0, yMm: 0, kind: "virtual" });
  });

  it("pauses with its pen up, resumes, and is stopped", async () => {
    const seen: (number | null)[] = [];
    const forget = plotter.onChange(({ plot }) => seen.push(plot && plot.progress));
    const plot = codeOf(plotter.plot(LONG));
    await until(() => (plotter.state.plot?.progress ?? 0) > 0.01);
    await plotter.pause();
    await until(() => plotter.state.activity === "held");
    expect(plotter.state.penUp).toBe(true);
    await plotter.resume();
    await until(() => plotter.state.activity === "plotting");
    await plotter.stop();
    expect(await plot).toBe("cancelled");
    expect(seen.some((progress) => progress !== null && progress > 0.01)).toBe(true);
    await until(() => plotter.state.connection === "idle");
    expect(plotter.state.plot).toBeNull();
    forget();
    const count = seen.length;
    await plotter.moveTo(10, 10);
    expect(seen.length).toBe(count);
  });

  it("is resumed right after a pause and paused right after that, waited for or not", async () => {
    const plot = codeOf(plotter.plot(LONG));
    await until(() => (plotter.state.plot?.progress ?? 0) > 0.01);
    for (let i = 0; i < 3; i++) {
      await plotter.pause();
      await plotter.resume();
    }
    await until(() => plotter.state.activity === "plotting");
    await Promise.all([plotter.pause(), plotter.resume(), plotter.pause()]);
    await until(() => plotter.state.activity === "held");
    await Promise.all([plotter.resume(), plotter.pause(), plotter.resume()]);
    await until(() => plotter.state.activity === "plotting");
    await plotter.stop();
    expect(await plot).toBe("cancelled");
  });

  it("is stopped by a signal, before and during the plot", async () => {
    expect(await codeOf(plotter.plot(ROW, { signal: AbortSignal.abort() }))).toBe("cancelled");
    const stop = new AbortController();
    const plot = codeOf(plotter.plot(LONG, { signal: stop.signal }));
    await until(() => plotter.state.plot !== null);
    stop.abort();
    expect(await plot).toBe("cancelled");
    expect(await codeOf(plotter.plot(ROW, { speed: 50 }))).toBe("done");
  });

  it("asks for the pen of the next layer, and resumes when it is there", async () => {
    const names: string[] = [];
    await plotter.plot(TWO_PENS, {
      onPenChange: async ({ layerName }) => {
        expect(plotter.state.penUp).toBe(true);
        await new Promise((resolve) => setTimeout(resolve, 5));
        names.push(layerName);
      },
    });
    expect(names).toEqual(["Two"]);
    const failing = plotter.plot(TWO_PENS, {
      onPenChange: () => Promise.reject(new Error("no such pen")),
    });
    await expect(failing).rejects.toThrow("no such pen");
  });

  it.each([
    ["a drawing that is none", "<svg><path", {}, "bad-file"],
    ["a setting that there is not", ROW, { motion: { sped: 3 } }, "bad-setting"],
    ["a paper that there is not", ROW, { paper: "A99" }, "bad-setting"],
    ["a speed that is no speed", ROW, { speed: -1 }, "bad-setting"],
    ["lines beyond the paper", [circle(600, 40)], {}, "out-of-bounds"],
    ["something else", 12, {}, "bad-file"],
  ] as const)("refuses %s before anything moves", async (_what, drawing, options, code) => {
    expect(await codeOf(plotter.plot(drawing as never, options as never))).toBe(code);
    expect(plotter.state).toMatchObject({ activity: "none", connection: "idle", plot: null });
  });

  it("has nothing to pause, resume or stop while it does not plot, and plots one drawing at a time", async () => {
    for (const ask of ["pause", "resume", "stop"] as const)
      expect(await codeOf(plotter[ask]())).toBe("conflict");
    const first = codeOf(plotter.plot(LONG));
    await until(() => plotter.state.plot !== null);
    expect(await codeOf(plotter.plot(ROW))).toBe("busy");
    await plotter.stop();
    expect(await first).toBe("cancelled");
  });

  it("is stopped and paused from the call on, before anything moves", async () => {
    const stopped = codeOf(plotter.plot(LONG));
    await Promise.all([plotter.stop(), plotter.stop()]);
    expect(await stopped).toBe("cancelled");
    expect(plotter.state.plot).toBeNull();
    const paused = codeOf(plotter.plot(LONG));
    await plotter.pause();
    await until(() => plotter.state.activity === "held");
    expect(plotter.state.plot?.progress ?? 0).toBe(0);
    await plotter.pause();
    await plotter.resume();
    await plotter.resume();
    await plotter.stop();
    expect(await paused).toBe("cancelled");
  });

  it.each([0, 20])("is stopped by a signal %i ms after the call", async (ms) => {
    const stop = new AbortController();
    const plot = codeOf(plotter.plot(LONG, { signal: stop.signal }));
    setTimeout(() => stop.abort(), ms);
    expect(await plot).toBe("cancelled");
  });

  it("takes one of two plots that are started at once", async () => {
    const codes = await Promise.all([codeOf(plotter.plot(ROW)), codeOf(plotter.plot(ROW))]);
    expect(codes).toEqual(["done", "busy"]);
  });

  it("stops the plot with the pen up, and plots again, when the program's own callback throws", async () => {
    const fault = new Error("the program's");
    const boom = (): never => {
      throw fault;
    };
    expect(await codeOf(plotter.plot(LONG, { onProgress: boom }))).toBe(fault);
    expect(await codeOf(plotter.plot(TWO_PENS, { onPenChange: boom }))).toBe(fault);
    plotter.onChange(boom);
    expect(await codeOf(plotter.plot(LONG))).toBe(fault);
    expect(await codeOf(plotter.plot(ROW))).toBe("done");
    expect(plotter.state.penUp).toBe(true);
  });

  it.each([
    ["stop", "cancelled"],
    ["resume", "done"],
  ] as const)("heeds a %s during a pen change", async (ask, code) => {
    expect(await codeOf(plotter.plot(TWO_PENS, { onPenChange: () => plotter[ask]() }))).toBe(code);
  });

  it.each([
    ["NaN", [[[10, Number.NaN]]], /Point 1 of line 1/],
    ["one line instead of a list", [[10, 10]], /Point 1 of line 1 .* Lines are \[\[\[x, y\]/],
    ["points with names", [[[1, 1]], [{ x: 1, y: 2 }]], /Point 1 of line 2/],
    ["three coordinates", [[[1, 1, 1]]], /Point 1 of line 1/],
    ["a number as a line", [7], /Line 1 is not a list of points/],
    ["no lines", [], /nothing to draw/],
  ])("refuses %s as lines, and says where", async (_what, lines, message) => {
    const error: unknown = await plotter.plot(lines as never).catch((fault: unknown) => fault);
    expect(error).toMatchObject({ code: "bad-file", message: expect.stringMatching(message) });
  });

  it("refuses heights and positions that are none", async () => {
    for (const where of ["half", Number.NaN, 101, -1])
      expect(await codeOf(plotter.pen(where as never))).toBe("bad-setting");
    expect(await codeOf(plotter.moveTo(Number.NaN, 1))).toBe("bad-setting");
    expect(await codeOf(plotter.moveTo(1, undefined as never))).toBe("bad-setting");
  });

  it("refuses everything after it was closed", async () => {
    await plotter.close();
    await plotter.close();
    for (const ask of [() => plotter.plot(ROW), () => plotter.pen("up"), () => plotter.home()])
      expect(await codeOf(ask())).toBe("disconnected");
  });

  it("ends a plot that waits when it is closed", async () => {
    const plot = codeOf(plotter.plot(LONG));
    await until(() => plotter.state.plot !== null);
    await plotter.close();
    expect(await plot).toBe("disconnected");
  });
});

describe("openPlotter", () => {
  it.each([
    [{}, "bad-setting", /exactly one/],
    [{ virtual: true, url: "http://127.0.0.1:1" }, "bad-setting", /exactly one/],
    [{ devise: "auto" }, "bad-setting", /no option devise/],
    [{ webSerial: true }, "bad-setting", /for pages/],
    [{ url: "localhost:9080" }, "bad-setting", /not an address/],
    [{ url: "http://me:secret@127.0.0.1:9080" }, "bad-setting", /access key in key/],
    [{ url: "http://127.0.0.1:1" }, "disconnected", /No plotwright server answers/],
    [{ url: "http://127.0.0.1:1", settings: {} }, "bad-setting", /server has the settings/],
    [{ virtual: true, settings: { machine: "axidraw-v33" } }, "bad-setting", /axidraw-v33/],
    [{ virtual: { speed: 0 } }, "bad-setting", /more than 0/],
    [{ virtual: { speed: Infinity } }, "bad-setting", /at most 200/],
    [{ virtual: true, settings: { pen: { uppPct: 3 } } }, "bad-setting", /uppPct|upPct/],
    [{ device: "/dev/there-is-none" }, "no-board", /there-is-none/],
  ])("refuses %j", async (choice, code, message) => {
    const error: unknown = await openPlotter(choice as PlotterChoice).catch((fault: unknown) => fault);
    expect(error).toMatchObject({ code, message: expect.stringMatching(message) });
  });

  it("names the plotters of a server that does not have the wanted one", async () => {
    const server = await createServer({ port: 0, device: "virtual", dataDir: folderOfTest() });
    try {
      await expect(openPlotter({ url: server.url, plotter: "big one" })).rejects.toThrow(
        /no plotter big one. It has: Virtual plotter/,
      );
      const found = await openPlotter({ url: server.url, plotter: "virtual plotter" });
      expect(found.state.kind).toBe("virtual");
      await found.close();
    } finally {
      await server.close();
    }
  });

  it("uses the given model, heights and speeds for every plot and move", async () => {
    const plotter = await openPlotter({
      virtual: { speed: SPEED },
      settings: { machine: "axidraw-minikit", motion: { draw: { speedMmPerS: 20 } } },
    });
    expect(await codeOf(plotter.moveTo(300, 10))).toBe("out-of-bounds");
    const { plottedS: slow } = await plotter.plot(
      [
        [
          [10, 10],
          [110, 10],
        ],
      ],
      { paper: "A6" },
    );
    const { plottedS: fast } = await plotter.plot(
      [
        [
          [10, 10],
          [110, 10],
        ],
      ],
      { paper: "A6", speed: 60 },
    );
    expect(slow).toBeGreaterThan(fast + 2);
    await plotter.close();
  });
});

describe("a plot on a server", () => {
  it("ends with words when its job is removed by someone else", async () => {
    const server = await createServer({
      port: 0,
      device: "virtual",
      virtualSpeed: SPEED,
      dataDir: folderOfTest(),
    });
    const [plotter, other] = await Promise.all([
      openPlotter({ url: server.url }),
      openPlotter({ url: server.url }),
    ]);
    const plot = codeOf(plotter.plot(LONG));
    await until(() => plotter.state.plot !== null);
    expect(await codeOf(other.plot(ROW))).toBe("busy");
    const { jobs } = (await (await fetch(`${server.url}/api/v1/state`)).json()) as { jobs: { id: string }[] };
    expect(jobs.length).toBe(1);
    await fetch(`${server.url}/api/v1/jobs/${jobs[0].id}/cancel`, { method: "POST" });
    expect(await plot).toBe("cancelled");
    await Promise.all([plotter.close(), other.close()]);
    await server.close();
  });

  it("ends with words when the server was ended and is back", async () => {
    const dataDir = folderOfTest();
    const first = await createServer({ port: 0, device: "virtual", virtualSpeed: SPEED, dataDir });
    const plotter = await openPlotter({ url: first.url });
    const plot = plotter.plot(LONG).catch((error: unknown) => error);
    await plotter.pause();
    await first.close();
    const port = Number(new URL(first.url).port);
    const second = await createServer({ port, device: "virtual", virtualSpeed: SPEED, dataDir });
    expect(await plot).toMatchObject({ code: "disconnected", message: expect.stringMatching(/stopped/) });
    await plotter.close();
    await second.close();
  });

  it("ends with words when nothing answers for a minute, and not before", async () => {
    const server = await createServer({
      port: 0,
      device: "virtual",
      virtualSpeed: SPEED,
      dataDir: folderOfTest(),
    });
    const relay = await relayTo(Number(new URL(server.url).port));
    const plotter = await openPlotter({ url: `http://127.0.0.1:${relay.port}` });
    let ended: unknown = null;
    const plot = plotter.plot(LONG).catch((error: unknown) => (ended = error));
    await plotter.pause();
    vi.useFakeTimers({ toFake: ["Date"] });
    try {
      await relay.close();
      await until(() => /No plotwright server answers/.test(plotter.state.message ?? ""));
      expect(ended).toBeNull();
      vi.setSystemTime(Date.now() + 61_000);
      await plot;
      expect(ended).toMatchObject({
        code: "disconnected",
        message: expect.stringMatching(/No plotwright server answers .* Whether the plot continues/),
      });
    } finally {
      vi.useRealTimers();
    }
    await plotter.close();
    await server.close();
  });
});

/** A port that leads to another one, until it is closed: then all its connections end at once. */
async function relayTo(port: number): Promise<{ port: number; close: () => Promise<void> }> {
  const sockets = new Set<Socket>();
  const relay = createTcpServer((socket) => {
    const onward = connect(port, "127.0.0.1");
    for (const one of [socket, onward]) sockets.add(one.on("error", () => undefined));
    socket.pipe(onward).pipe(socket);
  });
  await new Promise<void>((resolve) => void relay.listen(0, "127.0.0.1", resolve));
  return {
    port: (relay.address() as AddressInfo).port,
    close: () =>
      new Promise((resolve) => {
        relay.close(() => resolve());
        for (const socket of sockets) socket.destroy();
      }),
  };
}

describe("a plotter of a server that goes away", () => {
  it("says so, and is known again when the server is back", async () => {
    const dataDir = folderOfTest();
    const first = await createServer({ port: 0, device: "virtual", dataDir });
    const { port } = new URL(first.url);
    const plotter = await openPlotter({ url: first.url });
    await first.close();
    await until(() => plotter.state.connection === "absent");
    expect(plotter.state.message).toMatch(/server/);
    const second = await createServer({ port: Number(port), device: "virtual", dataDir });
    await until(() => plotter.state.connection === "idle");
    await plotter.close();
    await second.close();
  });
});
