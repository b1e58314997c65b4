/** A PNG of what will be on the paper, for assistants, most of which show no SVG. */
import { crc32, deflateSync } from "node:zlib";
import type { toJson } from "../../../src/internal.js";

export type StrokesOnPaper = ReturnType<typeof toJson>;

/** Of the longer side. Assistants scale larger pictures down. */
const LONG_SIDE_PX = 1200;
/** Half the width of a line. */
const RADIUS_PX = 1.25;
const INK = [32, 32, 32] as const;

/** The paper in white, the strokes in the colours of their layers. */
export function pictureOf(drawn: StrokesOnPaper): Buffer {
  const pxPerMm = LONG_SIDE_PX / Math.max(drawn.widthMm, drawn.heightMm);
  const widthPx = Math.max(1, Math.round(drawn.widthMm * pxPerMm));
  const heightPx = Math.max(1, Math.round(drawn.heightMm * pxPerMm));
  const raster = new Raster(widthPx, heightPx);
  for (const { color, strokesMm } of drawn.layers) {
    const ink = inkOf(color);
    for (const stroke of strokesMm) {
      raster.line(
        stroke.map((mm) => mm * pxPerMm),
        ink,
      );
    }
  }
  return pngOf(raster.rgb, widthPx, heightPx);
}

function inkOf(color: string | null): readonly [number, number, number] {
  const hex = /^#([\da-f]{2})([\da-f]{2})([\da-f]{2})/i.exec(color ?? "");
  return hex === null ? INK : [parseInt(hex[1], 16), parseInt(hex[2], 16), parseInt(hex[3], 16)];
}

class Raster {
  readonly rgb: Uint8Array;
  /** How much of each pixel is inked, so that the overlapping dots of one line do not make its edge darker. */
  private readonly inked: Float32Array;

  constructor(
    private readonly widthPx: number,
    private readonly heightPx: number,
  ) {
    this.rgb = new Uint8Array(3 * widthPx * heightPx).fill(255);
    this.inked = new Float32Array(widthPx * heightPx);
  }

  /** `xy`: x, y, x, y … in pixels; one point is a dot. */
  line(xy: readonly number[], ink: readonly [number, number, number]): void {
    this.dot(xy[0], xy[1], ink);
    for (let i = 2; i + 1 < xy.length; i += 2) {
      const [dx, dy] = [xy[i] - xy[i - 2], xy[i + 1] - xy[i - 1]];
      const dotCount = Math.ceil(2 * Math.hypot(dx, dy));
      for (let k = 1; k <= dotCount; k++) {
        this.dot(xy[i - 2] + (dx * k) / dotCount, xy[i - 1] + (dy * k) / dotCount, ink);
      }
    }
  }

  private dot(x: number, y: number, ink: readonly [number, number, number]): void {
    const reach = RADIUS_PX + 0.5;
    const [x0, x1] = [Math.max(0, Math.floor(x - reach)), Math.min(this.widthPx - 1, Math.floor(x + reach))];
    const [y0, y1] = [Math.max(0, Math.floor(y - reach)), Math.min(this.heightPx - 1, Math.floor(y + reach))];
    for (let py = y0; py <= y1; py++) {
      for (let px = x0; px <= x1; px++) {
        const coverage = Math.min(1, reach - Math.hypot(px + 0.5 - x, py + 0.5 - y));
        const at = py * this.widthPx + px;
        if (coverage <= this.inked[at]) continue;
        this.inked[at] = coverage;
        for (let i = 0; i < 3; i++) this.rgb[3 * at + i] = 255 + (ink[i] - 255) * coverage;
      }
    }
  }
}

/** An uncommented PNG of 8 bits for each of red, green and blue, without filters. */
function pngOf(rgb: Uint8Array, widthPx: number, heightPx: number): Buffer {
  const rows = Buffer.alloc((3 * widthPx + 1) * heightPx);
  for (let y = 0; y < heightPx; y++) {
    rows.set(rgb.subarray(3 * widthPx * y, 3 * widthPx * (y + 1)), (3 * widthPx + 1) * y + 1);
  }
  const header = Buffer.alloc(13);
  header.writeUInt32BE(widthPx, 0);
  header.writeUInt32BE(heightPx, 4);
  header.set([8, 2, 0, 0, 0], 8);
  const signature = Buffer.from([0x89, 0x50, 0x4e, 0x47, 0x0d, 0x0a, 0x1a, 0x0a]);
  return Buffer.concat([signature, chunk("IHDR", header), chunk("IDAT", deflateSync(rows)), chunk("IEND")]);
}

function chunk(type: string, data: Buffer = Buffer.alloc(0)): Buffer {
  const body = Buffer.concat([Buffer.from(type, "latin1"), data]);
  const [length, sum] = [Buffer.alloc(4), Buffer.alloc(4)];
  length.writeUInt32BE(data.length);
  sum.writeUInt32BE(crc32(body));
  return Buffer.concat([length, body, sum]);
}
