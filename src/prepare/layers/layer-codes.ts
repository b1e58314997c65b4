/**
 * Layer names with codes that control the plot, as AxiDraw users write them.
 * (https://wiki.evilmadscientist.com/AxiDraw_Layer_Control)
 *
 *   name   = "%" text                       the layer is not plotted
 *          | ["!"] [number] { code } text   "!" waits for the operator before the layer
 *   code   = "+h" 0…100   pen-down height, percent     upper or lower case; if a code is repeated, the last valid
 *          | "+s" 1…110   pen-down speed, percent      one applies; codes out of range are ignored
 *          | "+d" 1…      wait before the layer, ms
 *          | "+v" 1…100   percent of the layer's usual speed; an extension of plotwright
 *   number = digits: the N of "plot layer N"
 *   text   = the rest, the readable name
 *
 * There are no spaces between codes; the text starts after the last code.
 */
export interface LayerCodes {
  readonly skip: boolean;
  readonly pause: boolean;
  readonly number: number | null;
  readonly penDownPct: number | null;
  readonly drawSpeedPct: number | null;
  readonly speedSharePct: number | null;
  readonly delayMs: number | null;
  readonly text: string;
}

export function parseLayerName(name: string): LayerCodes {
  if (name.startsWith("%")) return { ...NO_CODES, skip: true, text: name.slice(1) };
  const pause = name.startsWith("!");
  const head = /^\d*/.exec(pause ? name.slice(1) : name) as RegExpExecArray;
  let rest = (pause ? name.slice(1) : name).slice(head[0].length);
  let penDownPct: number | null = null;
  let drawSpeedPct: number | null = null;
  let speedSharePct: number | null = null;
  let delayMs: number | null = null;
  for (let code = CODE.exec(rest); code !== null; code = CODE.exec(rest)) {
    const value = code[2] === "" ? NaN : Number(code[2]);
    const letter = code[1].toLowerCase();
    if (letter === "h" && value <= 100) penDownPct = value;
    if (letter === "s" && value >= 1 && value <= 110) drawSpeedPct = value;
    if (letter === "v" && value >= 1 && value <= 100) speedSharePct = value;
    if (letter === "d" && value > 0) delayMs = value;
    rest = rest.slice(code[0].length);
  }
  const number = head[0] === "" ? null : Number(head[0]);
  return { skip: false, pause, number, penDownPct, drawSpeedPct, speedSharePct, delayMs, text: rest };
}

/** The inverse of `parseLayerName`. A space separates text that would otherwise be read as a code. */
export function formatLayerName(codes: LayerCodes): string {
  if (codes.skip) return `%${codes.text}`;
  const head = [
    codes.pause ? "!" : "",
    codes.number ?? "",
    codes.delayMs === null ? "" : `+d${codes.delayMs}`,
    codes.penDownPct === null ? "" : `+h${codes.penDownPct}`,
    codes.drawSpeedPct === null ? "" : `+s${codes.drawSpeedPct}`,
    codes.speedSharePct === null ? "" : `+v${codes.speedSharePct}`,
  ].join("");
  const readBack = parseLayerName(head + codes.text);
  return readBack.text === codes.text && readBack.skip === codes.skip && readBack.number === codes.number
    ? head + codes.text
    : `${head} ${codes.text}`;
}

/** The readable name: without the codes, with its number. */
export function shownLayerName(name: string): string {
  const { number, text } = parseLayerName(name);
  return `${number ?? ""}${text}`.trim() || name;
}

export const NO_CODES: LayerCodes = {
  skip: false,
  pause: false,
  number: null,
  penDownPct: null,
  drawSpeedPct: null,
  speedSharePct: null,
  delayMs: null,
  text: "",
};

/** A code counts only if something follows its letter, as in the AxiDraw software. */
const CODE = /^\+([hsdv])(?=.)(\d*)/is;
