/**
 * The preview's machine: three canvases in a stack (desk, strokes, rulers and pen), one view, and at most
 * one frame of strokes in the making.
 *
 * Where a frame of strokes takes the graphics card longer than the screen's beat, the last one is moved and
 * scaled as a picture until the next is ready: the paper stays under the finger whatever the drawing's size.
 */
import { beginCanvas, deskColors, drawBackdrop, type Desk, type DeskColors } from "./backdrop.js";
import { markMoment } from "../ui/moments.js";
import { createCanvasRenderer } from "./canvas-renderer.js";
import { createGlRenderer } from "./gl-renderer.js";
import { drawMarker, drawRulers, RULER_PX, type Marker, type RulerSpan } from "./overlay.js";
import type { Frame, SceneRenderer } from "./renderer.js";
import type { Scene } from "./scene.js";
import { fitView, zoomAt, type Size, type View } from "./view.js";

export interface StageCanvases {
  readonly box: HTMLElement;
  readonly desk: HTMLCanvasElement;
  readonly strokes: HTMLCanvasElement;
  readonly overlay: HTMLCanvasElement;
}

export type FrameLook = Omit<Frame, "view" | "width" | "height" | "ratio" | "isMoving">;

const INSET_PX = 26;
/** The legend and the tools lie here. */
const BELOW_PX = 54;
/** A view that has not been moved for so long rests, and is drawn in full. */
const REST_MS = 160;
const MAX_RATIO = 2;

export class Stage {
  readonly #canvases: StageCanvases;
  readonly #observer: ResizeObserver;
  #renderer: SceneRenderer | null;
  #scene: Scene | null = null;
  #look: FrameLook;
  #desk: Desk;
  #marker: Marker | null = null;
  #paint: ((context: CanvasRenderingContext2D, view: View) => void) | null = null;
  #rulerSpan: RulerSpan | null = null;
  #colors: DeskColors;
  #size: Size = { width: 0, height: 0 };
  #view: View = { scale: 1, offsetX: 0, offsetY: 0 };
  /** The view that the strokes canvas shows. */
  #drawnView: View | null = null;
  /** Until the user pans or zooms, the paper is kept whole in sight. */
  #isFitted = true;
  #areStrokesStale = true;
  /** Not drawn yet. */
  #isSceneNew = true;
  /** The 2D canvases are drawn again only when something on them has changed. */
  #areSheetsStale = true;
  #restTimer: ReturnType<typeof setTimeout> | null = null;
  #request = 0;

  constructor(canvases: StageCanvases, desk: Desk, look: FrameLook) {
    this.#canvases = canvases;
    this.#desk = desk;
    this.#look = look;
    this.#colors = deskColors(canvases.box);
    this.#renderer = createGlRenderer(canvases.strokes) ?? createCanvasRenderer(canvases.strokes);
    this.#observer = new ResizeObserver(() => this.#resize());
    this.#observer.observe(canvases.box);
    canvases.strokes.addEventListener("webglcontextlost", this.#onLost);
    canvases.strokes.addEventListener("webglcontextrestored", this.#onRestored);
    this.#resize();
  }

  get rendererKind(): SceneRenderer["kind"] | null {
    return this.#renderer?.kind ?? null;
  }

  get view(): View {
    return this.#view;
  }

  /** Of the preview, CSS px. */
  get size(): Size {
    return this.#size;
  }

  setView(view: View): void {
    this.#view = view;
    this.#isFitted = false;
    if (this.#restTimer !== null) clearTimeout(this.#restTimer);
    this.#restTimer = setTimeout(() => {
      this.#restTimer = null;
      this.#refresh(true);
    }, REST_MS);
    this.#refresh(true);
  }

  fit(): void {
    this.#isFitted = true;
    this.#fitNow();
    this.#refresh(true);
  }

  zoomBy(factor: number): void {
    this.setView(zoomAt(this.#view, factor, this.#size.width / 2, this.#size.height / 2));
  }

  setScene(scene: Scene | null): void {
    if (scene === this.#scene) return;
    this.#scene = scene;
    this.#isSceneNew = true;
    this.#renderer?.setScene(scene);
    this.#refresh(true);
  }

  setLook(look: FrameLook): void {
    this.#look = look;
    this.#refresh(true);
  }

  setDesk(desk: Desk): void {
    const { width, height } = this.#desk.paperMm;
    const isOther = desk.paperMm.width !== width || desk.paperMm.height !== height;
    this.#desk = desk;
    if (isOther) this.fit();
    else this.#refresh(false);
  }

  setMarker(marker: Marker | null): void {
    this.#marker = marker;
    this.#refresh(false);
  }

  get desk(): Desk {
    return this.#desk;
  }

  /** A painter for what lies over the strokes (highlights, handles), called with every frame; and its box on the rulers. */
  setPainter(
    paint: ((context: CanvasRenderingContext2D, view: View) => void) | null,
    rulerSpan: RulerSpan | null,
  ): void {
    this.#paint = paint;
    this.#rulerSpan = rulerSpan;
    this.#refresh(false);
  }

  /** The theme has changed: the colours are read again. */
  recolor(): void {
    this.#colors = deskColors(this.#canvases.box);
    this.#refresh(false);
  }

  close(): void {
    cancelAnimationFrame(this.#request);
    if (this.#restTimer !== null) clearTimeout(this.#restTimer);
    this.#observer.disconnect();
    this.#canvases.strokes.removeEventListener("webglcontextlost", this.#onLost);
    this.#canvases.strokes.removeEventListener("webglcontextrestored", this.#onRestored);
    this.#renderer?.close();
    this.#renderer = null;
  }

  readonly #onLost = (event: Event): void => {
    event.preventDefault();
    this.#renderer = null;
  };

  readonly #onRestored = (): void => {
    this.#renderer = createGlRenderer(this.#canvases.strokes);
    this.#renderer?.setScene(this.#scene);
    this.#refresh(true);
  };

  #resize(): void {
    const { clientWidth: width, clientHeight: height } = this.#canvases.box;
    this.#size = { width, height };
    if (this.#isFitted) this.#fitNow();
    this.#refresh(true);
    // Before the browser shows the new size, not a frame after it.
    cancelAnimationFrame(this.#request);
    this.#frame();
  }

  #fitNow(): void {
    const insets = {
      top: RULER_PX + INSET_PX,
      left: RULER_PX + INSET_PX,
      right: INSET_PX,
      bottom: INSET_PX + BELOW_PX,
    };
    this.#view = fitView(this.#desk.paperMm, this.#size, insets);
  }

  #refresh(areStrokesStale: boolean): void {
    this.#areStrokesStale ||= areStrokesStale;
    this.#areSheetsStale = true;
    this.#schedule();
  }

  #schedule(): void {
    if (this.#request === 0) this.#request = requestAnimationFrame(this.#frame);
  }

  readonly #frame = (): void => {
    this.#request = 0;
    if (this.#size.width === 0 || this.#size.height === 0) return;
    const ratio = Math.min(MAX_RATIO, window.devicePixelRatio || 1);
    if (this.#areSheetsStale) this.#drawSheets(ratio);
    if (this.#areStrokesStale) this.#drawStrokes(ratio);
  };

  #drawSheets(ratio: number): void {
    const { desk, overlay } = this.#canvases;
    this.#areSheetsStale = false;
    const deskContext = beginCanvas(desk, this.#size, ratio);
    if (deskContext) drawBackdrop(deskContext, this.#view, this.#desk, this.#colors);
    const overlayContext = beginCanvas(overlay, this.#size, ratio);
    if (overlayContext) {
      this.#paint?.(overlayContext, this.#view);
      if (this.#marker) drawMarker(overlayContext, this.#view, this.#marker, this.#colors);
      drawRulers(overlayContext, this.#view, this.#size, this.#colors, this.#rulerSpan);
    }
  }

  #drawStrokes(ratio: number): void {
    const { strokes } = this.#canvases;
    const frame: Frame = {
      ...this.#look,
      ...this.#size,
      ratio,
      view: this.#view,
      isMoving: this.#restTimer !== null,
    };
    if (this.#renderer && !this.#renderer.draw(frame)) {
      strokes.style.transform = this.#drawnView ? transformBetween(this.#drawnView, this.#view) : "";
      this.#schedule();
      return;
    }
    strokes.style.transform = "";
    // A picture keeps the size that it was drawn for until the next one: the box may have changed.
    strokes.style.width = `${this.#size.width}px`;
    strokes.style.height = `${this.#size.height}px`;
    this.#drawnView = this.#view;
    this.#areStrokesStale = false;
    if (this.#isSceneNew && this.#scene) markMoment("plotwright-picture");
    this.#isSceneNew = false;
  }
}

/** Shows a picture drawn for `from` as it would lie under `to`. */
const transformBetween = (from: View, to: View): string => {
  const f = to.scale / from.scale;
  return `translate(${to.offsetX - from.offsetX * f}px, ${to.offsetY - from.offsetY * f}px) scale(${f})`;
};
