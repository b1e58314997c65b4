/**
 * All commands of HP-GL (HP, "7475A Interfacing and Programming Manual", and later plotters) and HP-GL/2 (HP, "PCL 5
 * Technical Reference", chapters 18 to 23): how the parameters of each are read, and what becomes of it on paper.
 * docs/import.md shows this table; a test compares them.
 */
import type { WarningCode } from "../warnings.js";

/**
 * What follows the two letters of a command:
 * - numbers: numbers, and strings in double quotes
 * - label: text up to the label terminator
 * - message: a string in double quotes, or else text up to a semicolon
 * - character: one character
 * - encoded: an encoded polyline, up to a semicolon
 */
type Parameters = "numbers" | "label" | "message" | "character" | "encoded";

/**
 * - drawn: as on a plotter
 * - alike: similarly; `about` tells the difference
 * - reported: not drawn, with a warning
 * - setting: makes no difference to the lines on the paper
 */
type Outcome = "drawn" | "alike" | "reported" | "setting";

interface CommandGroup {
  readonly names: readonly string[];
  readonly outcome: Outcome;
  readonly about: string;
  readonly reads: Parameters;
  /** With fewer numbers the command is ignored and reported. */
  readonly least: number;
  /** The warning of a reported command, given unless its numbers are all 0 or left out. */
  readonly warning: WarningCode;
}

const group = (
  names: string,
  outcome: Outcome,
  about: string,
  { reads = "numbers", least = 0, warning = "not-supported" }: Partial<CommandGroup> = {},
): CommandGroup => ({ names: names.split(" "), outcome, about, reads, least, warning });

export const COMMAND_GROUPS: readonly CommandGroup[] = [
  group("PU PD PA PR", "drawn", "moves and lines"),
  group("PE", "drawn", "encoded lines, base 64 and 32", { reads: "encoded" }),
  group("AA AR", "drawn", "arcs about a centre", { least: 3 }),
  group("AT RT", "drawn", "arcs through three points", { least: 4 }),
  group("BZ BR", "drawn", "Bézier curves", { least: 6 }),
  group("CI", "drawn", "circles", { least: 1 }),
  group(
    "CT",
    "drawn",
    "unit of chord angles: chords from 20° are drawn as a polygon, shorter ones as a curve",
  ),
  group("EA ER", "drawn", "edges of rectangles", { least: 2 }),
  group("EW", "drawn", "edges of wedges", { least: 3 }),
  group("RA RR", "alike", "filled rectangles, filled as FT tells", { least: 2 }),
  group("WG", "alike", "filled wedges, filled as FT tells", { least: 3 }),
  group("PM EP", "drawn", "polygons and their edges"),
  group("FP", "alike", "filled polygons, filled as FT tells"),
  group(
    "FT AC",
    "alike",
    "type of fill and its anchor: FT3 and FT4 are drawn as their lines; others are filled areas, which the hatch setting fills. Shading and patterns are reported",
  ),
  group(
    "LT UL",
    "alike",
    "line types: dashes and dots. Adaptive types (negative) have a fixed length, which is reported",
  ),
  group("SP", "drawn", "a layer for each pen"),
  group("PC CR", "drawn", "colours of the pens"),
  group("IN DF", "drawn", "back to the defaults"),
  group(
    "IP SC",
    "drawn",
    "scaling: all types of SC. Without IP the plotter's page is guessed, which is reported",
  ),
  group("IR", "alike", "scaling by shares of the plotter's page, which is guessed and reported"),
  group("RO", "alike", "rotation, always about the plotter's origin"),
  group("IW", "drawn", "window: what is outside is cut off"),
  group("SM", "drawn", "a symbol at each point, centred", { reads: "character" }),
  group("LB", "drawn", "labels, in the letters of the `text` option", { reads: "label" }),
  group("BL", "drawn", "a label to be drawn by PB", { reads: "label" }),
  group("PB", "drawn", "the label of BL"),
  group("DT", "drawn", "label terminator", { reads: "character" }),
  group("SI SR DI DR DV SL LO ES CP", "drawn", "size, direction, slant, origin and spacing of labels"),
  group("UC", "drawn", "characters drawn by the file"),
  group("XT YT TL", "drawn", "ticks of axes, and their length"),
  group("PG AF AH FR", "alike", "next page: drawn on top of the page before, which is reported"),
  group("DL", "reported", "downloaded characters"),
  group("SV", "reported", "screened lines: drawn solid", { warning: "effect-ignored" }),
  group("CA CS CM DS IV LM TD", "reported", "other character sets: read as ASCII", {
    warning: "text-style-ignored",
  }),
  group("AD SD FI FN CF", "reported", "fonts, and how letters are filled", { warning: "text-style-ignored" }),
  group("CO MG WR", "setting", "comments and messages", { reads: "message" }),
  group("WD", "setting", "text for the plotter's display", { reads: "label" }),
  group("BP EN", "setting", "beginning and name of a plot"),
  group(
    "OA OB OC OD OE OF OG OH OI OK OL OO OP OS OT OW DC DP IM",
    "setting",
    "questions to the plotter, digitizing",
  ),
  group(
    "VS VA VN AS FS AP SG PT PW WU LA MT QL ST TR MC PP SB NP EC",
    "setting",
    "speed, force, width and choice of the pens, line ends, paper and its quality, cutter",
  ),
  group(
    "PS NR RP BF GC GM CV CC KY UF RF SA SS GP",
    "setting",
    "size of the paper, copies, memory, keys, definitions that only other commands use",
  ),
];

/** The group of each command, by its two letters. */
export const GROUP_OF: ReadonlyMap<string, CommandGroup> = new Map(
  COMMAND_GROUPS.flatMap((one) => one.names.map((name) => [name, one] as const)),
);
