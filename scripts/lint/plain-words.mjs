/**
 * Lint rule `plain-words`: comments and messages are in plain, modern English. Each entry is a phrase that once had to
 * be read twice in this project, and what to write in its place. The rule reads the whole text of a file, so names and
 * strings count too.
 */
export const ODD_WORDS = [
  { odd: "so manieth", plain: "Nth" },
  { odd: "gone on with", plain: "resumed" },
  { odd: "go(?:es|ing)? on with", plain: "resume, continue" },
  { odd: "foretold|foretells?", plain: "predicted" },
  { odd: "nobody", plain: "no one, or name the actor" },
  { odd: "whoever", plain: "name the actor" },
  { odd: "(?:in|at) its own way|at its own", plain: "separately" },
  { odd: "(?:has|have) not got", plain: "does not have" },
  { odd: "tells? of", plain: "reports" },
  { odd: "what there is", plain: "name the thing" },
  { odd: "of one's own", plain: "custom" },
  { odd: "baton", plain: "operator lock" },
  { odd: "job book", plain: "job list" },
  { odd: "looks? (?:at most|each)", plain: "samples" },
  { odd: "given in by", plain: "injected by" },
  { odd: "by and by", plain: "gradually" },
  { odd: "anew", plain: "again" },
  { odd: "upon", plain: "on" },
  { odd: "lest", plain: "so that … not" },
  { odd: "for want of", plain: "without" },
  { odd: "it is said", plain: "name the source" },
];

/** Finds every odd phrase: `{ index, phrase, plain }`, in the order of ODD_WORDS. Phrases may be broken over lines. */
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
        const message = `Write plainly: in the place of "${phrase}" (${plain}).`;
        report({ loc: sourceCode.getLocFromIndex(index), message });
      }
    },
  }),
};
