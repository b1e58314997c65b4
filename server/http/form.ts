/**
 * A drawing with its settings as a form (multipart/form-data), as browsers and `curl -F` send it: one file, and fields
 * beside it in any order. The file goes to the disk as it arrives; the fields are short.
 */
import { once } from "node:events";
import type { IncomingHttpHeaders } from "node:http";
import type { Readable } from "node:stream";
import type { BusboyFileStream, BusboyHeaders, BusboyInstance } from "@fastify/busboy";
import type { Request } from "express";
import { PlotwrightError } from "../../src/index.js";
import type { DrawingFiles, StoredDrawing } from "../storage/drawing-files.js";
import { bytesOf } from "./operation-routes.js";

/** The settings of a job may take 100 kB. */
const MAX_FIELD_BYTES = 200_000;
const LIMITS = { files: 1, fields: 10, parts: 12, headerPairs: 20, headerSize: 16_000 };
/** Everything but the file: also what is sent before, between and after the parts. */
const MAX_OTHER_BYTES = (LIMITS.fields + 1) * MAX_FIELD_BYTES;

interface Upload {
  readonly stream: Readable;
  readonly name: string;
  readonly stored: Promise<StoredDrawing>;
}

interface Form<Field extends string> {
  readonly drawing: StoredDrawing;
  /** As the sender's computer names it; undefined if it has no name. */
  readonly fileName: string | undefined;
  readonly fields: Readonly<Partial<Record<Field, string>>>;
}

/** Throws `bad-setting`, `bad-file` or `too-large`, and then leaves no file behind. */
export async function readForm<Field extends string>(
  request: Request<Record<string, string>>,
  files: DrawingFiles,
  known: readonly Field[],
): Promise<Form<Field>> {
  const parser = await parserFor(request.headers);
  const fields = new Map<string, string>();
  /** At most one. */
  const uploads: Upload[] = [];
  const parsed = new Promise<void>((resolve, reject) => {
    parser.on("file", (_field: string, stream: BusboyFileStream, name: string) => {
      // A fault of the form. If writing fails, the stream is destroyed, and the reason is that of `stored`.
      stream.on("error", (cause) => {
        if (!stream.destroyed) reject(notReadable(cause));
      });
      const stored = files.addFile(stream as AsyncIterable<Uint8Array>);
      stored.catch(reject);
      uploads.push({ stream, name, stored });
    });
    parser.on("field", (name: string, value: string, _isNameCut: boolean, isCut: boolean) => {
      const fault = faultOf(name, isCut, known, fields);
      if (fault === null) fields.set(name, value);
      else reject(new PlotwrightError("bad-setting", fault));
    });
    parser.on("filesLimit", () => reject(new PlotwrightError("bad-file", TWO_FILES)));
    const tooMany = `The form has too many fields. ${onlyFields(known)}`;
    parser.on("fieldsLimit", () => reject(new PlotwrightError("bad-setting", tooMany)));
    parser.on("partsLimit", () => reject(new PlotwrightError("bad-setting", tooMany)));
    parser.on("error", (cause: unknown) => reject(notReadable(cause)));
    parser.on("finish", resolve);
  });
  // Awaited below, unless reading fails before.
  parsed.catch(() => undefined);
  try {
    await feed(parser, request, parsed, files);
    await parsed;
    const [upload] = uploads;
    if (upload === undefined) throw new PlotwrightError("bad-file", NO_FILE);
    return {
      drawing: await upload.stored,
      fileName: upload.name,
      fields: Object.fromEntries(fields) as Form<Field>["fields"],
    };
  } catch (error) {
    for (const { stream, stored } of uploads) {
      stream.destroy(error as Error);
      await stored.then(
        ({ id }) => files.remove(id),
        () => undefined,
      );
    }
    throw error;
  }
}

/** Loaded with the first form, because most servers never get one. */
async function parserFor(headers: IncomingHttpHeaders): Promise<BusboyInstance> {
  const { Busboy: Parser } = await import("@fastify/busboy");
  try {
    return new Parser({
      headers: headers as BusboyHeaders,
      limits: { ...LIMITS, fieldSize: MAX_FIELD_BYTES },
    });
  } catch (cause) {
    throw notReadable(cause);
  }
}

/** Until the request ends or parsing fails, no faster than the file is written. */
async function feed(
  parser: BusboyInstance,
  request: Request<Record<string, string>>,
  parsed: Promise<void>,
  files: DrawingFiles,
): Promise<void> {
  let bytes = 0;
  for await (const chunk of bytesOf(request)) {
    bytes += chunk.byteLength;
    files.mustFit(bytes - MAX_OTHER_BYTES);
    const isFull = !parser.write(chunk);
    await Promise.race([parsed, isFull ? once(parser, "drain") : null]);
  }
  parser.end();
}

const TWO_FILES =
  "The form has more than one file. A job has one drawing, so send each with its own request; settings are text, not a file.";

const NO_FILE = "The form has no file. Add the drawing, as with curl -F drawing=@drawing.svg.";

const onlyFields = (known: readonly string[]): string =>
  `It may have one file, and the fields ${known.join(", ")}.`;

/** Null: the field is as it should be. */
function faultOf(
  name: string,
  isCut: boolean,
  known: readonly string[],
  fields: ReadonlyMap<string, string>,
): string | null {
  if (!known.includes(name)) {
    return `The form has a field ${JSON.stringify(String(name).slice(0, 100))} that is not a file. ${onlyFields(known)}`;
  }
  if (fields.has(name)) return `The form has the field ${name} twice.`;
  return isCut ? `${name}: it is longer than ${MAX_FIELD_BYTES / 1000} kB.` : null;
}

const notReadable = (cause: unknown): PlotwrightError =>
  new PlotwrightError(
    "bad-setting",
    `The form can't be read (${cause instanceof Error ? cause.message : String(cause)}). Let your program set the Content-Type, which has the boundary between its parts.`,
    { cause },
  );
