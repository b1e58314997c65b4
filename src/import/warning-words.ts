/** The message for each kind of warning. Loaded only for a file that has warnings, since it is long. */
import { PX_NOTE } from "../drawing/px-size.js";

const many = (count: number, one: string, more: string): string =>
  count === 1 ? `1 ${one}` : `${count} ${more}`;

/** The message for each kind: how many, what it means on paper, what to do. `details` names the first few. */
export const WARNING_WORDS = {
  "text-not-drawn": (n: number) =>
    `${many(n, "text is", "texts are")} not drawn. Choose single-stroke letters, or convert text to paths in your drawing program.`,
  "text-substituted": (n: number) =>
    `${many(n, "text is", "texts are")} drawn in single-stroke letters instead of the file's font. To keep the font, convert text to paths in your drawing program, or on the command line give its file with --font.`,
  "glyphs-missing": (n: number, details: string) =>
    `${many(n, "character is", "characters are")} not in the font and left out${details}. Use another font, or convert text to paths.`,
  "text-over-edge": (n: number) =>
    `${many(n, "text reaches", "texts reach")} over the edge of the file's page, which cuts ${n === 1 ? "it" : "them"} off on a screen. Make ${n === 1 ? "it" : "them"} smaller, or move ${n === 1 ? "it" : "them"} in your drawing program.`,
  "text-off-path": (n: number) =>
    `${many(n, "letter has", "letters have")} no room on ${n === 1 ? "its path and is" : "their path and are"} left out. Make the text smaller, or the path longer.`,
  "image-not-drawn": (n: number) =>
    `${many(n, "picture is", "pictures are")} not drawn: a pen draws lines. Trace pictures to paths first.`,
  "foreign-object": (n: number) =>
    `${many(n, "embedded web page", "embedded web pages")} (foreignObject) not drawn. Export without HTML labels, or convert to paths.`,
  "filter-ignored": (n: number) =>
    `${many(n, "filter effect is", "filter effects are")} ignored: the lines are drawn as they are.`,
  "mask-ignored": (n: number) =>
    `${many(n, "mask is", "masks are")} not fully drawn: what ${n === 1 ? "it hides or fades" : "they hide or fade"} is drawn in solid lines. Use a clip path, or cut the shapes.`,
  "gradient-stroke": (n: number) =>
    `${many(n, "line", "lines")} with a gradient as colour: drawn in one colour.`,
  "gradient-fill": (n: number) => `${many(n, "fill", "fills")} with a gradient: taken as one colour.`,
  "pattern-stroke": (n: number, details: string) =>
    `${many(n, "line", "lines")} with a pattern as colour${details}: drawn in one colour.`,
  "pattern-fill": (n: number, details: string) =>
    `${many(n, "fill", "fills")} with a pattern${details}: taken as one colour, the pattern is not drawn.`,
  "blend-ignored": (n: number, details: string) =>
    `${many(n, "blend mode is", "blend modes are")} ignored${details}: a pen cannot mix colours like a screen.`,
  "effect-ignored": (n: number, details: string) =>
    `${many(n, "effect is", "effects are")} not drawn${details}.`,
  "text-style-ignored": (n: number, details: string) =>
    `${many(n, "style of text is", "styles of text are")} not drawn${details}. Convert the text to paths to keep it.`,
  "color-unknown": (n: number, details: string) =>
    `${many(n, "colour is", "colours are")} not known and ignored${details}. Give a plain colour.`,
  "opacity-ignored": (n: number) =>
    `${many(n, "object is", "objects are")} partly transparent: drawn in solid lines.`,
  "paint-order-ignored": (n: number, details: string) =>
    `${many(n, "paint order is", "paint orders are")} ignored${details}: fills are drawn first, then lines.`,
  "paint-missing": (n: number, details: string) =>
    `${many(n, "colour refers", "colours refer")} to something that is not in the file${details}.`,
  "path-data": (n: number, details: string) =>
    `${many(n, "path has", "paths have")} an error and ${n === 1 ? "is" : "are"} drawn only up to it${details}. Check ${n === 1 ? "it" : "them"} in your drawing program.`,
  "attribute-fault": (n: number, details: string) =>
    `${many(n, "attribute is", "attributes are")} malformed and ignored${details}.`,
  "length-approximate": (n: number, details: string) =>
    `${many(n, "length is", "lengths are")} in ex or ch${details}: taken as half the font size. Give ${n === 1 ? "it" : "them"} in px or mm to be exact.`,
  "speed-factor": (n: number, details: string) =>
    `${many(n, "speed is", "speeds are")} ignored${details}. Give a number from 0.01 to 1: 0.5 is half the usual speed.`,
  "coordinates-out-of-range": (n: number, details: string) =>
    `${many(n, "shape has", "shapes have")} coordinates beyond a kilometre and ${n === 1 ? "is" : "are"} left out${details}.`,
  "single-point": (n: number) =>
    `${many(n, "path is", "paths are")} a single point and ${n === 1 ? "draws" : "draw"} nothing. Make it a short line for a dot.`,
  "zero-width-stroke": (n: number) =>
    `${many(n, "shape has", "shapes have")} a line of width 0, invisible on screen, and ${n === 1 ? "is" : "are"} not drawn. Give it a width.`,
  "reference-missing": (n: number, details: string) =>
    `${many(n, "copy refers", "copies refer")} to something that is not in the file${details}.`,
  "reference-external": (n: number, details: string) =>
    `${many(n, "copy refers", "copies refer")} to another file and ${n === 1 ? "is" : "are"} not drawn${details}. Embed it.`,
  "circular-use": (n: number, details: string) =>
    `${many(n, "copy contains", "copies contain")} itself and ${n === 1 ? "is" : "are"} not drawn${details}.`,
  "clip-ignored": (n: number, details: string) =>
    `${many(n, "clip is", "clips are")} not supported and ignored${details}: what ${n === 1 ? "it hides" : "they hide"} is drawn. Use a clip path of shapes.`,
  "clip-text": (n: number) =>
    `${many(n, "clip has", "clips have")} the shape of text, so what ${n === 1 ? "it shows" : "they show"} is not drawn. Convert the text to paths in your drawing program, or on the command line give a font file with --font.`,
  "style-fault": (n: number, details: string) =>
    `${many(n, "style rule", "style rules")} could not be read and ${n === 1 ? "is" : "are"} ignored${details}.`,
  "style-slow": (n: number, details: string) =>
    `${many(n, "style rule takes", "style rules take")} too long to match and ${n === 1 ? "is" : "are"} ignored${details}. Use fewer :has, :not and ~ in one rule, or give the elements a class.`,
  "style-external": (n: number) =>
    `${many(n, "style sheet is", "style sheets are")} in another file and ignored. Embed the styles.`,
  "hidden-layer": (n: number, details: string) =>
    `${many(n, "layer is", "layers are")} hidden in the file and not drawn${details}. Show it in your drawing program to plot it.`,
  "xml-repaired": (n: number, details: string) =>
    `${many(n, "error", "errors")} in the file ${n === 1 ? "was" : "were"} ignored${details}.`,
  "too-many-layers": (n: number) =>
    `The file has ${n} groups at the top level: treated as one layer. Group them into layers.`,
  "page-size": (_n: number, details: string) =>
    `The file does not define its page size${details}. Check the size on the paper, or export with a width and height in mm.`,
  background: (n: number) =>
    `${many(n, "filled shape is", "filled shapes are")} taken as the background and not drawn. Give ${n === 1 ? "it" : "them"} a stroke to draw the outline.`,
  [PX_NOTE]: (_n: number, details: string) =>
    `The file's lengths are in px, so its size is a guess${details}. Check the size on the paper, and set --px-per-inch if it is wrong.`,
  "animation-ignored": (n: number) =>
    `${many(n, "animation is", "animations are")} ignored: drawn as at the start.`,
  "object-unreadable": (n: number, details: string) =>
    `${many(n, "object has", "objects have")} a value that cannot be read and ${n === 1 ? "is" : "are"} left out${details}. Draw ${n === 1 ? "it" : "them"} again, or export the file again.`,
  "paper-space": (n: number) =>
    `${many(n, "object is", "objects are")} on a sheet in paper space and not drawn: the model is. To plot the sheet, export its layout as a drawing.`,
  "not-supported": (n: number, details: string) =>
    `${many(n, "object is", "objects are")} of a type that is not drawn${details}. Convert to plain lines and curves.`,
  "empty-drawing": () =>
    "There is nothing to draw in this file: no visible line or filled shape. Check that its layers are shown, and that its shapes have a stroke or a fill.",
} satisfies Record<string, (count: number, details: string) => string>;
