/** The readers of drawings. In a separate file, so that an empty page does not load them. */
export { importDrawing } from "../../src/index.js";
export { textOf } from "../backend/drawing-text.js";
