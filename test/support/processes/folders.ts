/** Temporary folders. */
import { mkdtempSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import path from "node:path";
import { onTestFinished } from "vitest";

/** A folder that outlives a test, and how to remove it. */
export function temporaryFolder(name: string): { path: string; remove: () => void } {
  const folder = mkdtempSync(path.join(tmpdir(), `plotwright-${name}-`));
  return { path: folder, remove: () => rmSync(folder, { recursive: true, force: true }) };
}

/** A folder for the test that runs, or that is about to begin. It is removed after the test and its `afterEach`. */
export function folderOfTest(): string {
  const folder = temporaryFolder("test");
  onTestFinished(folder.remove);
  return folder.path;
}
