import { useEffect } from "react";
import { usePageState, usePageStore } from "../state/use-store.js";
import { watchText as words } from "./text.js";
import { IconButton } from "../ui/button.js";

/** For a tablet beside the plotter: shows only the status, the sheet and the camera, and keeps the screen on. */
export const FullScreenButton = () => {
  const store = usePageStore();
  const isFull = usePageState((state) => state.isFullScreen);
  useEffect(() => {
    if (!isFull) return;
    // If the browser has no full screen (on a phone), Watch still fills the page.
    void document.documentElement.requestFullscreen?.().catch(() => undefined);
    const lock = "wakeLock" in navigator ? navigator.wakeLock.request("screen").catch(() => null) : null;
    const onChange = (): void => {
      if (document.fullscreenElement === null) store.setState({ isFullScreen: false });
    };
    document.addEventListener("fullscreenchange", onChange);
    return () => {
      document.removeEventListener("fullscreenchange", onChange);
      void lock?.then((held) => held?.release());
      if (document.fullscreenElement !== null) void document.exitFullscreen().catch(() => undefined);
    };
  }, [isFull, store]);
  const label = isFull ? words.endFullScreen : words.fullScreen;
  return (
    <IconButton
      kind="tool"
      icon="full"
      label={label}
      aria-pressed={isFull}
      onClick={() => store.setState({ isFullScreen: !isFull })}
    />
  );
};
