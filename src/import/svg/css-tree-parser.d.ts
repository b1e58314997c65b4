/** The parser entry of css-tree alone: its lexer and data are 200 kB that an import has no use for. */
declare module "css-tree/parser" {
  import type { CssNode, ParseOptions } from "css-tree";
  export default function parse(text: string, options?: ParseOptions): CssNode;
}
