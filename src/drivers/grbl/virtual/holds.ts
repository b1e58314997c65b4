/** How the virtual Grbl stops by a hold or by its door, and goes on. */
import type { Dwell } from "./dwell.js";
import type { Modes } from "./gcode-words.js";
import type { GrblMotion } from "./motion.js";
import type { States } from "./states.js";
import type { VirtualPen } from "./virtual-pen.js";
import type { VirtualSettings } from "./virtual-settings.js";

export interface HeldBoard {
  readonly settings: VirtualSettings;
  readonly states: States;
  readonly motion: GrblMotion;
  readonly modes: Modes;
  readonly pen: VirtualPen;
  readonly wait: Dwell;
  nowS(): number;
  reply(line: string): void;
  /** The queue does not begin to move by itself. */
  cancelStart(): void;
  /** The search for its switches ends with this alarm. */
  failHoming(alarm: number): void;
}

export class Holds {
  constructor(private readonly board: HeldBoard) {}

  hold(): void {
    const { states, wait, motion } = this.board;
    if (states.cannotHold || states.isAsleep) return;
    wait.hold(this.board.nowS());
    states.isHeld = true;
    this.board.cancelStart();
    if (motion.isMoving) motion.hold();
    else this.rested();
  }

  stopForDoor(): void {
    const { states, settings } = this.board;
    if (states.isHoming) return this.board.failHoming(7);
    if (states.cannotHold) return;
    this.board.reply(settings.face.message("Check Door"));
    if (states.isAsleep) return;
    states.door.stop();
    this.hold();
  }

  resume(): void {
    const { states, motion, modes, pen } = this.board;
    const nowS = this.board.nowS();
    if (!states.isHeld || motion.isMoving) return;
    if (states.door.state === null) return this.goOn(nowS);
    if (!states.door.resume(nowS, modes.signal !== null)) return;
    pen.signal(modes.signal, nowS);
    if (states.door.hasResumed(nowS)) this.goOn(nowS);
  }

  goOn(nowS: number): void {
    const { states, wait, motion } = this.board;
    states.isHeld = false;
    wait.goOn(nowS);
    if (!motion.isEmpty) motion.go(nowS);
  }

  /** It has come to rest, or was at rest. */
  rested(): void {
    const { states, motion, pen } = this.board;
    if (states.door.rested()) pen.signal(null, this.board.nowS());
    // A hold ends a jog.
    if (states.isJogging && states.isHeld) {
      motion.stop();
      states.isHeld = states.door.state !== null;
    }
    if (motion.isEmpty) states.isJogging = false;
  }
}
