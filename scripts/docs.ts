/**
 * `npm run docs`: writes the types of the settings, and the generated parts of docs/*.md: parts of cli.md, motion.md and
 * comparison.md, and both references.
 */
import { writeFileSync } from "node:fs";
import path from "node:path";
import { cliReference } from "./cli-reference.js";
import { DOCS, writePart } from "./doc-parts.js";
import { httpReference } from "./http-reference.js";
import { libraryReference } from "./library-reference.js";
import { penGainsTable } from "./pen-gains.js";
import { sampleTimesTable } from "./sample-times.js";
import { settingsTable } from "./settings-table.js";
import { SETTINGS_TYPES_FILE, settingsTypes } from "./settings-types.js";

// First, because the library's reference is made from them.
writeFileSync(SETTINGS_TYPES_FILE, await settingsTypes());
writePart("cli.md", "settings", settingsTable());
writePart("cli.md", "commands", await cliReference());
writePart("motion.md", "pen gains", await penGainsTable());
writePart("comparison.md", "sample times", await sampleTimesTable());
writeFileSync(path.join(DOCS, "library-reference.md"), (await libraryReference()).markdown);
writeFileSync(path.join(DOCS, "http-reference.md"), await httpReference());
