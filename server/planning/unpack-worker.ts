/** See unpack.ts. */
import { openSync, readFileSync, closeSync, fsyncSync, writeSync } from "node:fs";
import { parentPort, workerData } from "node:worker_threads";
import type { UnpackInput, Unpacked } from "./unpack.js";

function unpack({ path, drawingPath }: UnpackInput): Unpacked {
  let value: unknown;
  try {
    value = JSON.parse(readFileSync(path, "utf8"));
  } catch {
    return { fault: "The request is not valid JSON." };
  }
  if (typeof value !== "object" || value === null || Array.isArray(value)) {
    return { fault: "The request must be a JSON object." };
  }
  const { drawing, ...rest } = value as Record<string, unknown>;
  if (typeof drawing !== "string" || drawing === "") return { fault: "drawing: the SVG's text is missing." };
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

parentPort?.postMessage(unpack(workerData as UnpackInput));
