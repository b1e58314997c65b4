import { useEffect, useRef, useState } from "react";
import type { Backend, DrawingSource } from "../backend/backend.js";
import { useBackend, useIsConnected } from "../state/use-store.js";
import { croppedPicture } from "./crop-picture.js";
import "./thumb.css";

/** Larger files are not fetched for a thumbnail. */
const MAX_BYTES = 1_000_000;
const pictures = new Map<string, string | null>();
const MAX_PICTURES = 200;

const keyOf = ({ of, id }: DrawingSource): string => `${of} ${id}`;

/**
 * A thumbnail of a drawing on the server (of a job or a sample), cropped to what is drawn. As the source of an image,
 * an SVG runs no scripts and fetches nothing, so the file can be shown as it is. Other formats and large files have none.
 * If the server can't be reached, the drawing is fetched when it is back.
 */
export const Thumb = ({ of, id }: DrawingSource) => {
  const backend = useBackend();
  const key = keyOf({ of, id });
  const isConnected = useIsConnected();
  const box = useRef<HTMLSpanElement>(null);
  const [url, setUrl] = useState(pictures.get(key) ?? null);
  useEffect(() => {
    if (!box.current || url !== null) return;
    const watcher = new IntersectionObserver((entries) => {
      if (!entries.some(({ isIntersecting }) => isIntersecting)) return;
      watcher.disconnect();
      void pictureOf(backend, { of, id }).then(setUrl, () => undefined);
    });
    watcher.observe(box.current);
    return () => watcher.disconnect();
  }, [backend, of, id, url, isConnected]);
  return (
    <span className="thumb" ref={box} aria-hidden="true">
      {url !== null && <img src={url} alt="" loading="lazy" decoding="async" />}
    </span>
  );
};

/** Null: the drawing has no thumbnail. Rejects if it can't be fetched now. */
const pictureOf = async (backend: Backend, source: DrawingSource): Promise<string | null> => {
  const known = pictures.get(keyOf(source));
  if (known !== undefined) return known;
  const svg = await backend.svgOf(source, MAX_BYTES);
  const whole = svg === null ? null : URL.createObjectURL(new Blob([svg], { type: "image/svg+xml" }));
  const url = whole === null ? null : await croppedPicture(whole).catch(() => whole);
  if (pictures.size >= MAX_PICTURES) forgetOldest();
  pictures.set(keyOf(source), url);
  return url;
};

const forgetOldest = (): void => {
  const [oldest] = pictures;
  if (!oldest) return;
  if (oldest[1] !== null) URL.revokeObjectURL(oldest[1]);
  pictures.delete(oldest[0]);
};
