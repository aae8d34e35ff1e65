// Small drawings beside the code, as SVG. Colors come from the style sheet.

function draw(tag, attributes = {}, ...children) {
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
const bar = (x, y, width, height, kind) => draw("rect", { x, y, width, height, class: kind });
const group = (kind, ...children) => draw("g", { class: kind }, ...children);
/** An arrow with its head, which is small where the arrow is short. */
function arrow(from, to, kind) {
  const way = [to[0] - from[0], to[1] - from[1], 0];
  const [ux, uy] = scale(unit(way), Math.min(4, Math.hypot(...way) / 3));
  const corner = (side) => [to[0] - 2 * ux + side * uy, to[1] - 2 * uy - side * ux].join();
  const points = `${to.join()} ${corner(1)} ${corner(-1)}`;
  return group(kind, line(from, to), draw("polygon", { points }));
}
/** World axes on paper: x to the right, z up, y into the paper. */
const oblique = (center, size) => ([x, y, z]) =>
  [center[0] + size * (x + 0.38 * y), center[1] - size * (z + 0.3 * y)];

const diagrams = {
  cube(tries) {
    const at = oblique([150, 92], 50), ends = [-1, 1];
    const edges = [0, 1, 2].flatMap((axis) =>
      ends.flatMap((p) => ends.map((q) => {
        const end = (s) => at([0, 1, 2].map((i) => [s, p, q][(i + axis) % 3]));
        return line(end(-1), end(1), "faint");
      })));
    const points = tries.map((xyz, i) => {
      const [x, y] = at(xyz);
      const number = text([x + 7, y - 5], String(i + 1), "small");
      if (i === tries.length - 1) {
        const way = arrow(at([0, 0, 0]), [x, y], "path");
        return group("", way, circle([x, y], 4, "path fill"), number);
      }
      const stroke = (side) => line([x - 4, y - 4 * side], [x + 4, y + 4 * side], "no");
      return group("", stroke(1), stroke(-1), number);
    });
    return picture(184, "The cube from -1 to 1, the sphere in it, and the points drawn",
      ...edges,
      circle(at([0, 0, 0]), 50, "faint dash"),
      circle(at([0, 0, 0]), 3, "light fill"),
      ...points,
      text([6, 176], "● taken   × rejected: outside the sphere", "small"));
  },
  hit(cosine) {
    const angle = Math.acos(clamp(Math.abs(cosine), 0, 1)), side = cosine >= 0 ? 1 : -1;
    const from = [150 - 100 * Math.sin(angle), 96 - side * 84 * Math.cos(angle)];
    return picture(side > 0 ? 120 : 190, "The ray arrives at the surface, beside the normal",
      line([30, 96], [270, 96], "ground"),
      arrow(from, [150, 96], "path"),
      arrow([150, 96], [150, 24], "n"),
      circle([150, 96], 4, "path fill"),
      text([158, 30], "n"),
      text([190, 88], "front", "small"),
      text([190, 112], "back", "small"));
  },
  path(bounce, hits) {
    const names = ["L", ...hits.slice(0, bounce).map((hit) => hit.surface)].slice(-4);
    const boxes = names.map((name, i) => {
      const short = name.length > 10 ? `${name.slice(0, 9)}…` : name;
      return group("", bar(8 + 72 * i, 30, 68, 30, "box"),
        text([42 + 72 * i, 49], short, "middle small"));
    });
    const count = bounce + 1;
    const cut = count > names.length ? ` (the last ${names.length} of ${count})` : "";
    return picture(92, "The elements of path",
      text([8, 20], `path${cut}`, "small"),
      ...boxes,
      text([8, 82], bounce > 0 ? `${count} > 1: stored` : "1 is not > 1: not stored", "strong"));
  },
  roulette(u, survival) {
    const x = (value) => 16 + 268 * value, [wide, rest] = [268 * survival, 268 * (1 - survival)];
    const outcome = `u = ${digits(u)}: ${u < survival ? "scatters" : "absorbed"}`;
    const inBar = (from, to, words) =>
      to - from > 0.25 ? [text([x((from + to) / 2), 58], words, "middle small")] : [];
    return picture(92, `On a scale from 0 to 1, u is ${digits(u)} and P_r ${digits(survival)}`,
      bar(x(0), 44, wide, 20, "yes-area"),
      bar(x(survival), 44, rest, 20, "no-area"),
      line([x(survival), 38], [x(survival), 70], "strong-line"),
      text([x(0), 84], "0", "middle small"),
      text([clamp(x(survival), 60, 240), 84], `P_r = ${digits(survival)}`, "middle small"),
      text([x(1), 84], "1", "middle small"),
      text([clamp(x(u), 112, 188), 18], outcome, "middle strong"),
      arrow([x(u), 23], [x(u), 44], "path"),
      ...inBar(0, survival, "scatters"),
      ...inBar(survival, 1, "absorbed"));
  },
  hemisphere(r, theta, z) {
    const [a, b, size] = [[78, 84], [222, 116], 62];
    const on = [a[0] + size * r * Math.cos(theta), a[1] - size * r * Math.sin(theta)];
    const foot = [b[0] + size * r, b[1]], top = [foot[0], b[1] - size * z];
    const half = `A ${size} ${size} 0 0 1 ${b[0] + size} ${b[1]} Z`;
    return picture(172, "The point on the disk, and lifted to the hemisphere",
      circle(a, size, "box"),
      line(a, [a[0] + size, a[1]], "faint"),
      line(a, on, "t"),
      circle(on, 4, "path fill"),
      text([a[0], 166], "disk from above", "middle small"),
      draw("path", { d: `M ${b[0] - size} ${b[1]} ${half}`, class: "box" }),
      arrow(b, [b[0], b[1] - size - 14], "n"),
      text([b[0] - 14, b[1] - size - 6], "n"),
      line(b, foot, "t"),
      line(foot, top, "path dash"),
      arrow(b, top, "path"),
      text([b[0] + (size * r) / 2, 132], "r", "middle small"),
      text([Math.min(foot[0] + 5, 288), (foot[1] + top[1]) / 2 + 4], "z", "small"),
      text([b[0], 166], "from the side", "middle small"));
  },
  frame(t, b, n, direction, bare) {
    const at = oblique([150, 82], 62), center = at([0, 0, 0]);
    // An arrow along an axis has its name there.
    const isFree = (axis) => [t, b, n].every((arrow) => dot(arrow, axis) < 0.9);
    const axes = ["x", "y", "z"].map((name, i) => {
      const axis = [0, 1, 2].map((k) => (k === i ? 1 : 0)), [x, y] = at(axis);
      return group("", line(center, [x, y], "faint"),
        text([x + 3, y], isFree(axis) ? name : "", "small faint-text"));
    });
    const named = Object.entries({ t, b, n }).map(([name, axis]) => {
      const [x, y] = at(axis);
      const place = [x + (x < center[0] - 20 ? -16 : 6), y + (y > center[1] ? 12 : -4)];
      return group("", arrow(center, [x, y], name), text(place, name, "strong"));
    });
    const [x, y, z] = [t, b, n].map((axis) => dot(direction, axis));
    // Longer than the others, so that it is in sight behind the new direction.
    const other = scale(unit(add(add(scale(t, bare * x), b, bare * y), n, z)), 1.35);
    return picture(184, "The frame t, b, n in world axes, with the new direction",
      ...axes,
      ...(isUnit(bare) ? [] : [group("dash", arrow(center, at(other), "no"))]),
      ...named,
      arrow(center, at(direction), "path"),
      text([6, 178], isUnit(bare)
        ? "thick: the new direction"
        : "dashed: if t and b were not normalized", "small"));
  },
  offset(direction, normal, offset) {
    const cosine = dot(direction, normal), sine = Math.sqrt(Math.max(0, 1 - cosine * cosine));
    const point = [110, 112], start = [110, 62];
    return picture(150, "The surface, the point hit and the start of the new ray, magnified",
      line([20, 112], [280, 112], "ground"),
      group("dash", line(point, start, "n")),
      circle(point, 4, "path ring"),
      circle(start, 4, "path fill"),
      arrow(start, [110 + 110 * sine, 62 - 60 * cosine], "path"),
      text([118, 92], offset === null ? "offset along n" : `${digits(offset)} n`, "small"),
      text([118, 128], "point hit, rounded", "small"),
      text([20, 145], "magnified about 1,000,000 times", "small faint-text"),
      text([20, 66], "start", "small"));
  },
};
