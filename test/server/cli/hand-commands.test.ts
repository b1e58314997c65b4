/** Commands to the machine: never to a missing board, and always to the servo of this plotter. */
import { writeFileSync } from "node:fs";
import { join } from "node:path";
import { afterEach, beforeEach, describe, expect, it, vi } from "vitest";
import { openPtyBoard, type PtyBoard } from "../../../server/cli/board/board.js";
import { nodeClock } from "../../../server/serial/node-clock.js";
import { prepareDataDir } from "../../../server/storage/data-dir.js";
import { Store } from "../../../server/storage/store.js";
import { machineById, VirtualBoard } from "../../../src/index.js";
import { DEFAULT_PLOT_SETTINGS } from "../../../src/schema/index.js";
import { drawingOf, makeJob } from "../../support/jobs/jobs.js";
import { cli } from "../../support/processes/command-line.js";
import { folderOfTest } from "../../support/processes/folders.js";

// Ignores any board connected to this computer.
vi.mock("../../../server/serial/find-boards.js", () => ({ findBoards: () => Promise.resolve([]) }));

const SVG = `<svg xmlns="http://www.w3.org/2000/svg" width="20mm" height="20mm" viewBox="0 0 20 20" stroke="black"><path d="M1 2h9"/></svg>`;
let data: string;
beforeEach(() => {
  data = folderOfTest();
  prepareDataDir(data);
  writeFileSync(join(data, "a.svg"), SVG);
  // Without --data, plot would look into the user's own folder.
  vi.stubEnv("XDG_DATA_HOME", data);
});
afterEach(() => {
  vi.unstubAllEnvs();
});

describe("without a plotter", () => {
  // A server that runs on this computer would be named in the message (test in plot.test.ts).
  beforeEach(() => void vi.stubGlobal("fetch", () => Promise.reject(new TypeError("fetch failed"))));
  afterEach(() => void vi.unstubAllGlobals());
  const file = (): string => join(data, "a.svg");
  it.each([
    ["plot", () => ["plot", file()]],
    ["pen", () => ["pen", "up"]],
    ["info", () => ["info"]],
    ["home", () => ["home"]],
    ["align", () => ["align"]],
    ["move-to", () => ["move-to", "1", "1"]],
    ["frame", () => ["frame", file()]],
    ["test-patch", () => ["test-patch"]],
  ] as const)("%s reports it in one line, exit code 4", async (name, args) => {
    const where = name === "plot" ? [] : ["--data", data];
    const { code, out, err } = await cli(...args(), ...where);
    expect([code, out]).toEqual([4, ""]);
    expect(err).toMatch(/^plotwright: No plotter is plugged in: [^\n]*--device virtual\.\n$/);
  });

  it("an unknown machine is bad usage, not a missing board", async () => {
    const { code, err } = await cli("info", "--machine", "typewriter", "--device", "virtual", "--data", data);
    expect([code, err]).toEqual([2, expect.stringMatching(/There is no machine "typewriter"\. Known/)]);
  });

  it("a plotter of the data folder is found by its name or id, in any case", async () => {
    const store = Store.open(data);
    store.savePlotter({ id: "main", name: null, device: "auto", machine: null });
    store.savePlotter({ id: "studio-1", name: "Studio", device: "virtual", machine: "axidraw-v3-a3" });
    store.savePlotter({ id: "far", name: "Far", device: join(data, "none"), machine: null });
    store.close();
    for (const device of ["Studio", "studio", "studio-1"]) {
      const { code, out } = await cli("info", "--json", "--device", device, "--data", data);
      expect([code, JSON.parse(out)]).toEqual([0, expect.objectContaining({ kind: "virtual" })]);
    }
    // It has the settings of that plotter: 400 mm are beyond the other's machine.
    const fast = ["--virtual-speed", "100", "--data", data];
    expect((await cli("move-to", "400", "10", "--device", "Studio", ...fast)).code).toBe(0);
    expect((await cli("plot", file(), "--device", "studio", ...fast)).code).toBe(0);
    const far = await cli("info", "--device", "Far", "--data", data);
    expect([far.code, far.err]).toEqual([4, expect.stringContaining(join(data, "none"))]);
    for (const args of [["info"], ["plot", file()], ["plot", "--resume"]]) {
      const { code, err } = await cli(...args, "--device", "Atelier", "--data", data);
      expect([code, err]).toEqual([
        4,
        'plotwright: --device Atelier: there is no such serial port, and no plotter with that name. Plotters: main, Studio, Far. "plotwright devices" lists the boards that are plugged in.\n',
      ]);
    }
  });

  it("the virtual board is used on request", async () => {
    const virtual = ["--device", "virtual", "--virtual-speed", "100"];
    expect(await cli("pen", "up", "--data", data, ...virtual)).toEqual({ code: 0, out: "", err: "" });
    expect((await cli("plot", file(), ...virtual)).code).toBe(0);
    expect((await cli("info", "--data", data, ...virtual)).out).toMatch(/device {4}virtual/);
  });
});

describe("home on a NextDraw", () => {
  const machine = machineById("nextdraw-8511");
  const onBoard = async (fault: (board: VirtualBoard) => void) => {
    const line = await openPtyBoard(
      new VirtualBoard({ clock: nodeClock, speed: 20, machine, firmware: "3.0.3" }),
    );
    line.board.gantry!.push({ xMm: 60, yMm: 30 });
    fault(line.board);
    const to = ["--device", line.path, "--virtual-speed", "20", "--data", data, "--machine", machine.id];
    const ended = await cli("home", ...to);
    const { xMm, yMm } = line.board.gantry!.carriage;
    await line.close();
    return { ...ended, offMm: Math.hypot(xMm, yMm) };
  };

  it("finds the corner by itself", async () => {
    const { code, err, offMm } = await onBoard(() => undefined);
    expect([code, err]).toEqual([0, ""]);
    expect(offMm).toBeLessThan(0.05);
  });

  it("says what is wrong and what to do if it does not", async () => {
    const { code, err } = await onBoard((board) => (board.gantry!.switchCondition = "absent"));
    expect(code).toBe(5);
    expect(err).toMatch(/^plotwright: Home was not found \(switch not detected\)\. .*chosen model/);
  });
});

describe("on a plotter whose servo is on another pin", () => {
  let line: PtyBoard;
  let board: VirtualBoard;
  let received = "";
  beforeEach(async () => {
    received = "";
    const machine = machineById("nextdraw-2234");
    board = new VirtualBoard({ clock: nodeClock, speed: 20, machine });
    const end = board.transport();
    const write = end.write.bind(end);
    end.write = (bytes) => {
      received += Buffer.from(bytes).toString();
      return write(bytes);
    };
    line = await openPtyBoard({ transport: () => end, close: () => board.close() });
  });
  afterEach(() => line.close());
  const onBoard = (...args: string[]) =>
    cli(...args, "--device", line.path, "--virtual-speed", "20", "--data", data);
  const done = { code: 0, out: "", err: "" };
  const { upPct, downPct } = DEFAULT_PLOT_SETTINGS.pen;
  const penPct = (): number => Math.round(board.state().penPct);

  async function penMoves(...more: string[]): Promise<void> {
    expect(await onBoard("pen", "down", ...more)).toEqual(done);
    await expect.poll(penPct).toBe(downPct);
    expect(await onBoard("pen", "up", ...more)).toEqual(done);
    await expect.poll(penPct).toBe(upPct);
    expect(await onBoard("pen", "down", "--pen-down", "20", ...more)).toEqual(done);
    await expect.poll(penPct).toBe(20);
    expect(await onBoard("align", ...more)).toEqual(done);
    await expect.poll(penPct).toBe(upPct);
    expect(await onBoard("cycle-pen", ...more)).toEqual(done);
    expect((await onBoard("info", ...more)).code).toBe(0);
  }

  it("hand commands move it when the machine is given", () => penMoves("--machine", "nextdraw-2234"));

  it("hand commands move it if a server has stored the machine, or plotted on it last", async () => {
    const store = Store.open(data);
    store.savePlotter({ id: "main", name: null, device: "auto", machine: "nextdraw-2234" });
    store.close();
    await penMoves();
    const again = Store.open(data);
    again.savePlotter({ id: "main", name: null, device: "auto", machine: null });
    const settings = { ...DEFAULT_PLOT_SETTINGS, machine: "nextdraw-2234" };
    const ended = { plotterId: "main", state: "done" } as const;
    for (const [id, startedAt, more] of [
      ["a", "2026-01-01T00:00:00.000Z", {}],
      ["b", "2026-01-02T00:00:00.000Z", { settings }],
    ] as const) {
      again.addJob(makeJob(id, { ...ended, startedAt, endedAt: startedAt, ...more }), drawingOf(id));
    }
    again.close();
    await penMoves();
  });

  it("plot and pen use the heights that a server has stored, and an option changes one of them", async () => {
    const store = Store.open(data);
    store.savePlotter({ id: "main", name: null, device: "auto", machine: "nextdraw-2234" });
    const pen = { ...DEFAULT_PLOT_SETTINGS.pen, upPct: 71, downPct: 44 };
    store.savePlotterSettings("main", { pen, pens: [], presets: [] });
    store.close();
    /** The servo commands that reach the board, as height in percent and pin. */
    const sentBy = async (...args: string[]): Promise<{ err: string; sent: string[] }> => {
      received = "";
      const { code, err } = await onBoard(...args);
      const lines = received;
      expect([code, lines]).toEqual([0, expect.not.stringContaining("SC,4")]);
      // From 5400 at 0 % to 12600 at 100 %.
      const found = [...lines.matchAll(/S2,(\d+),(\d)/g)].map(
        ([, pos, pin]) => `${(Number(pos) - 5_400) / 72} on ${pin}`,
      );
      return { err, sent: [...new Set(found)].sort() };
    };
    expect((await sentBy("pen", "down")).sent).toContain("44 on 5");
    expect((await sentBy("pen", "up")).sent).toEqual(["71 on 5"]);
    expect((await sentBy("cycle-pen")).sent).toEqual(["44 on 5", "71 on 5"]);
    expect((await sentBy("cycle-pen", "--pen-down", "25")).sent).toEqual(["25 on 5", "71 on 5"]);
    const file = join(data, "a.svg");
    expect((await sentBy("plot", file)).sent).toEqual(["44 on 5", "71 on 5"]);
    const config = join(data, "job.json");
    writeFileSync(config, JSON.stringify({ machine: "axidraw-v3", pen: { downPct: 33 } }));
    const ofJob = await sentBy("plot", file, "--config", config);
    expect(ofJob.sent).toEqual(["33 on 5", "71 on 5"]);
    expect(ofJob.err).toContain("note: Its settings are for the AxiDraw V3.");
  });

  it("nothing moves while the plotter is ambiguous", async () => {
    const server = Store.open(data);
    const before = penPct();
    const { code, err } = await onBoard("pen", "down");
    expect([code, err]).toEqual([
      4,
      expect.stringMatching(/^plotwright: A plotwright server is running: .*--machine/),
    ]);
    expect(penPct()).toBe(before);
    expect(await onBoard("pen", "down", "--machine", "nextdraw-2234")).toEqual(done);
    server.close();
  });
});
