/** How the virtual Grbl performs a line of G-code: it queues a move, waits, sets its work offset, or switches its output. */
import { dwellS } from "../model/grbl-controller.js";
import type { Coordinates } from "./coordinates.js";
import { ERROR, wordsOf, type Modes } from "./gcode-words.js";
import type { GrblMotion } from "./motion.js";
import { VirtualMoves } from "./moves.js";
import type { VirtualSettings } from "./virtual-settings.js";

export interface GcodeTarget {
  readonly settings: VirtualSettings;
  readonly motion: GrblMotion;
  readonly modes: Modes;
  readonly coordinates: Coordinates;
  /** Lines are only checked. */
  isChecking(): boolean;
  /** The signal of the output has changed. */
  signalChanged(): void;
  /** The line is answered after this time. `then` does what is left of it. */
  wait(seconds: number, then: () => void): void;
  /** M0: it stands as in a hold, and the line is answered when it is resumed. */
  waitForUser(): void;
  offsetChanged(): void;
  /** It stops with ALARM:2. */
  softLimit(): void;
}

export class GcodeLines {
  private readonly moves: VirtualMoves;

  constructor(private readonly board: GcodeTarget) {
    this.moves = new VirtualMoves(board);
  }

  /** A reset. */
  forget(): void {
    this.moves.forget();
  }

  /** Returns 0 if the line is done or queued, an error code if it is refused, null if it has to wait. */
  perform(line: string): number | null {
    const { modes: lasting, motion } = this.board;
    const block = wordsOf(line);
    if (typeof block === "number") return block;
    if (this.board.isChecking()) return 0;
    const { modes, words } = block;
    if (modes.includes("M0")) return this.pause();
    if (!lasting.takeTool(words)) return ERROR.highTool;
    const isChange = lasting.takeSpindle(block, motion.isEmpty);
    if (isChange === null) return null;
    if (isChange) {
      motion.mayRest();
      this.board.signalChanged();
    }
    if (modes.includes("G4")) return this.dwell(modes, words);
    if (modes.includes("G10")) return this.setOffset(words);
    return this.moves.take(modes, words);
  }

  /** A move in the same line, whose line end was lost, comes after the wait. */
  private dwell(modes: readonly string[], words: ReadonlyMap<string, number>): number | null {
    const { motion } = this.board;
    const seconds = words.get("P");
    if (seconds === undefined) return ERROR.noWait;
    if (!motion.isEmpty) return null;
    motion.mayRest();
    const rest = new Map(words);
    rest.delete("P");
    if (seconds <= 0) return this.moves.take(modes, rest);
    this.board.wait(dwellS(seconds), () => this.moves.takeAtOnce(modes, rest));
    return null;
  }

  private pause(): null {
    const { motion } = this.board;
    if (!motion.isEmpty) return null;
    motion.mayRest();
    this.board.waitForUser();
    return null;
  }

  private setOffset(words: ReadonlyMap<string, number>): number | null {
    const { motion, coordinates } = this.board;
    if (words.get("L") !== 20 || words.get("P") !== 1) return ERROR.unknown;
    if (!motion.isEmpty) return null;
    coordinates.setOffset(words, motion.at);
    this.board.offsetChanged();
    return 0;
  }
}
