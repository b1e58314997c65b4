/** Our import compared with resvg on real icons and on tricky files: same shapes, same order, same places. */
import { readdirSync, readFileSync } from "node:fs";
import { createRequire } from "node:module";
import { dirname, join } from "node:path";
import { beforeAll, describe, expect, it } from "vitest";
import { disagreement } from "../../../support/import/disagreement.js";
import { farthest, loadResvg, resvgShapes, type Polyline } from "../../../support/import/resvg-shapes.js";

/** Of the page's larger side. */
const TOLERANCE = 0.001;
const ICONS_PER_SET = 75;

/** Evenly spread over the folder, so that a new version of the set changes little. */
function sample(packageName: string, folder: string): [string, string][] {
  const root = dirname(createRequire(import.meta.url).resolve(`${packageName}/package.json`));
  const names = readdirSync(join(root, folder))
    .filter((name) => name.endsWith(".svg"))
    .sort();
  const step = names.length / ICONS_PER_SET;
  return Array.from({ length: ICONS_PER_SET }, (_, i) => {
    const name = names[Math.floor(i * step)];
    return [`${packageName}/${name}`, readFileSync(join(root, folder, name), "utf8")];
  });
}

beforeAll(loadResvg);

describe("agreement with an independent renderer", () => {
  it.each([
    ["feather-icons", "dist/icons"],
    ["bootstrap-icons", "icons"],
    ["heroicons", "24/outline"],
  ])(`on ${ICONS_PER_SET} icons of %s`, async (packageName, folder) => {
    for (const [name, svg] of sample(packageName, folder)) {
      expect(await disagreement(svg), name).toBeLessThan(TOLERANCE);
    }
  });

  it("fails if a shape is slightly off, so the comparison can fail", () => {
    const theirs = resvgShapes(
      '<svg xmlns="http://www.w3.org/2000/svg" width="100" height="100"><path stroke="red" d="M10 10h50"/></svg>',
    ).shapes[0];
    const moved: Polyline[] = [theirs[0].map(([x, y]) => [x + 0.2, y])];
    expect(farthest(moved, theirs) / 100).toBeGreaterThan(TOLERANCE);
  });

  it.each([
    [
      "a symbol with aspect ratio",
      '<symbol id="s" viewBox="0 0 20 10" preserveAspectRatio="xMaxYMin meet"><circle cx="5" cy="5" r="4" stroke="red"/></symbol><use href="#s" x="10" y="5" width="30" height="40"/>',
    ],
    [
      "CSS with everything",
      '<style>g>.a:not(#b){stroke:red}#b{stroke:blue!important}</style><g><path class="a" d="M1 1h9"/><path class="a" id="b" style="stroke:none" d="M2 9h9"/></g>',
    ],
    [
      "nested svg and percent",
      '<svg x="10%" y="20%" width="50%" height="50%" viewBox="0 0 7 9"><rect width="70%" height="50%" stroke="red" rx="1"/></svg>',
    ],
    [
      "switch and display",
      '<switch><g systemLanguage="xx"><path d="M0 0h1" stroke="red"/></g><g><path d="M5 5h9" stroke="red"/></g></switch><path display="none" d="M0 0h9" stroke="red"/>',
    ],
    [
      "arcs of every flag",
      '<g stroke="red" fill="none"><path d="M10 50A30 20 30 0 0 60 40"/><path d="M10 50A30 20 30 0 1 60 40"/><path d="M10 50A30 20 30 1 0 60 40"/><path d="M10 50A30 20 30 1 1 60 40a3 9-20 0190.5.5"/></g>',
    ],
    [
      "units",
      '<g stroke="red" font-size="16"><line x1="1mm" y1="1cm" x2="1in" y2="20pt"/><circle cx="2em" cy="3ex" r="5%"/></g>',
    ],
    [
      "transforms",
      '<g transform="rotate(20 30 40) skewX(10),scale(1.5 .7)translate(3)"><rect x="5" y="6" width="20" height="9" ry="3" stroke="red"/></g>',
    ],
    [
      "use of use",
      '<defs><path id="p" d="M0 0q5 9 9 0t9 0"/><g id="g" stroke="red"><use href="#p" y="3"/></g></defs><use href="#g" x="9" transform="scale(2)"/>',
    ],
    [
      "smooth curves",
      '<path stroke="red" d="M5 5c5 9 9 9 9 0s9-9 9 0S40 40 50 5Q60 9 70 5T90 9t5 5V50H20z"/>',
    ],
    [
      "markers",
      '<marker id="m" orient="auto" markerWidth="5" markerHeight="5" refX="2" refY="2" viewBox="0 0 4 4"><path d="M1 1L3 2L1 3" stroke="red"/></marker><path d="M10 10L40 20L30 60" fill="none" stroke="red" stroke-width="2" marker-start="url(#m)" marker-mid="url(#m)" marker-end="url(#m)"/>',
    ],
  ])("on %s", async (_name, body) => {
    expect(
      await disagreement(`<svg xmlns="http://www.w3.org/2000/svg" width="100" height="100">${body}</svg>`),
    ).toBeLessThan(TOLERANCE / 2);
  });
});
