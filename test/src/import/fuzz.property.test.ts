/**
 * Damaged SVGs, 10 000 in the full run: each gives a drawing with finite numbers or a PlotwrightError, within
 * a time limit.
 */
import { describe, expect, it } from "vitest";
import { PlotwrightError } from "../../../src/errors.js";
import { importSvg } from "../../../src/import/svg/import-svg.js";
import { cpuS, endWhenOver } from "../../support/clocks/watchdog.js";
import { generator, mutate } from "../../support/import/mutate.js";
import { countFor } from "../../support/runs/full-run.js";

const CASES = countFor("PLOTWRIGHT_FUZZ_CASES", 10_000, 1_000);
/** Max processor time per file, and the time after which a file counts as hanging, however loaded the machine. */
const LONGEST_S = 2;
const HANGS_MS = 60_000;

const SEEDS = [
  '<svg xmlns="http://www.w3.org/2000/svg" width="100mm" height="80mm" viewBox="0 0 100 80"><style>.a{stroke:red;fill:none}#b>g:not(.x){stroke-width:2px}</style><defs><symbol id="s" viewBox="0 0 9 9"><circle cx="4" cy="4" r="3"/></symbol><linearGradient id="l"><stop stop-color="#f00"/></linearGradient><clipPath id="c" clipPathUnits="objectBoundingBox"><circle cx=".5" cy=".5" r=".4"/></clipPath><marker id="m" orient="auto" viewBox="0 0 4 4"><path d="M0 0l4 2-4 2z"/></marker></defs><g id="b" transform="translate(5 5) rotate(30)"><use href="#s" x="3" width="20" height="20"/><path class="a" d="M0 0h10v10A5 5 0 01 3 4q1 2 3 4t5 5s1 2 3 4z" stroke-dasharray="1 2" marker-end="url(#m)"/></g><g clip-path="url(#c)"><rect x="10%" y="1cm" width="3em" height="20" rx="2" stroke="url(#l)"/><polygon points="1,2 3,4 5,6"/></g></svg>',
  '<svg width="200" height="200"><g inkscape:label="L1" inkscape:groupmode="layer"><path id="p" style="fill:none;stroke:#123456;stroke-width:1.5;transform:scale(2)" d="m 1e1,2e-1 c 1,2 3,4 5,6 z m 3 3"/></g><switch><g systemLanguage="en"><text x="5" y="9" font-size="12">Hi &amp; bye<textPath href="#p" startOffset="10%" side="right">round<tspan dy="2">about</tspan></textPath></text></g></switch><svg x="3" y="4" width="50%" height="50%" viewBox="0 0 1 1" preserveAspectRatio="xMinYMax slice"><ellipse rx=".4" ry=".2"/></svg><image width="5" height="5"/><line x1="1" x2="9" vector-effect="non-scaling-stroke"/></svg>',
];

/** Pieces at which files often break. */
const PIECES =
  'NaN|1e300|-1e308|1e-300|Infinity|0|-1|%|"|\'|<|>|</g>|<g>|/>|&|&#0;|&x;|<!--|-->|<![CDATA[|]]>|url(#c)|url(#|#m|use|href="#b"|<use href="#b"/>|<use href="#s"/>|transform="scale(0)"|matrix(1 0 0|rotate(|,|;|}|{|@media|:not(|var(--x)|--x:var(--x);|!important|M|z|a0 0 0 00 0|\u0000|\ufffd|\ud800|em|viewBox="0 0 0 0"|viewBox="0 0 1e-9 1e9"|width="1e9"|display="none"|<svg|<clipPath id="c" clip-path="url(#c)">|marker="url(#m)"|999999999999999999999'.split(
    "|",
  );

describe("importSvg on damaged files", () => {
  it("is interrupted if it hangs", async () => {
    const hang = async (): Promise<void> => {
      await Promise.resolve();
      for (;;);
    };
    await expect(endWhenOver(50, hang)).rejects.toThrow(/not over in 50 ms/);
  });

  it(`never crashes, hangs, or returns a NaN, ${CASES} times`, async () => {
    let drawn = 0;
    let refused = 0;
    for (let i = 0; i < CASES; i++) {
      const below = generator(i);
      const text = mutate(SEEDS[i % SEEDS.length], PIECES, below);
      try {
        const mark = process.cpuUsage();
        const { paths, clips, widthMm, heightMm } = await endWhenOver(HANGS_MS, () => importSvg(text));
        expect(cpuS(mark), text).toBeLessThan(LONGEST_S);
        expect(paths.coords.every(Number.isFinite), text).toBe(true);
        expect(paths.strokeWidth.every(Number.isFinite), text).toBe(true);
        expect(
          clips.every((clip) => clip.coords.every(Number.isFinite)),
          text,
        ).toBe(true);
        expect(widthMm > 0 && heightMm > 0 && Number.isFinite(widthMm + heightMm), text).toBe(true);
        expect(paths.verbOffsets[paths.count], text).toBe(paths.verbs.length);
        expect(paths.coordOffsets[paths.count], text).toBe(paths.coords.length);
        drawn++;
      } catch (error) {
        if (!(error instanceof PlotwrightError)) throw new Error(`seed ${i}: ${text}`, { cause: error });
        expect(error.code, text).toBe("bad-file");
        refused++;
      }
    }
    // Both outcomes must occur often, or the mutations test nothing.
    expect(drawn).toBeGreaterThan(CASES / 10);
    expect(refused).toBeGreaterThan(CASES / 10);
  });
});
