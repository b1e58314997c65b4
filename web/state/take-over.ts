/** Requests that only the operator may make, in a browser that is not the operator. */
import { BackendFault, type Backend } from "../backend/backend.js";
import { otherOperator, type PageStore } from "./store.js";

/** Runs a request that only the operator may make. Null: another browser is the operator, and the user declined. */
export type AsOperator = <T>(request: () => Promise<T>) => Promise<T | null>;

/** If another browser is the operator, the user is asked to take over, and the request is sent again. */
export const createAsOperator = (store: PageStore, backend: Pick<Backend, "operator">): AsOperator => {
  /** Requests made while the question is open share its answer. */
  let asking: Promise<boolean> | null = null;

  const ask = (): Promise<boolean> =>
    new Promise((resolve) => {
      const answer = (takesOver: boolean): void => {
        asking = null;
        store.setState({ takeOverQuestion: null });
        resolve(takesOver);
      };
      const operator = otherOperator(store.getState())?.name ?? null;
      store.setState({ takeOverQuestion: { operator, answer } });
    });

  return async (request) => {
    try {
      return await request();
    } catch (error) {
      if (!(error instanceof BackendFault) || error.code !== "not-operator") throw error;
      asking ??= ask();
      if (!(await asking)) return null;
      await backend.operator.take();
      return request();
    }
  };
};
