/**
 * The stored plotters. Plotters can be added, changed and removed at any time. Every change is stored before it is
 * announced.
 */
import { PlotwrightError } from "../../src/index.js";
import { machineOf } from "../../src/internal.js";
import {
  DEFAULT_PLOT_SETTINGS,
  plotterSettingsSchema,
  type AskedDevice,
  type Device,
  type NewPlotter,
  type Plotter,
  type PlotterPatch,
  type PlotterSettings,
  type PlotSettings,
  type ServerEvent,
} from "../../src/schema/index.js";
import type { ManagedPlotter, PlotterPort } from "./plotter-port.js";
import type { PlotterRow, PlotterStore } from "../storage.js";
import type { AskedPort } from "./ask-ports.js";
import type { FoundBoard } from "./devices.js";
import { settingsOfPlotter, type SettingsOfPlotter, type WithMachine } from "./settings-of-plotter.js";

interface RegistryParts {
  readonly store: PlotterStore;
  /** Opens a plotter, which connects in the background. */
  readonly open: (
    row: PlotterRow,
    isTaken: (path: string) => boolean,
    settings: PlotSettings,
  ) => ManagedPlotter;
  readonly withMachine: WithMachine;
  readonly findBoards: () => Promise<readonly FoundBoard[]>;
  readonly askPorts: (isTaken: (path: string) => boolean) => Promise<readonly AskedPort[]>;
  readonly announce: (event: ServerEvent) => void;
  /** Id of the plotter that a new server starts with. */
  readonly firstId: string;
  /**
   * Device of the first plotter for this run only; default: the stored one, which is "auto" on the first
   * start.
   */
  readonly firstDevice?: string | undefined;
}

/** How jobs that have not ended use a plotter. */
interface PlotterUse {
  isPlotterBusy(plotterId: string): boolean;
  liveJobCount(plotterId: string): number;
}

export class PlotterRegistry {
  private readonly rows = new Map<string, PlotterRow>();
  private readonly portById = new Map<string, ManagedPlotter>();
  /** Patches and removals run one after the other. */
  private turn: Promise<unknown> = Promise.resolve();
  private isClosed = false;

  constructor(private readonly parts: RegistryParts) {
    const { store, firstId } = parts;
    if (store.plotters().length === 0) {
      store.savePlotter({ id: firstId, name: null, device: "auto", machine: null });
    }
    store.plotters().forEach((row, index) => {
      const device = index === 0 ? (parts.firstDevice ?? row.device) : row.device;
      this.rows.set(row.id, { ...row, device });
    });
    // Open only after all rows are known, so that a plotter with "auto" does not take the board of another.
    for (const row of this.rows.values()) this.open(row);
  }

  /** The plotters by id. The map stays up to date. */
  get ports(): ReadonlyMap<string, PlotterPort> {
    return this.portById;
  }

  list(): Plotter[] {
    return [...this.portById.values()].map((port) => port.snapshot());
  }

  /** By plotter id. A plotter without settings, or with an unreadable record, is left out. */
  settings(): Record<string, PlotterSettings> {
    return Object.fromEntries(
      Object.entries(this.parts.store.plotterSettings()).flatMap(([id, stored]) => {
        const parsed = plotterSettingsSchema.safeParse(stored);
        return parsed.success ? [[id, parsed.data]] : [];
      }),
    );
  }

  /** The settings from which jobs and manual moves start. `last`: those of its last job. */
  settingsOf(id: string, last?: PlotSettings): SettingsOfPlotter {
    const machine = this.rows.get(id)?.machine ?? null;
    return settingsOfPlotter({ machine, own: this.settings()[id], last }, this.parts.withMachine);
  }

  /** Throws `not-found`. */
  saveSettings(id: string, settings: PlotterSettings): PlotterSettings {
    this.find(id);
    this.parts.store.savePlotterSettings(id, settings);
    this.parts.announce({ type: "plotter-settings", plotterId: id, settings });
    return settings;
  }

  async devices(): Promise<Device[]> {
    return (await this.parts.findBoards()).map((board) => this.deviceOf(board));
  }

  /** Not those that plotters use: these are known. */
  async askDevices(): Promise<AskedDevice[]> {
    const [boards, asked] = await Promise.all([
      this.parts.findBoards(),
      this.parts.askPorts((path) => this.userOf(path) !== undefined),
    ]);
    const answers = new Map(asked.map(({ path, answer, fault }) => [path, { answer, fault }]));
    return boards.map((board) => ({
      ...this.deviceOf(board),
      ...(answers.get(board.path) ?? { answer: null, fault: null }),
    }));
  }

  private userOf(path: string): Plotter | undefined {
    return this.list().find((plotter) => plotter.device === path);
  }

  private deviceOf({ path, description, serialNumber }: FoundBoard): Device {
    return {
      path,
      description: serialNumber === null ? description : `${description} ${serialNumber}`,
      inUseBy: this.userOf(path)?.id ?? null,
    };
  }

  /** Throws `conflict` if another plotter has the name or device. */
  add({ name, device, machine = null }: NewPlotter): Plotter {
    this.mustBeFree(name, device, null);
    if (machine !== null) this.mustBeMachine(machine);
    const row = { id: this.newId(name), name, device, machine };
    this.parts.store.savePlotter(row);
    this.rows.set(row.id, row);
    const port = this.open(row);
    this.announce();
    return port.snapshot();
  }

  /**
   * A new device makes it reconnect. Throws `busy` for a new device or machine while a job is being plotted.
   */
  patch(id: string, patch: PlotterPatch, use: PlotterUse): Promise<Plotter> {
    return this.inTurn(() => this.patchNow(id, patch, use));
  }

  private async patchNow(id: string, patch: PlotterPatch, use: PlotterUse): Promise<Plotter> {
    const { row, port } = this.find(id);
    const { name = row.name, device = row.device, machine = row.machine } = patch;
    this.mustBeFree(patch.name ?? null, patch.device ?? null, id);
    if (typeof patch.machine === "string") this.mustBeMachine(patch.machine);
    const isMoved = device !== row.device;
    const isOther = machine !== row.machine;
    if ((isMoved || isOther) && use.isPlotterBusy(id)) {
      throw new PlotwrightError("busy", "A job is on the plotter. Cancel it first, or wait until it ends.");
    }
    const next = { id, name, device, machine };
    // A device that was set for this run only is not stored.
    const storedDevice =
      patch.device ?? this.parts.store.plotters().find((one) => one.id === id)?.device ?? device;
    this.parts.store.savePlotter({ ...next, device: storedDevice });
    this.rows.set(id, next);
    if (isMoved) {
      await port.close();
      if (!this.isClosed) this.open(next);
    } else {
      if (isOther) port.useMachine(machine, this.settingsOf(id).settings);
      if (name !== null) port.rename(name);
    }
    this.announce();
    return this.find(id).port.snapshot();
  }

  /** The plotter as it is stored. */
  stored(id: string): PlotterRow | undefined {
    return this.rows.get(id);
  }

  /** Has the plotter search for its board again. Throws `busy` while a job is being plotted. */
  reconnect(id: string, use: PlotterUse): Promise<Plotter> {
    return this.inTurn(async () => {
      const { row, port } = this.find(id);
      if (use.isPlotterBusy(id)) {
        throw new PlotwrightError("busy", "A job is on the plotter. Cancel it first, or wait until it ends.");
      }
      // One whose board is lost still knows what the board may have forgotten, such as how high its pen is.
      if (port.snapshot().connection === "absent") await port.start();
      else {
        await port.close();
        if (!this.isClosed) this.open(row);
      }
      this.announce();
      return this.find(id).port.snapshot();
    });
  }

  /** Throws `conflict` while it has jobs that have not ended, and for the last plotter. */
  remove(id: string, use: PlotterUse): Promise<void> {
    return this.inTurn(() => this.removeNow(id, use));
  }

  private async removeNow(id: string, use: PlotterUse): Promise<void> {
    const { port } = this.find(id);
    const count = use.liveJobCount(id);
    if (count > 0) {
      const jobs = count === 1 ? "a job" : `${count} jobs`;
      throw new PlotwrightError("conflict", `The plotter has ${jobs}: move them to another one first.`);
    }
    if (this.portById.size === 1) throw new PlotwrightError("conflict", "The last plotter can't be removed.");
    this.parts.store.removePlotter(id);
    this.rows.delete(id);
    this.portById.delete(id);
    this.announce();
    await port.close();
  }

  async close(): Promise<void> {
    this.isClosed = true;
    await Promise.all([...this.portById.values()].map((port) => port.close()));
  }

  private inTurn<T>(work: () => Promise<T>): Promise<T> {
    const done = this.turn.then(work);
    this.turn = done.catch(() => undefined);
    return done;
  }

  private open(row: PlotterRow): ManagedPlotter {
    const isTaken = (path: string): boolean => this.ownerOf(path, row.id) !== undefined;
    const port = this.parts.open(row, isTaken, this.settingsOf(row.id).settings);
    port.onChange(() => {
      if (this.portById.get(row.id) !== port) return;
      this.parts.announce({ type: "plotter", plotter: port.snapshot() });
    });
    this.portById.set(row.id, port);
    return port;
  }

  private announce(): void {
    this.parts.announce({ type: "plotters", plotters: this.list() });
  }

  private find(id: string): { readonly row: PlotterRow; readonly port: ManagedPlotter } {
    const [row, port] = [this.rows.get(id), this.portById.get(id)];
    if (row === undefined || port === undefined) {
      throw new PlotwrightError("not-found", `There is no plotter ${id}.`);
    }
    return { row, port };
  }

  /** Throws `bad-setting` for an unknown machine id. */
  private mustBeMachine(machine: string): void {
    machineOf(this.parts.withMachine({ ...DEFAULT_PLOT_SETTINGS, machine }));
  }

  private mustBeFree(name: string | null, device: string | null, exceptId: string | null): void {
    const others = [...this.rows.values()].filter(({ id }) => id !== exceptId);
    if (name !== null && others.some((row) => row.name?.toLowerCase() === name.toLowerCase())) {
      throw new PlotwrightError("conflict", `There is already a plotter "${name}". Choose another name.`);
    }
    const owner = device === null ? undefined : this.ownerOf(device, exceptId);
    if (owner !== undefined) {
      throw new PlotwrightError(
        "conflict",
        `"${owner.name ?? owner.id}" already uses ${device ?? ""}. Choose another device.`,
      );
    }
  }

  /** The plotter that is set to this port or connected to it. "virtual" and "auto" may be used by many. */
  private ownerOf(device: string, exceptId: string | null): PlotterRow | undefined {
    if (device === "virtual" || device === "auto") return undefined;
    return [...this.rows.values()].find(
      ({ id, device: chosen }) =>
        id !== exceptId && (chosen === device || this.portById.get(id)?.snapshot().device === device),
    );
  }

  /** A readable id for links and scripts. Ids are never reused, since jobs in the history refer to removed plotters. */
  private newId(name: string): string {
    const word = name
      .toLowerCase()
      .replace(/[^a-z0-9]+/g, "-")
      .replace(/^-|-$/g, "");
    let nowMs = Date.now();
    const id = (): string => `${word === "" ? "plotter" : word}-${nowMs.toString(36)}`;
    // Different names may have the same word: "左" and "右" have none.
    while (this.rows.has(id())) nowMs++;
    return id();
  }
}
