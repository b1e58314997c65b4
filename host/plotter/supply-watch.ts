/** Watches the motor supply of a connected machine. Asking also detects a board that no longer answers. */
import type { Clock } from "../../src/index.js";
import type { Machine, SupplyState } from "../../src/internal.js";

const ASK_EVERY_S = 2;

interface SupplyEvents {
  /** Whether the machine is free to be asked. */
  mayAsk(): boolean;
  /**
   * Resolves when the motors are released. Before that the supply does not count as restored. `isBack`: it failed only
   * for a moment.
   */
  lost(isBack: boolean): Promise<void>;
  restored(): void;
}

export class SupplyWatch {
  private isLowNow = false;
  private wasReadLow = false;
  private machine: Machine | null = null;
  private cancel: (() => void) | null = null;
  private released: Promise<void> = Promise.resolve();

  constructor(
    private readonly clock: Clock,
    private readonly events: SupplyEvents,
  ) {}

  get isLow(): boolean {
    return this.isLowNow;
  }

  /** Asks this machine from now on, until another is watched or `stop` is called. */
  watch(machine: Machine): void {
    this.stop();
    this.isLowNow = false;
    this.machine = machine;
    this.askLater(machine);
  }

  stop(): void {
    this.cancel?.();
    this.machine = null;
  }

  /**
   * A reading that came during a plot. Only two low ones in a row count: with a second program on the port, an answer
   * may be mistaken.
   */
  read(state: SupplyState): void {
    const isLow = state === "low";
    if (state === "failed" || (isLow && this.wasReadLow)) this.lost(!isLow);
    this.wasReadLow = isLow;
  }

  private askLater(machine: Machine): void {
    this.cancel = this.clock.after(ASK_EVERY_S, () => {
      const asked = this.events.mayAsk() ? this.ask(machine) : Promise.resolve();
      // A lost connection is reported by the machine's own event.
      asked
        .catch(() => undefined)
        .finally(() => {
          if (this.machine === machine) this.askLater(machine);
        });
    });
  }

  private async ask(machine: Machine): Promise<void> {
    await this.released;
    let state = await readSupply(machine);
    if (state === "low") state = await readSupply(machine);
    // After a failure that is known, the board also reports that the supply was low until now.
    if (state === "low" || (state === "failed" && !this.isLowNow)) this.lost(state === "failed");
    else if (this.isLowNow) {
      this.isLowNow = false;
      this.events.restored();
    }
  }

  private lost(isBack: boolean): void {
    if (this.isLowNow) return;
    this.isLowNow = true;
    this.released = this.events.lost(isBack);
  }
}

/** A machine that cannot measure its supply counts as having a good one. */
async function readSupply(machine: Machine): Promise<SupplyState> {
  if (machine.supply) return machine.supply.read();
  await machine.ping?.();
  return "good";
}
