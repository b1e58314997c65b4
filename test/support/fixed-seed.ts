/**
 * Property tests draw the same cases in every run, so that a failure is there for everybody and a change is
 * judged on what it changes. `PLOTWRIGHT_SEED=random` (or a number) draws others: worth doing after work on
 * an algorithm. Known then: about once in two thousand random polygons, slivers along a border defeat either
 * Clipper's rounding or the sampling that checks it.
 */
import fc from "fast-check";

const asked = process.env["PLOTWRIGHT_SEED"];
if (asked !== "random") fc.configureGlobal({ seed: asked === undefined ? 20_261_121 : Number(asked) });
