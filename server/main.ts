#!/usr/bin/env node
/** The bin: reads the arguments, runs the command, sets the exit code; nothing else. */
import { processIo } from "./cli/io.js";
import { runCli } from "./cli/program.js";
import { packageVersion } from "./package-files.js";

process.exitCode = await runCli(process.argv.slice(2), processIo(), packageVersion());
