/** What state the virtual Grbl is in: the one that it reports, and whether it reads lines in it. */
import { Door } from "./door.js";
import type { GrblMotion } from "./motion.js";

export class States {
  isLocked = false;
  isAsleep = false;
  isHoming = false;
  /** A hold, or its door, has stopped it. */
  isHeld = false;
  /** Its emergency stop keeps it locked. */
  isStopPressed = false;
  /** Lines are only checked. */
  isChecking = false;
  isJogging = false;
  /** After some alarms it answers nothing until it is reset. */
  isDeaf = false;
  readonly door: Door;

  constructor(resumingState: number) {
    this.door = new Door(resumingState);
  }

  get readsLines(): boolean {
    return !this.isHeld && !this.isAsleep && !this.isDeaf;
  }

  /** A hold or a door does nothing now. */
  get cannotHold(): boolean {
    return this.isLocked || this.isChecking || this.isHoming;
  }

  /** After a reset; a lock stays. */
  begin(): void {
    this.isAsleep = this.isHoming = this.isHeld = this.isChecking = this.isJogging = this.isDeaf = false;
    this.door.reset();
  }

  name(motion: GrblMotion): string {
    if (this.isAsleep) return "Sleep";
    if (this.isHoming) return "Home";
    if (this.isLocked) return "Alarm";
    if (this.door.state !== null) return this.door.state;
    if (this.isHeld) return motion.isMoving ? "Hold:1" : "Hold:0";
    if (this.isChecking) return "Check";
    if (this.isJogging) return "Jog";
    return motion.isEmpty ? "Idle" : "Run";
  }
}
