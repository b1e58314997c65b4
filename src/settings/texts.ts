/**
 * What each setting does, in a phrase, and what else people call it: for the command line, the page, the HTTP reference and
 * docs/cli.md. Planning needs no texts, so they are not in the tables: a bundler leaves them out of a program that only plans.
 */
import { PEN_SERVO_TABLE, SPRINGS_TABLE, STREAM_TABLE } from "./machine.js";
import {
  AXIS_TABLE,
  DRAW_TABLE,
  EASE_TABLE,
  FIT_TABLE,
  MOTION_TABLE,
  MOTOR_ACCEL,
  QUALITY_TABLE,
  SPEED_FACTOR,
  TRAVEL_TABLE,
} from "./motion.js";
import { DROP_RATE, LAYER_WAIT, LIFT_RATE, OVERLAP_TABLE, PEN_TABLE, PLOT_PEN_TABLE } from "./pen.js";
import { MARGINS_TABLE, PAPER_TABLE } from "./placement.js";
import { HATCH_TABLE, LAYER_REPEATS, PREPARE_TABLE } from "./prepare.js";
import { orAutoInWords, rangeInWords, takesAuto, type Setting, type SettingsTable } from "./setting.js";

interface Texts {
  /** What it does. */
  readonly about: string;
  /** Other words for it, by phrases, for searches. */
  readonly words?: string;
}

const inTable = <T extends SettingsTable>(
  table: T,
  texts: Readonly<Record<keyof T & string, Texts>>,
): (readonly [Setting, Texts])[] => Object.entries(table).map(([key, row]) => [row, texts[key]]);

const TEXTS: ReadonlyMap<Setting, Texts> = new Map<Setting, Texts>([
  ...inTable(STREAM_TABLE, {
    sendAheadMs: {
      about:
        "motion sent ahead of the pen; with less, stops are faster, but the pen may pause when the computer is busy",
      words: "buffer, latency",
    },
  }),
  ...inTable(PEN_SERVO_TABLE, {
    minMs: { about: "time of the shortest move of the pen" },
    slopeMsPerPct: { about: "additional time of a pen move for each percent of the servo's range" },
    liftPctPerS: { about: "how fast the servo's signal rises, if the pen's settings have no lifting speed" },
    dropPctPerS: { about: "how fast the servo's signal falls, if the pen's settings have no lowering speed" },
    frameMs: { about: "interval of the servo's pulses: 24, or 3 for a brushless lift" },
  }),
  ...inTable(SPRINGS_TABLE, {
    xHz: { about: "frequency at which the machine swings along x, from the ringing sheet" },
    yHz: { about: "frequency at which the machine swings along y, from the ringing sheet" },
    damping: { about: "damping ratio of the swing; 0: it never ends" },
  }),
  ...inTable(DRAW_TABLE, {
    speedMmPerS: { about: "maximum speed, pen down", words: "velocity, feed rate, fast, slow" },
    accelMmPerS2: { about: "acceleration, pen down", words: "ramp, accel" },
    cornerMm: {
      about: "how far corners and tight curves may deviate from the drawing, pen down",
      words: "cornering, junction deviation, sharp corners",
    },
    jerkMmPerS3: { about: "maximum change of acceleration, pen down (scurve)", words: "jerk, s-curve" },
  }),
  ...inTable(TRAVEL_TABLE, {
    speedMmPerS: { about: "maximum speed, pen up", words: "velocity, feed rate, fast, slow" },
    accelMmPerS2: { about: "acceleration, pen up", words: "ramp, accel" },
    cornerMm: {
      about: "how far corners may be cut short, pen up",
      words: "cornering, junction deviation, sharp corners",
    },
    jerkMmPerS3: { about: "maximum change of acceleration, pen up (scurve)", words: "jerk, s-curve" },
  }),
  ...inTable(MOTION_TABLE, {
    mode: { about: "how corners are taken", words: "cornering, junction" },
    shaper: {
      about: "input shaper against the machine's swinging; needs its measured frequencies",
      words: "input shaping, resonance, vibration, wobble",
    },
  }),
  ...inTable(AXIS_TABLE, {
    speedXMmPerS: {
      about: "maximum speed along x, pen down and up",
      words: "velocity, feed rate, fast, slow",
    },
    speedYMmPerS: {
      about: "maximum speed along y, pen down and up",
      words: "velocity, feed rate, fast, slow",
    },
    accelXMmPerS2: { about: "maximum acceleration along x, pen down and up", words: "ramp, accel" },
    accelYMmPerS2: { about: "maximum acceleration along y, pen down and up", words: "ramp, accel" },
  }),
  ...inTable(FIT_TABLE, {
    toleranceMm: { about: "how far merged commands may deviate from the plan", words: "deviation, merge" },
    floorMs: { about: "commands are shorter than this only where the drawing requires it" },
  }),
  ...inTable(EASE_TABLE, {
    lengthMm: { about: "length of the slow start and end of every stroke" },
    speedMmPerS: { about: "speed of the slow start and end", words: "velocity, feed rate, fast, slow" },
  }),
  ...inTable(QUALITY_TABLE, {
    quality: {
      about: "sets speed, acceleration and corner rounding together, from the machine's measured swing",
    },
  }),
  ...inTable(PEN_TABLE, {
    upPct: {
      about: "height while travelling",
      words: "pen up height, pen up position, servo up, lift height",
    },
    downPct: {
      about: "height while drawing",
      words: "pen down height, pen down position, servo down, pressure, depth",
    },
    extraLiftMs: {
      about: "wait longer for the pen to lift than the machine's servo usually takes; negative: less long",
      words: "pen up delay, pen lift time, servo delay",
    },
    extraDropMs: {
      about: "wait longer for the pen to drop than the machine's servo usually takes; negative: less long",
      words: "pen down delay, pen drop time, settle, servo delay",
    },
  }),
  ...inTable(OVERLAP_TABLE, {
    overlap: {
      about: "whether the carriage moves while the pen lifts and lowers clear of the paper",
      words: "overlap, tails",
    },
    contactPct: { about: "share of the lift at which the tip leaves the paper", words: "contact height" },
    fullHeightMm: {
      about:
        "travels at least this long lift the pen to its full height, shorter ones only clear of the paper",
    },
  }),
  ...inTable(PLOT_PEN_TABLE, {
    widthMm: { about: "width of the pen's line" },
    offsetXMm: { about: "how far right of the first pen it draws" },
    offsetYMm: { about: "how far below the first pen it draws" },
  }),
  ...inTable(PAPER_TABLE, {
    widthMm: { about: "width of the paper in portrait" },
    heightMm: { about: "height of the paper in portrait" },
  }),
  ...inTable(MARGINS_TABLE, {
    topMm: { about: "free edge at the top of the paper", words: "border, edge, padding" },
    rightMm: { about: "free edge at the right of the paper", words: "border, edge, padding" },
    bottomMm: { about: "free edge at the bottom of the paper", words: "border, edge, padding" },
    leftMm: { about: "free edge at the left of the paper", words: "border, edge, padding" },
  }),
  ...inTable(HATCH_TABLE, {
    spacingMm: { about: "fill areas with lines this far apart; 0 leaves them empty" },
    angleDeg: { about: "direction of the hatch lines, clockwise from the x axis" },
    cross: { about: "hatch in both directions" },
  }),
  ...inTable(PREPARE_TABLE, {
    landscape: { about: "use a named paper size in landscape", words: "portrait, orientation" },
    marginMm: { about: "free edge around the drawing", words: "border, edge, padding" },
    fit: {
      about: "scale the drawing to the paper inside the margins",
      words: "scale, size, zoom, fit to page, true size",
    },
    pxPerInch: {
      about: "size of the px of a file whose page is given in px",
      words: "dpi, ppi, px per inch, pixels, scale",
    },
    outside: {
      about:
        "if the drawing leaves the paper: plot nothing, cut it off at the edge, move it onto the paper, fit it to the paper, or draw it",
      words: "crop, clip, overflow",
    },
    rotateDeg: { about: "turn the drawing clockwise about its middle, before fitting", words: "turn, angle" },
    mirror: { about: "mirror the drawing", words: "flip, reflect, reverse" },
    clipToMargins: { about: "cut off what lies outside the margins", words: "clip, crop, mask" },
    cropToPage: { about: "cut off what lies outside the file's own page", words: "clip, crop, artboard" },
    tileColumns: {
      about: "spread the drawing over this many sheets beside each other",
      words: "tiles, tiling, poster, large, several sheets, columns",
    },
    tileRows: {
      about: "spread the drawing over this many sheets below each other",
      words: "tiles, tiling, poster, large, several sheets, rows",
    },
    tileOverlapMm: { about: "how much of the drawing neighbouring sheets share", words: "tiles, glue" },
    tileMarks: {
      about: "with several sheets: draw marks in the margins that show where to cut",
      words: "tiles, crop marks, registration",
    },
    tile: {
      about: "which of several sheets is plotted, counted row by row; 0: all of them, one after the other",
      words: "tiles, one sheet again",
    },
    outlineFills: { about: "draw the outline of shapes that are only filled", words: "stroke, border" },
    hatchOutlines: { about: "when hatching: fill closed lines too, not only filled shapes" },
    hideCovered: {
      about: "leave out lines under shapes that are painted later",
      words: "occlusion, hidden lines, overlap",
    },
    joinMm: { about: "join ends that are closer than this", words: "merge lines, connect, weld" },
    dropShorterMm: {
      about: "leave out strokes shorter than this; 0 keeps dots too",
      words: "filter, tiny, dots, remove short",
    },
    dropRepeatsMm: {
      about: "leave out lines already drawn within this distance; 0 keeps all",
      words: "duplicates, double lines, deduplicate",
    },
    simplifyMm: {
      about: "drop points closer than this to the line (Douglas–Peucker)",
      words: "reduce points, optimise, optimize",
    },
    flattenMm: {
      about: "maximum gap between a curve and its chords, on paper",
      words: "flatten, resolution, segments, tolerance",
    },
    smoothRounds: {
      about: "rounds of corner cutting (Chaikin); each round doubles the number of points",
      words: "soften",
    },
    reloop: { about: "begin closed strokes at a random point" },
    order: { about: "order of strokes", words: "sort, optimise, optimize, travel, reorder" },
    orderS: { about: "how long the search for the best order may take" },
    spread: {
      about: "draw neighbouring strokes at different times, so that ink dries",
      words: "shuffle, smear, bleed",
    },
    reinkMm: {
      about: "stop after this length of drawing, to take up ink; 0: never",
      words: "refill, dip, brush, paint",
    },
    layers: { about: "what makes a layer", words: "groups, colours, colors, sublayers" },
  }),
  [MOTOR_ACCEL, { about: "maximum acceleration of one motor" }],
  [SPEED_FACTOR, { about: "share of the usual speed at which it is drawn" }],
  [LIFT_RATE, { about: "how fast the pen rises" }],
  [DROP_RATE, { about: "how fast the pen is lowered", words: "pen down speed, servo speed" }],
  [LAYER_WAIT, { about: "wait with the pen up before the layer's first stroke" }],
  [LAYER_REPEATS, { about: "how often the layer is drawn" }],
]);

function textsOf(row: Setting): Texts {
  const texts = TEXTS.get(row);
  if (texts === undefined)
    throw new TypeError(`The setting "${row.label}" has no texts in src/settings/texts.ts.`);
  return texts;
}

/**
 * What a row of the settings tables does, in a phrase.
 *
 * @throws TypeError for a row that is in none of them
 */
export const aboutOf = (row: Setting): string => textsOf(row).about;

/** What else people call it, by phrases; "" if nothing. Throws as `aboutOf` does. */
export const wordsOf = (row: Setting): string => textsOf(row).words ?? "";

/** A row in sentences: "Free edge around the drawing (0 to 1000 mm). Default 15." */
export function meaningInWords(row: Setting, withDefault: boolean): string {
  const text = aboutOf(row);
  const about = `${text.charAt(0).toUpperCase()}${text.slice(1)}`;
  const range = takesAuto(row) ? orAutoInWords(row) : row.kind === "number" ? rangeInWords(row) : "";
  const initial = typeof row.default === "string" ? `"${row.default}"` : String(row.default);
  const why = row.aboutAuto === undefined ? "" : `: ${row.aboutAuto}`;
  return `${about}${range === "" ? "" : ` (${range})`}.${withDefault ? ` Default ${initial}${why}.` : ""}`;
}
