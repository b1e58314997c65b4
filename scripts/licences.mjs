/**
 * For the build of the page: writes the licences of everything that is built into it, its workers too, into
 * licences.txt. Vite's own `build.license` leaves out what only a worker uses.
 */
import { existsSync, readFileSync, readdirSync } from "node:fs";
import path from "node:path";

const HERE = import.meta.dirname;

/** Beside index.html; the page's About sheet shows it. */
const FILE = "licences.txt";

/** What is not a package of its own: data that came into our sources. */
const IN_OUR_SOURCES = [{ title: "Hershey fonts, from hersheytext 2.0.0 (MIT)", file: "hershey-fonts.txt" }];

const LICENCE_FILE = /^(licen[cs]e|copying)/i;

/** Two plugins: `inWorkers` gathers while the workers are built, which is before the page is; `inPage` writes the file. */
export function licencePlugins() {
  const folders = new Set();
  const gather = (bundle) => {
    for (const { moduleIds = [] } of Object.values(bundle)) {
      for (const id of moduleIds) {
        const folder = packageFolder(id);
        if (folder !== null) folders.add(folder);
      }
    }
  };
  return {
    inWorkers: () => ({
      name: "licences-of-workers",
      generateBundle: (_options, bundle) => gather(bundle),
    }),
    inPage: () => ({
      name: "licences",
      apply: "build",
      generateBundle(_options, bundle) {
        gather(bundle);
        this.emitFile({ type: "asset", fileName: FILE, source: licenceText([...folders].sort()) });
      },
    }),
  };
}

/** The package's folder in node_modules; null for a file of ours and for what the bundler makes up. */
function packageFolder(moduleId) {
  if (moduleId.startsWith("\0")) return null;
  const match = /^(.*\/node_modules\/(?:@[^/]+\/)?[^/]+)\//.exec(moduleId.replaceAll("\\", "/"));
  return match === null ? null : match[1];
}

function licenceText(folders) {
  const ours = section("plotwright (MIT)", path.join(HERE, "..", "LICENSE"));
  const others = IN_OUR_SOURCES.map(({ title, file }) => section(title, ownCopy(file)));
  return `${[ours, ...others, ...folders.map(ofPackage)].join("\n\n\n")}\n`;
}

function ofPackage(folder) {
  const { name, version, license } = JSON.parse(readFileSync(path.join(folder, "package.json"), "utf8"));
  const title = `${name} ${version} (${license})`;
  const its = readdirSync(folder).find((entry) => LICENCE_FILE.test(entry));
  const file = its === undefined ? ownCopy(`${path.basename(folder)}.txt`) : path.join(folder, its);
  // A page that goes out without the text of a licence breaks it.
  if (!existsSync(file)) throw new Error(`${title} is built into the page: put its licence into ${file}`);
  return section(title, file);
}

/** Of data, and of a package that comes without a licence file: from its repository. */
const ownCopy = (name) => path.join(HERE, "licences", name);

const section = (title, file) => `${title}\n\n${readFileSync(file, "utf8").replaceAll("\r\n", "\n").trim()}`;
