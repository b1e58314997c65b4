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

/** A drawing that is made on the page while the plotter draws it. */
export interface HandDrawingState {
  /** "ready": strokes can be drawn; "finishing": the pen draws the rest; "broken": `fault` says why it has ended. */
  readonly phase: "ready" | "finishing" | "broken";
  /** Null until the first stroke. */
  readonly jobId: string | null;
  /** How long ago the line was drawn on the page that the pen draws now, s. */
  readonly lagS: number;
  /** Length that is not drawn yet. */
  readonly waitingMm: number;
  /** The pen is so far behind that no stroke can begin. */
  readonly isBehind: boolean;
  /** Something was not taken because of that. */
  readonly hasRefused: boolean;
  /** A part of the last stroke lay beside the paper. */
  readonly hasLeftPaper: boolean;
  readonly canUndo: boolean;
  readonly fault: string | null;
  readonly pen: HandPen;
}

export interface HandPen {
  /** Takes back the last stroke, as far as the pen has not drawn it. */
  undo(): Promise<void>;
  /** The plotter draws the rest. */
  finish(): void;
  /** Opens the whole drawing in Prepare. */
  keep(): void;
  leave(): void;
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
  /** While drawing by hand is open, a mode of Watch; "opening": this part of the page is being loaded. */
  readonly handDrawing: HandDrawingState | "opening" | null;
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
  handDrawing: null,
  isFullScreen: false,
  openDialog: null,
  takeOverQuestion: null,
  notices: [],
} as const satisfies Partial<UiSlice>;
