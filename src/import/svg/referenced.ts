/**
 * What shapes refer to: clip paths, masks and markers. `import-svg.ts` loads this file only for drawings that may have
 * them.
 */
import type { Warnings } from "../warnings.js";
import { SvgClips } from "./masks/clips.js";
import { SvgMasks } from "./masks/masks.js";
import type { SvgGeometry } from "./shapes/basic-shapes.js";
import type { ElementBoxes } from "./element-boxes.js";
import { insideMarker, markerPlaces } from "./shapes/markers.js";
import type { SvgFile } from "./svg-file.js";
import type { TextPainter } from "./text/text-painter.js";

export interface Referenced {
  readonly clips: SvgClips;
  readonly masks: SvgMasks;
  readonly markerPlaces: typeof markerPlaces;
  readonly insideMarker: typeof insideMarker;
}

export function referencedBy(
  file: SvgFile,
  geometry: SvgGeometry,
  boxes: ElementBoxes,
  texts: TextPainter | null,
  warnings: Warnings,
): Referenced {
  return {
    clips: new SvgClips(file, geometry, boxes, texts, warnings),
    masks: new SvgMasks(file, boxes),
    markerPlaces,
    insideMarker,
  };
}
