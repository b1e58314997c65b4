/** Paths of files in the package, found both from the sources (server/) and from the build (dist/server/). */
import { existsSync, readFileSync } from "node:fs";
import { join } from "node:path";
import { fileURLToPath } from "node:url";

export function packagePath(path: string): string {
  const above = fileURLToPath(new URL("../..", import.meta.url));
  return join(existsSync(join(above, "package.json")) ? above : join(above, ".."), path);
}

export function packageVersion(): string {
  const { version } = JSON.parse(readFileSync(packagePath("package.json"), "utf8")) as { version: string };
  return version;
}
