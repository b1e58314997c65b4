/** The files that the page has sent, read once: those of the last plan, and those measured since then. */
import type { Drawing } from "../../src/index.js";
import type { DrawingText } from "../backend/drawing-text.js";
import type { WorkerFile } from "./protocol.js";

export class SentFiles {
  private readonly files = new Map<string, DrawingText | Promise<Drawing>>();

  /** Forgets all other files. */
  keep(wanted: readonly WorkerFile[]): void {
    const keys = new Set(wanted.map(({ key }) => key));
    for (const key of this.files.keys()) if (!keys.has(key)) this.files.delete(key);
    for (const file of wanted) this.add(file);
  }

  add({ key, text }: WorkerFile): void {
    if (text !== null) this.files.set(key, text);
  }

  read(key: string): Promise<Drawing> {
    const file = this.files.get(key);
    if (file === undefined) throw new Error("the worker was asked for a drawing whose text it does not have");
    if (file instanceof Promise) return file;
    const reading = drawingIn(file);
    this.files.set(key, reading);
    return reading;
  }
}

/** The readers are loaded when the first file is opened. */
async function drawingIn(content: DrawingText): Promise<Drawing> {
  const { importDrawing, textOf } = await import("./formats.js");
  return importDrawing("", textOf(content));
}
