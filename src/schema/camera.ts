/** A camera that the server reads while a plotter plots, and the pictures that it keeps with each job. */
import { z } from "zod";

export const cameraSchema = z.object({
  /** Of an MJPEG stream or a still picture; may have a name and a password. Only operators see it. */
  url: z
    .url({ protocol: /^https?$/, error: "it must be an address that begins with http:// or https://" })
    .max(2_000),
  /** Time between two pictures. */
  everyS: z.number().min(1).max(3_600).default(10),
});
export type Camera = z.output<typeof cameraSchema>;

export const cameraStateSchema = z.object({
  /** Null: there is none. */
  camera: cameraSchema.nullable(),
  /** The latest try to get a picture since the server has started; null: there was none. `fault`: why there is none. */
  last: z.object({ at: z.string(), fault: z.string().nullable() }).nullable(),
});
export type CameraState = z.output<typeof cameraStateSchema>;

export const keptPictureSchema = z.object({
  /** When it was taken (ISO 8601); its name. */
  at: z.iso.datetime(),
  bytes: z.int(),
});
export type KeptPicture = z.output<typeof keptPictureSchema>;

export const keptPicturesSchema = z.object({
  pictures: z.array(keptPictureSchema),
  /** How many more were due: the camera had none, or they could not be stored. */
  missing: z.int().default(0),
});
export type KeptPictures = z.output<typeof keptPicturesSchema>;
export const pictureRequestSchema = keptPictureSchema.pick({ at: true });

/** The kinds of pictures that are kept. */
export const PICTURE_TYPES = { jpg: "image/jpeg", png: "image/png", webp: "image/webp" } as const;
export type PictureKind = keyof typeof PICTURE_TYPES;

/** The kind of a picture by its first 12 bytes; null: another kind, or no picture. */
export const pictureKindOf = (bytes: Uint8Array): PictureKind | null => {
  const text = String.fromCharCode(...bytes.subarray(0, 12));
  if (text.startsWith("\xff\xd8\xff")) return "jpg";
  if (text.startsWith("\x89PNG\r\n\x1a\n")) return "png";
  return text.startsWith("RIFF") && text.endsWith("WEBP") ? "webp" : null;
};
