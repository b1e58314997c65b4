/** Messages between the page and its drawing worker. Scenes and pictures are transferred, never copied. */
import type { Frame, Picture } from "../scene/renderer.js";

export type DrawRequest =
  | { readonly type: "scene"; readonly scene: Picture | null }
  /** Only the newest is drawn. */
  | { readonly type: "show"; readonly id: number; readonly frame: Frame };

export interface DrawReply {
  /** The frame's id. */
  readonly id: number;
  /** False for a coarse picture. The whole one follows, unless another frame is requested. */
  readonly isWhole: boolean;
  readonly bitmap: ImageBitmap;
}
