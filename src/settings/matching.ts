/** Finds settings and actions by the words that people use: which entries fit what was typed, best first. */

export interface Searched {
  readonly label: string;
  /** Other words for it, by phrases. */
  readonly words: string;
  /** Where it is: the titles of its panels. */
  readonly where: string;
}

/** Small letters without accents, and only spaces between words. */
const plain = (text: string): string =>
  text
    .normalize("NFD")
    .replace(/\p{M}/gu, "")
    .toLowerCase()
    .replace(/[^\p{L}\p{N}]+/gu, " ")
    .trim();

/** A name counts more than another word for the thing, and that more than the panel's title. */
const WEIGHTS = { label: 8, words: 4, where: 1 } as const;
const WHOLE_NAME = 20;
const WHOLE_PHRASE = 14;

/** How well one typed word fits: at the beginning of a word, or, from three letters on, within one. 0: not at all. */
const fitOfWord = (typed: string, text: string): number => {
  if (` ${text}`.includes(` ${typed}`)) return ` ${text} `.includes(` ${typed} `) ? 1 : 0.8;
  return typed.length >= 3 && text.includes(typed) ? 0.3 : 0;
};

/** 0: one of the typed words fits nowhere. */
const fitOf = (query: string, { label, words, where }: Searched): number => {
  const texts = { label: plain(label), words: plain(words), where: plain(where) };
  let sum = 0;
  for (const typed of query.split(" ")) {
    const fits = (["label", "words", "where"] as const).map(
      (which) => WEIGHTS[which] * fitOfWord(typed, texts[which]),
    );
    const best = Math.max(...fits);
    if (best === 0) return 0;
    sum += best;
  }
  if (texts.label === query) return sum + WHOLE_NAME;
  const isPhrase = words.split(",").some((phrase) => plain(phrase) === query);
  return sum + (isPhrase ? WHOLE_PHRASE : 0);
};

/** Entries that fit equally well stay in their order. */
export const bestMatches = <T extends Searched>(typed: string, entries: readonly T[]): readonly T[] => {
  const query = plain(typed);
  if (query === "") return entries;
  return entries
    .map((entry) => ({ entry, fit: fitOf(query, entry) }))
    .filter(({ fit }) => fit > 0)
    .sort((a, b) => b.fit - a.fit)
    .map(({ entry }) => entry);
};
