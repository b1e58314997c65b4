/**
 * Draws strokes by WebGL2: one instanced quad per piece, coloured in the shader. So panning, zooming, another colouring
 * or another moment of the plot cost no work per piece on the processor.
 *
 *        r ┌────────────────────────┐      a quad around the piece from a to b, wider by r on every
 *          │  a ──────────────── b  │      side; the fragment's distance from the piece gives round
 *          └────────────────────────┘      ends and smooth edges
 *
 * The parts of a picture are drawn into an off-screen buffer in order of time, so the result does not depend on the
 * number of parts. A fence shows when the card has finished a part.
 */
import { bytesFromHex, RAMP_SIZE, rampBytes } from "./color-map.js";
import { linkProgram, makeTexture, UNIFORMS, type Uniforms } from "./gl-program.js";
import {
  ASKED_COLOR,
  lineWidthPx,
  pictureSize,
  TRAVEL_ALPHA,
  TRAVEL_COLOR,
  TRAVEL_PX,
  type Detail,
  type Frame,
  type Picture,
  type SceneRenderer,
} from "./renderer.js";
import { LAYER_SHORT, PIECE_BYTES, VALUE_SHORT } from "./pieces.js";
import { turnOf } from "./view.js";
import {
  cutOffS,
  drawSome,
  piecesOf,
  sheetsOf,
  tasksOf,
  type Boxed,
  type Sheet,
  type PieceStyle,
  type Task,
} from "./tasks.js";

const COLOR_CODE = { value: 0, time: 1, layer: 2 } as const;
/** The palette's alpha is a pen's width: 255 means this. */
const WIDEST_MM = 12.75;
const PLAIN = 3;
const MAX_LAYERS = 2_048;
/** Later than any plot lasts: shaders need not know infinity. */
const NEVER_S = 1e30;
/** Bytes handed to the card at a time, and how long that may take of one part, ms. */
const CHUNK_BYTES = 1 << 20;
const LOADING_MS = 6;

interface Loaded extends Boxed {
  readonly buffer: WebGLBuffer;
  /** Bytes that were sent to the card. */
  loadedBytes: number;
}

/** Null if the browser has no WebGL2, or the card refuses another context. */
export const createGlRenderer = (canvas: OffscreenCanvas): SceneRenderer | null => {
  const gl = canvas.getContext("webgl2", { antialias: false, failIfMajorPerformanceCaveat: true });
  return gl && new GlRenderer(canvas, gl);
};

class GlRenderer implements SceneRenderer {
  private readonly uniforms: Uniforms;
  private readonly palette: WebGLTexture;
  private readonly target: WebGLFramebuffer;
  private readonly pixels: WebGLRenderbuffer;
  private width = 0;
  private height = 0;
  private paletteKey = "";
  private scene: Picture | null = null;
  private sheets: Record<Detail, Sheet<Loaded>> | null = null;
  private frame: Frame | null = null;
  private tasks: Task<Loaded>[] = [];
  private style: PieceStyle | null = null;
  private fence: WebGLSync | null = null;

  constructor(
    private readonly canvas: OffscreenCanvas,
    private readonly gl: WebGL2RenderingContext,
  ) {
    const program = linkProgram(gl);
    gl.useProgram(program);
    this.uniforms = Object.fromEntries(
      UNIFORMS.map((name) => [name, gl.getUniformLocation(program, name)]),
    ) as Uniforms;
    gl.activeTexture(gl.TEXTURE0);
    makeTexture(gl, RAMP_SIZE, rampBytes(), gl.LINEAR);
    gl.activeTexture(gl.TEXTURE1);
    this.palette = makeTexture(gl, 1, new Uint8Array(4), gl.NEAREST);
    gl.uniform1i(this.uniforms.ramp, 0);
    gl.uniform1i(this.uniforms.palette, 1);
    gl.enable(gl.BLEND);
    gl.blendFunc(gl.ONE, gl.ONE_MINUS_SRC_ALPHA);
    this.target = gl.createFramebuffer();
    this.pixels = gl.createRenderbuffer();
    for (const location of [0, 1, 2, 3]) {
      gl.enableVertexAttribArray(location);
      gl.vertexAttribDivisor(location, 1);
    }
  }

  get isFinished(): boolean {
    return this.tasks.length === 0;
  }

  setScene(scene: Picture | null): void {
    for (const { draw, travel, asked } of Object.values(this.sheets ?? {})) {
      for (const loaded of [draw, travel, asked]) if (loaded) this.gl.deleteBuffer(loaded.buffer);
    }
    this.scene = scene;
    this.tasks = [];
    this.sheets = scene && sheetsOf(scene, (boxed) => this.load(boxed));
  }

  begin(frame: Frame, detail: Detail): number {
    this.frame = frame;
    this.style = null;
    this.clear(frame);
    this.setPalette(frame);
    this.tasks = this.sheets ? tasksOf(frame, this.sheets[detail]) : [];
    return piecesOf(this.tasks);
  }

  advance(pieceCount: number): number {
    const frame = this.frame;
    if (!frame) return 0;
    const drawn = drawSome(this.tasks, pieceCount, (task, to) => {
      if (!this.isLoaded(task.of)) return false;
      if (task.style !== this.style) this.setStyle(frame, task.style);
      this.drawRange(task.of.buffer, task.from, to);
      return true;
    });
    const gl = this.gl;
    if (this.fence) gl.deleteSync(this.fence);
    this.fence = gl.fenceSync(gl.SYNC_GPU_COMMANDS_COMPLETE, 0);
    gl.flush();
    return drawn;
  }

  isIdle(): boolean {
    const gl = this.gl;
    if (!this.fence) return true;
    const status = gl.getSyncParameter(this.fence, gl.SYNC_STATUS) as number;
    if (status !== gl.SIGNALED && !gl.isContextLost()) return false;
    gl.deleteSync(this.fence);
    this.fence = null;
    return true;
  }

  present(): void {
    const gl = this.gl;
    if (this.canvas.width !== this.width || this.canvas.height !== this.height) {
      this.canvas.width = this.width;
      this.canvas.height = this.height;
    }
    gl.bindFramebuffer(gl.DRAW_FRAMEBUFFER, null);
    const [w, h] = [this.width, this.height];
    gl.blitFramebuffer(0, 0, w, h, 0, 0, w, h, gl.COLOR_BUFFER_BIT, gl.NEAREST);
    gl.bindFramebuffer(gl.DRAW_FRAMEBUFFER, this.target);
  }

  close(): void {
    this.setScene(null);
    this.gl.deleteTexture(this.palette);
    this.gl.deleteFramebuffer(this.target);
    this.gl.deleteRenderbuffer(this.pixels);
  }

  /** Resizes the off-screen buffer to the frame and clears it. */
  private clear(frame: Frame): void {
    const { view, ratio } = frame;
    const gl = this.gl;
    const [w, h] = pictureSize(frame);
    gl.bindFramebuffer(gl.FRAMEBUFFER, this.target);
    if (w !== this.width || h !== this.height) {
      [this.width, this.height] = [w, h];
      gl.bindRenderbuffer(gl.RENDERBUFFER, this.pixels);
      gl.renderbufferStorage(gl.RENDERBUFFER, gl.RGBA8, w, h);
      gl.framebufferRenderbuffer(gl.FRAMEBUFFER, gl.COLOR_ATTACHMENT0, gl.RENDERBUFFER, this.pixels);
    }
    gl.viewport(0, 0, w, h);
    gl.clearColor(0, 0, 0, 0);
    gl.clear(gl.COLOR_BUFFER_BIT);
    gl.uniform1f(this.uniforms.scale, view.scale * ratio);
    gl.uniform2f(this.uniforms.turn, ...turnOf(view));
    gl.uniform2f(this.uniforms.offset, view.offsetX * ratio, view.offsetY * ratio);
    gl.uniform2f(this.uniforms.viewport, w, h);
    gl.uniform1f(this.uniforms.totalS, Math.max(1e-6, this.scene?.totalS ?? 1));
  }

  private load(boxed: Boxed): Loaded {
    const gl = this.gl;
    const buffer = gl.createBuffer();
    gl.bindBuffer(gl.ARRAY_BUFFER, buffer);
    gl.bufferData(gl.ARRAY_BUFFER, boxed.pieces.bytes.byteLength, gl.STATIC_DRAW);
    return { ...boxed, buffer, loadedBytes: 0 };
  }

  /** Sends the next bytes of a new scene to the card. True when all are sent. */
  private isLoaded(loaded: Loaded): boolean {
    const gl = this.gl;
    const { bytes } = loaded.pieces;
    if (loaded.loadedBytes === bytes.byteLength) return true;
    const untilMs = performance.now() + LOADING_MS;
    gl.bindBuffer(gl.ARRAY_BUFFER, loaded.buffer);
    while (loaded.loadedBytes < bytes.byteLength) {
      if (performance.now() > untilMs) return false;
      const length = Math.min(CHUNK_BYTES, bytes.byteLength - loaded.loadedBytes);
      gl.bufferSubData(
        gl.ARRAY_BUFFER,
        loaded.loadedBytes,
        new Uint8Array(bytes, loaded.loadedBytes, length),
      );
      loaded.loadedBytes += length;
    }
    return true;
  }

  private setPalette({ layerColors: colors, layerWidthsMm }: Frame): void {
    const key = `${colors.join()} ${layerWidthsMm.join()}`;
    if (key === this.paletteKey) return;
    this.paletteKey = key;
    const gl = this.gl;
    const count = Math.min(MAX_LAYERS, Math.max(1, colors.length));
    const bytes = new Uint8Array(count * 4);
    colors.slice(0, count).forEach((color, i) => {
      const share = Math.min(1, (layerWidthsMm[i] ?? 0) / WIDEST_MM);
      bytes.set([...bytesFromHex(color), Math.round(255 * share)], i * 4);
    });
    gl.activeTexture(gl.TEXTURE1);
    gl.bindTexture(gl.TEXTURE_2D, this.palette);
    gl.texImage2D(gl.TEXTURE_2D, 0, gl.RGBA, count, 1, 0, gl.RGBA, gl.UNSIGNED_BYTE, bytes);
  }

  private setStyle(frame: Frame, style: PieceStyle): void {
    const gl = this.gl;
    this.style = style;
    const isThin = style === "travel" || style === "asked";
    const narrowestPx = isThin ? TRAVEL_PX : lineWidthPx(frame, 0);
    gl.uniform1f(this.uniforms.cutOffS, Math.min(NEVER_S, cutOffS(frame, style)));
    gl.uniform1f(this.uniforms.radius, (narrowestPx * frame.ratio) / 2);
    gl.uniform1f(this.uniforms.widthMm, isThin ? 0 : WIDEST_MM);
    if (style === "ghost") this.setPlain(frame.ghostColor, 1);
    else if (style === "asked") this.setPlain(ASKED_COLOR, 1);
    else if (style === "travel") this.setPlain(TRAVEL_COLOR, TRAVEL_ALPHA);
    else gl.uniform1i(this.uniforms.colorBy, COLOR_CODE[frame.colorBy]);
  }

  private setPlain(hex: string, alpha: number): void {
    const [r, g, b] = bytesFromHex(hex);
    this.gl.uniform1i(this.uniforms.colorBy, PLAIN);
    this.gl.uniform4f(this.uniforms.plain, r / 255, g / 255, b / 255, alpha);
  }

  private drawRange(buffer: WebGLBuffer, from: number, to: number): void {
    const gl = this.gl;
    const base = from * PIECE_BYTES;
    gl.bindBuffer(gl.ARRAY_BUFFER, buffer);
    gl.vertexAttribPointer(0, 4, gl.FLOAT, false, PIECE_BYTES, base);
    gl.vertexAttribPointer(1, 2, gl.FLOAT, false, PIECE_BYTES, base + 16);
    gl.vertexAttribPointer(2, 2, gl.UNSIGNED_SHORT, true, PIECE_BYTES, base + VALUE_SHORT * 2);
    gl.vertexAttribPointer(3, 2, gl.UNSIGNED_SHORT, false, PIECE_BYTES, base + LAYER_SHORT * 2);
    gl.drawArraysInstanced(gl.TRIANGLE_STRIP, 0, 4, to - from);
  }
}
