/** The frame around each page of the documentation. */
import { escapeHtml, type Heading } from "./markdown.js";
import { PAGES, PAGE_GROUPS, type DocPage } from "./pages.js";

/** No inline script or style, nothing from other servers. */
const DOCS_POLICY = [
  "default-src 'none'",
  "script-src 'self'",
  "style-src 'self'",
  "img-src 'self'",
  "connect-src 'self'",
  "worker-src 'self'",
  "base-uri 'none'",
  "form-action 'none'",
].join("; ");

/**
 * The policy that server/http sends as a header. Any web server can serve the browser version, so its page contains the
 * policy. Styles set by React are properties and need no exception.
 */
const APP_POLICY = [
  "default-src 'self'",
  "script-src 'self'",
  "style-src 'self'",
  "style-src-attr 'unsafe-inline'",
  "img-src 'self' data: blob: http: https:",
  "worker-src 'self' blob:",
  "connect-src 'self'",
  "object-src 'none'",
  "base-uri 'none'",
  "form-action 'self'",
].join("; ");

const policyTag = (policy: string): string =>
  `<meta http-equiv="Content-Security-Policy" content="${policy}" />`;

/** The app's page with its policy, which must come before everything that it governs. */
export function withAppPolicy(html: string): string {
  if (html.includes('http-equiv="Content-Security-Policy"')) return html;
  return html.replace(
    /<meta charset="utf-8" ?\/?>/i,
    (charset) => `${charset}\n    ${policyTag(APP_POLICY)}`,
  );
}

interface Content {
  readonly title: string;
  readonly html: string;
  readonly headings: readonly Heading[];
}

/** `current`: null for a page outside the navigation. `toDocs`: the path to the folder docs/, "" inside it. */
export function layout(current: DocPage | null, { title, html, headings }: Content, toDocs = ""): string {
  const fullTitle = title === "plotwright" ? "plotwright: pen plotter software" : `${title} · plotwright`;
  return `<!doctype html>
<html lang="en">
<head>
<meta charset="utf-8">
${policyTag(DOCS_POLICY)}
<meta name="viewport" content="width=device-width, initial-scale=1">
<meta name="color-scheme" content="light dark">
<title>${escapeHtml(fullTitle)}</title>
<link rel="icon" type="image/svg+xml" href="${toDocs}icon.svg">
<link rel="stylesheet" href="${toDocs}site.css">
<script src="${toDocs}site.js"></script>
</head>
<body>
<a class="skip" href="#content">Skip to the text</a>
<header>
<a class="brand" href="${toDocs}index.html"><img src="${toDocs}icon.svg" alt="" width="28" height="28"> plotwright</a>
<a class="app" href="${toDocs}../app/index.html">Open the app</a>
<button type="button" id="menu" aria-expanded="false" aria-controls="navigation">Menu</button>
</header>
<div class="columns">
<nav id="navigation" aria-label="Documentation">
<label class="search" for="search">Search titles<input type="search" id="search" autocomplete="off"></label>
<ul id="found" aria-live="polite" hidden></ul>
<div id="pages">
${PAGE_GROUPS.map(
  ({ title: group, pages }) =>
    `<h2>${group}</h2>\n<ul>${pages.map((one) => navigationItem(one, current, toDocs)).join("")}</ul>`,
).join("\n")}
</div>
</nav>
<main id="content" tabindex="-1">
${tableOfContents(headings)}
<article>
${html}
</article>
${current === null ? "" : neighbours(current)}
</main>
</div>
</body>
</html>
`;
}

function navigationItem(one: DocPage, current: DocPage | null, toDocs: string): string {
  const mark = one === current ? ' aria-current="page"' : "";
  return `<li><a href="${toDocs}${one.file}"${mark}>${escapeHtml(one.label)}</a></li>`;
}

function tableOfContents(headings: readonly Heading[]): string {
  const shown = headings.filter(({ depth }) => depth === 2 || depth === 3);
  if (shown.length < 3) return "";
  const items = shown.map(
    ({ depth, id, text }) => `<li class="depth-${depth}"><a href="#${id}">${escapeHtml(text)}</a></li>`,
  );
  return `<details class="contents"><summary>On this page</summary><ul>${items.join("")}</ul></details>`;
}

function neighbours(current: DocPage): string {
  const at = PAGES.indexOf(current);
  const [before, after] = [PAGES[at - 1] as DocPage | undefined, PAGES[at + 1] as DocPage | undefined];
  const link = (one: DocPage | undefined, rel: string, words: string): string =>
    one === undefined
      ? "<span></span>"
      : `<a rel="${rel}" href="${one.file}"><small>${words}</small> ${escapeHtml(one.label)}</a>`;
  return `<footer>${link(before, "prev", "Back")}${link(after, "next", "Next")}</footer>`;
}
