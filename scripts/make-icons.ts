/**
 * Writes the PNG icons of web/public from its icon.svg, for home screens that do not accept SVG. They are
 * committed: run this only after changing the icon (`npm run icons`).
 */
import { readFileSync, writeFileSync } from "node:fs";
import { createRequire } from "node:module";
import { initWasm, Resvg } from "@resvg/resvg-wasm";

const FOLDER = new URL("../web/public/", import.meta.url);

interface PngIcon {
  readonly file: string;
  readonly px: number;
  /**
   * The drawing's share of the icon's width. Below 1 the background extends to the edges, which may be
   * cropped.
   */
  readonly share: number;
}

const ICONS: readonly PngIcon[] = [
  { file: "icon-192.png", px: 192, share: 1 },
  { file: "icon-512.png", px: 512, share: 1 },
  // iOS rounds the corners; Android may crop to a circle of 80 %.
  { file: "apple-touch-icon.png", px: 180, share: 0.9 },
  { file: "icon-maskable-192.png", px: 192, share: 0.8 },
  { file: "icon-maskable-512.png", px: 512, share: 0.8 },
];

/** The icon, or the icon on a square of its background. */
function pictureOf(icon: string, share: number): string {
  if (share === 1) return icon;
  const [, ground] = /<rect [^>]*fill="(#\w+)"/.exec(icon) ?? [];
  if (ground === undefined) throw new Error("icon.svg has no background to extend to the edges");
  const place = `x="${50 - 50 * share}" y="${50 - 50 * share}" width="${100 * share}" height="${100 * share}"`;
  return (
    `<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 100 100"><rect width="100" height="100" fill="${ground}"/>` +
    `${icon.replace("<svg ", `<svg ${place} `)}</svg>`
  );
}

await initWasm(readFileSync(createRequire(import.meta.url).resolve("@resvg/resvg-wasm/index_bg.wasm")));
const icon = readFileSync(new URL("icon.svg", FOLDER), "utf8");
for (const { file, px, share } of ICONS) {
  const png = new Resvg(pictureOf(icon, share), { fitTo: { mode: "width", value: px } }).render().asPng();
  writeFileSync(new URL(file, FOLDER), png);
  console.log(`${file}  ${px} × ${px}  ${(png.length / 1000).toFixed(1)} kB`);
}
