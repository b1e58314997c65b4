/** What a visible state of the page is. */
import type { Page } from "playwright-core";
import type { ServerProcess } from "../server-process.js";

export interface Stand {
  readonly page: Page;
  readonly server: ServerProcess;
  /** A new server in place of one that ended. */
  restart(): Promise<void>;
  /** The page in another browser, which the server tells apart from this one. */
  openOther(path?: string): Promise<Page>;
}

export interface PageState {
  readonly name: string;
  readonly virtualSpeed?: number;
  /** Instead of the virtual board. */
  readonly device?: string;
  /** The server lets in only devices that are paired. */
  readonly isPairing?: true;
  /** Leaves nothing behind once a sheet that it opened is closed. */
  readonly isPassing?: true;
  /** Begins with an empty paper; other states begin with a sample on it. */
  readonly isFirstVisit?: true;
  /** Shows a part of the page that no passing state shows: part of every test run, not only of the full one. */
  readonly isOnlyPlace?: true;
  reach(stand: Stand): Promise<void>;
}
