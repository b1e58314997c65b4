#!/usr/bin/env node
/** The executable: reads the arguments, runs the command and sets the exit code. */
import { setFlagsFromString } from "node:v8";
import { processIo } from "./cli/io.js";
import { runCli } from "./cli/program.js";
import { packageVersion } from "./storage/package-files.js";

/**
 * V8 compiles a WebAssembly function again, optimized, after this many bytes of its code have run. With the default,
 * which is 1000 times smaller, this takes 0.4 of the 0.95 s of processor time of a server's start, and SQLite has too
 * little to do to benefit from it.
 */
setFlagsFromString("--wasm-tiering-budget=2000000000");

process.exitCode = await runCli(process.argv.slice(2), processIo(), packageVersion());
