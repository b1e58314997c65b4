import { useEffect, useRef, useState } from "react";
import type { Job } from "../../src/schema/index.js";
import "../styles/jobs.css";

/** Larger files are not fetched for a picture of a thumb's size. */
const MAX_BYTES = 1_000_000;
const pictures = new Map<string, string | null>();
const MAX_PICTURES = 200;

export const jobDrawingPath = ({ id }: Pick<Job, "id">): string => `/jobs/${encodeURIComponent(id)}/drawing`;

/**
 * A small picture of a drawing on the server, a job's or a sample. As the source of an image an SVG runs no scripts
 * and fetches nothing, so the file can be shown as it is. Other formats, and large files, have no picture.
 */
export const Thumb = ({ path }: { path: string }) => {
  const box = useRef<HTMLSpanElement>(null);
  const [url, setUrl] = useState(pictures.get(path) ?? null);
  useEffect(() => {
    if (!box.current || pictures.has(path)) return;
    const watcher = new IntersectionObserver((entries) => {
      if (!entries.some(({ isIntersecting }) => isIntersecting)) return;
      watcher.disconnect();
      void pictureOf(path).then(setUrl);
    });
    watcher.observe(box.current);
    return () => watcher.disconnect();
  }, [path]);
  return (
    <span className="thumb" ref={box} aria-hidden="true">
      {url !== null && <img src={url} alt="" loading="lazy" decoding="async" />}
    </span>
  );
};

const pictureOf = async (path: string): Promise<string | null> => {
  const url = await fetchPicture(path).catch(() => null);
  if (pictures.size >= MAX_PICTURES) forgetOldest();
  pictures.set(path, url);
  return url;
};

const fetchPicture = async (path: string): Promise<string | null> => {
  const stop = new AbortController();
  const response = await fetch(`/api/v1${path}`, { signal: stop.signal });
  if (!response.ok || Number(response.headers.get("content-length") ?? 0) > MAX_BYTES) {
    stop.abort();
    return null;
  }
  const file = await response.text();
  if (!/<svg[\s>]/i.test(file.slice(0, 20_000))) return null;
  return URL.createObjectURL(new Blob([file], { type: "image/svg+xml" }));
};

const forgetOldest = (): void => {
  const [oldest] = pictures;
  if (!oldest) return;
  if (oldest[1] !== null) URL.revokeObjectURL(oldest[1]);
  pictures.delete(oldest[0]);
};
