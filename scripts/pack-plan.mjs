/**
 * Packs `plotwright-plan`: the entry "plotwright" alone, from the built product, for programs that only plan. It has what
 * that entry loads, and depends only on the packages that this code imports. Fonts are read by a package of 9 MB, which is
 * an optional peer.
 *
 *   node scripts/pack-plan.mjs [FOLDER]      FOLDER: where the file goes; default: this folder
 */
import { spawnSync } from "node:child_process";
import { copyFileSync, mkdirSync, mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import path from "node:path";
import { ROOT, giveUp } from "./setup.mjs";

const ENTRY = "dist/src/index";
const KEPT_FIELDS = [
  ...["version", "keywords", "license", "author", "repository", "homepage", "bugs"],
  ...["type", "engines", "sideEffects"],
];
const README = `# plotwright-plan

The planning part of plotwright: it reads SVG, DXF, HPGL and JSON, places, fills and orders the strokes, and plans the motion of a pen
plotter, in Node and in browsers. It is the entry "plotwright" of the package plotwright, under another name, and without everything that
a server, the command line and a serial port need.

    npm install plotwright-plan

    import { planSvg } from "plotwright-plan";
    const { trajectory } = await planSvg(svgText);

To draw text in the outlines of a font file, add fontkit: npm install fontkit.
`;

const manifest = JSON.parse(readFileSync(path.join(ROOT, "package.json"), "utf8"));
const code = filesFrom(`${ENTRY}.js`, /(?:\bfrom|\bimport)\s*\(?\s*"([^"\n]+)"/g, (file) => file);
const types = filesFrom(`${ENTRY}.d.ts`, /(?:\bfrom|\bimport)\s*\(?\s*"([^"\n]+)"/g, (file) =>
  file.replace(/\.js$/, ".d.ts"),
);
const imported = [...code.packages].map((name) => /^(?:@[^/]+\/)?[^/]+/.exec(name)[0]);
const dependencies = versions((name) => name !== "fontkit");
const peerDependencies = versions((name) => name === "fontkit");
const unknown = [...types.packages].filter((name) => !(name in dependencies));
if (unknown.length > 0) giveUp(`the types of ${ENTRY} need ${unknown.join(", ")}.`);

const folder = mkdtempSync(path.join(tmpdir(), "plotwright-plan-"));
try {
  for (const file of [...code.files, ...types.files]) copy(file);
  copy("LICENSE");
  copy("dist/chunks/licences.txt");
  writeFileSync(path.join(folder, "README.md"), README);
  writeFileSync(path.join(folder, "package.json"), JSON.stringify(planManifest(), null, 2));
  const to = path.resolve(process.argv[2] ?? ROOT);
  const { status } = spawnSync("npm", ["pack", "--ignore-scripts", "--pack-destination", to], {
    cwd: folder,
    stdio: ["ignore", "inherit", "ignore"],
    shell: process.platform === "win32",
  });
  process.exitCode = status ?? 1;
} finally {
  rmSync(folder, { recursive: true, force: true });
}

function planManifest() {
  return {
    name: `${manifest.name}-plan`,
    description:
      "Plans the motion of a pen plotter from SVG, DXF, HPGL and JSON: the planning part of plotwright",
    ...Object.fromEntries(KEPT_FIELDS.filter((key) => key in manifest).map((key) => [key, manifest[key]])),
    main: `./${ENTRY}.js`,
    types: `./${ENTRY}.d.ts`,
    exports: { ".": { types: `./${ENTRY}.d.ts`, default: `./${ENTRY}.js` } },
    dependencies,
    peerDependencies,
    peerDependenciesMeta: Object.fromEntries(
      Object.keys(peerDependencies).map((name) => [name, { optional: true }]),
    ),
  };
}

function versions(isWanted) {
  const names = [...new Set(imported)].filter((name) => name in manifest.dependencies && isWanted(name));
  return Object.fromEntries(names.sort().map((name) => [name, manifest.dependencies[name]]));
}

/** The files that one imports, directly and indirectly, and the packages. */
function filesFrom(first, imports, fileOf) {
  const files = new Set([first]);
  const packages = new Set();
  for (const file of files) {
    const text = readFileSync(path.join(ROOT, file), "utf8");
    for (const [, name] of text.matchAll(imports)) {
      if (name.startsWith(".")) files.add(fileOf(path.posix.join(path.posix.dirname(file), name)));
      else if (/^[@\w][\w./-]*$/.test(name)) packages.add(name);
    }
  }
  return { files, packages };
}

function copy(file) {
  mkdirSync(path.dirname(path.join(folder, file)), { recursive: true });
  copyFileSync(path.join(ROOT, file), path.join(folder, file));
}
