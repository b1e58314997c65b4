/**
 * `npm publish` runs this first: the fields that only the publisher knows must be in package.json, or links
 * on the package's page are dead.
 */
import { readFileSync } from "node:fs";
import path from "node:path";
import { ROOT, giveUp } from "./setup.mjs";

const NEEDED = ["author", "repository", "homepage", "bugs"];

const manifest = JSON.parse(readFileSync(path.join(ROOT, "package.json"), "utf8"));
const missing = NEEDED.filter((field) => !manifest[field]);
if (missing.length > 0) {
  giveUp(`package.json lacks ${missing.join(", ")}: see "Releasing" in CONTRIBUTING.md.`);
}
if (!readFileSync(path.join(ROOT, "CHANGELOG.md"), "utf8").includes(`\n## ${manifest.version}\n`)) {
  giveUp(`CHANGELOG.md has no section "## ${manifest.version}".`);
}
