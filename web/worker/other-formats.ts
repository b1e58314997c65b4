/** The readers of DXF, HPGL and JSON: a file of their own, so that the first visit need not fetch them. */
export { importDrawing } from "../../src/index.js";
