/** The frame around each page of the site. */
import { descriptionOf, escapeHtml, type Heading } from "./markdown.js";
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

/** Where the site's parts are, as seen from a page. */
export interface Place {
  /** The path to the folder docs/: "" inside it. */
  readonly toDocs: string;
  /** Address of the repository, for links to the source; null if it is not known. */
  readonly source: string | null;
}

const NAME = "plotwright: pen plotter software";

interface Content {
  readonly title: string;
  readonly html: string;
  readonly headings: readonly Heading[];
}

/** A page of the documentation; `current` is null for a page outside the navigation. */
export function layout(current: DocPage | null, { title, html, headings }: Content, place: Place): string {
  const body = `<div class="columns">
<nav id="navigation" aria-label="Documentation">
${PAGE_GROUPS.map(
  ({ title: group, pages }) =>
    `<h2>${group}</h2>\n<ul>${pages.map((one) => navigationItem(one, current, place.toDocs)).join("")}</ul>`,
).join("\n")}
</nav>
<main id="content" tabindex="-1">
${tableOfContents(headings)}
<article>
${html}
</article>
${current === null ? "" : pageFooter(current, place)}
</main>
</div>`;
  const fullTitle = title === "plotwright" ? NAME : `${title} · plotwright`;
  return frame(fullTitle, descriptionOf(html), body, place);
}

/** The start page. */
export function home(html: string, place: Place): string {
  const toSource = place.source === null ? "" : `<a href="${escapeHtml(place.source)}">Source</a>`;
  const body = `<main id="content" class="home" tabindex="-1">
${html}
<footer><a href="${place.toDocs}index.html">Documentation</a>${toSource}<a href="${place.toDocs}license.html">MIT licence</a></footer>
</main>`;
  return frame(NAME, textOfLead(html), body, place);
}

const textOfLead = (html: string): string =>
  (/<p class="lead">([\s\S]*?)<\/p>/.exec(html)?.[1] ?? "").replace(/\s+/g, " ").trim();

function frame(title: string, description: string, body: string, { toDocs, source }: Place): string {
  const hasMenu = body.includes('id="navigation"');
  return `<!doctype html>
<html lang="en">
<head>
<meta charset="utf-8">
${policyTag(DOCS_POLICY)}
<meta name="viewport" content="width=device-width, initial-scale=1">
<meta name="color-scheme" content="light dark">
<meta name="description" content="${escapeHtml(description)}">
<title>${escapeHtml(title)}</title>
<link rel="icon" type="image/svg+xml" href="${toDocs}icon.svg">
<link rel="stylesheet" href="${toDocs}site.css">
<script src="${toDocs}site.js"></script>
</head>
<body>
<a class="skip" href="#content">Skip to the text</a>
<header>
<a class="brand" href="${toDocs}../index.html"><img src="${toDocs}icon.svg" alt="" width="28" height="28"> plotwright</a>
<div id="finder" role="search">
<input type="search" id="search" placeholder="Search" aria-label="Search" autocomplete="off" spellcheck="false">
<ul id="found" aria-live="polite" hidden></ul>
</div>
<a class="wide" href="${toDocs}index.html">Docs</a>
${source === null ? "" : `<a class="wide" href="${escapeHtml(source)}">Source</a>`}
<select id="theme" aria-label="Theme">${["system", "light", "dark"].map((theme) => `<option value="${theme}">Theme: ${theme}</option>`).join("")}</select>
<a class="button" href="${toDocs}../app/index.html">Open the app</a>
${hasMenu ? '<button type="button" id="menu" aria-expanded="false" aria-controls="navigation">Menu</button>' : ""}
</header>
${body}
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

/** The page's source, and the pages before and after it. */
function pageFooter(current: DocPage, { source }: Place): string {
  const at = PAGES.indexOf(current);
  const [before, after] = [PAGES[at - 1] as DocPage | undefined, PAGES[at + 1] as DocPage | undefined];
  const link = (one: DocPage | undefined, rel: string, words: string): string =>
    one === undefined
      ? "<span></span>"
      : `<a rel="${rel}" href="${one.file}"><small>${words}</small> ${escapeHtml(one.label)}</a>`;
  const own =
    source === null
      ? ""
      : `<p><a href="${escapeHtml(source)}/blob/main/${current.source}">The source of this page</a></p>`;
  return `<footer>${own}${link(before, "prev", "Back")}${link(after, "next", "Next")}</footer>`;
}
