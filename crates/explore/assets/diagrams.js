// Small drawings beside the code, as SVG. Colors come from the style sheet.

function draw(tag, attributes, ...children) {
  const node = document.createElementNS("http://www.w3.org/2000/svg", tag);
  Object.entries(attributes).forEach(([name, value]) => node.setAttribute(name, value));
  node.append(...children);
  return node;
}
const picture = (height, label, ...children) => {
  const viewBox = `0 0 300 ${height}`;
  return draw("svg", { viewBox, role: "img", "aria-label": label, class: "diagram" }, ...children);
};
const line = ([x1, y1], [x2, y2], kind = "") => draw("line", { x1, y1, x2, y2, class: kind });
const circle = ([cx, cy], r, kind = "") => draw("circle", { cx, cy, r, class: kind });
const text = ([x, y], words, kind = "") => draw("text", { x, y, class: kind }, words);
const bar = (x, width, kind) => draw("rect", { x, y: 44, width, height: 20, class: kind });
/** What is drawn in one color of the style sheet. */
const tinted = (color, ...children) => {
  const group = draw("g", {}, ...children);
  group.style.color = `var(--${color})`;
  return group;
};
/** An arrow with its head, which is small where the arrow is short. */
function arrow(from, to, color, kind = "") {
  const way = [to[0] - from[0], to[1] - from[1], 0];
  const [ux, uy] = scale(unit(way), Math.min(4, Math.hypot(...way) / 3));
  const corner = (side) => [to[0] - 2 * ux + side * uy, to[1] - 2 * uy - side * ux].join();
  const points = `${to.join()} ${corner(1)} ${corner(-1)}`;
  return tinted(color, line(from, to, kind), draw("polygon", { points, class: "filled" }));
}
/** World axes on paper: x to the right, z up, y into the paper. */
const oblique = (center, size) => ([x, y, z]) =>
  [center[0] + size * (x + 0.38 * y), center[1] - size * (z + 0.3 * y)];

const diagrams = {
  cube(tries) {
    const at = oblique([150, 92], 50), center = at([0, 0, 0]), ends = [-1, 1];
    const edges = [0, 1, 2].flatMap((axis) =>
      ends.flatMap((p) => ends.map((q) => {
        const end = (s) => at([0, 1, 2].map((i) => [s, p, q][(i + axis) % 3]));
        return line(end(-1), end(1), "faint");
      })));
    const points = tries.flatMap((xyz, i) => {
      const [x, y] = at(xyz), isTaken = i === tries.length - 1;
      return [
        isTaken ? arrow(center, [x, y], "path") : "",
        tinted(isTaken ? "path" : "extra", text([x, y + 5], isTaken ? "●" : "×", "middle")),
        text([x + 7, y - 5], String(i + 1)),
      ];
    });
    return picture(184, "The cube from -1 to 1, the sphere in it, and the points drawn",
      ...edges,
      circle(center, 50, "faint dash"),
      tinted("light", circle(center, 3, "filled")),
      ...points,
      text([6, 176], "● taken   × rejected: outside the sphere"));
  },
  roulette(u, survival) {
    const x = (value) => 16 + 268 * value;
    const outcome = `u = ${digits(u)}: ${u < survival ? "scatters" : "absorbed"}`;
    const part = (from, to, words, kind) => [
      bar(x(from), x(to) - x(from), kind),
      text([x((from + to) / 2), 58], to - from > 0.25 ? words : "", "middle"),
    ];
    return picture(92, `On a scale from 0 to 1, u is ${digits(u)} and P_r ${digits(survival)}`,
      ...part(0, survival, "scatters", "yes-area"),
      ...part(survival, 1, "absorbed", "no-area"),
      line([x(survival), 38], [x(survival), 70]),
      text([x(0), 84], "0", "middle"),
      text([clamp(x(survival), 60, 240), 84], `P_r = ${digits(survival)}`, "middle"),
      text([x(1), 84], "1", "middle"),
      text([clamp(x(u), 112, 188), 18], outcome, "middle strong"),
      arrow([x(u), 23], [x(u), 44], "path"));
  },
  hemisphere(r, theta, z) {
    const [a, b, size] = [[78, 84], [222, 116], 62];
    const on = [a[0] + size * r * Math.cos(theta), a[1] - size * r * Math.sin(theta)];
    const foot = [b[0] + size * r, b[1]], top = [foot[0], b[1] - size * z];
    const half = `A ${size} ${size} 0 0 1 ${b[0] + size} ${b[1]} Z`;
    return picture(172, "The point on the disk, and lifted to the hemisphere",
      circle(a, size, "box"),
      line(a, [a[0] + size, a[1]], "faint"),
      tinted("t", line(a, on), line(b, foot)),
      tinted("path", circle(on, 4, "filled")),
      text([a[0], 166], "disk from above", "middle"),
      draw("path", { d: `M ${b[0] - size} ${b[1]} ${half}`, class: "box" }),
      arrow(b, [b[0], b[1] - size - 14], "n"),
      text([b[0] - 14, b[1] - size - 6], "n"),
      tinted("path", line(foot, top, "dash")),
      arrow(b, top, "path"),
      text([b[0] + (size * r) / 2, 132], "r", "middle"),
      text([Math.min(foot[0] + 5, 288), (foot[1] + top[1]) / 2 + 4], "z"),
      text([b[0], 166], "from the side", "middle"));
  },
  offset(direction, normal, offset) {
    const cosine = dot(direction, normal), sine = Math.sqrt(Math.max(0, 1 - cosine * cosine));
    const point = [110, 112], start = [110, 62];
    return picture(150, "The surface, the point hit and the start of the new ray, magnified",
      line([20, 112], [280, 112], "ground"),
      tinted("n", line(point, start, "dash")),
      tinted("path", circle(point, 4, "box"), circle(start, 4, "filled")),
      arrow(start, [110 + 110 * sine, 62 - 60 * cosine], "path"),
      text([118, 92], offset === null ? "offset along n" : `${digits(offset)} n`),
      text([118, 128], "point hit, rounded"),
      text([20, 145], "magnified about 1,000,000 times", "soft"),
      text([20, 66], "start"));
  },
};
