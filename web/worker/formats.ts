/** The readers of drawings: a file of their own, so that an empty page need not fetch them. */
export { importDrawing } from "../../src/index.js";
