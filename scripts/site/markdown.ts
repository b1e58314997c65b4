/** Markdown of the repository to HTML of the site: ids of headings as on GitHub, links between the files as pages. */
import path from "node:path";
import highlight from "highlight.js/lib/core";
import bash from "highlight.js/lib/languages/bash";
import javascript from "highlight.js/lib/languages/javascript";
import json from "highlight.js/lib/languages/json";
import python from "highlight.js/lib/languages/python";
import typescript from "highlight.js/lib/languages/typescript";
import { Marked, type Tokens } from "marked";
import { PAGES, type DocPage } from "./pages.js";

highlight.registerLanguage("ts", typescript);
highlight.registerLanguage("js", javascript);
highlight.registerLanguage("sh", bash);
highlight.registerLanguage("json", json);
highlight.registerLanguage("python", python);

export interface Heading {
  readonly depth: number;
  readonly id: string;
  /** Plain text. */
  readonly text: string;
}

export interface Rendered {
  readonly html: string;
  readonly headings: readonly Heading[];
  /** Paths in the repository of the pictures that the page shows. */
  readonly pictures: readonly string[];
}

const ENTITIES: Readonly<Record<string, string>> = { "&": "&amp;", "<": "&lt;", ">": "&gt;", '"': "&quot;" };
export const escapeHtml = (text: string): string => text.replace(/[&<>"]/g, (one) => ENTITIES[one]);

/** `source`: the file's path in the repository, which its links are relative to. */
export function renderMarkdown(source: string, markdown: string): Rendered {
  const headings: Heading[] = [];
  const pictures: string[] = [];
  const idFor = idWriter();
  const marked = new Marked({
    renderer: {
      heading({ tokens, depth }: Tokens.Heading) {
        const text = plainText(tokens);
        const id = idFor(text);
        headings.push({ depth, id, text });
        const anchor =
          depth === 1
            ? ""
            : ` <a class="anchor" href="#${id}" aria-label="Link to “${escapeHtml(text)}”">#</a>`;
        return `<h${depth} id="${id}">${this.parser.parseInline(tokens)}${anchor}</h${depth}>\n`;
      },
      link({ href, text, tokens }: Tokens.Link) {
        // On GitHub the text of a link is a file's name. On the site it is the label of the file's page.
        const page = text.endsWith(".md") ? pageOf(source, href) : undefined;
        const words = page === undefined ? this.parser.parseInline(tokens) : escapeHtml(page.label);
        return `<a href="${escapeHtml(linkTo(source, href))}">${words}</a>`;
      },
      image({ href, text }: Tokens.Image) {
        const picture = inRepository(source, href);
        pictures.push(picture);
        const file = escapeHtml(picture.replace(/^docs\//, ""));
        // The link shows the picture in full size: on a phone its words are too small.
        return `<a href="${file}"><img src="${file}" alt="${escapeHtml(text)}"></a>`;
      },
      text(token: Tokens.Text | Tokens.Escape) {
        const { tokens = [] } = token as Partial<Tokens.Text>;
        if (tokens.length > 0) return this.parser.parseInline(tokens);
        return escapeHtml(keepNumbersTogether(token.text));
      },
      codespan({ text }: Tokens.Codespan) {
        // A short option or name stays on one line; a path may break before a slash.
        const mark = text.length <= 20 ? ' class="whole"' : "";
        const html = escapeHtml(text).replace(/(?<=\w)\/(?=[\w:])/g, "<wbr>/");
        return `<code${mark}>${keepOptionsTogether(html)}</code>`;
      },
      code({ text, lang = "" }: Tokens.Code) {
        const [language, file] = lang.split(" ");
        // A drawing made of characters scrolls, because its lines must not wrap: the keyboard must be able to reach them.
        if (language === "")
          return `<div class="code"><pre tabindex="0"><code>${escapeHtml(text)}</code></pre></div>\n`;
        const colored = highlight.highlight(text, { language }).value;
        const value = language === "sh" ? keepOptionsTogether(colored) : colored;
        const name = file === undefined || file === "no-run" ? "" : `<p class="file">${escapeHtml(file)}</p>`;
        return `<div class="code">${name}<pre class="wraps"><code>${value}</code></pre></div>\n`;
      },
      table({ header, align, rows }: Tokens.Table) {
        const cell = (tag: string) => (one: Tokens.TableCell, column: number) => {
          const side = align[column] === null ? "" : ` class="${align[column]}"`;
          return `<${tag}${side}>${this.parser.parseInline(one.tokens)}</${tag}>`;
        };
        const hasHeader = header.some(({ text }) => text !== "");
        // A header cell without text says nothing to a screen reader.
        const head = header.map((one, i) => cell(one.text === "" ? "td" : "th")(one, i)).join("");
        const body = rows.map((row) => `<tr>${row.map(cell("td")).join("")}</tr>`).join("\n");
        return `<div class="table" tabindex="0" role="region" aria-label="Table"><table>${
          hasHeader ? `<thead><tr>${head}</tr></thead>` : ""
        }<tbody>\n${body}\n</tbody></table></div>\n`;
      },
      html({ text }: Tokens.HTML | Tokens.Tag) {
        if (!text.trim().startsWith("<!--")) throw new Error(`${source}: HTML in Markdown: ${text.trim()}`);
        return "";
      },
    },
  });
  const html = marked.parse(markdown, { async: false });
  return { html, headings, pictures };
}

/** Prevents line breaks between the hyphens of an option and its first word. */
const keepOptionsTogether = (html: string): string =>
  html.replace(/(?<![\w-])--?[a-z]\w*/gi, '<span class="option">$&</span>');

/** Prevents line breaks in "10 000" and "15 / 25", and between a number and its unit. */
const keepNumbersTogether = (text: string): string =>
  text
    .replace(
      /(?<=\d) (?=\d{3}(?!\d)|%|(?:mm|s|ms|min|kB|MB|Hz|mm\/s|mm\/s²|mm\/s³|steps\/s)(?![\w/]))/g,
      "\u00a0",
    )
    .replace(/(?<=\d) \/ (?=\d)/g, "\u00a0/\u00a0");

/** Where a link of a Markdown file leads on the site. Throws if its target is not on the site. */
function linkTo(source: string, href: string): string {
  if (/^(https?|mailto):/.test(href) || href.startsWith("#")) return href;
  const anchor = href.split("#")[1] as string | undefined;
  const found = pageOf(source, href);
  if (found === undefined) throw new Error(`${source}: the link to ${href} leads to no page of the site`);
  return anchor === undefined ? found.file : `${found.file}#${anchor}`;
}

function pageOf(source: string, href: string): DocPage | undefined {
  const target = inRepository(source, href.split("#")[0]);
  return PAGES.find((one) => one.source === target);
}

const inRepository = (source: string, href: string): string =>
  path.posix.join(path.posix.dirname(source), decodeURI(href));

interface InlineToken {
  readonly type: string;
  readonly text?: string;
  readonly tokens?: readonly InlineToken[];
}

/** The page's first sentences, for search engines and previews of links. */
export function descriptionOf(html: string): string {
  const texts = [...html.matchAll(/<(p|li)>([\s\S]*?)<\/\1>/g)].map((match) => textOf(match[2]));
  const first = texts.find(({ length }) => length >= MIN_DESCRIPTION) ?? "";
  return first.length <= MAX_DESCRIPTION
    ? first
    : `${first.slice(0, first.lastIndexOf(" ", MAX_DESCRIPTION))} …`;
}
const MIN_DESCRIPTION = 40;
const MAX_DESCRIPTION = 160;

/** The page's text by its headings, for the search. */
export function sectionsOf({ html, headings }: Rendered): (Heading & { readonly content: string })[] {
  const starts = headings.map(({ id, depth }) => html.indexOf(`<h${depth} id="${id}"`));
  return headings.map((heading, i) => {
    const section = html.slice(starts[i], starts[i + 1]);
    return { ...heading, content: textOf(section.slice(section.indexOf("</h"))) };
  });
}

const CHARACTERS: Readonly<Record<string, string>> = { amp: "&", lt: "<", gt: ">", quot: '"', "#x27": "'" };
/** HTML without its tags. Words of different cells and paragraphs stay apart. */
const textOf = (html: string): string =>
  html
    .replace(/<\/?(?:p|li|ul|ol|td|th|tr|table|thead|tbody|pre|div|h\d)\b[^>]*>/g, " ")
    .replace(/<[^>]*>/g, "")
    .replace(/&(amp|lt|gt|quot|#x27);/g, (_, name: string) => CHARACTERS[name])
    .replace(/\s+/g, " ")
    .trim();

const plainText = (tokens: readonly InlineToken[]): string =>
  tokens.map((token) => (token.tokens === undefined ? (token.text ?? "") : plainText(token.tokens))).join("");

/** Ids as GitHub makes them, so that one link works in both places. */
function idWriter(): (text: string) => string {
  const counts = new Map<string, number>();
  return (text) => {
    const id = text
      .toLowerCase()
      .replace(/[^\p{L}\p{N}\s_-]/gu, "")
      .replaceAll(" ", "-");
    const count = counts.get(id) ?? 0;
    counts.set(id, count + 1);
    return count === 0 ? id : `${id}-${count}`;
  };
}
