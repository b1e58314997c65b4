/** What only the operator may do, asked for in a browser that does not operate. */
import { BackendFault, type Backend } from "../backend/backend.js";
import { otherOperator, type PageStore } from "./store.js";

/** Runs a request that only the operator may make. Null: another browser operates, and the user left it so. */
export type AsOperator = <T>(request: () => Promise<T>) => Promise<T | null>;

/** Where another browser operates, it asks whether to take over, and then does it. */
export const createAsOperator = (store: PageStore, backend: Pick<Backend, "takeOver">): AsOperator => {
  /** One question for all requests that come while it is open. */
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
      await backend.takeOver();
      return request();
    }
  };
};
