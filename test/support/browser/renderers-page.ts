/** The part of the renderers' test that runs inside a browser; the test bundles it. */
import { createGlRenderer } from "../../../web/scene/gl-renderer.js";
import type { Detail, Frame, SceneRenderer } from "../../../web/scene/renderer.js";
import type { Pieces } from "../../../web/scene/pieces.js";
import { createSoftRenderer } from "../../../web/scene/soft-renderer.js";

export type RendererName = "gl" | "soft";
/** A scene to be sent to the page: bytes in base 64. */
export interface SentScene {
  readonly draw: string;
  readonly travel: string;
  readonly totalS: number;
}

const PIECE_BYTES = 32;
const piecesIn = (base64: string): Pieces => {
  const bytes = Uint8Array.from(atob(base64), (character) => character.charCodeAt(0));
  return { count: bytes.length / PIECE_BYTES, bytes: bytes.buffer };
};

const base64Of = (bytes: Uint8ClampedArray): string => {
  let text = "";
  for (let at = 0; at < bytes.length; at += 8_192) {
    text += String.fromCharCode(...bytes.subarray(at, at + 8_192));
  }
  return btoa(text);
};

/** The card works asynchronously: its work is done after the page's task ends. */
const turn = (): Promise<void> => new Promise((resolve) => setTimeout(resolve, 0));

async function draw(renderer: SceneRenderer, frame: Frame, detail: Detail, part: number): Promise<void> {
  renderer.begin(frame, detail);
  while (!renderer.isFinished) {
    renderer.advance(part);
    while (!renderer.isIdle()) await turn();
  }
  renderer.present();
}

/** RGBA in base 64 of the picture of a frame on white, drawn in parts of that many pieces. */
export async function pixelsOf(
  name: RendererName,
  { draw: drawn, travel, totalS }: SentScene,
  frame: Frame,
  part: number,
): Promise<string> {
  const canvas = new OffscreenCanvas(1, 1);
  const renderer = name === "gl" ? createGlRenderer(canvas) : createSoftRenderer(canvas);
  if (!renderer) throw new Error(`no ${name} here`);
  renderer.setScene({ draw: piecesIn(drawn), travel: piecesIn(travel), totalS });
  await draw(renderer, { ...frame, view: { ...frame.view, offsetX: 33 } }, "whole", 5_000);
  await draw(renderer, frame, "whole", part);
  const { width, height } = canvas;
  const context = new OffscreenCanvas(width, height).getContext("2d")!;
  context.fillStyle = "#fff";
  context.fillRect(0, 0, width, height);
  context.drawImage(canvas.transferToImageBitmap(), 0, 0);
  renderer.close();
  return base64Of(context.getImageData(0, 0, width, height).data);
}
