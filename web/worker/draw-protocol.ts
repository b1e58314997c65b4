/** What the page and its drawing worker say to each other. Scenes and pictures are transferred, never copied. */
import type { Frame, Picture } from "../scene/renderer.js";

export type DrawRequest =
  | { readonly type: "scene"; readonly scene: Picture | null }
  /** Only the newest is drawn. */
  | { readonly type: "show"; readonly id: number; readonly frame: Frame };

export interface DrawReply {
  readonly type: "picture";
  /** Of the frame that it shows. */
  readonly id: number;
  /** False for a first look that the whole follows, unless another frame is asked for. */
  readonly isWhole: boolean;
  readonly bitmap: ImageBitmap;
}
