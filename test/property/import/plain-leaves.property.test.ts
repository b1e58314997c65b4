/**
 * Runs of plain elements have a way of their own through the importer. Inside a link text may mean something, so that
 * there the XML parser reads all of it: both ways have to come to the same, in good files and in damaged ones.
 */
import { describe, expect, it } from "vitest";
import { PlotwrightError } from "../../../src/errors.js";
import { importSvg } from "../../../src/import/svg/import-svg.js";
import { generator, mutate } from "./support/mutate.js";

const CASES = 400;

const HEAD =
  '<svg xmlns="http://www.w3.org/2000/svg" xmlns:inkscape="i" xmlns:sodipodi="s" width="90mm" height="90mm" viewBox="0 0 90 90">';
const STYLES = [
  "",
  "<style>.a{stroke:red}</style>",
  "<style>#p1{stroke:red}path:nth-child(3){stroke:#0f0}</style>",
];
const DEFS =
  '<defs><clipPath id="c"><circle r="40"/></clipPath><marker id="m"><path d="M0 0h2"/></marker><linearGradient id="l"><stop stop-color="red"/></linearGradient></defs>\n';

/** Elements as programs write them, `N` being a number that is another in each. */
const LEAVES = [
  '<path d="MN N LN 5" stroke-width="0.3"/>\n',
  '<path\n   style="stroke:#00f;fill:none"\n   id="pN"\n   d="M N,1 N,2"\n   sodipodi:nodetypes="cc" />\n',
  '\t<line x1="N" y1="2" x2="30%" y2="N" stroke="red"/>\r\n',
  "<circle cx='N' cy='3' r='2' class='a'/>",
  '<rect width="N" height="4" transform="rotate(N)"/><rect width="3" height="N" transform="skew(1"/>\n',
  '<path d="M1 N\n\tL4 N" stroke="#123"/>',
  '<path d="MN 1hN" stroke="red" stroke-dasharray="2" pathLength="9"/> ',
  '<rect width="N" height="4" transform="scale(1" stroke="red"/>\n',
  '<path d="M0 NhN" stroke="red" clip-path="url(#c)"/><path d="M0 NhN" stroke="red" clip-path="url(#c)"/>',
  '<path d="M0 NhN" stroke="url(#l)"/>\n',
  '<path d="M1 1hN" stroke="url(#none) red"/><path d="M1 1x" stroke="red"/><path d="MN 1" stroke="red"/>',
  '<path d="M1 Nh3" stroke="red" marker-end="url(#m)"/><path d="M0 N" clip-path="url(#c)" d2="&lt;"/>',
  '<svg stroke="blue" inkscape:label="ä"><path d="M0 NhN"/></svg><!-- N --><title>N</title>',
  "<foreignObject/><metadata/><image width='N' height='1'/><use href='#p1' x='N'/>N",
];
const PIECES = [
  '"',
  "'",
  "<",
  ">",
  "/",
  "&",
  "&#10;",
  "\n",
  "\t",
  "\r",
  "é",
  "😀",
  "\u0000",
  "]]>",
  "</svg>",
  ' d="M1"',
  "<svg>",
];

/** Runs of some of the leaves, and single ones. */
function leaves(below: (end: number) => number): string {
  let text = STYLES[below(STYLES.length)] + DEFS;
  for (let run = 0; run < 6; run++) {
    const leaf = LEAVES[below(LEAVES.length)];
    for (let k = below(5); k >= 0; k--) text += leaf.replace(/N/g, () => String(below(80)));
  }
  return text;
}

/** The drawing, or the fault. */
function outcome(text: string): unknown {
  try {
    return importSvg(text);
  } catch (error) {
    expect(error).toBeInstanceOf(PlotwrightError);
    return (error as PlotwrightError).message.replace("unclosed tag: a", "unclosed tag: g");
  }
}

describe("runs of plain elements", () => {
  it(`are read as the XML parser reads them, whole and damaged, ${CASES} times each`, () => {
    let faults = 0;
    for (let i = 0; i < CASES; i++) {
      const below = generator(i);
      const whole = leaves(below);
      for (const inside of [whole, mutate(whole, PIECES, below)]) {
        const [plain, parsed] = ["g", "a"].map((tag) =>
          outcome(`${HEAD}\n<${tag}>${inside}</${tag}>\n</svg>`),
        );
        if (typeof plain === "string") faults++;
        expect(plain).toEqual(parsed);
      }
    }
    expect(faults).toBeGreaterThan(CASES / 10);
    expect(faults).toBeLessThan(CASES);
  });
});
