/**
 * The shader. Each instance draws one piece: a quad around it, with round ends, smooth edges and its colour.
 *
 *   line              mm x0 y0 x1 y1           scale             device px a mm
 *   turn              cos and sin of the desk's turn
 *   time              s                        offset, viewport  device px
 *   value             share of the ramp        radius            device px, of the narrowest line
 *   share             of value, of time        widthMm           of a full alpha in the palette; 0: all are equally narrow
 *   cutOffS           s: the time that the pen has reached; the piece under it ends there
 *   ends              device px along the piece: what is drawn of it (`beyondJoint`)
 *   colorBy           0 value, 1 time, 2 layer, 3 plain
 */

import { FLUSH_PX, FLUSH_REACH_PX, JOINT_STEP, OVERLAP_PX } from "./pieces.js";

/** As a literal of the shader's language. */
const float = (value: number): string => value.toFixed(6);

const VERTEX = `#version 300 es
precision highp float;
layout(location = 0) in vec4 line;
layout(location = 1) in vec2 time;
layout(location = 2) in vec2 value;
layout(location = 3) in vec2 layerJoints;
uniform float scale;
uniform vec2 turn, offset, viewport;
uniform float radius;
uniform float widthMm;
uniform sampler2D palette;
uniform float totalS;
uniform float cutOffS;
out vec2 local;
flat out float reach;
flat out float len;
flat out vec2 ends;
out vec2 share;
flat out float layerIndex;
float beyondJoint(float code, float end) {
  float beyond = (code - 1.0) * ${float(JOINT_STEP)} * reach;
  bool isFlush = code > 0.0 && beyond < ${float(FLUSH_PX)} && reach < ${float(FLUSH_REACH_PX)};
  return isFlush ? 2.0 * beyond + ${float(OVERLAP_PX)} : end;
}
vec2 onScreen(vec2 mm) {
  return vec2(turn.x * mm.x - turn.y * mm.y, turn.y * mm.x + turn.x * mm.y) * scale + offset;
}
void main() {
  float layer = layerJoints.x;
  vec2 a = onScreen(line.xy);
  float part = time.y > time.x ? clamp((cutOffS - time.x) / (time.y - time.x), 0.0, 1.0) : 1.0;
  vec2 b = onScreen(mix(line.xy, line.zw, part));
  len = distance(a, b);
  vec2 u = len > 1e-4 ? (b - a) / len : vec2(1.0, 0.0);
  reach = radius;
  if (widthMm > 0.0) {
    reach = max(radius, texelFetch(palette, ivec2(int(layer), 0), 0).a * widthMm * scale / 2.0);
  }
  float r = reach + 1.0;
  float after = floor(layerJoints.y / 256.0);
  float before = layerJoints.y - 256.0 * after;
  ends = vec2(beyondJoint(before, -1.0) < 0.0 ? -r : 0.0, len + (part < 1.0 ? r : beyondJoint(after, r)));
  float along = (gl_VertexID & 2) != 0 ? len + r : -r;
  float side = (gl_VertexID & 1) != 0 ? r : -r;
  vec2 p = a + u * along + vec2(-u.y, u.x) * side;
  local = vec2(along, side);
  float f = (len > 1e-4 ? along / len : 0.5) * part;
  share = vec2(mix(value.x, value.y, f), mix(time.x, time.y, f) / totalS);
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
flat in vec2 ends;
uniform int colorBy;
uniform vec4 plain;
uniform sampler2D ramp;
uniform sampler2D palette;
out vec4 color;
void main() {
  if (local.x < ends.x || local.x > ends.y) discard;
  float d = length(vec2(local.x - clamp(local.x, 0.0, len), local.y));
  float alpha = clamp(reach + 0.5 - d, 0.0, 1.0);
  if (alpha <= 0.0) discard;
  vec4 c = plain;
  if (colorBy == 0) c = texture(ramp, vec2(clamp(share.x, 0.002, 0.998), 0.5));
  else if (colorBy == 1) c = texture(ramp, vec2(clamp(share.y, 0.002, 0.998), 0.5));
  else if (colorBy == 2) c = vec4(texelFetch(palette, ivec2(int(layerIndex), 0), 0).rgb, 1.0);
  color = vec4(c.rgb, 1.0) * (c.a * alpha);
}`;

export const UNIFORMS = [
  "scale",
  "turn",
  "offset",
  "viewport",
  "radius",
  "widthMm",
  "totalS",
  "cutOffS",
  "colorBy",
  "plain",
  "ramp",
  "palette",
] as const;
export type Uniforms = Record<(typeof UNIFORMS)[number], WebGLUniformLocation | null>;

export const linkProgram = (gl: WebGL2RenderingContext): WebGLProgram => {
  const program = gl.createProgram();
  for (const [type, source] of [
    [gl.VERTEX_SHADER, VERTEX],
    [gl.FRAGMENT_SHADER, FRAGMENT],
  ] as const) {
    const shader = gl.createShader(type);
    if (!shader) throw new Error("WebGL could not create a shader");
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

export const makeTexture = (
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
