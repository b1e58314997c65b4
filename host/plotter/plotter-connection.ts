/**
 * One plotter, as used by the queue, the command line and embedding programs: connects, plots and makes
 * manual moves. `state` always shows its condition and, after an error, what to do.
 *
 *   absent ──connect──> connecting ──> idle <──> busy
 *      ^                    │            │         │
 *      └── no board ────────┴── fault <──┴─────────┘   (retried every 2 s while a device path is known)
 */
import { PlotwrightError, type Clock, type MachineProfile } from "../../src/index.js";
import {
  controllerOf,
  driverOf,
  findsHome,
  powerFailed,
  powerLost,
  powerLow,
  type Driver,
  type Machine,
  type PenBefore,
  type VirtualMachine,
  machineOf,
} from "../../src/internal.js";
import {
  DEFAULT_PLOT_SETTINGS,
  type CommandAnswer,
  type HandMove,
  type PlotSettings,
} from "../../src/schema/index.js";
import type { PlotPlanner } from "../planning/planning.js";
import { isOtherBoard, startOn } from "./board-id.js";
import { connect, connectFailed, type ConnectedMachine } from "./connected-machine.js";
import { moveByHand } from "./hand-moves.js";
import { MachinePlot } from "./machine-plot.js";
import {
  closedError,
  initialState,
  noConsole,
  notStarted,
  penRested,
  stateAfter,
  UNKNOWN,
  welcome,
  type PlotterOptions,
  type PlotterState,
} from "./plotter-state.js";
import { SupplyWatch } from "./supply-watch.js";
import type { RunningPlot, PlotProgress, PlotStart } from "./plotter-port.js";

const RECONNECT_S = 2;

export class PlotterConnection {
  private readonly clock: Clock;
  private settings: PlotSettings;
  private current: PlotterState;
  private readonly listeners: ((state: PlotterState) => void)[] = [];
  private connection: ConnectedMachine | null = null;
  private machine: Machine | null = null;
  /** The pen when the connection was lost. */
  private penBefore: PenBefore | null = null;
  /** Why there is no connection. */
  private trouble: PlotwrightError | null = null;
  private lostAtS: number | null = null;
  private connecting: Promise<void> | null = null;
  private cancelRetry: (() => void) | null = null;
  private run: MachinePlot | null = null;
  /** Resolves at the end of the current manual move. */
  private movingByHand: Promise<void> | null = null;
  /** Settings with another controller, to be used when nothing moves. */
  private chosen: PlotSettings | null = null;
  private closed = false;
  /** A real board was connected. */
  private hadSerial = false;
  private readonly supply: SupplyWatch;
  private virtual: VirtualMachine | null = null;

  constructor(private readonly options: PlotterOptions) {
    this.clock = options.clock;
    this.supply = new SupplyWatch(options.clock, {
      mayAsk: () => !this.movingByHand && (this.run === null || this.run.isHeld),
      lost: (isBack) => this.powerLost(isBack),
      restored: () => {
        if (this.closed) return;
        this.setState({
          connection: "idle",
          message: this.connection && welcome(this.connection.kind, this.options.device),
        });
      },
    });
    this.settings = options.settings ?? DEFAULT_PLOT_SETTINGS;
    this.current = initialState(options.device);
  }

  get state(): PlotterState {
    return this.current;
  }

  /** The built-in virtual machine while it is in use: gives access to the drawn line and simulated faults. */
  get virtualMachine(): VirtualMachine | null {
    return this.connection?.kind === "virtual" ? this.virtual : null;
  }

  onChange(listener: (state: PlotterState) => void): void {
    this.listeners.push(listener);
  }

  /** Tells the listeners that something has changed. */
  protected announce(): void {
    for (const listener of this.listeners) listener(this.current);
  }

  /** Connects. Never rejects: errors are shown in `state`, and thrown by methods that need the board. */
  start(): Promise<void> {
    this.setState({ connection: "connecting", message: null });
    return this.startConnecting();
  }

  /** Resolves when it is known whether the board is connected: immediately, unless it is still connecting. */
  async settled(): Promise<void> {
    await this.connecting;
  }

  /** Commands and replies of the current connection, as text to download. */
  log(): string {
    return this.connection?.machine.log() ?? "";
  }

  /** Starts a plot. Rejects with `busy`, or with the error that prevents a connection. */
  async plot(planner: PlotPlanner, settings: PlotSettings, start: PlotStart = {}): Promise<RunningPlot> {
    await this.connecting;
    if (!this.isConnectedFor(settings)) await this.connectFor(settings);
    if (start.board && isOtherBoard(start.board, this.current)) {
      await this.byHand((machine) => machine.liftAndFreeMotors(settings));
    }
    const machine = this.idleMachine();
    this.settings = settings;
    this.machineChanged();
    const run = new MachinePlot(machine, planner, settings, startOn(this.current, start));
    this.run = run;
    const beginsHeld = start.held ?? (start.from ?? null) !== null;
    this.setState({ connection: "busy", activity: beginsHeld ? "held" : "plotting" });
    run.onHeld((held) => this.setState({ activity: held ? "held" : "plotting" }));
    run.onProgress((progress) => this.positionChanged(progress));
    run.finished.then(
      () => this.runEnded(),
      () => this.runEnded(),
    );
    return run;
  }

  /** Sets machine, speeds and heights for manual moves. Home stays the same, since it is a motor position. */
  use(settings: PlotSettings): void {
    this.chosen = this.isConnectedFor(settings) ? null : settings;
    if (this.chosen) void this.useChosen();
    else {
      this.settings = settings;
      this.machineChanged();
    }
  }

  /** Default settings: those of the last job or move. */
  async pen(
    request: { readonly up: boolean; readonly heightPct?: number | undefined },
    settings: PlotSettings = this.settings,
  ): Promise<void> {
    if (!this.isConnectedFor(settings)) await this.connectFor(settings);
    await this.byHand((machine) => {
      this.settings = settings;
      return machine.movePen(request.up, settings, request.heightPct);
    });
  }

  async motorsOff(): Promise<void> {
    await this.byHand((machine) => machine.motorsOff());
  }

  /**
   * Makes a manual move with the machine, speeds and heights of `settings`; default: those of the last job or
   * move. Rejects with `busy` while plotting, and with `out-of-bounds` for positions outside the machine.
   */
  async move(move: HandMove, settings: PlotSettings = this.settings): Promise<void> {
    if (!this.isConnectedFor(settings)) await this.connectFor(settings);
    await this.byHand((machine) => {
      this.settings = settings;
      return moveByHand(machine, move, settings);
    });
  }

  /** Stops a manual move at once, which then rejects with `conflict`. Resolves when the pen is up. */
  async stopMove(): Promise<void> {
    if (!this.movingByHand) return;
    this.machine?.stopAtOnce();
    await this.movingByHand;
  }

  /** Sends one line, returns the whole answer. `bad-setting` for commands that would break the connection. */
  async command(line: string): Promise<CommandAnswer> {
    return this.byHand((machine) => {
      if (!machine.console) throw noConsole();
      return machine.console.send(line);
    });
  }

  /** Closes the connection. During a move or a plot it first stops at once and lifts the pen. */
  async close(): Promise<void> {
    this.closed = true;
    this.cancelRetry?.();
    this.supply.stop();
    // Before the first await: from now on no job may start on this connection.
    this.setState({ connection: "absent", message: null });
    await this.connecting;
    const run = this.run;
    run?.fail(closedError());
    // Fails if the connection is lost; there is nothing left to do then.
    if (run || this.movingByHand) await this.machine?.stopAndLift(this.settings).catch(() => undefined);
    await this.connection?.machine.close();
    // It still waits for its next reply, and then fails.
    await this.movingByHand;
    this.virtual?.close();
  }

  private isConnectedFor(settings: PlotSettings): boolean {
    const [machine, before] = [machineOf(settings), machineOf(this.settings)];
    // A virtual machine has the switches of its model, or none.
    const hasSwitches = findsHome(machine) || findsHome(before);
    const isSame = machine.id === before.id || this.connection?.kind !== "virtual" || !hasSwitches;
    return isSame && machine.controller.kind === before.controller.kind;
  }

  /** Reconnects with the driver of these settings. If that fails, rejects and restores the previous settings. */
  private async connectFor(settings: PlotSettings): Promise<void> {
    await this.connecting;
    if (this.run || this.movingByHand) return;
    const before = this.settings;
    await this.reconnectFor(settings);
    if (this.machine) return;
    this.settings = before;
    throw this.trouble ?? notStarted();
  }

  private async useChosen(): Promise<void> {
    await this.connecting;
    const settings = this.chosen;
    if (!settings || this.closed || this.run || this.movingByHand) return;
    this.chosen = null;
    await this.reconnectFor(settings);
  }

  /** Reconnects with the driver of these settings. If that fails, the automatic attempts use it too. */
  private async reconnectFor(settings: PlotSettings): Promise<void> {
    this.settings = settings;
    const connection = this.connection;
    const virtual = this.virtual;
    this.supply.stop();
    this.penBefore = null;
    this.machine = this.connection = this.virtual = null;
    this.setState({ connection: "connecting", message: null, otherBoard: null, ...UNKNOWN });
    await connection?.machine.close().catch(() => undefined);
    virtual?.close();
    await this.startConnecting();
  }

  private startConnecting(): Promise<void> {
    if (this.closed) return Promise.resolve();
    this.connecting ??= this.connect().finally(() => {
      this.connecting = null;
    });
    return this.connecting;
  }

  private async connect(): Promise<void> {
    this.cancelRetry?.();
    try {
      const machine = machineOf(this.settings);
      const driver = await driverOf(machine);
      const connection = await connect({
        ...this.options,
        virtualIfNone: this.options.virtualIfNone !== false,
        hadBoard: this.hadSerial,
        speed: this.options.virtualSpeed ?? 1,
        driver,
        controller: controllerOf(machine),
        virtualMachine: () => (this.virtual ??= this.virtualOf(driver, machine)),
        events: {
          changed: () => this.machineChanged(),
          buttonPressed: () => void this.run?.pause().catch(() => undefined),
          supplyRead: (state) => this.supply.read(state),
          lost: (error) => this.lost(error),
        },
      });
      await this.adopt(connection);
    } catch (error) {
      this.lost(error instanceof PlotwrightError ? error : connectFailed(error));
    }
  }

  private virtualOf(driver: Driver, machine: MachineProfile): VirtualMachine {
    return driver.virtualMachine({
      clock: this.clock,
      speed: this.options.virtualSpeed ?? 1,
      firmware: this.options.firmware,
      springs: this.options.virtualSprings,
      machine,
    });
  }

  private async adopt(connection: ConnectedMachine): Promise<void> {
    if (this.closed) {
      await connection.machine.close();
      return;
    }
    this.connection = connection;
    this.hadSerial ||= connection.kind === "serial";
    const { machine } = connection;
    await machine.readKeptState(this.settings, this.penBefore);
    // close() closes the connection.
    if (this.closed) return;
    this.machine = machine;
    this.trouble = null;
    this.supply.watch(machine);
    this.machineChanged();
    const restedS = this.lostAtS === null ? null : this.clock.nowS() - this.lostAtS;
    this.lostAtS = null;
    this.setState({
      kind: connection.kind,
      device: connection.device,
      connection: "idle",
      otherBoard: null,
      boardName: machine.name ?? null,
      boardSerialNumber: connection.serialNumber,
      firmware: machine.firmware,
      message:
        machine.foundMidPlot?.penUp === false
          ? penRested(this.current, restedS)
          : (machine.note ?? welcome(connection.kind, this.options.device)),
    });
  }

  private lost(error: PlotwrightError): void {
    if (this.closed) return;
    this.trouble = error;
    if (this.machine) this.lostAtS = this.clock.nowS();
    this.supply.stop();
    if (this.machine) {
      const { penMoving, penUp, memory = null } = this.machine;
      this.penBefore = { penUp: penMoving ? null : penUp, memory };
    }
    this.machine = null;
    this.connection?.machine.close().catch(() => undefined);
    this.connection = null;
    // A held run does not notice the lost board by itself.
    this.run?.fail(error);
    this.setState(stateAfter(error));
    this.cancelRetry?.();
    this.cancelRetry = this.clock.after(RECONNECT_S, () => void this.startConnecting());
  }

  private runEnded(): void {
    this.run = null;
    this.setIdle();
    this.machineChanged();
  }

  /** Resolves when the motors are released. `isBack`: the supply failed only for a moment. */
  private async powerLost(isBack: boolean): Promise<void> {
    const settings = this.settings;
    const homes = findsHome(machineOf(settings));
    this.run?.fail(isBack ? powerFailed(homes) : powerLost(homes));
    this.setState({ connection: "fault", message: (isBack ? powerFailed(homes) : powerLow(homes)).message });
    const machine = this.machine;
    // A manual move, or the way home of a cancelled plot.
    machine?.stopAtOnce();
    try {
      await machine?.forgetPosition();
      await machine?.liftAndFreeMotors(settings);
    } catch {
      // A lost connection is reported by the machine's own event.
    }
  }

  private async byHand<T>(action: (machine: Machine) => Promise<T>): Promise<T> {
    await this.connecting;
    const machine = this.idleMachine();
    const { stopSignal } = machine;
    const moved = action(machine).catch(async (error: unknown) => {
      // A move that was stopped may have left the pen on the paper.
      const isStopped = stopSignal.aborted && this.machine === machine && !this.closed;
      if (isStopped && machine.penUp !== true) await machine.movePen(true, this.settings);
      throw error;
    });
    this.movingByHand = moved.then(
      () => undefined,
      () => undefined,
    );
    this.setState({ connection: "busy", activity: "moving" });
    try {
      return await moved;
    } finally {
      this.movingByHand = null;
      this.setIdle();
    }
  }

  private setIdle(): void {
    const isReady = this.machine && !this.closed && !this.supply.isLow;
    this.setState({ activity: "none", ...(isReady ? { connection: "idle" } : {}) });
    void this.useChosen();
  }

  /** The machine, for one request. Use it before the next await: another request could take it meanwhile. */
  private idleMachine(): Machine {
    if (this.closed) throw closedError();
    if (this.run) {
      throw new PlotwrightError("busy", "The plotter is plotting: cancel the plot or wait until it ends.");
    }
    if (this.movingByHand) {
      throw new PlotwrightError("busy", "The plotter is still moving: wait until it stops.");
    }
    if (!this.machine) throw this.trouble ?? notStarted();
    if (this.supply.isLow) throw powerLow(findsHome(machineOf(this.settings)));
    return this.machine;
  }

  private machineChanged(): void {
    const machine = this.machine;
    if (!machine) return;
    const position = machine.positionMm(machineOf(this.settings));
    this.setState({
      emergencyStopMs: machine.emergencyStopMs(this.settings),
      penUp: machine.penUp,
      penMoving: machine.penMoving,
      heightUnsure: machine.height?.isUnsure ?? false,
      motorsOn: machine.motorsOn,
      xMm: position?.x ?? null,
      yMm: position?.y ?? null,
    });
  }

  /** Updates the position. While plotting it is not announced here, since the run's progress reports it. */
  private positionChanged({ xMm, yMm, penUp, penMoving }: PlotProgress): void {
    // A run that ends because the connection is lost still reports a position, which is then unknown.
    if (this.machine) this.current = { ...this.current, xMm, yMm, penUp, penMoving };
  }

  private setState(change: Partial<PlotterState>): void {
    const keys = Object.keys(change) as (keyof PlotterState)[];
    if (keys.every((key) => this.current[key] === change[key])) return;
    this.current = { ...this.current, ...change };
    this.announce();
  }
}
