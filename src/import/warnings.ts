/** Collects features that will not be drawn as seen on screen, counted by kind, with the first few positions. */
import type { Drawing, DrawingWarning } from "../drawing/drawing.js";
import { isEmptyBox, type Box } from "../geometry/box.js";
import { getOrAdd } from "../get-or-add.js";
import type { WARNING_WORDS } from "./warning-words.js";

const MAX_BOXES = 20;
const MAX_DETAILS = 3;

export type WarningCode = keyof typeof WARNING_WORDS;

interface Entry {
  count: number;
  readonly boxes: (readonly [number, number, number, number])[];
  readonly details: string[];
}

export class Warnings {
  private readonly entries = new Map<WarningCode, Entry>();

  /**
   * @param box in page mm
   * @param detail named in the message for the first few
   */
  add(code: WarningCode, box?: Box, detail?: string, count = 1): void {
    const entry = getOrAdd(this.entries, code, () => ({ count: 0, boxes: [], details: [] }));
    entry.count += count;
    if (box !== undefined && entry.boxes.length < MAX_BOXES && isUsable(box))
      entry.boxes.push([box.x0, box.y0, box.x1, box.y1]);
    if (detail !== undefined && entry.details.length < MAX_DETAILS && !entry.details.includes(detail)) {
      entry.details.push(detail);
    }
  }

  /** Moves the positions recorded so far, along with the drawing. */
  translate(dx: number, dy: number): void {
    for (const { boxes } of this.entries.values()) {
      boxes.forEach(([x0, y0, x1, y1], i) => {
        boxes[i] = [x0 + dx, y0 + dy, x1 + dx, y1 + dy];
      });
    }
  }

  toArray(): CountedWarning[] {
    return Array.from(this.entries, ([code, { count, boxes, details }]) => {
      const more = details.length < count && details.length === MAX_DETAILS ? " …" : "";
      const named = details.length === 0 ? "" : ` (${details.join("; ")}${more})`;
      return { code, count, boxes, named };
    });
  }
}

/** A warning before it has a message. */
export interface CountedWarning extends Omit<DrawingWarning, "code" | "message"> {
  readonly code: WarningCode;
  /** The first few details, for the message. */
  readonly named: string;
}

/** A drawing as its reader makes it. */
export type ReadDrawing = Omit<Drawing, "warnings"> & { readonly warnings: readonly CountedWarning[] };

/** The drawing with the messages of its warnings. */
export const inWords = (drawing: ReadDrawing, words: typeof WARNING_WORDS): Drawing => ({
  ...drawing,
  warnings: drawing.warnings.map(({ code, count, boxes, named }) => ({
    code,
    message: words[code](count, named),
    count,
    boxes,
  })),
});

const isUsable = (box: Box): boolean =>
  !isEmptyBox(box) && Number.isFinite(box.x0 + box.y0 + box.x1 + box.y1);
