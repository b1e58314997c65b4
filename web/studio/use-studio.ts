import { useCallback, useEffect, useMemo, useState } from "react";
import { useActions, useBackend } from "../state/use-store.js";
import { studioApi, type StudioApi } from "./studio-api.js";

export const useStudio = (): StudioApi => {
  const backend = useBackend();
  const actions = useActions();
  return useMemo(() => studioApi(backend, actions), [backend, actions]);
};

/** The server's answer (null until it arrives) and a function that fetches it again. */
export const useFetched = <T>(ask: () => Promise<T | null>): readonly [T | null, () => void] => {
  const [answer, setAnswer] = useState<T | null>(null);
  const [turn, setTurn] = useState(0);
  useEffect(() => {
    let isCurrent = true;
    void ask().then((got) => {
      if (isCurrent && got !== null) setAnswer(got);
    });
    return () => {
      isCurrent = false;
    };
  }, [ask, turn]);
  return [answer, useCallback(() => setTurn((now) => now + 1), [])];
};
