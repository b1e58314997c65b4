/** Why a worker failed. The event has no message if the worker's file could not be loaded. */
import { browserText } from "./text.js";

export const reasonOf = (event: Event): string =>
  event instanceof ErrorEvent && event.message !== "" ? event.message : browserText.notLoaded;
