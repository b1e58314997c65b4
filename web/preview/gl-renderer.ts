/**
 * Strokes by WebGL2: one instanced quad a piece, coloured in the shader, so that panning, zooming,
 * another colouring or another moment of the plot cost no work per piece on the page's thread.
 *
 *        r ┌────────────────────────┐      a quad around the piece from a to b, wider by r on every
 *          │  a ──────────────── b  │      side; the fragment's distance from the piece gives round
 *          └────────────────────────┘      ends and smooth edges
 *
 * At most one frame is in flight: a fence tells when the card is done, and `draw` declines until then.
 */
import { RAMP_SIZE, rampBytes } from "./color-map.js";
import {
  bytesFromHex,
  GHOST_COLOR,
  INK_COLOR,
  lineWidthPx,
  TRAVEL_COLOR,
  type Frame,
  type SceneRenderer,
} from "./renderer.js";
import { LAYER_SHORT, PIECE_BYTES, piecesBefore, SPEED_SHORT, type Pieces, type Scene } from "./scene.js";

const VERTEX = `#version 300 es
precision highp float;
layout(location = 0) in vec4 line;   // mm
layout(location = 1) in vec2 time;   // s
layout(location = 2) in vec2 speed;  // share of the top speed
layout(location = 3) in float layer;
uniform float scale;                 // device px a mm
uniform vec2 offset, viewport;       // device px
uniform float radius;                // device px, of the narrowest line where layers have their own widths
uniform float widthMm;               // of a full alpha in the palette; 0: all lines are 2 radius wide
uniform sampler2D palette;
uniform float totalS;
out vec2 local;
flat out float reach;
flat out float len;
out vec2 share;                      // of speed, of time
flat out float layerIndex;
void main() {
  vec2 a = line.xy * scale + offset;
  vec2 b = line.zw * scale + offset;
  len = distance(a, b);
  vec2 u = len > 1e-4 ? (b - a) / len : vec2(1.0, 0.0);
  reach = radius;
  if (widthMm > 0.0) {
    reach = max(radius, texelFetch(palette, ivec2(int(layer), 0), 0).a * widthMm * scale / 2.0);
  }
  float r = reach + 1.0;
  float along = (gl_VertexID & 2) != 0 ? len + r : -r;
  float side = (gl_VertexID & 1) != 0 ? r : -r;
  vec2 p = a + u * along + vec2(-u.y, u.x) * side;
  local = vec2(along, side);
  float f = len > 1e-4 ? along / len : 0.5;
  share = vec2(mix(speed.x, speed.y, f), mix(time.x, time.y, f) / totalS);
  layerIndex = layer;
  gl_Position = vec4(p.x / viewport.x * 2.0 - 1.0, 1.0 - p.y / viewport.y * 2.0, 0.0, 1.0);
}`;

const FRAGMENT = `#version 300 es
precision highp float;
in vec2 local;
flat in float len;
in vec2 share;
flat in float layerIndex;
flat in float reach;
uniform int colorBy;                 // 0 speed, 1 order, 2 layer, 3 plain
uniform vec4 plain;
uniform sampler2D ramp;
uniform sampler2D palette;
out vec4 color;
void main() {
  float d = length(vec2(local.x - clamp(local.x, 0.0, len), local.y));
  float alpha = clamp(reach + 0.5 - d, 0.0, 1.0);
  if (alpha <= 0.0) discard;
  vec4 c = plain;
  if (colorBy == 0) c = texture(ramp, vec2(clamp(share.x, 0.002, 0.998), 0.5));
  else if (colorBy == 1) c = texture(ramp, vec2(clamp(share.y, 0.002, 0.998), 0.5));
  else if (colorBy == 2) c = vec4(texelFetch(palette, ivec2(int(layerIndex), 0), 0).rgb, 1.0);
  color = vec4(c.rgb, 1.0) * (c.a * alpha);
}`;

const UNIFORMS = [
  "scale",
  "offset",
  "viewport",
  "radius",
  "widthMm",
  "totalS",
  "colorBy",
  "plain",
  "ramp",
  "palette",
] as const;
type Uniforms = Record<(typeof UNIFORMS)[number], WebGLUniformLocation | null>;
const COLOR_CODE = { speed: 0, order: 1, layer: 2, pen: 2, ink: 3 } as const;
/** The palette's alpha is a pen's width, in 255ths of this. */
const WIDEST_MM = 12.75;
/** What is drawn of a large drawing while it is moved; a stride may be 255 bytes at most. */
const MOVING_PIECES = 200_000;
const MAX_SKIP = Math.floor(255 / PIECE_BYTES);
const PLAIN = 3;
const MAX_LAYERS = 2_048;

interface Loaded {
  readonly pieces: Pieces;
  readonly buffer: WebGLBuffer;
  /** Bytes that the card has. */
  loadedBytes: number;
}

/** Bytes handed to the card at a time, and how long that may take of one frame, ms. */
const CHUNK_BYTES = 1 << 20;
const LOADING_MS = 6;

/** Null where the browser has no WebGL2. */
export const createGlRenderer = (canvas: HTMLCanvasElement): SceneRenderer | null => {
  const gl = canvas.getContext("webgl2", { alpha: true, antialias: false, premultipliedAlpha: true });
  return gl ? new GlRenderer(canvas, gl) : null;
};

class GlRenderer implements SceneRenderer {
  readonly kind = "webgl";
  readonly #canvas: HTMLCanvasElement;
  readonly #gl: WebGL2RenderingContext;
  readonly #uniforms: Uniforms;
  readonly #palette: WebGLTexture;
  #paletteKey = "";
  #scene: Scene | null = null;
  #draw: Loaded | null = null;
  #travel: Loaded | null = null;
  #fence: WebGLSync | null = null;

  constructor(canvas: HTMLCanvasElement, gl: WebGL2RenderingContext) {
    this.#canvas = canvas;
    this.#gl = gl;
    const program = linkProgram(gl);
    gl.useProgram(program);
    this.#uniforms = Object.fromEntries(
      UNIFORMS.map((name) => [name, gl.getUniformLocation(program, name)]),
    ) as Uniforms;
    gl.activeTexture(gl.TEXTURE0);
    makeTexture(gl, RAMP_SIZE, rampBytes(), gl.LINEAR);
    gl.activeTexture(gl.TEXTURE1);
    this.#palette = makeTexture(gl, 1, new Uint8Array(4), gl.NEAREST);
    gl.uniform1i(this.#uniforms.ramp, 0);
    gl.uniform1i(this.#uniforms.palette, 1);
    gl.enable(gl.BLEND);
    gl.blendFunc(gl.ONE, gl.ONE_MINUS_SRC_ALPHA);
    for (const location of [0, 1, 2, 3]) {
      gl.enableVertexAttribArray(location);
      gl.vertexAttribDivisor(location, 1);
    }
  }

  setScene(scene: Scene | null): void {
    const gl = this.#gl;
    for (const loaded of [this.#draw, this.#travel]) if (loaded) gl.deleteBuffer(loaded.buffer);
    this.#scene = scene;
    this.#draw = scene ? this.#load(scene.draw) : null;
    this.#travel = scene ? this.#load(scene.travel) : null;
  }

  draw(frame: Frame): boolean {
    if (!this.#isLoaded() || !this.#isIdle()) return false;
    const gl = this.#gl;
    const width = Math.max(1, Math.round(frame.width * frame.ratio));
    const height = Math.max(1, Math.round(frame.height * frame.ratio));
    if (this.#canvas.width !== width || this.#canvas.height !== height) {
      this.#canvas.width = width;
      this.#canvas.height = height;
    }
    gl.viewport(0, 0, width, height);
    gl.clearColor(0, 0, 0, 0);
    gl.clear(gl.COLOR_BUFFER_BIT);
    if (!this.#scene || !this.#draw || !this.#travel) return true;
    this.#setView(frame, width, height);
    this.#setPalette(frame);
    this.#drawStrokes(frame, this.#draw);
    if (frame.showTravel) this.#drawTravel(frame, this.#travel);
    this.#fence = gl.fenceSync(gl.SYNC_GPU_COMMANDS_COMPLETE, 0);
    gl.flush();
    return true;
  }

  close(): void {
    this.setScene(null);
    this.#gl.deleteTexture(this.#palette);
  }

  #isIdle(): boolean {
    const gl = this.#gl;
    if (!this.#fence) return true;
    const status = gl.getSyncParameter(this.#fence, gl.SYNC_STATUS) as number;
    if (status !== gl.SIGNALED && !gl.isContextLost()) return false;
    gl.deleteSync(this.#fence);
    this.#fence = null;
    return true;
  }

  #load(pieces: Pieces): Loaded {
    const gl = this.#gl;
    const buffer = gl.createBuffer();
    gl.bindBuffer(gl.ARRAY_BUFFER, buffer);
    gl.bufferData(gl.ARRAY_BUFFER, pieces.bytes.byteLength, gl.STATIC_DRAW);
    return { pieces, buffer, loadedBytes: 0 };
  }

  /** Brings a little more of a new scene to the card; true once all of it is there. */
  #isLoaded(): boolean {
    const gl = this.#gl;
    const untilMs = performance.now() + LOADING_MS;
    for (const loaded of [this.#draw, this.#travel]) {
      if (!loaded) continue;
      const { bytes } = loaded.pieces;
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
    }
    return true;
  }

  #setView({ view, ratio }: Frame, width: number, height: number): void {
    const gl = this.#gl;
    gl.uniform1f(this.#uniforms.scale, view.scale * ratio);
    gl.uniform2f(this.#uniforms.offset, view.offsetX * ratio, view.offsetY * ratio);
    gl.uniform2f(this.#uniforms.viewport, width, height);
    gl.uniform1f(this.#uniforms.totalS, Math.max(1e-6, this.#scene?.totalS ?? 1));
  }

  #setPalette({ layerColors: colors, layerWidthsMm }: Frame): void {
    const key = `${colors.join()} ${layerWidthsMm?.join() ?? ""}`;
    if (key === this.#paletteKey) return;
    this.#paletteKey = key;
    const gl = this.#gl;
    const count = Math.min(MAX_LAYERS, Math.max(1, colors.length));
    const bytes = new Uint8Array(count * 4);
    colors.slice(0, count).forEach((color, i) => {
      const share = Math.min(1, (layerWidthsMm?.[i] ?? 0) / WIDEST_MM);
      bytes.set([...bytesFromHex(color), Math.round(255 * share)], i * 4);
    });
    gl.activeTexture(gl.TEXTURE1);
    gl.bindTexture(gl.TEXTURE_2D, this.#palette);
    gl.texImage2D(gl.TEXTURE_2D, 0, gl.RGBA, count, 1, 0, gl.RGBA, gl.UNSIGNED_BYTE, bytes);
  }

  #drawStrokes(frame: Frame, { pieces, buffer }: Loaded): void {
    const gl = this.#gl;
    const lineMm = frame.layerWidthsMm ? 0 : frame.lineMm;
    gl.uniform1f(this.#uniforms.radius, (lineWidthPx(frame, lineMm) * frame.ratio) / 2);
    gl.uniform1f(this.#uniforms.widthMm, frame.layerWidthsMm ? WIDEST_MM : 0);
    const done = frame.untilS === null ? pieces.count : piecesBefore(pieces, frame.untilS);
    this.#setPlain(GHOST_COLOR, 1);
    const skip = frame.isMoving ? Math.min(MAX_SKIP, Math.ceil(pieces.count / MOVING_PIECES)) : 1;
    this.#drawRange(buffer, done, pieces.count, skip);
    gl.uniform1i(this.#uniforms.colorBy, COLOR_CODE[frame.colorBy]);
    if (frame.colorBy === "ink") this.#setPlain(INK_COLOR, 1);
    this.#drawRange(buffer, 0, done, skip);
  }

  #drawTravel(frame: Frame, { pieces, buffer }: Loaded): void {
    this.#gl.uniform1f(this.#uniforms.radius, 0.45 * frame.ratio);
    this.#gl.uniform1f(this.#uniforms.widthMm, 0);
    this.#setPlain(TRAVEL_COLOR, 0.6);
    const done = frame.untilS === null ? pieces.count : piecesBefore(pieces, frame.untilS);
    this.#drawRange(buffer, 0, done);
  }

  #setPlain(hex: string, alpha: number): void {
    const [r, g, b] = bytesFromHex(hex);
    this.#gl.uniform1i(this.#uniforms.colorBy, PLAIN);
    this.#gl.uniform4f(this.#uniforms.plain, r / 255, g / 255, b / 255, alpha);
  }

  /** Every `skip`-th piece: instances are stepped over by a wider stride. */
  #drawRange(buffer: WebGLBuffer, from: number, to: number, skip = 1): void {
    if (to <= from) return;
    const gl = this.#gl;
    const base = from * PIECE_BYTES;
    const stride = PIECE_BYTES * skip;
    gl.bindBuffer(gl.ARRAY_BUFFER, buffer);
    gl.vertexAttribPointer(0, 4, gl.FLOAT, false, stride, base);
    gl.vertexAttribPointer(1, 2, gl.FLOAT, false, stride, base + 16);
    gl.vertexAttribPointer(2, 2, gl.UNSIGNED_SHORT, true, stride, base + SPEED_SHORT * 2);
    gl.vertexAttribPointer(3, 1, gl.UNSIGNED_SHORT, false, stride, base + LAYER_SHORT * 2);
    gl.drawArraysInstanced(gl.TRIANGLE_STRIP, 0, 4, Math.floor((to - from) / skip));
  }
}

const linkProgram = (gl: WebGL2RenderingContext): WebGLProgram => {
  const program = gl.createProgram();
  for (const [type, source] of [
    [gl.VERTEX_SHADER, VERTEX],
    [gl.FRAGMENT_SHADER, FRAGMENT],
  ] as const) {
    const shader = gl.createShader(type);
    if (!shader) throw new Error("the graphics card gave no shader");
    gl.shaderSource(shader, source);
    gl.compileShader(shader);
    gl.attachShader(program, shader);
  }
  gl.linkProgram(program);
  if (!gl.getProgramParameter(program, gl.LINK_STATUS) && !gl.isContextLost()) {
    throw new Error(
      `the preview's shader does not link: ${gl.getProgramInfoLog(program) ?? "no reason given"}`,
    );
  }
  return program;
};

const makeTexture = (
  gl: WebGL2RenderingContext,
  width: number,
  bytes: Uint8Array,
  filter: number,
): WebGLTexture => {
  const texture = gl.createTexture();
  gl.bindTexture(gl.TEXTURE_2D, texture);
  gl.texImage2D(gl.TEXTURE_2D, 0, gl.RGBA, width, 1, 0, gl.RGBA, gl.UNSIGNED_BYTE, bytes);
  for (const name of [gl.TEXTURE_MIN_FILTER, gl.TEXTURE_MAG_FILTER]) {
    gl.texParameteri(gl.TEXTURE_2D, name, filter);
  }
  for (const name of [gl.TEXTURE_WRAP_S, gl.TEXTURE_WRAP_T]) {
    gl.texParameteri(gl.TEXTURE_2D, name, gl.CLAMP_TO_EDGE);
  }
  return texture;
};
