/** Commander's messages about wrong arguments, reworded: what is wrong, and what to do. */

/** An extra argument is usually an option without its name, or part of a file name. */
const OPTIONS = "Options begin with --, and names with blanks need quotes.";

/** Commander's message, and ours. */
const REWORDED: readonly (readonly [RegExp, string])[] = [
  [/^option '(--[^ ']+).*' argument '(.*)' is invalid\. It must be (.*)\.$/, '$1: it must be $3, not "$2".'],
  [
    /^option '(--[^ ']+).*' argument '(.*)' is invalid\. Allowed choices are (.*)\.$/,
    '$1: it must be one of $3, not "$2".',
  ],
  [
    /^command-argument value '(.*)' is invalid for argument '(.*)'\. It must be (.*)\.$/,
    '<$2>: it must be $3, not "$1".',
  ],
  [/^option '(--[^ ']+) (.*)' argument missing$/, "$1: its value $2 is missing."],
  [/^required option '(.*)' not specified$/, "$1 is missing."],
  [/^missing required argument '(.*)'$/, "<$1> is missing."],
  [/^unknown command '(.*)'$/, "There is no command $1."],
  [/^unknown command '(.*)' \(Did you mean (.*)\?\)$/, "There is no command $1. Did you mean $2?"],
  [/^unknown option '(.*)'$/, "There is no option $1."],
  [/^unknown option '(.*)' \(Did you mean (.*)\?\)$/, "There is no option $1. Did you mean $2?"],
  [
    /^too many arguments for 'serve'\. Expected 0 arguments but got (\d+)\.$/,
    "serve takes no arguments, got $1. Options begin with --, such as --port 9381.",
  ],
  [
    /^too many arguments for '(.+)'\. Expected 0 arguments but got (\d+)\.$/,
    `$1 takes no arguments, got $2. ${OPTIONS}`,
  ],
  [
    /^too many arguments for '(.+)'\. Expected 1 argument but got (\d+)\.$/,
    `$1 takes at most 1 argument, got $2. ${OPTIONS}`,
  ],
  [
    /^too many arguments for '(.+)'\. Expected (\d+) arguments but got (\d+)\.$/,
    `$1 takes at most $2 arguments, got $3. ${OPTIONS}`,
  ],
];

/** `command`: whose help has the details; undefined: the program's. */
export function usageInWords(text: string, command: string | undefined): string {
  const found = REWORDED.find(([pattern]) => pattern.test(text));
  const words = found === undefined ? text : text.replace(...found);
  return `${words} See plotwright ${command === undefined ? "" : `${command} `}--help.`;
}
