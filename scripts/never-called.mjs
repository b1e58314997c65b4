/**
 * Library files that are referenced, so tree-shaking keeps them, but never called: zod's JSON schema writer on the page,
 * and the parts of css-select's default adapter that write and change documents (we pass our own adapter).
 */
export const NEVER_CALLED =
  /[\\/](zod[\\/]v4[\\/]core[\\/](json-schema-processors|to-json-schema)|domutils[\\/]dist[\\/](feeds|legacy|manipulation|stringify))\.js$/;

/** The source of such a file with empty functions in place of its exports. */
export function emptied(source) {
  const names = [...source.matchAll(/^export (?:function|const) (\w+)/gm)].map((match) => match[1]);
  const renamed = [...source.matchAll(/^export \{ \w+ as (\w+) \};$/gm)].map((match) => match[1]);
  return [...names, ...renamed].map((name) => `export const ${name} = () => undefined;`).join("\n");
}
