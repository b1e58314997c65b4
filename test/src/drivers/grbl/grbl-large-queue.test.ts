/** A Grbl on a board with more memory: its queue holds more moves than an Arduino's. */
import { expect, it } from "vitest";
import { PlotterConnection } from "../../../../host/plotter/plotter-connection.js";
import { asciiBytes, LineSplitter } from "../../../../src/drivers/line-splitter.js";
import { VirtualGrbl } from "../../../../src/drivers/grbl/virtual/virtual-grbl.js";
import type { Transport } from "../../../../src/index.js";
import { DEFAULT_PLOT_SETTINGS, type PlotSettings } from "../../../../src/schema/index.js";
import { GRBL } from "../../../support/machines/machine.js";
import { DRAWING, expectDrawn } from "../../../support/plots/live-plot.js";
import { LocalPlanner } from "../../../support/plots/local-planner.js";
import { ManualClock } from "../../../support/clocks/manual-clock.js";

const SETTINGS: PlotSettings = { ...DEFAULT_PLOT_SETTINGS, machine: GRBL.id, customMachine: GRBL };
/** Moves in the queue of the virtual Grbl, which is an Arduino's. */
const SMALL_QUEUE = 15;
const LARGE_QUEUE = 100;
const RX_BYTES = 128;

/** Accepts moves before the Grbl behind it has room for them. */
class LargeQueue implements Transport {
  private lines: string[] = [];
  /** How many of the lines, from the first on, were passed on. */
  private passedCount = 0;
  /** How many of them were answered before the Grbl answered them. */
  private earlyCount = 0;
  private received = "";
  private readonly sent = new LineSplitter();
  private listener: (bytes: Uint8Array) => void = () => undefined;

  constructor(private readonly grbl: Transport) {
    grbl.onData((bytes) => this.sent.push(bytes, (line) => this.answered(line)));
  }

  async write(bytes: Uint8Array): Promise<void> {
    for (const byte of bytes) {
      const character = String.fromCharCode(byte);
      if (character === "\x18") {
        this.lines = [];
        this.passedCount = this.earlyCount = 0;
        this.received = "";
      }
      if ("?!~\x18".includes(character)) await this.grbl.write(Uint8Array.of(byte));
      else if (character !== "\n") this.received += character;
      else {
        this.lines.push(this.received);
        this.received = "";
      }
    }
    this.pass();
  }

  onData(listener: (bytes: Uint8Array) => void): void {
    this.listener = listener;
  }

  onClose(listener: (error?: Error) => void): void {
    this.grbl.onClose(listener);
  }

  close(): Promise<void> {
    return this.grbl.close();
  }

  private answered(line: string): void {
    const isReply = line === "ok" || line.startsWith("error:");
    if (isReply) {
      this.lines.shift();
      this.passedCount--;
      if (this.earlyCount > 0) this.earlyCount--;
      else this.deliver(line);
    } else this.deliver(line.replace(`[OPT:V,${SMALL_QUEUE},`, `[OPT:V,${LARGE_QUEUE},`));
    this.pass();
  }

  private pass(): void {
    const waiting = (): number => this.lines.slice(0, this.passedCount + 1).join("\n").length;
    while (this.passedCount < this.lines.length && waiting() < RX_BYTES) {
      void this.grbl.write(asciiBytes(`${this.lines[this.passedCount++]}\n`));
    }
    const mayWait = (line: string | undefined): boolean => /^(G1)?[XYZF]/.test(line ?? "");
    while (this.earlyCount < LARGE_QUEUE - SMALL_QUEUE && mayWait(this.lines[this.earlyCount])) {
      this.earlyCount++;
      this.deliver("ok");
    }
  }

  /** Not at once: a reply must not arrive during the write. */
  private deliver(line: string): void {
    void Promise.resolve().then(() => this.listener(asciiBytes(`${line}\r\n`)));
  }
}

it("an emergency stop on a board with a large queue leaves no gap", async () => {
  for (let afterS = 0.5; afterS < 8; afterS += 0.7) {
    const world = new ManualClock();
    const board = new VirtualGrbl({ clock: world, speed: 1, machine: GRBL });
    const open = (): Promise<Transport> => Promise.resolve(new LargeQueue(board.transport()));
    const devices = { find: () => Promise.resolve([]), open };
    const driver = new PlotterConnection({ device: "a port", clock: world, settings: SETTINGS, devices });
    await world.run(driver.start());
    const run = await world.run(driver.plot(new LocalPlanner(DRAWING), SETTINGS));
    await world.advance(afterS);
    await world.run(run.emergencyStop());
    await world.run(run.resume());
    expect(await world.run(run.finished)).toEqual({ kind: "done" });
    expectDrawn(board as never, DRAWING, 0.02);
  }
});
