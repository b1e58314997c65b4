import { useEffect, useState } from "react";

const INTERVAL_MS = 5_000;

/** The current time in ms, updated often enough for "done 16:42". */
export const useNow = (): number => {
  const [nowMs, setNowMs] = useState(() => Date.now());
  useEffect(() => {
    const timer = setInterval(() => setNowMs(Date.now()), INTERVAL_MS);
    return () => clearInterval(timer);
  }, []);
  return nowMs;
};
