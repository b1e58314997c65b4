import { useMemo } from "react";
import { useActions, useBackend, usePageStore } from "../state/use-store.js";
import { handApi, type HandApi } from "./hand-api.js";

export const useHand = (): HandApi => {
  const store = usePageStore();
  const backend = useBackend();
  const actions = useActions();
  return useMemo(() => handApi(store, backend, actions), [store, backend, actions]);
};
