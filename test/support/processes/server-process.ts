/** The built server in its own process, as a user starts it, on a free port with its own data folder. */
import { spawn, type ChildProcess } from "node:child_process";
import { once } from "node:events";
import path from "node:path";
import { ROOT } from "../../../scripts/setup.mjs";

export interface ServerProcess {
  readonly url: string;
  readonly process: ChildProcess;
  /** Its output so far, both streams. */
  readonly output: () => string;
  /** SIGTERM, and waits for the end. */
  stop(): Promise<void>;
}

interface ServerProcessOptions {
  readonly dataDir: string;
  /** Board seconds per second on the virtual board. */
  readonly virtualSpeed?: number;
  readonly args?: readonly string[];
  /** Besides those of this process. */
  readonly env?: NodeJS.ProcessEnv;
}

/** Rejects with the server's output if it ends before it listens. */
export async function startServerProcess(options: ServerProcessOptions): Promise<ServerProcess> {
  const args = ["--port", "0", "--device", "virtual", "--data", options.dataDir];
  args.push("--virtual-speed", String(options.virtualSpeed ?? 20), ...(options.args ?? []));
  const child = spawn(process.execPath, [path.join(ROOT, "dist/server/main.js"), "serve", ...args], {
    stdio: ["ignore", "pipe", "pipe"],
    env: { ...process.env, ...options.env },
  });
  let output = "";
  const url = await new Promise<string>((resolve, reject) => {
    const listen = (chunk: Buffer): void => {
      output += chunk.toString();
      const found = /https?:\/\/127\.0\.0\.1:\d+/.exec(output);
      if (found !== null) resolve(found[0]);
    };
    child.stdout.on("data", listen);
    child.stderr.on("data", listen);
    child.once("exit", (code) => reject(new Error(`the server ended with code ${code}: ${output}`)));
  });
  const stop = async (): Promise<void> => {
    if (child.exitCode !== null || child.signalCode !== null) return;
    const ended = once(child, "exit");
    child.kill("SIGTERM");
    await ended;
  };
  return { url, process: child, output: () => output, stop };
}
