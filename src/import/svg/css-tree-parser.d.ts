/** The parser entry of css-tree alone: the whole package adds 200 kB of lexer and data that an import does not use. */
declare module "css-tree/parser" {
  import type { CssNode, ParseOptions } from "css-tree";
  export default function parse(text: string, options?: ParseOptions): CssNode;
}
