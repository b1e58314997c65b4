import type { Color } from "../color.js";

/** What a shape is filled or stroked with. */
export type Paint =
  | { readonly kind: "none" }
  | { readonly kind: "color"; readonly color: Color }
  | { readonly kind: "currentColor" }
  | { readonly kind: "context"; readonly of: "fill" | "stroke" }
  /** A gradient or pattern, by id, and what to use where there is none. */
  | { readonly kind: "server"; readonly id: string; readonly fallback: Paint };
