/**
 * Full-text search. `npm run build:site` makes the index from the pages; the site's script loads this file and the index
 * when the reader goes to the search field.
 */
import MiniSearch, { type Options, type SearchResult } from "minisearch";

/** The text below one heading of a page. */
export interface Section {
  readonly id: number;
  /** Of the page, in the navigation. */
  readonly page: string;
  readonly title: string;
  /** In the folder docs/, with the heading's id. */
  readonly href: string;
  readonly text: string;
}

const OPTIONS: Options<Section> = {
  fields: ["title", "page", "text"],
  storeFields: ["title", "page", "href", "text"],
  searchOptions: {
    boost: { title: 4, page: 3 },
    combineWith: "AND",
    prefix: true,
    fuzzy: (word) => (word.length > 4 ? 0.2 : false),
  },
};

/** The index as text. */
export function indexOf(sections: readonly Section[]): string {
  const index = new MiniSearch(OPTIONS);
  index.addAll(sections);
  return JSON.stringify(index);
}

const MAX_FOUND = 20;
const EXCERPT_CHARS = 150;

/** A piece of an excerpt; `isMatch`: it is one of the words that were searched for. */
interface Piece {
  readonly text: string;
  readonly isMatch: boolean;
}

export interface Found {
  readonly title: string;
  readonly page: string;
  readonly href: string;
  readonly excerpt: readonly Piece[];
}

/** A function that searches the index. */
export function searchIn(index: string): (words: string) => Found[] {
  const loaded = MiniSearch.loadJSON(index, OPTIONS);
  return (words) => loaded.search(words).slice(0, MAX_FOUND).map(foundOf);
}

function foundOf(result: SearchResult): Found {
  const { title, page, href, text } = result as unknown as Section;
  return { title, page, href, excerpt: excerptOf(text, result.terms) };
}

/** The text around the first of the words, in pieces. */
function excerptOf(text: string, words: readonly string[]): Piece[] {
  const anyWord = new RegExp(`(?<![\\p{L}\\p{N}])(?:${words.map(escaped).join("|")})`, "giu");
  const first = Math.max(0, text.search(anyWord));
  const start = first < EXCERPT_CHARS / 2 ? 0 : text.indexOf(" ", first - EXCERPT_CHARS / 2) + 1;
  const full = start + EXCERPT_CHARS;
  const end = full < text.length ? text.lastIndexOf(" ", full) : text.length;
  const shown = `${start > 0 ? "… " : ""}${text.slice(start, end)}${end < text.length ? " …" : ""}`;
  const pieces: Piece[] = [];
  let done = 0;
  for (const match of shown.matchAll(anyWord)) {
    pieces.push({ text: shown.slice(done, match.index), isMatch: false }, { text: match[0], isMatch: true });
    done = match.index + match[0].length;
  }
  return [...pieces, { text: shown.slice(done), isMatch: false }];
}

const escaped = (word: string): string => word.replace(/[.*+?^${}()|[\]\\]/g, "\\$&");
