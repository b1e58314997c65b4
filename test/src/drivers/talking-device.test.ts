/** A device that never stops talking, whatever it is sent: connecting and asking end soon, and say that it is another one. */
import { describe, expect, it } from "vitest";
import { allDrivers } from "../../../src/internal.js";
import type { Transport } from "../../../src/index.js";
import { ManualClock } from "../../support/clocks/manual-clock.js";
import { NO_EVENTS } from "../../support/machines/machine.js";
import { outcome } from "../../support/plots/virtual-plotter.js";

const SOON_S = 8;

/** Says the same again and again. */
class TalkingLine implements Transport {
  isClosed = false;
  private listener: (bytes: Uint8Array) => void = () => undefined;

  constructor(
    private readonly clock: ManualClock,
    private readonly words: string,
    private readonly everyS: number,
  ) {
    this.talk();
  }

  private talk(): void {
    if (this.isClosed) return;
    this.listener(Buffer.from(this.words, "latin1"));
    this.clock.after(this.everyS, () => this.talk());
  }

  write(): Promise<void> {
    return Promise.resolve();
  }

  onData(listener: (bytes: Uint8Array) => void): void {
    this.listener = listener;
  }

  onClose(): void {
    // This device is never unplugged.
  }

  close(): Promise<void> {
    this.isClosed = true;
    return Promise.resolve();
  }
}

const DEVICES = [
  ["a GPS receiver", "$GPGGA,120000,,,,,0,00,99.99,,,,,,*48\r\n", 0.2],
  ["a slow GPS receiver", "$GPGGA,120000,,,,,0,00,99.99,,,,,,*48\r\n", 0.9],
  ["a 3D printer that reports temperatures", "ok T:20.1 /0.0 B:20.0 /0.0 @:0 B@:0\n", 0.5],
  ["a log", "[12:00:00][D][sensor:094]: Sending state 21.5\r\n", 0.02],
  ["noise without line ends", "\xf8\x80\x00x\xfe\x1c", 0.01],
] as const;

describe.each((await allDrivers()).map(({ driver, ids }) => [ids[0].vendorId, driver] as const))(
  "the driver for boards with the USB vendor %s",
  (_, driver) => {
    it.each(DEVICES)("says soon that it is not its board: %s", async (_name, words, everyS) => {
      const world = new ManualClock();
      const line = new TalkingLine(world, words, everyS);
      const options = { clock: world, machineClock: world, speed: 1, events: NO_EVENTS };
      const said = await outcome(world.run(driver.identify(line, options), SOON_S));
      expect(said).toMatch(
        /^no-board: Something answers on this port, but it is not an? (Grbl|EiBotBoard): /,
      );
      expect(line.isClosed).toBe(true);
    });

    it.each(DEVICES)("finds nothing when it asks %s", async (_name, words, everyS) => {
      const world = new ManualClock();
      const line = new TalkingLine(world, words, everyS);
      expect(await world.run(driver.ask(line, world), SOON_S)).toBeNull();
      expect(line.isClosed).toBe(true);
    });
  },
);
