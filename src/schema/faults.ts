/** Describes why a schema refuses a value, in plain words instead of those of the schema library. */
import type { z } from "zod";

type Issue = z.core.$ZodIssue;

/** How the library's own messages begin; all others were written for this program and are used as they are. */
const LIBRARY_WORDS = /^(Invalid|Too (small|big)|Unrecognized)/;

const KINDS: Readonly<Record<string, string>> = {
  string: "text",
  number: "a number",
  int: "a whole number",
  boolean: "true or false",
  array: "a list",
  object: "an object",
  record: "an object",
};

/** The first thing that is wrong, after the name of the field: "name: it is missing". */
export function firstFault(error: z.ZodError): { readonly path: string; readonly words: string } {
  const issue = error.issues[0];
  if (issue === undefined) return { path: "", words: "it is not understood" };
  const unknown = issue.code === "unrecognized_keys" ? issue.keys.slice(0, 1) : [];
  return { path: [...issue.path, ...unknown].join("."), words: faultInWords(issue) };
}

/** A clause such as "it must be at least 3". */
export function faultInWords(issue: Issue): string {
  if (!LIBRARY_WORDS.test(issue.message)) return issue.message;
  switch (issue.code) {
    case "invalid_type":
      if (issue.message.endsWith("undefined")) return "it is missing";
      return `it must be ${KINDS[issue.expected] ?? issue.expected}`;
    case "invalid_value":
      return `it must be ${issue.values.length > 1 ? "one of " : ""}${issue.values.join(", ")}`;
    case "too_small":
      return `it must ${boundOf(issue.origin, issue.minimum, issue.inclusive === false ? "more than" : "at least")}`;
    case "too_big":
      return `it must ${boundOf(issue.origin, issue.maximum, issue.inclusive === false ? "less than" : "at most")}`;
    case "unrecognized_keys":
      return `there is no ${issue.keys.join(", ")}`;
    default:
      return "it has a form that is not allowed here";
  }
}

function boundOf(origin: string, bound: number | bigint, relation: string): string {
  if (origin === "string") return `have ${relation} ${bound} character${bound === 1 ? "" : "s"}`;
  if (origin === "array" || origin === "set")
    return `have ${relation} ${bound} ${bound === 1 ? "entry" : "entries"}`;
  return `be ${relation} ${bound}`;
}
