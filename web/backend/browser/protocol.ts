/**
 * Messages between the pages of one browser and the host, over one BroadcastChannel. The host is a worker of one of the
 * pages. Every page, including the host's own, receives all events and calls the host in the same way.
 */
import type { ErrorCode } from "../../../src/index.js";
import type {
  LiveMessage,
  LiveReport,
  OperationGroup,
  OperationInput,
  ServerEvent,
} from "../../../src/schema/index.js";
import type { OwnMethods } from "./host-api.js";

/**
 * The channel that all tabs share. Change its number when the messages change, so that pages of different versions do
 * not misunderstand each other.
 */
export const CHANNEL = "plotwright-3";
/** The worker that holds this Web Lock is the host. The browser releases it when that worker ends. */
export const HOST_LOCK = "plotwright-host";
export const DATABASE = "plotwright-host";

/** Passed to the worker as its name, which is available before the first message. */
export interface WorkerStart {
  /** The page's id, also used as the id of its host. */
  readonly tab: string;
  /** CHANNEL, or a channel of this tab only if tabs can't agree on one host. */
  readonly channel: string;
  readonly virtualSpeed: number;
}

/** Posted to the worker by its own page. */
export interface PageVisibility {
  readonly isHidden: boolean;
}

/** An operation of the table, or a method that only this host has. */
export type HostCall =
  | { readonly group: OperationGroup; readonly name: string; readonly input: OperationInput }
  | { readonly group: "host"; readonly name: keyof OwnMethods; readonly input: OperationInput };

export type ToHost =
  /** A page has opened: it needs a snapshot. */
  | { readonly to: "host"; readonly type: "hello"; readonly tab: string }
  | {
      readonly to: "host";
      readonly type: "call";
      readonly tab: string;
      readonly id: number;
      readonly call: HostCall;
    }
  /** From the sender of a live drawing; null: it gives up. */
  | {
      readonly to: "host";
      readonly type: "live";
      readonly tab: string;
      readonly id: number;
      readonly plotterId: string;
      readonly message: LiveMessage | null;
    };

export type FromHost =
  /** `tab`: the only page that it is for; default: all. */
  | {
      readonly to: "pages";
      readonly type: "event";
      readonly host: string;
      readonly tab?: string;
      readonly event: ServerEvent;
    }
  | {
      readonly to: "pages";
      readonly type: "answer";
      readonly host: string;
      readonly tab: string;
      readonly id: number;
      readonly answer: Answer;
    }
  /** To the sender of a live drawing. */
  | {
      readonly to: "pages";
      readonly type: "live";
      readonly host: string;
      readonly tab: string;
      readonly id: number;
      readonly report: LiveReport;
    }
  /** The host has ended, so that the worker of page `next` can become the host. */
  | { readonly to: "pages"; readonly type: "handed-over"; readonly host: string; readonly next: string }
  /** The host can't start. */
  | { readonly to: "pages"; readonly type: "failed"; readonly host: string; readonly message: string };

export type Answer =
  | { readonly ok: true; readonly value: unknown }
  | { readonly ok: false; readonly code: ErrorCode; readonly message: string };

export type Message = ToHost | FromHost;
