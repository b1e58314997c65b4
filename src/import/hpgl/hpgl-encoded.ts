/**
 * HP-GL/2's encoded polyline (PE): numbers in base 64 or 32, least significant digit first; the last digit
 * has its own range; signs are zigzag-encoded. Flags: ":" pen, "<" up, "=" absolute, ">" fraction bits, "7"
 * base 32.
 */
interface EncodedTarget {
  pen(pen: number): void;
  move(x: number, y: number, isUp: boolean, isAbsolute: boolean): void;
}

const SEVEN_BITS = 0x7f;
const FIRST_DIGIT = 63;
const LAST_FLAG = 190;
const isDigit = (code: number): boolean =>
  (code >= FIRST_DIGIT && code < 127) || (code > LAST_FLAG && code < 255);

export function readEncodedPolyline(text: string, target: EncodedTarget): void {
  let at = 0;
  let base = 64;
  let fractionBits = 0;
  let isUp = false;
  let isAbsolute = false;

  /** The next number, or null at the end. Blanks, control characters and others that are no digit are skipped. */
  const read = (): number | null => {
    let value = 0;
    let place = 1;
    while (at < text.length) {
      const code = text.charCodeAt(at++) & (base === 32 ? SEVEN_BITS : 0xff);
      const last = base === 64 ? 191 : 95;
      const isLast = code >= last && code < last + base;
      if (!isLast && !(code >= FIRST_DIGIT && code < FIRST_DIGIT + base)) continue;
      value += (code - (isLast ? last : FIRST_DIGIT)) * place;
      place *= base;
      if (isLast) return value % 2 === 1 ? -(value - 1) / 2 : value / 2;
    }
    return null;
  };

  while (at < text.length) {
    // The eighth bit of a flag counts for nothing. Digits with it are all above 190.
    const code = text.charCodeAt(at);
    const flag = String.fromCharCode(code > LAST_FLAG ? code : code & SEVEN_BITS);
    if (flag === "7") base = 32;
    else if (flag === "<") isUp = true;
    else if (flag === "=") isAbsolute = true;
    else if (flag === ":" || flag === ">") {
      at++;
      const value = read();
      if (value === null) return;
      if (flag === ":") target.pen(value);
      else fractionBits = Math.max(-26, Math.min(26, value));
      continue;
    } else if (isDigit(code)) {
      const x = read();
      const y = read();
      if (x === null || y === null) return;
      const unit = 2 ** -fractionBits;
      target.move(x * unit, y * unit, isUp, isAbsolute);
      isUp = false;
      isAbsolute = false;
      continue;
    }
    at++;
  }
}
