import { enSetup, type SetupTexts } from "./en-setup.js";

/** The words in use for layers, pens, saving and folded settings. Imported by parts that are fetched later only. */
export const setup: SetupTexts = enSetup;
