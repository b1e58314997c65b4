/** A board of another controller where one of the model's is expected: it is named, so that the user can choose its model. */
import { PlotwrightError } from "../../src/index.js";
import { allUsbIds, type UsbId } from "../../src/internal.js";
import type { Plotter } from "../../src/schema/index.js";
import { askPorts, type AskedPort, type AskParts, type PortAnswer } from "./ask-ports.js";

export type OtherBoard = NonNullable<Plotter["otherBoard"]>;

export class OtherBoardError extends PlotwrightError {
  constructor(
    readonly board: OtherBoard,
    options?: ErrorOptions,
    /** Its port; default: the message names none. */
    path?: string,
  ) {
    super(
      "no-board",
      `${path === undefined ? "" : `${path}: `}${board.answer} answers on this port, but the model has another controller: choose your plotter's model, or on the command line give it with --machine.`,
      options,
    );
  }
}

/** Null: nothing has answered. */
export const boardOf = ({ answer, controller }: PortAnswer): OtherBoard | null =>
  answer === null || controller === null ? null : { answer, controller };

/** The boards of other controllers on ports that the user has chosen for this program, which may therefore ask all of them. */
export class OtherBoards {
  /** By path. Some devices restart when they are asked, so each one is asked once while it is plugged in. */
  private readonly answers = new Map<string, AskedPort>();

  constructor(
    private readonly parts: AskParts,
    private readonly isTaken: (path: string) => boolean,
  ) {}

  /** `ownIds`: of the model's controller, whose devices have been asked. */
  async first(ownIds: readonly UsbId[]): Promise<OtherBoard | null> {
    const pathsOf = async (ids: readonly UsbId[]): Promise<Set<string>> =>
      new Set((await this.parts.devices.find(ids)).map(({ path }) => path));
    const [all, own] = [await pathsOf(allUsbIds()), await pathsOf(ownIds)];
    for (const path of this.answers.keys()) if (!all.has(path)) this.answers.delete(path);
    // Asking loads all drivers.
    if (all.size === own.size) return null;
    const isLeftOut = (path: string): boolean =>
      own.has(path) || this.answers.has(path) || this.isTaken(path);
    for (const asked of await askPorts(this.parts, isLeftOut)) this.answers.set(asked.path, asked);
    const others = [...this.answers.values()].filter(({ path }) => !own.has(path) && !this.isTaken(path));
    return others.map(boardOf).find((board) => board !== null) ?? null;
  }
}
