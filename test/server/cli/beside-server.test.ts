/** Commands while a server has the plotter: they work through it. */
import { writeFileSync } from "node:fs";
import { join } from "node:path";
import { fileURLToPath } from "node:url";
import { beforeEach, describe, expect, it, onTestFinished } from "vitest";
import { createServer, type PlotwrightServer } from "../../../server/index.js";
import type { Job, Plotter } from "../../../src/schema/index.js";
import { send, stateOf as stateOfServer } from "../../support/servers/shared-servers.js";
import { CaughtIo, cli, cliWith, type CliRun } from "../../support/processes/command-line.js";
import { folderOfTest } from "../../support/processes/folders.js";

const square = (times: number): string =>
  `<svg xmlns="http://www.w3.org/2000/svg" width="20mm" height="20mm" viewBox="0 0 20 20" stroke="black" fill="none"><path d="${"M1 2h18v16h-18z".repeat(times)}"/></svg>`;
const FONT = fileURLToPath(
  new URL(
    "../../../node_modules/@fontsource/dejavu-sans/files/dejavu-sans-latin-400-normal.woff",
    import.meta.url,
  ),
);
/** About a minute of the plotter at twenty times its speed: it never ends by itself during a test. */
const LONG = square(400);

let data: string;
let file: string;
let server: PlotwrightServer;

beforeEach(async () => {
  data = folderOfTest();
  file = join(data, "a.svg");
  writeFileSync(file, square(1));
  server = await createServer({ port: 0, device: "virtual", virtualSpeed: 20, dataDir: data });
  onTestFinished(() => server.close());
});

const there = (...args: string[]): Promise<CliRun> => cli(...args, "--data", data);
const jobs = async (): Promise<Job[]> => {
  const { out } = await cli("queue", "--json", "--url", server.url);
  return JSON.parse(out) as Job[];
};
const stateOf = async (name: string): Promise<string | undefined> =>
  (await jobs()).find((job) => job.name === name)?.state;

const plotter = async (): Promise<Plotter> => {
  const response = await fetch(new URL("/api/v1/plotters/main", server.url));
  return (await response.json()) as Plotter;
};

describe("plotwright live beside a running server", () => {
  it("draws its lines as a job of the server", async () => {
    const io = new CaughtIo();
    io.inputText = "20 20\n40 20\nup\n-5 1\n[[30, 30], [50, 30]]\n";
    expect(await cliWith(io, "live", "--data", data)).toMatchObject({
      code: 3,
      err: expect.stringMatching(/Drawing live on .*\nline 4: .*-5/) as string,
    });
    const all = (await stateOfServer(server)).jobs;
    expect(all.map(({ name, state }) => [name, state])).toEqual([["live drawing", "done"]]);
  });
});

describe("a command by hand beside a running server", () => {
  it("moves the server's plotter, with its settings and those of the flags", async () => {
    expect(await there("move-to", "30", "2cm")).toEqual({ code: 0, out: "", err: "" });
    expect((await there("info")).out).toMatch(/^position  30\.00, 20\.00 mm$/m);
    expect(await there("jog", "-10", "0", "--travel-speed", "50")).toEqual({ code: 0, out: "", err: "" });
    expect(await there("pen", "down")).toEqual({ code: 0, out: "", err: "" });
    const { out } = await there("info", "--json");
    expect(JSON.parse(out)).toMatchObject({ kind: "virtual", penUp: false, xMm: 20, yMm: 20 });
    expect((await there("raw", "QM")).out).toMatch(/^QM,0,0,0/);
    expect((await there("home")).code).toBe(0);
    expect((await there("info")).out).toMatch(/^position  0\.00, 0\.00 mm$/m);
    expect(await there("frame", file)).toMatchObject({ code: 0, err: "" });
  });

  it("says what the server refuses, with the exit code of that fault", async () => {
    const { code, err } = await there("move-to", "900", "0");
    expect(code).not.toBe(0);
    expect(err).toMatch(/^plotwright: The server at http:\/\/127\.0\.0\.1:\d+ refused it: .*900/);
  });

  it("finds the plotter by its name", async () => {
    const { name } = await plotter();
    expect((await there("move-to", "5", "5", "--device", name)).code).toBe(0);
  });

  it("uses the port with --direct, where the server's settings can't be read", async () => {
    const { code, err } = await there("pen", "up", "--direct");
    expect(code).not.toBe(0);
    expect(err).toContain("server");
  });

  it("stops the move at Ctrl-C", async () => {
    const io = new CaughtIo();
    const moved = cliWith(io, "move-to", "280", "200", "--travel-speed", "2", "--data", data);
    await expect.poll(async () => (await plotter()).activity).toBe("moving");
    io.interrupt();
    expect(await moved).toMatchObject({ code: 5, err: "plotwright: The command was stopped.\n" });
    await expect.poll(async () => (await there("move-to", "0", "0")).code).toBe(0);
  });
});

describe("plotwright plot beside a running server", () => {
  it("plots through its queue, and reports as without a server", async () => {
    const { code, err } = await there("plot", file);
    expect(err).toMatch(
      /^The server at \S+ has .+, and plots it: job \S+\.\na\.svg: drawn 18 × 16 mm, 100 %\nPlotting a\.svg\.\n(?:\d+ % .*\n)*Done: a\.svg, after 00:00:\d\d\.\n$/,
    );
    expect(code).toBe(0);
    expect(await jobs()).toEqual([]);
  });

  it("pauses at Ctrl-C, resumes at Enter, and cancels at the second Ctrl-C", async () => {
    writeFileSync(file, LONG);
    const io = new CaughtIo();
    const plotted = cliWith(io, "plot", file, "--data", data);
    await expect.poll(() => stateOf("a.svg")).toBe("plotting");
    io.interrupt();
    await expect.poll(() => stateOf("a.svg")).toBe("paused");
    io.line();
    await expect.poll(() => stateOf("a.svg")).toBe("plotting");
    io.interrupt();
    await expect.poll(() => stateOf("a.svg")).toBe("paused");
    io.interrupt();
    expect((await plotted).code).toBe(5);
    expect(io.errText).toMatch(/Paused\. Enter resumes.*\n(.*\n)*Cancelling/);
  });

  it("removes the job at a Ctrl-C before it is started, and pauses at one while it is started", async () => {
    writeFileSync(file, LONG);
    const io = new CaughtIo();
    const plotted = cliWith(io, "plot", file, "--data", data);
    await expect.poll(() => io.listens).toBe(true);
    io.interrupt();
    expect(await plotted).toEqual({
      code: 5,
      out: "",
      err: "Stopping.\nplotwright: the plot was cancelled.\n",
    });
    expect([await jobs(), (await plotter()).activity]).toEqual([[], "none"]);
    const later = new (class extends CaughtIo {
      override err(text: string): void {
        super.err(text);
        if (text.includes(": drawn ")) this.interrupt();
      }
    })();
    const started = cliWith(later, "plot", file, "--data", data);
    await expect.poll(() => stateOf("a.svg")).toBe("paused");
    later.interrupt();
    expect((await started).code).toBe(5);
    expect(later.errText).toMatch(/Plotting a\.svg\.\nPaused\./);
  });

  it("pauses at Ctrl-C although the plot was paused and resumed elsewhere before", async () => {
    writeFileSync(file, LONG);
    const io = new CaughtIo();
    const plotted = cliWith(io, "plot", file, "--data", data);
    await expect.poll(() => stateOf("a.svg")).toBe("plotting");
    await there("pause");
    await expect.poll(() => io.errText).toMatch(/Paused\. Enter resumes, Ctrl-C cancels\.\n/);
    await there("resume");
    await expect.poll(() => io.errText).toContain("Resumed.\n");
    // The plot is not held any more, so Enter has nothing to resume.
    io.line();
    io.interrupt();
    await expect.poll(() => stateOf("a.svg")).toBe("paused");
    io.interrupt();
    expect((await plotted).code).toBe(5);
    expect(io.errText).toContain("Cancelling");
  });

  it("stops for pens, which are answered here", async () => {
    const layers = ["Sky", "Sea"].map((name) => `<g inkscape:groupmode="layer" inkscape:label="${name}" stroke="black"><path d="M1 2h9"/></g>`); // prettier-ignore
    writeFileSync(
      file,
      `<svg xmlns="http://www.w3.org/2000/svg" xmlns:inkscape="http://www.inkscape.org/namespaces/inkscape" width="20mm" height="20mm" viewBox="0 0 20 20">${layers.join("")}</svg>`,
    );
    const io = new CaughtIo();
    const plotted = cliWith(io, "plot", file, "--pen", "Sky=Blue", "Sea=Green", "--data", data);
    for (const pen of ["Blue", "Green"]) {
      await expect.poll(() => io.errText).toContain(`Put in "${pen}" for`);
      io.line();
    }
    expect((await plotted).code).toBe(0);
  });

  it("leaves the plot to the server when the command must end", async () => {
    writeFileSync(file, LONG);
    const io = new CaughtIo();
    const plotted = cliWith(io, "plot", file, "--data", data);
    await expect.poll(() => stateOf("a.svg")).toBe("plotting");
    io.end();
    const { code, err } = await plotted;
    expect(code).toBe(5);
    const [, id = ""] = /To follow it: plotwright follow (\S+)\n$/.exec(err) ?? [];
    expect(await stateOf("a.svg")).toBe("plotting");
    expect((await cli("cancel", id, "--url", server.url)).code).toBe(0);
  });

  it("leaves no job behind if the server can't start it", async () => {
    writeFileSync(file, LONG);
    await cli("add", file, "--start", "--url", server.url);
    const { code, err } = await there("plot", file);
    expect(code).not.toBe(0);
    expect(err).toContain("refused it");
    expect(await jobs()).toHaveLength(1);
  });
});

describe("a job of a running server", () => {
  const at = (...args: string[]): Promise<CliRun> => cli(...args, "--url", server.url);

  it("is started, paused, resumed, followed, cancelled and removed by name, id, or as the only one", async () => {
    writeFileSync(file, LONG);
    const added = await at("add", file, "--json");
    const { id } = JSON.parse(added.out) as Job;
    expect((await at("start")).out).toMatch(new RegExp(`^${id}\tplotting\ta\\.svg\n$`));
    expect(await at("pause", id.slice(0, 6))).toMatchObject({ code: 0 });
    await expect.poll(() => stateOf("a.svg")).toBe("paused");
    expect((await at("resume", "a.svg", "--json")).out).toContain('"state":"paused"');
    await expect.poll(() => stateOf("a.svg")).toBe("plotting");
    const io = new CaughtIo();
    const followed = cliWith(io, "follow", "--url", server.url);
    await expect.poll(() => io.errText).toContain("Following a.svg.\n");
    expect(await at("cancel")).toMatchObject({ code: 0 });
    expect(await followed).toMatchObject({ code: 5 });
    expect((await at("resume", id)).out).toContain("\tpaused\t");
    expect(await at("cancel", id)).toMatchObject({ code: 0 });
    // Not before the pen is up and home.
    await expect.poll(() => at("remove", id)).toMatchObject({ code: 0 });
    expect((await at("start", id)).err).toMatch(/The server has no job \S+\. It has none\./);
  });

  it("is found by the data folder of its server", async () => {
    writeFileSync(file, LONG);
    await there("add", file);
    expect((await there("queue")).out).toContain("\tqueued\t");
    expect((await there("start")).out).toContain("\tplotting\t");
    expect((await there("cancel", "a.svg")).code).toBe(0);
    expect((await there("follow", "a.svg")).code).toBe(5);
  });

  it.each(["add", "plot"])(
    "is refused by %s with a font, with the way to draw it in that font",
    async (command) => {
      const text = join(data, "text.svg");
      writeFileSync(
        text,
        '<svg xmlns="http://www.w3.org/2000/svg" width="60mm" height="20mm"><text y="40">ink</text></svg>',
      );
      const { code, err } = await there(command, text, "--font", FONT);
      expect(code).not.toBe(0);
      expect(err).toMatch(
        /^plotwright: --font: the server at .* plotwright plan FILE --font FONT --svg LINES\.svg/,
      );
      const lines = join(data, "lines.svg");
      const planned = await cli("plan", text, "--font", FONT, "--svg", lines, "--json");
      const { drawMm } = JSON.parse(planned.out) as { drawMm: number };
      const added = await there("add", lines, "--no-fit", "--json");
      expect((JSON.parse(added.out) as Job).stats?.drawMm).toBeCloseTo(drawMm, 0);
    },
  );

  it("is added, and stays in the queue, while another is plotted", async () => {
    writeFileSync(file, LONG);
    await at("add", file, "--start");
    const other = join(data, "b.svg");
    writeFileSync(other, square(1));
    const { code, out, err } = await at("add", other, file, "--start");
    expect(err).toMatch(/^note: b\.svg waits in the queue: .*"a\.svg" is being plotted\..*\n/);
    expect(out).toMatch(/^\S+\tb\.svg\t.*\n\S+\ta\.svg\t.*\n$/);
    expect(code).toBe(0);
    expect((await jobs()).map(({ name, state }) => [name, state])).toEqual([
      ["a.svg", "plotting"],
      ["b.svg", "queued"],
      ["a.svg", "queued"],
    ]);
  });

  it("is not meant by an empty name", async () => {
    await at("add", file);
    expect((await at("remove", "")).err).toMatch(/^plotwright: The name of the job is empty\./);
    expect(await jobs()).toHaveLength(1);
  });

  it("is followed to its end, or until Ctrl-C, which changes nothing", async () => {
    await at("add", file, "--start");
    expect((await at("follow", "a.svg")).code).toBe(0);
    writeFileSync(file, LONG);
    await at("add", file, "--start");
    const io = new CaughtIo();
    const followed = cliWith(io, "follow", "--json", "--url", server.url);
    await expect.poll(() => io.outText).toContain('"event":"followed"');
    io.interrupt();
    expect((await followed).code).toBe(0);
    expect(await stateOf("a.svg")).toBe("plotting");
  });

  it("must be named if several can be meant", async () => {
    await at("add", file, "--copies", "2");
    expect((await at("pause")).err).toMatch(/No job is plotting\. Jobs: /);
    expect((await at("remove", "a.svg")).err).toMatch(/Several jobs are called a\.svg: name one by its id/);
    expect((await at("remove")).err).toMatch(/missing required argument 'job'/);
  });
});

describe("--url", () => {
  it("selects the server, whose plotters are named if it has several", async () => {
    const other = await createServer({ port: 0, device: "virtual", dataDir: join(data, "other") });
    onTestFinished(() => other.close());
    const at = ["--url", other.url];
    const body = { name: "Second", device: "virtual", machine: "axidraw-v3" };
    expect((await send(other.url, "POST", "/plotters", body)).status).toBe(201);
    const [first, second] = (await stateOfServer(other)).plotters;
    const b = join(data, "b.svg");
    writeFileSync(b, square(1));
    const added = await cli("add", file, "--plotter", second.id, ...at);
    expect([added.code, added.out]).toEqual([0, expect.stringMatching(/\ta\.svg\t[\d:]+\tSecond\n$/)]);
    await cli("add", b, ...at);
    const lines = (await cli("queue", ...at)).out.trimEnd().split("\n");
    expect(lines.map((line) => line.split("\t").slice(-2))).toEqual([
      ["a.svg", "Second"],
      ["b.svg", first.name],
    ]);
    expect(await jobs()).toEqual([]);
  });
});
