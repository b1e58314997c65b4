/** From a drawing to strokes that the machine can reach, or the reason why there are none. */
import type { Drawing } from "../drawing/drawing.js";
import { strokeCount } from "../drawing/stroke-set.js";
import { PlotwrightError } from "../errors.js";
import type { MachineProfile } from "../machines/profile.js";
import { checkBounds } from "../prepare/check-bounds.js";
import { prepareSettingsOf, type PenSetup } from "../prepare/pens.js";
import { prepare, type Prepared } from "../prepare/prepare.js";
import type { Work } from "../prepare/work.js";
import type { PrepareSettings } from "../settings/prepare.js";

export interface PreparedJob {
  readonly prepared: Prepared;
  /** The file's and the paper's. Plain text. */
  readonly warnings: readonly string[];
}

/**
 * No clock goes in: the same drawing and settings give the same strokes in every process, so that a place in a job
 * stays valid after a restart.
 *
 * @throws PlotwrightError "bad-file" where nothing is left to draw, "out-of-bounds", "bad-setting", "cancelled"
 */
export function prepareJob(
  drawing: Drawing,
  settings: Pick<PenSetup, "pens" | "layerPens"> & { readonly prepare: PrepareSettings },
  machine: MachineProfile,
  work: Work = {},
): PreparedJob {
  const prepared = prepare(drawing, prepareSettingsOf(settings), work);
  const warnings = [...drawing.warnings.map((warning) => warning.message), ...prepared.warnings];
  if (strokeCount(prepared.strokes) === 0) {
    throw new PlotwrightError("bad-file", `There is nothing to draw. ${warnings.join(" ")}`.trim());
  }
  checkBounds(prepared.strokes, machine);
  return { prepared, warnings };
}
