import { useEffect, useRef, useState } from "react";
import type { Backend, DrawingSource } from "../backend/backend.js";
import { useBackend, useIsConnected } from "../state/use-store.js";
import type { DrawingText } from "../backend/drawing-text.js";
import { croppedPicture } from "./crop-picture.js";
import "./thumb.css";

/** Larger files are not fetched for a thumbnail. */
const MAX_BYTES = 1_000_000;
const pictures = new Map<string, string | null>();
const MAX_PICTURES = 200;

interface ThumbProps extends DrawingSource {
  /** When the file was changed last, if another may get its id. */
  readonly changedAt?: string;
}

const keyOf = ({ of, id, changedAt = "" }: ThumbProps): string => `${of} ${id} ${changedAt}`;

/**
 * A thumbnail of a drawing on the server (of a job, a sample or the library), cropped to what is drawn. As the source of
 * an image, an SVG runs no scripts and fetches nothing, so the file can be shown as it is; other formats are drawn first.
 * Large files have none. If the server can't be reached, the drawing is fetched when it is back.
 */
export const Thumb = ({ of, id, changedAt = "" }: ThumbProps) => {
  const backend = useBackend();
  const key = keyOf({ of, id, changedAt });
  const isConnected = useIsConnected();
  const box = useRef<HTMLSpanElement>(null);
  const [url, setUrl] = useState(pictures.get(key) ?? null);
  useEffect(() => {
    if (!box.current || url !== null) return;
    const watcher = new IntersectionObserver((entries) => {
      if (!entries.some(({ isIntersecting }) => isIntersecting)) return;
      watcher.disconnect();
      void pictureOf(backend, { of, id, changedAt }).then(setUrl, () => undefined);
    });
    watcher.observe(box.current);
    return () => watcher.disconnect();
  }, [backend, of, id, changedAt, url, isConnected]);
  return (
    <span className="thumb" ref={box} aria-hidden="true">
      {url !== null && <img src={url} alt="" loading="lazy" decoding="async" />}
    </span>
  );
};

/** Null: the drawing has no thumbnail. Rejects if it can't be fetched now. */
const pictureOf = async (backend: Backend, source: ThumbProps): Promise<string | null> => {
  const known = pictures.get(keyOf(source));
  if (known !== undefined) return known;
  const file = await backend.fileOf(source, MAX_BYTES);
  const svg = file === null || isSvg(file) ? file : await drawn(keyOf(source), file);
  const whole = svg === null ? null : URL.createObjectURL(new Blob([svg], { type: "image/svg+xml" }));
  const url = whole === null ? null : await croppedPicture(whole).catch(() => whole);
  if (pictures.size >= MAX_PICTURES) forgetOldest();
  pictures.set(keyOf(source), url);
  return url;
};

const SVG_BEGINS_WITHIN = 20_000;

const isSvg = (file: DrawingText): boolean => {
  const head =
    typeof file === "string"
      ? file.slice(0, SVG_BEGINS_WITHIN)
      : new TextDecoder().decode(file.slice(0, SVG_BEGINS_WITHIN));
  return /<svg[\s>]/i.test(head);
};

/** Null for a file that can't be read. */
const drawn = async (key: string, text: DrawingText): Promise<string | null> => {
  const { thumbSvg } = await import("../worker/drawn-svg.js");
  return thumbSvg({ key, text }).catch(() => null);
};

const forgetOldest = (): void => {
  const [oldest] = pictures;
  if (!oldest) return;
  if (oldest[1] !== null) URL.revokeObjectURL(oldest[1]);
  pictures.delete(oldest[0]);
};
