/** The worker of unpack.ts. */
import { openSync, readFileSync, closeSync, fsyncSync, writeSync } from "node:fs";
import { parentPort, workerData } from "node:worker_threads";
import type { UnpackInput, Unpacked } from "./unpack.js";

function unpack({ path, drawingPath, maxRestChars }: UnpackInput): Unpacked {
  let value: unknown;
  try {
    value = JSON.parse(readFileSync(path, "utf8"));
  } catch {
    return { code: "bad-setting", fault: "The request is not valid JSON." };
  }
  if (typeof value !== "object" || value === null || Array.isArray(value)) {
    return { code: "bad-setting", fault: "The request must be a JSON object." };
  }
  const { drawing, ...others } = value as Record<string, unknown>;
  if (typeof drawing !== "string" || drawing === "") {
    return { code: "bad-setting", fault: "drawing: the SVG's text is missing." };
  }
  const rest = textOf(others);
  if (rest === null) return { code: "bad-setting", fault: "The request is nested too deeply." };
  if (rest.length > maxRestChars) {
    return {
      code: "too-large",
      fault: `Without its drawing the request has more than ${maxRestChars / 1e3} kB. Send fewer settings.`,
    };
  }
  const bytes = Buffer.from(drawing, "utf8");
  const file = openSync(drawingPath, "wx", 0o600);
  try {
    for (let at = 0; at < bytes.length;) at += writeSync(file, bytes, at);
    fsyncSync(file);
  } finally {
    closeSync(file);
  }
  return { rest, drawingBytes: bytes.length };
}

/** Null if the value is nested too deeply to be written as JSON. */
function textOf(value: unknown): string | null {
  try {
    return JSON.stringify(value);
  } catch (error) {
    if (error instanceof RangeError) return null;
    throw error;
  }
}

parentPort?.postMessage(unpack(workerData as UnpackInput));
