/** CSS `calc()` for lengths (CSS Values 4, §10): + − × ÷ and parentheses. */

const TOKEN = /\s*([+-](?=\s)|[*/()]|[+-]?(?:\d+\.?\d*|\.\d+)(?:e[+-]?\d+)?(?:[a-z]+|%)?)/iy;
const MAX_CHARS = 1000;

/**
 * The value of `calc(…)`, or null if it is malformed. `lengthOf` reads the terms, including plain numbers.
 */
export function evaluateCalc(text: string, lengthOf: (term: string) => number | null): number | null {
  const body = text.trim().replace(/calc\(/gi, "(");
  if (body.length > MAX_CHARS) return null;
  const tokens: string[] = [];
  TOKEN.lastIndex = 0;
  while (TOKEN.lastIndex < body.length) {
    const match = TOKEN.exec(body);
    if (match === null) return null;
    tokens.push(match[1]);
  }
  let at = 0;
  const factor = (): number => {
    const token = tokens[at++] ?? "";
    if (token !== "(") return lengthOf(token) ?? NaN;
    const value = sum();
    return tokens[at++] === ")" ? value : NaN;
  };
  const product = (): number => {
    let value = factor();
    while (tokens[at] === "*" || tokens[at] === "/") {
      if (tokens[at++] === "*") value *= factor();
      else value /= factor();
    }
    return value;
  };
  const sum = (): number => {
    let value = product();
    while (tokens[at] === "+" || tokens[at] === "-") value += tokens[at++] === "+" ? product() : -product();
    return value;
  };
  const value = sum();
  return at === tokens.length && Number.isFinite(value) ? value : null;
}
