/**
 * Child processes: their scripts, each one JavaScript file with all of the modules of the project that it imports, and their
 * messages.
 */
import { mkdirSync, renameSync } from "node:fs";
import path from "node:path";
import { buildSync } from "esbuild";
import { ROOT } from "../../../scripts/setup.mjs";
import type { ChildProcess } from "node:child_process";

/** Below node_modules, so that the scripts can import packages. */
const FOLDER = path.join(ROOT, "node_modules", ".cache", "plotwright-tests");
const built = new Set<string>();

/**
 * The file to run for `name`.ts in this folder. Starting it takes less processor
 * time than compiling and loading the modules one by one.
 */
export function childScript(name: string): string {
  const file = path.join(FOLDER, `${name}.mjs`);
  if (built.has(file)) return file;
  mkdirSync(FOLDER, { recursive: true });
  // Written under another name and renamed, since other test processes write the same file.
  const draft = `${file}.${process.pid}`;
  buildSync({
    entryPoints: [path.join(import.meta.dirname, `${name}.ts`)],
    outfile: draft,
    bundle: true,
    packages: "external",
    platform: "node",
    format: "esm",
    target: "node20",
  });
  renameSync(draft, file);
  built.add(file);
  return file;
}

/** Longer than a busy computer needs to start a process. */
const WITHIN_MS = 120_000;

/** The child's next message that `isWanted` accepts. Rejects if the child ends first, and after two minutes. */
export function nextMessage<T>(
  child: ChildProcess,
  isWanted: (message: T) => boolean = () => true,
): Promise<T> {
  return new Promise((resolve, reject) => {
    const stop = (): void => {
      clearTimeout(timer);
      child.off("message", onMessage);
      child.off("exit", onExit);
    };
    const fail = (why: string): void => {
      stop();
      reject(new Error(`the child process ${why}: ${child.spawnargs.join(" ")}`));
    };
    const onMessage = (message: T): void => {
      if (!isWanted(message)) return;
      stop();
      resolve(message);
    };
    const onExit = (): void => fail("ended before it sent the message");
    const timer = setTimeout(() => fail("sent no such message in two minutes"), WITHIN_MS);
    child.on("message", onMessage);
    child.once("exit", onExit);
    if (hasEnded(child)) onExit();
  });
}

export const hasEnded = ({ exitCode, signalCode }: ChildProcess): boolean =>
  exitCode !== null || signalCode !== null;
