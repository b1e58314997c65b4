/** The reader of SVG: a file of its own, so that an empty page need not fetch it. */
export { importSvg } from "../../src/index.js";
