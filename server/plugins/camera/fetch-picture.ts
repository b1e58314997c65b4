/**
 * Reads one picture from a camera's address: a still picture, or the first whole picture of an MJPEG stream.
 *
 * The address is an operator's choice, and may be in the local network: that is where cameras are. What answers there is
 * not trusted: time, bytes and redirects are limited, only pictures are taken, and errors never say what an answer had.
 */
import { pictureKindOf, type PictureKind } from "../../../src/schema/index.js";

export interface CameraPicture {
  readonly kind: PictureKind;
  readonly bytes: Uint8Array;
}

/** Why there is no picture, in words for the operator, without the address. */
export class CameraFault extends Error {}

export const CAMERA_LIMITS = { timeoutMs: 10_000, maxBytes: 8_000_000, maxRedirects: 3 };
type Limits = typeof CAMERA_LIMITS;

/** Rejects with a CameraFault. */
export async function fetchPicture(
  address: string,
  stop: AbortSignal,
  limits: Limits = CAMERA_LIMITS,
): Promise<CameraPicture> {
  const late = AbortSignal.timeout(limits.timeoutMs);
  try {
    return await pictureIn(await answerOf(address, AbortSignal.any([stop, late]), limits), limits);
  } catch (error) {
    if (error instanceof CameraFault) throw error;
    if (late.aborted)
      throw new CameraFault(`The camera sent no picture within ${limits.timeoutMs / 1000} s.`);
    const { code = "" } = ((error as Error).cause ?? {}) as NodeJS.ErrnoException;
    throw new CameraFault(`The camera can't be reached${/^E[A-Z]+$/.test(code) ? ` (${code})` : ""}.`);
  }
}

/** Follows redirects. The name and password of the address go only to its own server. */
async function answerOf(address: string, signal: AbortSignal, { maxRedirects }: Limits): Promise<Response> {
  let url = new URL(address);
  const { origin, username, password } = url;
  const known = `${decoded(username)}:${decoded(password)}`;
  const authorization = `Basic ${Buffer.from(known).toString("base64")}`;
  for (let count = 0; count <= maxRedirects; count++) {
    url.username = url.password = "";
    const isOwn = username !== "" && url.origin === origin;
    const headers = { accept: "image/*, multipart/x-mixed-replace", ...(isOwn ? { authorization } : {}) };
    const response = await fetch(url, { headers, redirect: "manual", signal });
    const location = response.headers.get("location");
    if (response.status < 300 || response.status >= 400 || location === null) return response;
    await response.body?.cancel();
    const next = URL.canParse(location, url.href) ? new URL(location, url) : null;
    if (next === null || !/^https?:$/.test(next.protocol)) {
      throw new CameraFault("The camera redirects to an address that is not http or https.");
    }
    url = next;
  }
  throw new CameraFault(`The camera redirects more than ${maxRedirects} times.`);
}

/** A password may have a "%" that was typed as it is. */
function decoded(text: string): string {
  try {
    return decodeURIComponent(text);
  } catch {
    return text;
  }
}

async function pictureIn(response: Response, { maxBytes }: Limits): Promise<CameraPicture> {
  const { status, headers, body } = response;
  const type = headers.get("content-type")?.toLowerCase() ?? "";
  const isStream = type.startsWith("multipart/");
  const isPicture = isStream || /^(image\/|application\/octet-stream|$)/.test(type);
  try {
    if (status === 401 || status === 403) {
      throw new CameraFault(`The camera asks for a name and a password (HTTP ${status}).`);
    }
    if (status !== 200) throw new CameraFault(`The camera answers with HTTP ${status}.`);
    if (!isPicture || body === null) {
      throw new CameraFault("What is at this address is neither a still picture nor an MJPEG stream.");
    }
    const reader = new PictureReader(isStream, maxBytes);
    for await (const chunk of body) {
      const picture = reader.read(chunk);
      if (picture !== null) return picture;
    }
    return reader.atEnd();
  } finally {
    // Ends the connection to a stream that would never end.
    if (body !== null && !body.locked) await body.cancel().catch(() => undefined);
  }
}

/** In a stream, what may come before its first picture: the text of a part. */
const MAX_BEFORE_BYTES = 64_000;

/** Takes the bytes of an answer as they come, until they have a whole picture. */
export class PictureReader {
  private bytes = Buffer.alloc(64 * 1024);
  private count = 0;
  private readonly end = new JpegEnd();
  private hasBegun: boolean;

  constructor(
    isStream: boolean,
    private readonly maxBytes: number,
  ) {
    this.hasBegun = !isStream;
  }

  /** Null: the picture is not complete. */
  read(chunk: Uint8Array): CameraPicture | null {
    if (this.count + chunk.length > this.maxBytes) {
      throw new CameraFault(`The camera's picture is larger than ${this.maxBytes / 1e6} MB.`);
    }
    this.append(chunk);
    if (!this.hasBegun && !this.findBegin()) return null;
    const got = this.bytes.subarray(0, this.count);
    if (this.count < 12) return null;
    const kind = pictureKindOf(got);
    if (kind === null) throw notAPicture();
    if (kind !== "jpg") return null;
    const end = this.end.find(got);
    return end === null ? null : { kind, bytes: got.slice(0, end) };
  }

  /** A picture that is no JPEG ends with the answer. */
  atEnd(): CameraPicture {
    const bytes = this.bytes.subarray(0, this.count);
    const kind = this.hasBegun ? pictureKindOf(bytes) : null;
    if (kind === null) throw notAPicture();
    if (kind === "jpg") throw new CameraFault("The camera's picture is cut short.");
    return { kind, bytes };
  }

  private append(chunk: Uint8Array): void {
    if (this.count + chunk.length > this.bytes.length) {
      const larger = Buffer.alloc(2 * (this.count + chunk.length));
      larger.set(this.bytes.subarray(0, this.count));
      this.bytes = larger;
    }
    this.bytes.set(chunk, this.count);
    this.count += chunk.length;
  }

  /** Drops what is before the first picture of a stream. */
  private findBegin(): boolean {
    const at = this.bytes.subarray(0, this.count).indexOf(JPEG_BEGIN);
    if (at < 0 && this.count > MAX_BEFORE_BYTES) throw notAPicture();
    if (at < 0) return false;
    this.bytes = this.bytes.subarray(at);
    this.count -= at;
    this.hasBegun = true;
    return true;
  }
}

const notAPicture = (): CameraFault =>
  new CameraFault("What the camera sends is no picture: it has to be JPEG (also as MJPEG), PNG or WebP.");

const JPEG_BEGIN = Buffer.from([0xff, 0xd8, 0xff]);
const [END, SCAN, RESTART_0, RESTART_7] = [0xd9, 0xda, 0xd0, 0xd7] as const;

/**
 * Finds the end of a JPEG picture, by its segments: a picture may have smaller ones in it, and the lengths and boundaries
 * of a stream's parts are often wrong.
 */
class JpegEnd {
  /** The next byte to look at, behind the marker of the beginning. */
  private at = 2;
  private isInScan = false;

  /** `bytes`: all that have come, with more each time. Returns how many the picture has; null: its end has not come yet. */
  find(bytes: Uint8Array): number | null {
    for (;;) {
      if (this.isInScan) this.skipScan(bytes);
      if (this.at + 4 > bytes.length && bytes[this.at + 1] !== END) return null;
      if (bytes[this.at] !== 0xff) throw notAPicture();
      const marker = bytes[this.at + 1];
      if (marker === END) return this.at + 2;
      // A byte that only fills.
      if (marker === 0xff) this.at++;
      else {
        const length = 256 * bytes[this.at + 2] + bytes[this.at + 3];
        if (length < 2) throw notAPicture();
        this.at += 2 + length;
        this.isInScan = marker === SCAN;
      }
    }
  }

  /** In the data of a scan, 0xff is followed by 0, or by the number of a restart. */
  private skipScan(bytes: Uint8Array): void {
    for (;;) {
      const at = bytes.indexOf(0xff, this.at);
      if (at < 0 || at + 1 >= bytes.length) {
        this.at = at < 0 ? Math.max(this.at, bytes.length) : at;
        return;
      }
      const next = bytes[at + 1];
      this.at = at + 2;
      if (next === 0 || (next >= RESTART_0 && next <= RESTART_7)) continue;
      this.at = at;
      this.isInScan = false;
      return;
    }
  }
}
