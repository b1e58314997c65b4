import { useEffect, useState } from "react";

const BEAT_MS = 5_000;

/** The time of day in ms, fresh enough for "done at 16:42". */
export const useNow = (): number => {
  const [nowMs, setNowMs] = useState(() => Date.now());
  useEffect(() => {
    const timer = setInterval(() => setNowMs(Date.now()), BEAT_MS);
    return () => clearInterval(timer);
  }, []);
  return nowMs;
};
