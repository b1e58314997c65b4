/** Features of SVG that test suites cover, each drawn as resvg, an independent renderer, draws it. */
import { beforeAll, describe, expect, it } from "vitest";
import { disagreement } from "../../../support/import/disagreement.js";
import { loadResvg } from "../../../support/import/resvg-shapes.js";

/** Fraction of the page's side. */
const TOLERANCE = 0.0005;

beforeAll(loadResvg);

const expectAgreement = async (body: string, attributes = 'width="100" height="100"'): Promise<void> => {
  const head = `xmlns="http://www.w3.org/2000/svg" xmlns:xlink="http://www.w3.org/1999/xlink" ${attributes}`;
  expect(await disagreement(`<svg ${head}>${body}</svg>`)).toBeLessThan(TOLERANCE);
};

describe("markers", () => {
  const LINE =
    '<path d="M20 20L60 40L30 80" fill="none" stroke="red" stroke-width="2" marker-end="url(#m)"/>';
  it.each([
    [
      "inherit from their parent, not from the shape",
      `<g fill="none" stroke="blue"><marker id="m" markerWidth="5" markerHeight="5"><path d="M1 1L3 2L1 3"/></marker></g>${LINE}`,
    ],
    [
      "with a reference point in percent",
      `<marker id="m" markerWidth="9" markerHeight="9" refX="5%" refY="2%" overflow="visible"><path d="M1 1L3 2L1 3z"/></marker>${LINE}`,
    ],
    [
      "in the colours of the shape",
      `<marker id="m" markerWidth="5" markerHeight="5"><path d="M1 1L3 2L1 3z" fill="context-stroke"/></marker>${LINE}`,
    ],
    [
      "turned at a cusp",
      `<marker id="m" markerWidth="5" markerHeight="5" orient="auto" overflow="visible"><path d="M1 1L3 2L1 3z"/></marker>
       <path d="M20 75C47 70 50 52 50 20C50 52 52 70 80 80" fill="none" stroke="red" marker-mid="url(#m)"/>`,
    ],
  ])("%s", async (_name, body) => {
    await expectAgreement(body);
  });
});

describe("shapes", () => {
  it.each([
    ["a rectangle with a negative rx", '<rect x="10" y="10" width="50" height="40" rx="-5" ry="8"/>'],
    ["a rectangle with two negative radii", '<rect x="10" y="10" width="50" height="40" rx="-5" ry="-8"/>'],
    ["an ellipse with a negative rx", '<ellipse cx="50" cy="50" rx="-5" ry="20"/>'],
  ])("%s", async (_name, body) => {
    await expectAgreement(body);
  });
});
