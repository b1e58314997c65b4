import { enLater, type LaterTexts } from "./en-later.js";

/** The words in use in parts that are fetched later. Imported by those only, or it comes with the first load. */
export const later: LaterTexts = enLater;
