/** Crops thumbnails to the drawing: on its whole page, a small drawing in the middle of A3 would be a dot. */

/** Length of the longer side, px: enough to find the edges, and for a thumbnail on a high-resolution screen. */
const PICTURE_PX = 240;
/** Space around the drawing, as a share of its longer side. */
const PAD = 0.06;
/** A lighter pixel counts as paper, because some files have a white background. */
const PAPER_LIGHTNESS = 247;
const PAPER_ALPHA = 12;
/** Lines much finer than a pixel would be too faint, so the picture is drawn over itself this many times. */
const DARKENED = 2;

interface Box {
  readonly x: number;
  readonly y: number;
  readonly width: number;
  readonly height: number;
}

/** The box around everything drawn in RGBA pixels; null if there is nothing. */
export const inkBox = (data: Uint8ClampedArray, width: number, height: number): Box | null => {
  let [x0, y0, x1, y1] = [width, height, -1, -1];
  for (let y = 0; y < height; y++) {
    for (let x = 0; x < width; x++) {
      const at = 4 * (y * width + x);
      const isPaper =
        data[at + 3] < PAPER_ALPHA || Math.min(data[at], data[at + 1], data[at + 2]) > PAPER_LIGHTNESS;
      if (isPaper) continue;
      x0 = Math.min(x0, x);
      x1 = Math.max(x1, x);
      y0 = Math.min(y0, y);
      y1 = Math.max(y1, y);
    }
  }
  return x1 < 0 ? null : { x: x0, y: y0, width: x1 - x0 + 1, height: y1 - y0 + 1 };
};

/** The URL of the cropped picture, or the picture's own URL if it can't be cropped. */
export const croppedPicture = async (url: string): Promise<string> => {
  const image = new Image();
  image.src = url;
  await image.decode();
  const scale = PICTURE_PX / Math.max(image.naturalWidth, image.naturalHeight, 1);
  const [width, height] = [
    Math.max(1, Math.round(image.naturalWidth * scale)),
    Math.max(1, Math.round(image.naturalHeight * scale)),
  ];
  const box = inkBox(pixelsOf(image, 0, 0, 1 / scale, width, height).data, width, height);
  if (!box) return url;
  // Draws it again, larger, so that a small drawing is sharp.
  const pad = PAD * Math.max(box.width, box.height);
  const side = PICTURE_PX / (Math.max(box.width, box.height) + 2 * pad);
  const { canvas } = pixelsOf(
    image,
    (box.x - pad) / scale,
    (box.y - pad) / scale,
    1 / (scale * side),
    Math.round((box.width + 2 * pad) * side),
    Math.round((box.height + 2 * pad) * side),
  );
  const cut = await new Promise<Blob | null>((resolve) => canvas.toBlob(resolve));
  if (!cut) return url;
  URL.revokeObjectURL(url);
  return URL.createObjectURL(cut);
};

/** The part of an image that begins at (left, top), as `width` × `height` pixels of `step` image pixels each. */
const pixelsOf = (
  image: HTMLImageElement,
  left: number,
  top: number,
  step: number,
  width: number,
  height: number,
): { canvas: HTMLCanvasElement; data: Uint8ClampedArray } => {
  const canvas = document.createElement("canvas");
  canvas.width = width;
  canvas.height = height;
  const context = canvas.getContext("2d", { willReadFrequently: true });
  if (!context) throw new Error("no 2d context");
  context.drawImage(image, -left / step, -top / step, image.naturalWidth / step, image.naturalHeight / step);
  for (let pass = 0; pass < DARKENED; pass++) context.drawImage(canvas, 0, 0);
  return { canvas, data: context.getImageData(0, 0, width, height).data };
};
