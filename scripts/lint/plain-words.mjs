/**
 * Lint rule `plain-words`: comments and messages are in plain, modern English. Each entry has an odd or archaic phrase
 * as a regular expression, and its replacement. The rule checks the whole text of a file, including names and strings.
 */
export const ODD_WORDS = [
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

/** Finds every odd phrase: `{ index, phrase, plain }`, in the order of ODD_WORDS. A phrase may span lines. */
export function* oddWordsIn(text) {
  for (const { odd, plain } of ODD_WORDS) {
    const pattern = new RegExp(`\\b(?:${odd.replaceAll(" ", "[\\s*/]+")})\\b`, "gi");
    for (const { 0: phrase, index } of text.matchAll(pattern)) yield { index, phrase, plain };
  }
}

/** @type {import("eslint").Rule.RuleModule} */
export const plainWords = {
  meta: { type: "suggestion", schema: [] },
  create: ({ sourceCode, report }) => ({
    Program() {
      for (const { index, phrase, plain } of oddWordsIn(sourceCode.text)) {
        const message = `Use plain English instead of "${phrase}": ${plain}.`;
        report({ loc: sourceCode.getLocFromIndex(index), message });
      }
    },
  }),
};
