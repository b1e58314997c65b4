import { useMemo } from "react";
import { useActions, usePageStore } from "../state/use-store.js";
import { handApi, type HandApi } from "./hand-api.js";

export const useHand = (): HandApi => {
  const store = usePageStore();
  const actions = useActions();
  return useMemo(() => handApi(store, actions), [store, actions]);
};
