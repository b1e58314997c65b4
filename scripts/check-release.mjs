/**
 * `npm publish` runs this first. It checks that package.json has the fields that only the publisher knows; otherwise
 * links on the package's page are dead. In a workflow started by a tag, the tag must be the version.
 *
 *   node scripts/check-release.mjs [FOLDER]      FOLDER: of package.json and CHANGELOG.md
 */
import { readFileSync } from "node:fs";
import path from "node:path";
import { ROOT, giveUp } from "./setup.mjs";

const NEEDED = ["author", "repository", "homepage", "bugs"];

const folder = process.argv[2] ?? ROOT;
const manifest = JSON.parse(readFileSync(path.join(folder, "package.json"), "utf8"));
const missing = NEEDED.filter((field) => !manifest[field]);
if (missing.length > 0) {
  giveUp(`package.json lacks ${missing.join(", ")}: see "Releasing" in CONTRIBUTING.md.`);
}
if (!readFileSync(path.join(folder, "CHANGELOG.md"), "utf8").includes(`\n## ${manifest.version}\n`)) {
  giveUp(`CHANGELOG.md has no section "## ${manifest.version}".`);
}
const { GITHUB_REF_TYPE: refType, GITHUB_REF_NAME: tag } = process.env;
if (refType === "tag" && tag !== `v${manifest.version}`) {
  giveUp(`the tag ${tag} is not the version of package.json, v${manifest.version}.`);
}
