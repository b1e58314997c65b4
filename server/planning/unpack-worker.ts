/** See unpack.ts. */
import { openSync, readFileSync, closeSync, fsyncSync, writeSync } from "node:fs";
import { parentPort, workerData } from "node:worker_threads";
import type { UnpackInput, Unpacked } from "./unpack.js";

const MOST_DEEP = 20;

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
  if (isDeep(value)) return { fault: "The request is nested too deeply." };
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

/** Settings are nested six deep. What is nested thousands deep can't be handed from thread to thread. */
function isDeep(value: object): boolean {
  let level: object[] = [value];
  for (let depth = 0; depth < MOST_DEEP && level.length > 0; depth++) {
    level = level.flatMap((one) => Object.values(one) as unknown[]).filter(isObject);
  }
  return level.length > 0;
}

const isObject = (value: unknown): value is object => typeof value === "object" && value !== null;

parentPort?.postMessage(unpack(workerData as UnpackInput));
