/** How the virtual Grbl performs a line that begins with `$`. */
import type { Coordinates } from "./coordinates.js";
import { ERROR, wordsOf, type GcodeWords, type Modes } from "./gcode-words.js";
import type { GrblMotion } from "./motion.js";
import type { States } from "./states.js";
import type { VirtualSettings } from "./virtual-settings.js";

export interface DollarTarget {
  readonly settings: VirtualSettings;
  readonly motion: GrblMotion;
  readonly modes: Modes;
  readonly coordinates: Coordinates;
  readonly states: States;
  reply(line: string): void;
  /** Seeks its switches. The line is answered at the end. */
  seekSwitches(): void;
  /** Begins again, as after a reset. */
  begin(): void;
}

const HELP = "[HLP:$$ $# $G $I $N $x=val $Nx=line $J=line $SLP $C $X $H ~ ! ? ctrl-x]";

export class DollarLines {
  constructor(private readonly board: DollarTarget) {}

  /** `line`: without blanks, in capitals. Returns 0 if it is done, the code of an error, or null if it is answered later. */
  perform(line: string): number | null {
    const { board } = this;
    if (line === "$") board.reply(HELP);
    else if (line === "$G") board.reply(board.settings.face.modes(board.modes.words));
    else if (line === "$X") return this.unlock();
    else if (line === "$H") return this.seekSwitches();
    else return this.atRest(line);
    return 0;
  }

  /** Lines that need a machine at rest. */
  private atRest(line: string): number {
    const { settings, states, motion, reply } = this.board;
    const [, number, value] = /^\$(\d+)=(-?[\d.]+)$/.exec(line) ?? [];
    const jog = line.startsWith("$J=G91") ? wordsOf(line.slice(6)) : null;
    const isKnown = /^\$([$IC]|SLP)$/.test(line) || number !== undefined || jog !== null;
    if (!isKnown) return ERROR.dollar;
    if (!motion.isEmpty && !states.isLocked) return ERROR.busy;
    if (line === "$I") for (const info of settings.info) reply(info);
    else if (line === "$$") for (const setting of settings.list()) reply(setting);
    else if (line === "$SLP") states.isAsleep = true;
    else if (line === "$C") this.check();
    else if (jog !== null) return this.jog(jog);
    else {
      settings.offsetDue = 0;
      return settings.set(Number(number), Number(value)) ? 0 : ERROR.dollar;
    }
    return 0;
  }

  private unlock(): number {
    const { states, reply } = this.board;
    if (!states.isLocked) return 0;
    if (states.door.isOpen) return ERROR.door;
    if (states.isStopPressed) return ERROR.stop;
    reply("[MSG:Caution: Unlocked]");
    states.isLocked = false;
    return 0;
  }

  private seekSwitches(): number | null {
    const { settings, states } = this.board;
    if (!settings.hasHoming) return ERROR.noHoming;
    if (states.door.isOpen) return ERROR.door;
    this.board.seekSwitches();
    return null;
  }

  private check(): void {
    const { states, reply } = this.board;
    const begins = !states.isChecking;
    reply(begins ? "[MSG:Enabled]" : "[MSG:Disabled]");
    if (!begins) this.board.begin();
    states.isChecking = begins;
  }

  /** A relative move in X and Y. */
  private jog(line: GcodeWords | number): number {
    const { motion, coordinates, states } = this.board;
    if (typeof line === "number" || !line.words.has("F")) return ERROR.jog;
    const along = (letter: string): number => line.words.get(letter) ?? 0;
    const [x, y, z] = motion.end;
    motion.queue(coordinates.onSteps([x + along("X"), y + along("Y"), z]), along("F") / 60);
    states.isJogging = true;
    return 0;
  }
}
