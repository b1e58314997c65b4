/** What the page shows: its views, dialogs and notices. Its actions: ../ui-actions.ts. */
import type { Planned } from "../../worker/protocol.js";
import type { PanelName, ViewSettings } from "../persist.js";

export interface PageNotice {
  readonly id: number;
  readonly kind: "info" | "error";
  readonly text: string;
}

/** "prepare": the drawing that is laid out for plotting; "watch": the running plot. */
export type PageView = "prepare" | "watch";

/** The plan of the job that Watch shows, not of the drawing in Prepare. */
export interface WatchPlan {
  readonly key: string;
  readonly planned: Planned | null;
  readonly fault: string | null;
}

/** Asked when the user presses something that only the operator may do. */
interface TakeOverQuestion {
  readonly operator: string | null;
  answer(takesOver: boolean): void;
}

/** Dialogs, one at a time. */
export type DialogName =
  | "search"
  | "keys"
  | "about"
  | "machines"
  | "wizard"
  | "console"
  | "sharing"
  | "ringing"
  | "gallery"
  | "library";

export interface UiSlice {
  readonly view: ViewSettings;
  readonly pageView: PageView;
  /** The open panel of Watch; null: none. */
  readonly watchPanel: PanelName | null;
  /** The last job that had the plotter: Watch shows it while none is running. */
  readonly watchedId: string | null;
  readonly watchPlan: WatchPlan | null;
  /** Watch fills the screen. */
  readonly isFullScreen: boolean;
  readonly openDialog: DialogName | null;
  readonly takeOverQuestion: TakeOverQuestion | null;
  readonly notices: readonly PageNotice[];
}

/** Without what the last visit left. */
export const UI_AT_FIRST = {
  pageView: "prepare",
  watchPanel: "queue",
  watchedId: null,
  watchPlan: null,
  isFullScreen: false,
  openDialog: null,
  takeOverQuestion: null,
  notices: [],
} as const satisfies Partial<UiSlice>;
