// The box in 3-D: its colors, its shapes, and the programs of the graphics card.

/** The names of all colors, in the order of the shader's palette. The style sheet has values. */
const COLORS = "gray one two three four red missing extra moved text light edge".split(" ");
/** The shapes of dots, in the order of the shader's cases, as letters for legends. */
const SHAPES = { circle: "●", square: "■", diamond: "◆", triangle: "▲", ring: "○", cross: "×" };
/** A color and a shape as the first number of a dot's look. */
const look = (color, shape) =>
  COLORS.indexOf(color) | (Object.keys(SHAPES).indexOf(shape) << 4);

const SURFACE_VERTEX = `#version 300 es
layout(location = 0) in vec3 position; layout(location = 1) in vec3 normal;
layout(location = 2) in vec3 color;
uniform mat4 camera; out vec3 at, n, c;
void main() { at = position; n = normal; c = color; gl_Position = camera * vec4(position, 1); }`;
const SURFACE_FRAGMENT = `#version 300 es
precision highp float;
in vec3 at, n, c; uniform vec3 light, air, eye; uniform float alpha; out vec4 o;
void main() {
  // Seen from behind, a wall does not hide the room.
  if (dot(n, eye - at) < 0.) discard;
  float lit = .35 + .65 * max(dot(normalize(n), normalize(light - at)), 0.);
  o = vec4(mix(c * lit, air, .5), alpha);
}`;
// A dot is as wide as the cube in which the handout looks for a photon, but never too small to see.
// It stands a little nearer than its surface, whose depth varies within the dot's pixels.
// (`polygonOffset` would do the same, but some drivers give other depths in every frame.)
// A wall seen from behind is not drawn, and neither are its dots.
const DOT_VERTEX = `#version 300 es
layout(location = 0) in vec3 position; layout(location = 1) in uvec2 look;
layout(location = 2) in vec3 normal;
uniform mat4 camera; uniform vec3 eye, palette[12]; uniform vec2 shift;
uniform float pixels, least, most, large, dim, alpha, pick;
flat out vec4 c; flat out uint shape; flat out float wide;
void main() {
  uint state = look.y; shape = look.x >> 4;
  bool isBehind = alpha == 1. && dot(normal, eye - position) < 0.;
  gl_Position = camera * vec4(mix(position, eye, .006), 1);
  gl_Position.xy += shift * gl_Position.w;
  wide = clamp(pixels / gl_Position.w, least, most);
  if (state == 2u) wide = max(wide * 1.6, 4.);
  if (state == 3u) wide = max(wide, large);
  gl_PointSize = wide;
  if (state == 0u || isBehind) gl_Position = vec4(2, 2, 2, 1);
  uint id = uint(gl_VertexID) + 1u;
  c = pick > 0. ? vec4(id & 255u, (id >> 8) & 255u, id >> 16, 255) / 255.
    : vec4(palette[look.x & 15u], state == 2u ? 1. : dim);
}`;
const DOT_FRAGMENT = `#version 300 es
precision highp float; flat in vec4 c; flat in uint shape; flat in float wide;
uniform float pick; out vec4 o;
void main() {
  o = c;
  // Too small for a shape: a square, so that at least one pixel is drawn.
  if (pick > 0. || wide < 3.) return;
  vec2 p = abs(gl_PointCoord * 2. - 1.); float d = length(p);
  bool inside = shape == 0u ? d < 1. : shape == 1u ? max(p.x, p.y) < .88
    : shape == 2u ? p.x + p.y < 1. : shape == 3u ? p.x < gl_PointCoord.y * .95
    : shape == 4u ? d < 1. && d > .55 : abs(p.x - p.y) < .38;
  if (!inside) discard;
}`;
// A line is a strip of two triangles. Its width is in pixels.
const LINE_VERTEX = `#version 300 es
layout(location = 0) in vec3 a; layout(location = 1) in vec3 b; layout(location = 2) in vec4 color;
layout(location = 3) in vec2 style;
uniform mat4 camera; uniform vec3 eye; uniform vec2 size; out vec4 c; out float along;
flat out float dash;
void main() {
  vec4 p = camera * vec4(mix(a, eye, .002), 1), q = camera * vec4(mix(b, eye, .002), 1);
  float nearest = .01, cut = (nearest - p.w) / (q.w - p.w);
  if (p.w < nearest) p = mix(p, q, cut); else if (q.w < nearest) q = mix(p, q, cut);
  vec2 way = (q.xy / q.w - p.xy / p.w) * size; float far = max(length(way), 1e-3);
  vec2 aside = vec2(-way.y, way.x) / far * style.x / size;
  float end = float(gl_VertexID >> 1), side = float(gl_VertexID & 1) * 2. - 1.;
  gl_Position = end < .5 ? p : q;
  gl_Position.xy += aside * side * gl_Position.w;
  along = end * far / 2.; dash = style.y; c = color;
}`;
const LINE_FRAGMENT = `#version 300 es
precision highp float; in vec4 c; in float along; flat in float dash; out vec4 o;
void main() { if (dash > 0. && fract(along / dash) > .55) discard; o = c; }`;
