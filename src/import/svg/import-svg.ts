/**
 * SVG text to a Drawing: the same code in browser, worker and Node, without a DOM.
 *
 *   text ─ svg-tree ─> tree ─ cascade + style ─> computed styles ─┐
 *                        └─ svg-layers ─> layers ─────────────────┤
 *                                                                 └─ svg-walk ─> shapes ─ drawing-builder ─> Drawing
 *                                                                                            backgrounds marks shapes
 *
 * Bad files throw PlotwrightError("bad-file") with line and column; minor problems become warnings. Time and
 * memory are linear in the text and in what copies (`use`) add; copies are limited.
 */
import { checkText } from "../../check-arguments.js";
import { curveBoxOf } from "../../drawing/curve-box.js";
import { curvesOf, type Drawing } from "../../drawing/drawing.js";
import { compose, IDENTITY, scaling, type Affine } from "../../geometry/affine.js";
import { MM_PER_INCH } from "../../units.js";
import { backgroundsOf } from "./backgrounds.js";
import type { CssStyles } from "./css/css-styles.js";
import type { Declared } from "./css/properties.js";
import { type ColorParser, parseHexColor } from "../color.js";
import { DrawingBuilder } from "../drawing-builder.js";
import type { Context } from "./svg-context.js";
import type { referencedBy } from "./referenced.js";
import { ElementBoxes } from "./element-boxes.js";
import { checkImportOptions, type ImportOptions } from "../import-options.js";
import { SvgPaintServers } from "./shapes/paint-servers.js";
import { SvgGeometry } from "./shapes/basic-shapes.js";
import { SvgFile } from "./svg-file.js";
import { type SvgPage, guessedPage, sizedPage, type SizedPage } from "./svg-page.js";
import { SvgPainter } from "./svg-painter.js";
import { attributeValue, parseSvgTree, type SvgTree } from "./svg-tree.js";
import { SvgWalk } from "./svg-walk.js";
import type { LengthBasis } from "./css/length.js";
import { aroundOrigin, parseTransform } from "./css/transform.js";
import { declaredValue, parseOpacity, INITIAL_STYLE, type Style } from "./css/style.js";
import type { textPainterOf } from "./text/text-painter.js";
import { inWords, type ReadDrawing, Warnings } from "../warnings.js";

/** Max error of an arc, as a share of the page's diagonal: 0.3 µm on A4, 1 µm on A1. */
const ARC_TOLERANCE = 8e-7;

/**
 * Reads SVG text into a drawing, in mm on its own page.
 *
 * @throws PlotwrightError "bad-file" for text that is not SVG
 * @example
 * const drawing = await importSvg('<svg width="10mm" height="10mm" viewBox="0 0 1 1"><path d="M0 0L1 1" stroke="red"/></svg>');
 * drawing.paths.coords; // Float64Array [0, 0, 10, 10]
 */
export async function importSvg(text: string, options: ImportOptions = {}): Promise<Drawing> {
  checkText("importSvg", text);
  checkImportOptions(options);
  const warnings = new Warnings();
  // The tree is out of scope when the columns are assembled, which halves the peak memory.
  const { builder, page, pxPerInch } = await draw(text, options, warnings);
  const read = finish(builder, page, warnings);
  const drawing =
    read.warnings.length === 0
      ? { ...read, warnings: [] }
      : inWords(read, (await import("../warning-words.js")).WARNING_WORDS);
  return page.isInPx ? { ...drawing, pxPerInch } : drawing;
}

async function draw(
  text: string,
  options: ImportOptions,
  warnings: Warnings,
): Promise<SizedPage & { readonly builder: DrawingBuilder }> {
  const tree = parseSvgTree(text);
  const { styles, parseColor, textPainterOf, referencedBy } = await neededFor(tree);
  const languages = (options.languages ?? ["en"]).map((language) => language.toLowerCase());
  const file = new SvgFile(tree, styles, parseColor, languages);
  const { cascade, layers } = file;
  reportParsing(tree, styles, warnings);

  const root = cascade.declaredOf(0);
  const { page, pxPerInch } =
    options.pxPerInch === undefined
      ? guessedPage(text, tree, root, warnings)
      : sizedPage(tree, root, options.pxPerInch);
  const context = rootContext(file, page, root, pxPerInch);
  const builder = new DrawingBuilder(warnings);
  if (!layers.isSplit) warnings.add("too-many-layers", undefined, undefined, layers.groupCount);
  const arcToleranceMm = ARC_TOLERANCE * Math.hypot(page.widthMm, page.heightMm);
  const geometry = new SvgGeometry(tree, warnings, arcToleranceMm);
  const { widthMm, heightMm, pageFrom } = page;
  const pageBox = pageFrom === "extent" ? null : { x0: 0, y0: 0, x1: widthMm, y1: heightMm };
  const servers = new SvgPaintServers(file);
  const painter = new SvgPainter(file, geometry, servers, builder, warnings);
  const texts = textPainterOf?.(options, painter, pageBox) ?? null;
  const boxes = new ElementBoxes(file, geometry, texts, warnings);
  const referenced = referencedBy?.(file, geometry, boxes, texts, warnings) ?? null;
  const walk = new SvgWalk(file, geometry, boxes, referenced, painter, texts, builder, warnings);
  if (isShown(root)) walk.run(context);
  for (const selector of styles?.slowSelectors ?? [])
    warnings.add("style-slow", undefined, selector.slice(0, 80));
  return { builder, page, pxPerInch };
}

/** What only some files need. Null: this file does not. */
interface Needed {
  readonly styles: CssStyles | null;
  readonly parseColor: ColorParser;
  readonly textPainterOf: typeof textPainterOf | null;
  readonly referencedBy: typeof referencedBy | null;
}

/** The attributes by which shapes refer to others. Styles can do so too. */
const REFERENCES = ["clip-path", "mask", "marker-start", "marker-mid", "marker-end"];

/**
 * Imports what a file needs for its CSS, its colours, its text, and its clips, masks and markers. So a program that uses the
 * library loads these large parts only for a file that has them.
 */
async function neededFor(tree: SvgTree): Promise<Needed> {
  const has = (name: string): boolean => tree.names.includes(name);
  const hasStyles = has("style");
  const styles = hasStyles ? new (await import("./css/css-styles.js")).CssStyles(tree) : null;
  const parseColor =
    hasStyles || !hasSimplePaints(tree) ? (await import("../css-color.js")).parseCssColor : parseHexColor;
  const refers = hasStyles || REFERENCES.some(has);
  return {
    styles,
    parseColor,
    textPainterOf: has("text") ? (await import("./text/text-painter.js")).textPainterOf : null,
    referencedBy: refers ? (await import("./referenced.js")).referencedBy : null,
  };
}

const COLOR_ATTRIBUTES = new Set(["fill", "stroke", "color", "stop-color"]);
/** A value of these that `parseHexColor` is enough for. */
const SIMPLE_PAINT = /^\s*(#[\da-f]*|none|currentcolor|inherit|url\([^)]*\))?\s*$/i;

function hasSimplePaints(tree: SvgTree): boolean {
  const isColor = tree.names.map((name) => COLOR_ATTRIBUTES.has(name));
  return tree.attributeNames.every(
    (name, index) => !isColor[name] || SIMPLE_PAINT.test(attributeValue(tree, index)),
  );
}

function reportParsing(tree: SvgTree, styles: CssStyles | null, warnings: Warnings): void {
  for (const repair of tree.repairs) warnings.add("xml-repaired", undefined, repair);
  if (tree.foreignObjects > 0) warnings.add("foreign-object", undefined, undefined, tree.foreignObjects);
  if (tree.hasStylesheetLink) warnings.add("style-external");
  if (styles === null) return;
  if (styles.importCount > 0) warnings.add("style-external", undefined, undefined, styles.importCount);
  for (const fault of styles.faults) warnings.add("style-fault", undefined, fault);
}

function rootContext(file: SvgFile, page: SvgPage, root: Declared, pxPerInch: number): Context {
  const { viewportWidth, viewportHeight } = page;
  const size = INITIAL_STYLE.fontSize;
  const basis = { fontSize: size, rootFontSize: size, viewportWidth, viewportHeight };
  const style = file.computeStyle(INITIAL_STYLE, root, basis);
  const { fontSize } = style;
  return {
    map: compose(rootTransform(page, root, style, basis, MM_PER_INCH / pxPerInch), page.map),
    style,
    basis: { ...basis, fontSize, rootFontSize: fontSize },
    group: -1,
    clip: null,
    uses: null,
    contextFill: { kind: "none" },
    contextStroke: { kind: "none" },
    speedFactor: 1,
  };
}

/** The root element's own transform, in mm on the page. Its origin is the page's centre, as for a box in CSS. */
function rootTransform(
  page: SvgPage,
  root: Declared,
  style: Style,
  basis: LengthBasis,
  mmPerPx: number,
): Affine {
  const map = parseTransform(declaredValue(style, root, "transform") ?? "") ?? IDENTITY;
  if (map === IDENTITY) return IDENTITY;
  const box = { viewportWidth: page.widthMm / mmPerPx, viewportHeight: page.heightMm / mmPerPx };
  const origin = declaredValue(style, root, "transform-origin") ?? "center";
  const turned = aroundOrigin(map, origin, { ...basis, ...box });
  return compose(compose(scaling(mmPerPx), turned), scaling(1 / mmPerPx));
}

/** Browsers draw the root element regardless of its display property. */
const isShown = (root: Declared): boolean => parseOpacity(root.get("opacity") ?? "1") !== 0;

function finish(builder: DrawingBuilder, page: SvgPage, warnings: Warnings): ReadDrawing {
  const drawing = onPage(builder, page, warnings);
  const { paths } = drawing;
  const background = backgroundsOf(drawing);
  if (background === null) return drawing;
  background.forEach((isBackground, shape) => {
    if (isBackground) warnings.add("background", curveBoxOf(curvesOf(paths, shape), IDENTITY));
  });
  return { ...drawing, paths: { ...paths, background }, warnings: warnings.toArray() };
}

function onPage(builder: DrawingBuilder, page: SvgPage, warnings: Warnings): ReadDrawing {
  if (page.pageFrom !== "extent" || builder.shapeCount === 0)
    return builder.finish(page.widthMm, page.heightMm, page.pageFrom);
  warnings.add("page-size", undefined, "taken from the drawing");
  return builder.finishAround();
}
