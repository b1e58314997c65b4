/**
 * The settings that the search finds, and where each is on the page. Names and other words come from the settings
 * tables; words are added here only for fields without a row.
 */
import {
  aboutOf,
  AXIS_TABLE,
  DRAW_TABLE,
  DROP_RATE,
  EASE_TABLE,
  FIT_TABLE,
  HATCH_TABLE,
  MOTION_TABLE,
  OVERLAP_TABLE,
  PAPER_TABLE,
  PEN_TABLE,
  PREPARE_TABLE,
  STREAM_TABLE,
  TRAVEL_TABLE,
  findMachine,
  tileCount,
  type Setting,
  wordsOf,
} from "../../src/internal.js";
import { drawingText, fillText, linesText, paperText, tilesText } from "../drawing/text.js";
import { isCustomPaper } from "../drawing/paper.js";
import { layersText } from "../layers/text.js";
import { detailsText } from "../motion/details-text.js";
import { motionText } from "../motion/text.js";
import { heightsText, pensText } from "../pens/text.js";
import { plotterText, presetsText } from "../plotter/text.js";
import { isFirstPlot } from "../plotter/hand/pen-at-hand.js";
import type { PanelName } from "../state/persist.js";
import type { PageState } from "../state/store.js";
import { isUsed } from "../state/used-settings.js";
import { searchText as words } from "./text.js";

/** A place in a panel: the panel itself, or a folded group of settings in it. */
interface Panel {
  readonly name: PanelName;
  /** Ids of the groups to open, the outermost first; none: the panel is always open. */
  readonly groups: readonly string[];
  /** What the user sees on the way there. */
  readonly titles: readonly string[];
}

export const NO_LEGEND = "";

/** A control on the page. */
export interface FieldLocation {
  readonly panel: Panel;
  /** Its label; null: the panel's own heading. */
  readonly control: string | null;
  /** The legend around it, where a label occurs twice in a panel; `NO_LEGEND`: none is around it. */
  readonly legend?: string;
}

export interface Field {
  readonly id: string;
  readonly label: string;
  readonly words: string;
  readonly place: FieldLocation;
  /** The control that makes the field appear, while it is not on the page. */
  instead?(state: PageState): FieldLocation | null;
  /** Why the field can't be used now; null: it can. Left out: it always can. */
  whyOff?(state: PageState): string | null;
  /** The path of the setting without which the page does not show the field. Left out: every plotter has it. */
  readonly uses?: string;
}

const panel = (name: PanelName, groups: readonly string[], ...titles: readonly string[]): Panel => ({
  name,
  groups,
  titles,
});
const PANELS = {
  drawing: panel("drawing", ["drawing"], drawingText.title),
  paper: panel("paper", ["paper"], paperText.title),
  paperMore: panel("paper", ["paper", "paper-more"], paperText.title, paperText.more),
  tiles: panel("paper", ["paper", "tiles"], paperText.title, tilesText.title),
  layers: panel("layers", ["layers"], layersText.title),
  pens: panel("layers", ["layers", "pens"], layersText.title, pensText.title),
  lines: panel("lines", ["lines"], linesText.title),
  fill: panel("lines", ["lines", "fill"], linesText.title, fillText.title),
  motion: panel("speed", ["motion"], motionText.title),
  details: panel("speed", ["motion", "motion-details"], motionText.title, motionText.details),
  presets: panel("speed", ["presets"], presetsText.title),
  hand: panel("plotter", [], plotterText.title),
  moves: panel("plotter", ["moves"], plotterText.rest, plotterText.moves),
  pen: panel("plotter", ["pen"], plotterText.rest, heightsText.title),
  plotter: panel("plotter", ["plotter"], plotterText.rest, plotterText.more),
} as const satisfies Record<string, Panel>;

type Named = Pick<Field, "label"> & Partial<Pick<Field, "id" | "words" | "instead" | "whyOff" | "uses">>;
type PlaceName = keyof typeof PANELS;

const field = (where: PlaceName, { label, id, words = "", ...rest }: Named, legend?: string): Field => ({
  id: `${where} ${id ?? label}`,
  label,
  words,
  place: { panel: PANELS[where], control: label, ...(legend === undefined ? {} : { legend }) },
  ...rest,
});

/** A field of the settings tables; what it is about is searched too. */
const row = (where: PlaceName, setting: Setting, more: Partial<Named> = {}, legend?: string): Field => {
  const added = more.words === undefined ? "" : `${more.words}, `;
  return field(
    where,
    { label: setting.label, ...more, words: `${added}${wordsOf(setting)}, ${aboutOf(setting)}` },
    legend,
  );
};

const at = (where: PlaceName, control: string): FieldLocation => ({ panel: PANELS[where], control });
const unless =
  (isThere: (state: PageState) => boolean, place: FieldLocation): NonNullable<Field["instead"]> =>
  (state) =>
    isThere(state) ? null : place;

const isTiled = ({ settings }: PageState): boolean => tileCount(settings.prepare) > 1;
const ifTiled = { instead: unless(isTiled, at("tiles", PREPARE_TABLE.tileColumns.label)) };
/** A sheet with several drawings places each of them. */
const isOneDrawing = ({ drawing }: PageState): boolean => !drawing?.sheet;
const ifOneDrawing = { whyOff: (state: PageState) => (isOneDrawing(state) ? null : paperText.onSheet) };

const PAPER: readonly Field[] = [
  field("paper", {
    label: paperText.size,
    words: "paper size, format, A4, A3, A5, letter, custom size, width, height",
  }),
  field("paper", {
    label: paperText.orientation,
    words: `${wordsOf(PREPARE_TABLE.landscape)}, ${PREPARE_TABLE.landscape.label}`,
  }),
  row("paper", PREPARE_TABLE.marginMm, {
    instead: unless(({ settings }) => settings.prepare.margins === null, at("paperMore", paperText.margins)),
  }),
  field("paper", {
    label: paperText.placement,
    words: `${wordsOf(PREPARE_TABLE.fit)}, ${aboutOf(PREPARE_TABLE.fit)}`,
    ...ifOneDrawing,
  }),
  row("paper", PREPARE_TABLE.pxPerInch, {
    whyOff: ({ planned }) => ((planned?.pxPerInch ?? null) === null ? words.needsPx : null),
  }),
  row("paper", PREPARE_TABLE.rotateDeg, ifOneDrawing),
  field("paper", {
    label: paperText.unit,
    words: "units, inches, inch, mm, millimetres, millimeters, imperial, metric",
  }),
  row("tiles", PREPARE_TABLE.tileColumns),
  row("tiles", PREPARE_TABLE.tileRows),
  row("tiles", PREPARE_TABLE.tileOverlapMm, ifTiled),
  row("tiles", PREPARE_TABLE.tileMarks, ifTiled),
  row("tiles", PREPARE_TABLE.tile, { ...ifTiled, label: tilesText.which }),
  field("paperMore", { label: paperText.margins, words: "margin top right bottom left, border" }),
  row("paperMore", PREPARE_TABLE.mirror, ifOneDrawing),
  row("paperMore", PREPARE_TABLE.outside),
  row("paperMore", PREPARE_TABLE.cropToPage, ifOneDrawing),
  row("paperMore", PREPARE_TABLE.clipToMargins),
];

const CUSTOM_PAPER: readonly Field[] = [PAPER_TABLE.widthMm, PAPER_TABLE.heightMm].map((setting) =>
  row("paper", setting, { instead: unless(isCustomPaper, at("paper", paperText.size)) }),
);

const isFilled = ({ settings }: PageState): boolean => settings.prepare.hatch.spacingMm > 0;
const ifFilled = { instead: unless(isFilled, at("fill", fillText.switch)) };
const LINES: readonly Field[] = [
  row("lines", PREPARE_TABLE.order),
  row("lines", PREPARE_TABLE.orderS, {
    instead: unless(
      ({ settings }) => settings.prepare.order === "best",
      at("lines", PREPARE_TABLE.order.label),
    ),
  }),
  row("lines", PREPARE_TABLE.spread),
  ...Object.values<Setting>(PREPARE_TABLE)
    .filter((setting) => setting.panel === "lines")
    .map((setting) => row("lines", setting)),
  field("fill", { label: fillText.switch, words: "hatch, hatching, shading, infill" }),
  row("fill", HATCH_TABLE.spacingMm, { ...ifFilled, words: "hatch spacing, density, distance" }),
  row("fill", HATCH_TABLE.angleDeg, { ...ifFilled, words: "hatch angle" }),
  row("fill", HATCH_TABLE.cross, { ...ifFilled, words: "cross-hatch" }),
  row("fill", PREPARE_TABLE.hatchOutlines, ifFilled),
  row("fill", PREPARE_TABLE.outlineFills),
  row("fill", PREPARE_TABLE.hideCovered),
];

/** Only where the motion is planned here, not by the controller. */
const ifPlannedHere = { uses: "motion.mode" };
const ifFits = { uses: "motion.fit.toleranceMm" };
const isSoft = ({ settings }: PageState): boolean => settings.motion.mode === "scurve";
const cornerRule = at("details", MOTION_TABLE.mode.label);
const ease = unless(({ settings }) => Boolean(settings.motion.ease), at("details", detailsText.ease));
/** Their labels occur elsewhere too, so the search names them in full. */
const eased = (setting: Setting, label: string): Field => ({
  ...row("details", setting, { id: label, instead: ease }, NO_LEGEND),
  label,
});
const MOTION: readonly Field[] = [
  row("details", DRAW_TABLE.speedMmPerS, { id: "draw speedMmPerS" }, detailsText.drawing),
  ...(["accelMmPerS2", "cornerMm"] as const).map((key) =>
    row("details", DRAW_TABLE[key], { id: `draw ${key}`, ...ifPlannedHere }, detailsText.drawing),
  ),
  row(
    "details",
    TRAVEL_TABLE.speedMmPerS,
    { id: "travel speedMmPerS", words: "pen up" },
    detailsText.travelling,
  ),
  row(
    "details",
    TRAVEL_TABLE.accelMmPerS2,
    { id: "travel accelMmPerS2", words: "pen up", ...ifPlannedHere },
    detailsText.travelling,
  ),
  row(
    "details",
    DRAW_TABLE.jerkMmPerS3,
    { instead: unless(isSoft, cornerRule), ...ifPlannedHere },
    detailsText.drawing,
  ),
  row(
    "details",
    TRAVEL_TABLE.jerkMmPerS3,
    { id: "travel jerk", words: "pen up", instead: unless(isSoft, cornerRule), ...ifPlannedHere },
    detailsText.travelling,
  ),
  field("motion", {
    label: motionText.quality,
    words: "fine, normal, fast, precise, exact",
    ...ifPlannedHere,
  }),
  ...Object.entries<Setting>(AXIS_TABLE).map(([key, setting]) =>
    row("details", setting, { uses: `motion.${key}` }),
  ),
  row("details", MOTION_TABLE.shaper, {
    uses: "motion.shaper",
    whyOff: ({ settings }) => (findMachine(settings)?.springs ? null : words.needsMeasured),
  }),
  row("details", MOTION_TABLE.mode, ifPlannedHere),
  field("details", { label: detailsText.ease, words: "slow in, slow out, ease, ink start" }),
  eased(EASE_TABLE.lengthMm, words.easeLength),
  eased(EASE_TABLE.speedMmPerS, words.easeSpeed),
  field("details", { label: detailsText.fit, words: "merge commands, stutter, smooth", ...ifFits }),
  row("details", FIT_TABLE.toleranceMm, {
    instead: unless(({ settings }) => Boolean(settings.motion.fit), at("details", detailsText.fit)),
    ...ifFits,
  }),
  row("details", STREAM_TABLE.sendAheadMs, { uses: "sendAheadMs" }),
];

const overlaps = ({ settings }: PageState): boolean => settings.pen.overlap !== "off";
const ifOverlaps = { uses: "pen.overlap" };
const ifGentle = { uses: "pen.dropPctPerS" };
const overlapPlace = at("pen", OVERLAP_TABLE.overlap.label);
const PEN: readonly Field[] = [
  row("hand", PEN_TABLE.upPct),
  row("hand", PEN_TABLE.downPct),
  row("hand", OVERLAP_TABLE.contactPct, {
    instead: unless((state) => overlaps(state) && !isFirstPlot(state), overlapPlace),
    ...ifOverlaps,
  }),
  row("pen", PEN_TABLE.extraLiftMs),
  row("pen", PEN_TABLE.extraDropMs),
  field("pen", { label: heightsText.gentle, words: wordsOf(DROP_RATE), ...ifGentle }),
  row("pen", DROP_RATE, {
    instead: unless(({ settings }) => Boolean(settings.pen.dropPctPerS), at("pen", heightsText.gentle)),
    ...ifGentle,
  }),
  row("pen", OVERLAP_TABLE.overlap, ifOverlaps),
  row("pen", OVERLAP_TABLE.fullHeightMm, { instead: unless(overlaps, overlapPlace), ...ifOverlaps }),
];

const OTHER: readonly Field[] = [
  row("layers", PREPARE_TABLE.layers),
  field("pens", {
    label: pensText.stops,
    words: "pen change, pause between layers, stop",
    whyOff: ({ settings }) => (settings.pens.length > 0 ? null : words.needsPens),
  }),
  field("plotter", {
    label: plotterText.model,
    words: "machine, axidraw, nextdraw, idraw, grbl, size of the plotter",
  }),
];

const HEADINGS: readonly (readonly [PlaceName, string])[] = [
  ["drawing", "open file, choose, sample, import"],
  ["paper", ""],
  ["layers", "colours, colors, inkscape"],
  ["pens", "pen colour, line width, tool change"],
  ["lines", "clean up"],
  ["fill", "hatch, shading"],
  ["motion", "fast, slow"],
  ["details", "numbers, advanced"],
  ["presets", "save settings, profile"],
  ["moves", "jog, manual, go to"],
  ["pen", "delay, servo"],
  ["plotter", "firmware, version, where is the pen"],
];

/** Of all plotters, in the order of results that fit equally well. */
export const FIELDS: readonly Field[] = [
  ...PEN,
  ...MOTION,
  ...PAPER,
  ...CUSTOM_PAPER,
  ...OTHER,
  ...LINES,
  ...HEADINGS.map(([where, heading]): Field => {
    const { titles } = PANELS[where];
    return {
      id: `panel ${where}`,
      label: titles.at(-1) ?? "",
      words: heading,
      place: { panel: PANELS[where], control: null },
    };
  }),
];

/** The fields that the page has for the chosen plotter. */
export const fieldsFor = (state: PageState): readonly Field[] =>
  FIELDS.filter(({ uses }) => uses === undefined || isUsed(state, uses));
