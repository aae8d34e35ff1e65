// The box in 3-D: the program of the graphics card. It draws the triangles of walls, lines, which
// have no normal, and dots, which have a look.

/** The shapes of dots, in the order of the shader's cases, as letters for legends. */
const SHAPES = "●■◆▲○×";

const VERTEX = `#version 300 es
layout(location = 0) in vec3 position; layout(location = 1) in vec4 color;
layout(location = 2) in vec3 normal; layout(location = 3) in vec2 look;
uniform mat4 camera; uniform vec3 eye, light, air; uniform vec2 shift;
uniform float pixels, ratio, alpha, pick;
out vec4 c; flat out float shape, wide;
void main() {
  c = color; shape = round(look.x * 255.); wide = 0.;
  float state = round(look.y * 255.); bool isDot = state > 0., isLine = normal == vec3(0);
  // Dots and lines stand a little nearer than their surface, whose depth varies within a pixel.
  // (With \`polygonOffset\`, some drivers give other depths in every frame.)
  float nearer = isDot ? .006 : isLine ? .002 : 0.;
  gl_Position = camera * vec4(mix(position, eye, nearer), 1);
  // Seen from behind, a wall does not hide the room. If it is solid, its dots are hidden, too.
  bool isBehind = dot(normal, eye - position) < 0. && (!isDot || alpha == 1.);
  if (c.a == 0. || isBehind) gl_Position = vec4(2, 2, 2, 1);
  else if (isDot) {
    // The handout's rays go through upper left corners: half a pixel off the middle.
    gl_Position.xy += shift * gl_Position.w;
    // A dot is as wide as the cube in which the handout looks for a photon, if that can be seen.
    wide = clamp(pixels / gl_Position.w, pick > 0. ? 5. : 1.5 * ratio, 30. * ratio);
    if (state == 2.) wide = max(wide * 1.6, 4.);
    if (state == 3.) wide = max(wide, 8. * ratio);
    gl_PointSize = wide;
    uint id = uint(gl_VertexID) + 1u;
    if (pick > 0.) c = vec4(id & 255u, (id >> 8) & 255u, id >> 16, 255) / 255.;
  } else if (!isLine) {
    float lit = .35 + .65 * max(dot(normal, normalize(light - position)), 0.);
    c = vec4(mix(c.rgb * lit, air, .5), alpha);
  }
}`;
const FRAGMENT = `#version 300 es
precision highp float; in vec4 c; flat in float shape, wide; uniform float pick; out vec4 o;
void main() {
  o = c;
  // Too small for a shape: a square, so that at least one pixel is drawn.
  if (pick > 0. || wide < 3.) return;
  vec2 p = abs(gl_PointCoord * 2. - 1.); float d = length(p);
  bool inside = shape == 0. ? d < 1. : shape == 1. ? max(p.x, p.y) < .88
    : shape == 2. ? p.x + p.y < 1. : shape == 3. ? p.x < gl_PointCoord.y * .95
    : shape == 4. ? d < 1. && d > .55 : abs(p.x - p.y) < .38;
  if (!inside) discard;
}`;
