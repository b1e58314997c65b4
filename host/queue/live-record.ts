/**
 * Stores a live drawing while it grows, as an SVG file with one path for each stroke. What is stored is always a whole
 * file: new points replace its end, which is written again after them. So nothing has to be repaired after a crash.
 *
 *   <svg …><g …>
 *   <path d="M20 30h0        each stroke; h0: so that one of a single point is a dot
 *   L21 30.5                 a point on each line
 *   "/>
 *   </g></svg>
 */
import type { MachineProfile } from "../../src/index.js";
import type { StrokeRecord } from "../plotter/live-strokes.js";
import type { GrowingDrawing } from "../storage.js";

/** Time between two writes. */
const WRITE_MS = 100;
const STROKE_END = '"/>\n';
const FILE_END = "</g></svg>\n";

export class LiveRecord implements StrokeRecord {
  /** What the file has without its end, in characters; all are ASCII. */
  private storedLength: number;
  /** Text after that. */
  private unstored: string[] = [];
  private unstoredLength = 0;
  private strokeCount = 0;
  private isChanged = false;
  private timer: ReturnType<typeof setTimeout> | null = null;
  private writing: Promise<void> = Promise.resolve();

  /** `file` has `emptyDrawing` of the machine. `failed`: called once if it can't be written. */
  constructor(
    private readonly file: GrowingDrawing,
    machine: DrawnArea,
    private readonly failed: (error: unknown) => void,
  ) {
    this.storedLength = fileBegin(machine).length;
  }

  begin(x: number, y: number): void {
    this.append(beginText(x, y, this.strokeCount === 0));
    this.strokeCount++;
  }

  add(x: number, y: number): void {
    this.append(pointText(x, y));
  }

  takeBack(xy: Float64Array, withBegin: boolean): void {
    let length = 0;
    for (let i = withBegin ? 2 : 0; i < xy.length; i += 2) length += pointText(xy[i], xy[i + 1]).length;
    if (withBegin) {
      this.strokeCount--;
      length += beginText(xy[0], xy[1], this.strokeCount === 0).length;
    }
    this.shorten(length);
  }

  /** Stores everything. */
  async close(): Promise<void> {
    if (this.timer !== null) clearTimeout(this.timer);
    this.write();
    await this.writing;
    await this.file.close();
  }

  private append(text: string): void {
    this.unstored.push(text);
    this.unstoredLength += text.length;
    this.changed();
  }

  private shorten(length: number): void {
    const kept = Math.max(0, this.unstoredLength - length);
    this.storedLength -= Math.max(0, length - this.unstoredLength);
    this.unstored = [this.unstored.join("").slice(0, kept)];
    this.unstoredLength = kept;
    this.changed();
  }

  private changed(): void {
    this.isChanged = true;
    this.timer ??= setTimeout(() => this.write(), WRITE_MS);
  }

  private write(): void {
    this.timer = null;
    if (!this.isChanged) return;
    const { storedLength, strokeCount } = this;
    const text = this.unstored.join("");
    this.storedLength += text.length;
    this.unstored = [];
    this.unstoredLength = 0;
    this.isChanged = false;
    const end = (strokeCount > 0 ? STROKE_END : "") + FILE_END;
    this.writing = this.writing
      .then(() => this.file.write(storedLength, text + end))
      .catch((error: unknown) => this.failed(error));
  }
}

type DrawnArea = Pick<MachineProfile, "widthMm" | "heightMm">;

const fileBegin = ({ widthMm, heightMm }: DrawnArea): string =>
  `<svg xmlns="http://www.w3.org/2000/svg" xmlns:inkscape="http://www.inkscape.org/namespaces/inkscape" width="${widthMm}mm" height="${heightMm}mm" viewBox="0 0 ${widthMm} ${heightMm}">\n<g id="live" inkscape:groupmode="layer" inkscape:label="Live" fill="none" stroke="#000" stroke-width="0.3" stroke-linecap="round" stroke-linejoin="round">\n`;

/** The file of a live drawing that has no strokes yet, on a page as large as the machine reaches. */
export const emptyDrawing = (machine: DrawnArea): string => fileBegin(machine) + FILE_END;

const beginText = (x: number, y: number, isFirst: boolean): string =>
  `${isFirst ? "" : STROKE_END}<path d="M${mm(x)} ${mm(y)}h0\n`;

const pointText = (x: number, y: number): string => `L${mm(x)} ${mm(y)}\n`;

/** To a tenth of a micrometre. */
const mm = (value: number): string => String(Math.round(value * 1e4) / 1e4);
