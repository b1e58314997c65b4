/**
 * Advice for two readers. Messages name a setting by its flag, as the command line and programs know it; the page knows
 * it by its label. What only the command line can do is a clause of its own in a message: ", or on the command line …" up
 * to the end of the sentence, or a sentence that begins with "On the command line, ". A name for programs is
 * ', or "outside" in the settings'.
 */
import { PREPARE_TABLE } from "./prepare.js";
import type { Setting } from "./setting.js";

const quoted = (label: string): string => `“${label}”`;

/** What the page calls what the command line calls so. */
const PAGE_NAMES = new Map<string, string>([
  ...Object.values<Setting>(PREPARE_TABLE).flatMap(({ flag, label }) =>
    flag === undefined ? [] : [[flag, quoted(label)] as const],
  ),
  ["--machine", quoted("Model")],
  ["--device", quoted("Sharing, plotters, camera")],
]);

const SENTENCE_FOR_COMMAND_LINE = / On the command line, [^.]*\./g;
const CLAUSE_FOR_COMMAND_LINE = /,? or on the command line [^.]*/g;
const NAME_FOR_PROGRAMS = /, or "\w+" in the settings/g;

/** A message as the page shows it. Options that only begin a server keep their flags: there is no other way. */
export const inPageWords = (message: string): string =>
  message
    .replace(SENTENCE_FOR_COMMAND_LINE, "")
    .replace(CLAUSE_FOR_COMMAND_LINE, "")
    .replace(NAME_FOR_PROGRAMS, "")
    .replace(/--[a-z]+(?:-[a-z]+)*/g, (flag) => PAGE_NAMES.get(flag) ?? flag);
