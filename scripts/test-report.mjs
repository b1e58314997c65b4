/** Reads vitest's JSON reports for `npm test`: what failed, and what passed at a second attempt. */
import { readFileSync } from "node:fs";
import path from "node:path";
import { ROOT } from "./setup.mjs";

/** A report that vitest wrote to `file`; null if it left none. */
export function readReport(file) {
  try {
    return JSON.parse(readFileSync(file, "utf8"));
  } catch {
    return null;
  }
}

/** The path of a tested file as in the repository, on every system. */
const fileOf = ({ name }) => path.relative(ROOT, name).replaceAll("\\", "/");

export const failedFiles = (report) =>
  report.testResults.filter(({ status }) => status === "failed").map(fileOf);

/**
 * Failed tests as "file: name". A file that could not be loaded, or whose set-up failed, counts as one failure.
 */
export const failuresIn = (report) =>
  report.testResults.flatMap((file) => {
    const failed = file.assertionResults.filter(({ status }) => status === "failed");
    if (failed.length > 0) return failed.map(({ fullName }) => `${fileOf(file)}: ${fullName}`);
    return file.status === "failed" ? [`${fileOf(file)}: ${file.message}`] : [];
  });

export const passedCountIn = (report) =>
  report.testResults
    .flatMap(({ assertionResults }) => assertionResults)
    .filter(({ status }) => status === "passed").length;

/** The results of `first`, except for the files that ran again in `second`. */
export function withSecondAttempt(first, second) {
  const again = new Set(second.testResults.map(fileOf));
  const others = first.testResults.filter((file) => !again.has(fileOf(file)));
  return { testResults: [...others, ...second.testResults] };
}
