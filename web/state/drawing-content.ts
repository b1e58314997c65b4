/** Reads a file that the user gives, and says what it is if it is no drawing. */
import { isDrawingName } from "../../src/internal.js";
import type { DrawingText } from "../backend/drawing-text.js";
import { stateText } from "./text.js";

const HEAD_LENGTH = 4_096;

/** The tables of encodings are loaded with the first file. */
const contentOfFile = async (file: File): Promise<DrawingText> => {
  const bytes = await file.arrayBuffer();
  const { contentOf } = await import("../backend/drawing-text.js");
  return contentOf(bytes);
};

export const headOf = (content: DrawingText): string => {
  const head = content.slice(0, HEAD_LENGTH);
  return typeof head === "string" ? head : new TextDecoder().decode(head);
};

/** How PNG, JPEG, GIF, WebP, BMP, TIFF, HEIC and AVIF begin, read as text. */
const PICTURE = /^(.PNG|\ufffd{2,3}|ÿØÿ|GIF8|RIFF.{4}WEBP|BM|II\*\0|MM\0\*|.{4}ftyp(heic|heix|mif1|avif))/s;
const PICTURE_NAME = /\.(png|jpe?g|gif|webp|bmp|tiff?|heic|heif|avif)$/i;

/** Pixels. Some systems do not tell a file's type. */
const isPicture = ({ name, type }: File, head: string): boolean =>
  (type.startsWith("image/") && !type.startsWith("image/svg")) ||
  (head.includes("\0") && (PICTURE_NAME.test(name) || PICTURE.test(head)));

export const contentOfDrawing = async (
  file: File,
): Promise<{ readonly name: string; readonly text: DrawingText } | { readonly problem: string }> => {
  const text = await contentOfFile(file).catch(() => null);
  if (text === null) return { problem: stateText.unreadable(file.name) };
  const head = headOf(text);
  if (isPicture(file, head)) return { problem: stateText.isPicture(file.name) };
  if (head.includes("\0")) return { problem: stateText.notText(file.name) };
  return { name: isDrawingName(file.name) ? file.name.replace(/\.\w+$/, "") : file.name, text };
};
