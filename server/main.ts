#!/usr/bin/env node
/** The executable: reads the arguments, runs the command and sets the exit code. */
import { processIo } from "./cli/io.js";
import { runCli } from "./cli/program.js";
import { packageVersion } from "./storage/package-files.js";

process.exitCode = await runCli(process.argv.slice(2), processIo(), packageVersion());
