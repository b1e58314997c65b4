/**
 * The lines of a job as a file for any sender: with comments at the beginning and at each layer, and with a wait wherever a
 * plot would stop for another pen.
 */
import { settingsIdOf, type StrokeLayer, type StrokeSet } from "../../drawing/stroke-set.js";
import type { MachineProfile } from "../../machines/profile.js";
import { penOfLayer } from "../../plan/pen/pen-times.js";
import { shownLayerName } from "../../prepare/layers/layer-codes.js";
import { penOf, penStopsOf, type PenSetup, type PenStop } from "../../prepare/layers/pens.js";
import type { PenSettings } from "../../settings/pen.js";
import { number } from "./model/pen-lift.js";

/** The lines to send, and the first stroke of the layer that begins at a line, by the line's index. */
interface JobLines {
  readonly lines: readonly string[];
  readonly strokeAt: ReadonlyMap<number, number>;
}

interface FileJob {
  readonly strokes: StrokeSet;
  readonly machine: MachineProfile;
  readonly pen: PenSettings;
  readonly penSetup: PenSetup;
  readonly travelMmPerS: number;
  readonly totalS: number;
}

/** mm, absolute coordinates, mm/min. A machine gets them again after a reset, which may change these modes. */
export const MODES = "G21G90G94";
/** Waits until the user resumes. */
const WAIT_FOR_USER = "M0";
const HOME = "X0Y0";

/** Grbl 0.9 and 1.1 take 79 characters, some builds of 0.9 take 69. */
const MOST_CHARACTERS = 69;

export function fileLines({ lines, strokeAt }: JobLines, job: FileJob): string[] {
  const { strokes, machine, totalS } = job;
  const feed = `F${number(60 * job.travelMmPerS)}`;
  const stops = new Map(penStopsOf(strokes, job.penSetup).map((stop) => [stop.strokeIndex, stop]));
  const file = [
    comment(`For ${machine.name}`, `: about ${Math.ceil(totalS / 60)} min. Begins at home.`),
    MODES,
  ];
  let at = HOME;
  lines.forEach((line, i) => {
    const end = /^G[1-3](X[-\d.]+Y[-\d.]+)/.exec(line)?.[1];
    const stroke = strokeAt.get(i);
    if (stroke !== undefined) {
      const stop = stops.get(stroke);
      if (stop) {
        file.push(putIn(stop), `G1${HOME}${feed}`, WAIT_FOR_USER);
        // A layer that begins where the one before it ends has no travel to it.
        if (end === undefined) file.push(`G1${at}${feed}`);
      }
      file.push(aboutLayer(strokes.layers[strokes.layer[stroke]], job));
    }
    file.push(line);
    at = end ?? at;
  });
  return file;
}

const putIn = ({ penName, color }: PenStop): string =>
  comment(`Put in ${penName === null ? "the pen for this layer" : `the pen ${penName}`}`, colorPart(color));

function aboutLayer(layer: StrokeLayer, { pen, penSetup }: FileJob): string {
  const { upPct, downPct } = penOfLayer(pen, settingsIdOf(layer));
  const itsPen = penOf(penSetup, layer);
  return comment(
    `Layer ${shownLayerName(layer.name)}${itsPen ? `, pen ${itsPen.name}` : ""}`,
    `${colorPart(itsPen?.color ?? layer.color)}: pen down at ${downPct} %, up at ${upPct} %`,
  );
}

const colorPart = (color: string | null): string => (color === null ? "" : `, ${color}`);

/**
 * In brackets, since Grbl 0.9 takes no other comments. Some characters act at once even in a comment: ? ! ~ and those beyond
 * ASCII. `end` stays whole if the names before it are too long.
 */
function comment(names: string, end: string): string {
  const plain = names.replace(/[?!~();]|[^\x20-\x7e]/g, "_");
  return `(${plain.slice(0, MOST_CHARACTERS - 2 - end.length).trimEnd()}${end})`;
}
