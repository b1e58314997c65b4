import { en, type Texts } from "./en.js";

/** The words in use. A further language is chosen here, once, before the page is built. */
export const text: Texts = en;
