/**
 * The safety door of the virtual Grbl. While it is open nothing moves, the output for the spindle (or the pen's servo) is
 * off, and no line is read. A closed door does not resume by itself: `~` does.
 */

/** How long Grbl waits for a spindle that has to run again, s. */
const SPIN_UP_S = 4;

type Phase = "none" | "stopping" | "waiting" | "resuming";

export class Door {
  /** Its switch. */
  isOpen = false;
  private phase: Phase = "none";
  private resumedAtS = Infinity;

  /** `resumingState`: how its reports number a machine that resumes. */
  constructor(private readonly resumingState: number) {}

  /** "Door:1" …; null if the door stops nothing. */
  get state(): string | null {
    if (this.phase === "none") return null;
    if (this.phase === "resuming") return `Door:${this.resumingState}`;
    if (this.phase === "stopping") return "Door:2";
    return this.isOpen ? "Door:1" : "Door:0";
  }

  /** When the wait for the spindle ends; Infinity: there is none. */
  get nextS(): number {
    return this.resumedAtS;
  }

  stop(): void {
    this.phase = "stopping";
    this.resumedAtS = Infinity;
  }

  /** The machine has come to rest. Returns whether its output has to be switched off now. */
  rested(): boolean {
    if (this.phase !== "stopping") return false;
    this.phase = "waiting";
    return true;
  }

  /** `~`. Returns false if the door is open, or the machine has not stopped yet. */
  resume(nowS: number, isSpindleOn: boolean): boolean {
    if (this.phase !== "waiting" || this.isOpen) return false;
    this.phase = "resuming";
    this.resumedAtS = nowS + (isSpindleOn ? SPIN_UP_S : 0);
    return true;
  }

  /** Returns whether the machine resumes its motion now. */
  hasResumed(nowS: number): boolean {
    if (this.resumedAtS > nowS) return false;
    this.reset();
    return true;
  }

  reset(): void {
    this.phase = "none";
    this.resumedAtS = Infinity;
  }
}
