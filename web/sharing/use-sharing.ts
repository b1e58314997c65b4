import { useCallback, useEffect, useMemo, useState } from "react";
import { OPERATIONS, type OperationClient } from "../../src/schema/index.js";
import type { Backend } from "../backend/backend.js";
import type { Actions } from "../state/actions.js";
import { useActions, useBackend } from "../state/use-store.js";

/** The backend's operations. Each returns null if it failed, and the user has seen why. */
type Attempts = {
  readonly [Group in keyof OperationClient]: {
    readonly [Name in keyof OperationClient[Group]]: OperationClient[Group][Name] extends (
      ...args: infer Args
    ) => Promise<infer Answer>
      ? (...args: Args) => Promise<Answer | null>
      : never;
  };
};

const attempts = (backend: Backend, { attempt }: Pick<Actions, "attempt">): Attempts =>
  Object.fromEntries(
    Object.keys(OPERATIONS).map((group) => {
      const operations = backend[group as keyof Attempts] as Readonly<
        Record<string, (...args: readonly unknown[]) => Promise<unknown>>
      >;
      const attempted = Object.entries(operations).map(([name, call]) => [
        name,
        (...args: readonly unknown[]) => attempt(`${group} ${name}`, () => call(...args)),
      ]);
      return [group, Object.fromEntries(attempted)];
    }),
  ) as unknown as Attempts;

export const useSharing = (): Attempts => {
  const backend = useBackend();
  const actions = useActions();
  return useMemo(() => attempts(backend, actions), [backend, actions]);
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
