/**
 * Property tests use the same cases in every run, so that a failure is reproducible and independent of
 * earlier runs. `PLOTWRIGHT_SEED=random` (or a number) uses others: do this after work on an algorithm. Known
 * failure of other seeds: in about one of two thousand random polygons, slivers along a border defeat either
 * Clipper's rounding or the sampling that checks it.
 */
import fc from "fast-check";

const asked = process.env["PLOTWRIGHT_SEED"];
if (asked !== "random") fc.configureGlobal({ seed: asked === undefined ? 20_261_121 : Number(asked) });
