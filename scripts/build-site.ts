/**
 * `npm run build:site [-- --out FOLDER] [--base /PATH/]`: the web site, by default in dist/site: app/ is the browser
 * version of the page, docs/ the documentation. Any web server can serve it, at any path.
 *
 *   --base   path of the site on its server, which only the page for unknown addresses (404.html) needs; default /
 */
import { spawnSync } from "node:child_process";
import { createHash } from "node:crypto";
import { mkdirSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import path from "node:path";
import { parseArgs } from "node:util";
import { ROOT, nodeModule } from "./setup.mjs";
import { layout, withAppPolicy } from "./site/layout.js";
import { renderMarkdown, type Rendered } from "./site/markdown.js";
import { PAGES, type DocPage } from "./site/pages.js";

const { values } = parseArgs({
  options: {
    out: { type: "string", default: path.join(ROOT, "dist", "site") },
    base: { type: "string", default: "/" },
  },
});
const site = path.resolve(values.out);
const docs = path.join(site, "docs");

const inRoot = (...parts: string[]): string => path.join(ROOT, ...parts);
const inSources = (name: string): string => inRoot("scripts", "site", name);

rmSync(site, { recursive: true, force: true });
mkdirSync(docs, { recursive: true });
buildApp(path.join(site, "app"));
buildDocs();
buildEntrances();
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

function buildDocs(): void {
  const written = new Map<string, string | Buffer>();
  const rendered = PAGES.map((page) => ({ page, content: contentOf(page) }));
  for (const { page, content } of rendered) {
    const title = content.headings[0].text;
    written.set(page.file, layout(page, { ...content, title }));
    for (const picture of content.pictures) {
      written.set(picture.replace(/^docs\//, ""), readFileSync(inRoot(picture)));
    }
  }
  const titles = rendered.flatMap(({ page, content }) =>
    content.headings.map(({ text, id, depth }) => ({
      title: text,
      page: page.label,
      href: depth === 1 ? page.file : `${page.file}#${id}`,
    })),
  );
  written.set("titles.json", JSON.stringify(titles));
  written.set("site.css", readFileSync(inRoot("web", "ui", "tokens.css"), "utf8") + source("site.css"));
  written.set("site.js", source("site.js"));
  written.set("icon.svg", readFileSync(inRoot("web", "public", "icon.svg")));
  const hash = createHash("sha256");
  for (const [name, content] of written) hash.update(name).update("\0").update(content).update("\0");
  const worker = source("service-worker.js")
    .replace('"__FILES__"', () => JSON.stringify([...written.keys()]))
    .replace("__VERSION__", hash.digest("hex").slice(0, 12));
  written.set("service-worker.js", worker);
  for (const [name, content] of written) {
    const file = path.join(docs, name);
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

/** The site's own address leads to the documentation. 404.html is shown at any path, so its links are absolute. */
function buildEntrances(): void {
  const home = readFileSync(inSources("home.html"), "utf8");
  writeFileSync(path.join(site, "index.html"), home);
  const html = `<h1 id="not-found">Page not found</h1>
<p>There is no page at this address. The menu lists all pages; the <a href="${values.base}docs/index.html">overview</a> is a
good place to begin.</p>`;
  const page = layout(null, { title: "Page not found", html, headings: [] }, `${values.base}docs/`);
  writeFileSync(path.join(site, "404.html"), page);
}

function source(name: string): string {
  return readFileSync(inSources(name), "utf8");
}
