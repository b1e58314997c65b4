/** Writes samples/*.svg. They are committed: run this only after changing how one is drawn (`npm run samples`). */
import { writeFileSync } from "node:fs";
import { harmonograph } from "./samples/harmonograph.js";
import { letters } from "./samples/letters.js";
import { meadow } from "./samples/meadow.js";
import { moonrise } from "./samples/moonrise.js";
import { threeColours } from "./samples/three-colours.js";
import { whirlTriangles } from "./samples/whirl.js";

/** The page opens the first by name, so this one must come first. */
const SAMPLES: Readonly<Record<string, () => string>> = {
  "flower-meadow": meadow,
  harmonograph: harmonograph,
  "hello-paper": letters,
  moonrise: moonrise,
  "three-colour-hills": threeColours,
  "whirling-triangles": whirlTriangles,
};

for (const [name, draw] of Object.entries(SAMPLES)) {
  const svg = draw();
  writeFileSync(new URL(`../samples/${name}.svg`, import.meta.url), svg);
  console.log(`${name}.svg  ${Math.round(svg.length / 1000)} kB  ${svg.split("<path").length - 1} paths`);
}
