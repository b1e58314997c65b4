/**
 * Prepares the drawing of a job, and checks that there are strokes, that they are on the paper, and that the machine
 * reaches them.
 */
import type { Drawing } from "../drawing/drawing.js";
import { withPxPerInch } from "../drawing/px-size.js";
import { strokeCount } from "../drawing/stroke-set.js";
import type { JobSettings } from "../drivers/machine-job.js";
import { PlotwrightError } from "../errors.js";
import { boxOfPoints } from "../geometry/box.js";
import type { MachineProfile } from "../machines/profile.js";
import { checkBounds, checkPaper, isReached } from "../prepare/on-paper.js";
import { prepareSettingsOf, type PenSetup } from "../prepare/layers/pens.js";
import { prepare, type Prepared } from "../prepare/prepare.js";
import { tileCount } from "../prepare/tiles.js";
import type { Work } from "../prepare/work.js";
import type { PrepareSettings } from "../settings/prepare.js";
import { controllerOf } from "../drivers/registry.js";
import { DEFAULT_MOTION } from "../settings/motion.js";
import { DEFAULT_PEN } from "../settings/pen.js";

export interface PreparedJob {
  readonly prepared: Prepared;
  /** Warnings about the file, the paper, and settings that the machine does not use. Plain text. */
  readonly warnings: readonly string[];
}

/**
 * Prepares a drawing and checks the result. Without a clock in `work` the same drawing and settings give the same
 * strokes in every process, so that a position in a job stays valid after a restart.
 *
 * @throws PlotwrightError "bad-file" if nothing is left to draw, "out-of-bounds", "bad-setting", "cancelled"
 */
export function prepareJob(
  imported: Drawing,
  settings: JobSettings & Pick<PenSetup, "pens" | "layerPens"> & { readonly prepare: PrepareSettings },
  machine: MachineProfile,
  work: Work = {},
): PreparedJob {
  const { prepare: wanted } = settings;
  if (tileCount(wanted) > 1 && wanted.tile === 0) {
    throw new PlotwrightError(
      "bad-setting",
      `The drawing is on ${tileCount(wanted)} sheets, which are plotted one at a time. Choose one with --tile, or "tile" in the settings: 1 to ${tileCount(wanted)}.`,
    );
  }
  // The note about the size of a px disappears if the user has chosen it.
  const drawing = withPxPerInch(imported, settings.prepare.pxPerInch);
  const prepared = prepare(drawing, prepareSettingsOf(settings), work);
  const fileWarnings = drawing.warnings.map(({ message }) => message);
  const warnings = [...fileWarnings, ...prepared.warnings];
  if (strokeCount(prepared.strokes) === 0) {
    // For an empty drawing the file's warnings are enough. Otherwise the last of all warnings says that nothing is left.
    const isEmpty = drawing.warnings.some(({ code }) => code === "empty-drawing");
    throw new PlotwrightError("bad-file", (isEmpty ? fileWarnings : warnings).join(" "));
  }
  checkPaper(
    prepared.outside,
    settings.prepare.outside,
    { widthMm: prepared.paperWidthMm, heightMm: prepared.paperHeightMm },
    isReached(boxOfPoints(prepared.strokes.xy), machine),
  );
  checkBounds(prepared.strokes, machine);
  return { prepared, warnings: [...warnings, ...unusedSettings(settings, machine)] };
}

/**
 * A warning about changed settings that the machine's controller does not use, or none. Settings that are left out or have
 * their default are not named.
 */
export function unusedSettings({ motion, pen }: JobSettings, machine: MachineProfile): string[] {
  const { unusedSettings: unused = {} } = controllerOf(machine);
  const changed = Object.keys(unused).filter((path) => {
    const [usual = null] = valuesAt({ motion: DEFAULT_MOTION, pen: DEFAULT_PEN }, path.split("."));
    return valuesAt({ motion, pen }, path.split(".")).some((value) => value !== usual);
  });
  if (changed.length === 0) return [];
  const labels = changed.map((path) => unused[path]).join(", ");
  return [`${machine.name} does not use these settings, because its controller plans by itself: ${labels}.`];
}

/** The values at a path such as "motion.layers.*.cornerMm", without those that are left out or null. */
function valuesAt(value: unknown, [key, ...rest]: readonly string[]): unknown[] {
  if (value === null || value === undefined) return [];
  if (key === undefined) return [value];
  const fields = value as Readonly<Record<string, unknown>>;
  const next = key === "*" ? Object.values(fields) : [fields[key]];
  return next.flatMap((one) => valuesAt(one, rest));
}
