/** Comments, messages and documents are in plain, modern English. */

/** Odd or archaic phrases as regular expressions, and their replacements. */
const ODD_WORDS = [
  { odd: "manieth", plain: "Nth" },
  { odd: "gone on with", plain: "resumed" },
  { odd: "go(?:es|ing)? on with", plain: "resume, continue" },
  { odd: "(?:goes|went) on|(?:gone|going) on from", plain: "continues, resumes" },
  { odd: "goes before", plain: "overrides, precedes" },
  { odd: "broken(?: |-)off", plain: "interrupted" },
  { odd: "foretold|foretells?", plain: "predicted" },
  { odd: "nobody", plain: "no one, or name the actor" },
  { odd: "whoever", plain: "name the actor" },
  { odd: "(?:in|at) its own way", plain: "separately" },
  { odd: "(?:has|have) not got", plain: "does not have" },
  { odd: "tells? of", plain: "reports" },
  { odd: "what there is", plain: "name the thing" },
  { odd: "of one's own", plain: "custom" },
  { odd: "baton", plain: "operator lock" },
  { odd: "job book", plain: "job list" },
  { odd: "looks? (?:at most|each)", plain: "samples" },
  { odd: "given in by", plain: "injected by" },
  { odd: "by and by", plain: "gradually" },
  { odd: "for ever", plain: "endlessly" },
  { odd: "told of", plain: "reported" },
  { odd: "that there (?:is|are) not", plain: "missing, unknown" },
  { odd: "of ours", plain: "name the owner" },
  { odd: "heed(?:s|ed)?", plain: "follow" },
  { odd: "whence|hitherto|wherein|thereof", plain: "from, so far, in which, of it" },
  { odd: "anew", plain: "again" },
  { odd: "upon", plain: "on" },
  { odd: "lest", plain: "so that … not" },
  { odd: "for want of", plain: "without" },
  { odd: "it is said", plain: "name the source" },
  { odd: "whereupon|thereby|therein|henceforth|hereby", plain: "then, so, in it" },
  { odd: "in sight", plain: "visible" },
  { odd: "(?:is|are|was|were|be) told", plain: "is notified, is shown" },
  { odd: "(?:server|database|network) is away", plain: "can't be reached" },
  { odd: "such an? \\w+ as", plain: "like, as" },
  { odd: "whilst|amongst|betwixt|withal", plain: "while, among, between" },
];

export interface OddPhrase {
  readonly phrase: string;
  readonly plain: string;
  readonly line: number;
}

/** Every odd phrase in a text, also in names and strings. A phrase may span lines. */
export const oddPhrasesIn = (text: string): OddPhrase[] =>
  ODD_WORDS.flatMap(({ odd, plain }) => {
    const pattern = new RegExp(`\\b(?:${odd.replaceAll(" ", "[\\s*/]+")})\\b`, "gi");
    return [...text.matchAll(pattern)].map(({ 0: phrase, index }) => {
      const line = text.slice(0, index).split("\n").length;
      return { phrase, plain, line };
    });
  });
