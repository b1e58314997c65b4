/**
 * `npm run build:site [-- --out FOLDER] [--base /PATH/] [--source URL]`: the web site, by default in dist/site: a start
 * page, app/ with the browser version of the page, and docs/ with the documentation. Any web server can serve it, at any
 * path.
 *
 *   --base     path of the site on its server, which only the page for unknown addresses (404.html) needs; default /
 *   --source   address of the repository, for links to it; default: `repository` in package.json, otherwise no links
 */
import { spawnSync } from "node:child_process";
import { createHash } from "node:crypto";
import { mkdirSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import path from "node:path";
import { parseArgs } from "node:util";
import { buildSync } from "esbuild";
import { ROOT, nodeModule } from "./setup.mjs";
import { home, layout, withAppPolicy, type Place } from "./site/layout.js";
import { renderMarkdown, sectionsOf, type Rendered } from "./site/markdown.js";
import { PAGES, type DocPage } from "./site/pages.js";
import { indexOf } from "./site/search.js";

const { values } = parseArgs({
  options: {
    out: { type: "string", default: path.join(ROOT, "dist", "site") },
    base: { type: "string", default: "/" },
    source: { type: "string", default: repositoryOf(readFileSync(path.join(ROOT, "package.json"), "utf8")) },
  },
});
const site = path.resolve(values.out);
const source = values.source === "" ? null : values.source;

const inRoot = (...parts: string[]): string => path.join(ROOT, ...parts);
const sourceFile = (name: string): string => readFileSync(inRoot("scripts", "site", name), "utf8");

rmSync(site, { recursive: true, force: true });
buildApp(path.join(site, "app"));
buildPages();
console.log(`The site is in ${path.relative(process.cwd(), site)}`);

function buildApp(folder: string): void {
  const paths = ["--outDir", folder, "--base", "./"];
  const args = ["build", "--config", "web/vite.config.ts", ...paths, "--logLevel", "warn"];
  const env = { ...process.env, VITE_BACKEND: "browser", NODE_ENV: "production" };
  const vite = [nodeModule("vite", "bin", "vite.js"), ...args];
  const { status } = spawnSync(process.execPath, vite, { cwd: ROOT, env, stdio: "inherit" });
  if (status !== 0) throw new Error("the app could not be built; the message is above");
  const page = path.join(folder, "index.html");
  writeFileSync(page, withAppPolicy(readFileSync(page, "utf8")));
}

/** Everything except the app. The service worker stores these files, except itself and 404.html. */
function buildPages(): void {
  const written = new Map<string, string | Buffer>();
  const inDocs: Place = { toDocs: "", source };
  const rendered = PAGES.map((page) => ({ page, content: contentOf(page) }));
  for (const { page, content } of rendered) {
    written.set(`docs/${page.file}`, layout(page, { ...content, title: content.headings[0].text }, inDocs));
    for (const picture of content.pictures) {
      written.set(`docs/${picture.replace(/^docs\//, "")}`, readFileSync(inRoot(picture)));
    }
  }
  const sections = rendered.flatMap(({ page, content }) =>
    sectionsOf(content).map(({ text: title, id, depth, content: text }) => ({
      page: page.label,
      title,
      href: depth === 1 ? page.file : `${page.file}#${id}`,
      text,
    })),
  );
  written.set("docs/search-index.json", indexOf(sections.map((section, id) => ({ id, ...section }))));
  const tokens = readFileSync(inRoot("web", "ui", "tokens.css"), "utf8");
  written.set(
    "docs/site.css",
    [tokens, ...["site.css", "article.css", "home.css"].map(sourceFile)].join("\n"),
  );
  written.set("docs/site.js", scriptOf("site.ts", "iife"));
  written.set("docs/search.js", scriptOf("search.ts", "esm"));
  written.set("docs/icon.svg", readFileSync(inRoot("web", "public", "icon.svg")));
  written.set("index.html", home(sourceFile("home.html"), { toDocs: "docs/", source }));

  const hash = createHash("sha256");
  for (const [name, content] of written) hash.update(name).update("\0").update(content).update("\0");
  const worker = sourceFile("service-worker.js")
    .replace('"__FILES__"', () => JSON.stringify([...written.keys()]))
    .replace("__VERSION__", hash.digest("hex").slice(0, 12));
  written.set("service-worker.js", worker);
  written.set("404.html", notFound());
  for (const [name, content] of written) {
    const file = path.join(site, name);
    mkdirSync(path.dirname(file), { recursive: true });
    writeFileSync(file, content);
  }
}

function contentOf({ source: file }: DocPage): Rendered {
  const text = readFileSync(inRoot(file), "utf8");
  // The licence is plain text.
  const markdown = file === "LICENSE" ? `# Licence\n\n${text}` : text;
  return renderMarkdown(file, markdown);
}

/** Shown at any path, so its links are absolute. */
function notFound(): string {
  const html = `<h1 id="not-found">Page not found</h1>
<p>There is no page at this address. The menu lists all pages; the <a href="${values.base}docs/index.html">overview</a> is a
good place to begin.</p>`;
  const place = { toDocs: `${values.base}docs/`, source };
  return layout(null, { title: "Page not found", html, headings: [] }, place);
}

/** A script of the site in one file, with the licences of what is in it. */
function scriptOf(name: string, format: "iife" | "esm"): string {
  const entry = inRoot("scripts", "site", name);
  const options = { bundle: true, minify: true, write: false, target: "es2022", format } as const;
  const { outputFiles, metafile } = buildSync({ entryPoints: [entry], metafile: true, ...options });
  const packages = new Set(
    Object.keys(metafile.inputs).flatMap((file) => /node_modules\/([^/]+)\//.exec(file)?.[1] ?? []),
  );
  const licences = [...packages].map(
    (one) => `/*\n${one}\n\n${readFileSync(nodeModule(one, "LICENSE.txt"), "utf8")}*/\n`,
  );
  return licences.join("") + outputFiles[0].text;
}

/** The address of the repository in package.json, "" if there is none. */
function repositoryOf(packageJson: string): string {
  const { repository } = JSON.parse(packageJson) as { repository?: { url: string } | string };
  const url = typeof repository === "string" ? repository : (repository?.url ?? "");
  return url.replace(/^git\+/, "").replace(/\.git$/, "");
}
