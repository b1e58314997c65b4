/** A live drawing, as a program uses it. Its points go to the plotter of this program, or to a server. */
import type { LiveUndone } from "../../src/schema/index.js";
import type { LivePoints } from "../plotter/live-strokes.js";
import type { LiveDrawing, PlotResult } from "./plotter-handle.js";

/** Takes the strokes of a live drawing: `LiveStrokes`, or what sends them to a server (live-sender.ts). */
export interface TakesStrokes {
  stroke(points: LivePoints): void;
  lineTo(x: number, y: number): void;
  penUp(): void;
  undo(): LiveUndone | Promise<LiveUndone>;
  end(): void;
  /** Resolves when there is room for more points. */
  room(): Promise<void>;
  /** Resolves when everything so far is drawn. */
  idle(): Promise<void>;
}

/** A live drawing that has begun. */
export interface BegunLive {
  readonly strokes: TakesStrokes;
  readonly ended: Promise<PlotResult>;
}

export class ProgramsLive implements LiveDrawing {
  private isEnding = false;

  constructor(
    private readonly strokes: TakesStrokes,
    private readonly ended: () => Promise<PlotResult>,
  ) {}

  stroke(points: LivePoints): Promise<void> {
    return this.add(() => this.strokes.stroke(points));
  }

  lineTo(x: number, y: number): Promise<void> {
    return this.add(() => this.strokes.lineTo(x, y));
  }

  penUp(): void {
    this.strokes.penUp();
  }

  async undo(): Promise<LiveUndone> {
    return this.strokes.undo();
  }

  idle(): Promise<void> {
    return this.strokes.idle();
  }

  /** Called again, it resolves with the same end. */
  async end(): Promise<PlotResult> {
    if (!this.isEnding) this.strokes.end();
    this.isEnding = true;
    return this.ended();
  }

  /** A program that does not wait for room gets the error when it waits for something else. */
  private add(add: () => void): Promise<void> {
    const added = (async () => {
      add();
      await this.strokes.room();
    })();
    added.catch(() => undefined);
    return added;
  }
}
