import { useEffect, useState } from "react";
import { usePageState } from "../state/use-store.js";
import { sharingText as words } from "./text.js";
import "./sharing.css";

/** A camera that has not answered by then counts as failed. */
const PATIENCE_MS = 10_000;

/** The camera's picture: a stream, or a still picture that is fetched repeatedly. */
export const Camera = () => {
  const { cameraUrl, cameraEveryS } = usePageState((state) => state.view);
  const [turn, setTurn] = useState(0);
  const [picture, setPicture] = useState<"awaited" | "shown" | "failed">("awaited");
  useEffect(() => {
    if (cameraEveryS === 0) return;
    const timer = setInterval(() => setTurn((now) => now + 1), cameraEveryS * 1_000);
    return () => clearInterval(timer);
  }, [cameraEveryS]);
  useEffect(() => {
    if (picture !== "awaited") return;
    const timer = setTimeout(() => setPicture("failed"), PATIENCE_MS);
    return () => clearTimeout(timer);
  }, [picture]);
  if (!isCameraUrl(cameraUrl)) return null;
  return (
    <section className="card camera" aria-label={words.camera}>
      <h2 className="card-title">{words.camera}</h2>
      {/* While it is tried again, without the browser's sign of a broken picture. */}
      <img
        className={picture === "failed" ? "visually-hidden" : undefined}
        src={cameraEveryS === 0 ? cameraUrl : freshUrl(cameraUrl, turn)}
        alt={words.cameraAlt}
        referrerPolicy="no-referrer"
        onLoad={() => setPicture("shown")}
        onError={() => setPicture("failed")}
      />
      {picture === "failed" && <p className="note note-error">{words.cameraFailed}</p>}
    </section>
  );
};

/** Whether a camera's picture may come from this address. */
export const isCameraUrl = (url: string): boolean => {
  try {
    return ["http:", "https:"].includes(new URL(url).protocol);
  } catch {
    return false;
  }
};

/** The address with a changing parameter, so that no cache answers with the last picture. */
const freshUrl = (url: string, turn: number): string => {
  const fresh = new URL(url);
  fresh.searchParams.set("plotwright", String(turn));
  return fresh.href;
};
