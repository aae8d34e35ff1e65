// Small drawings beside the code, as SVG. Colors come from the style sheet.

const svg = (height, label, ...parts) =>
  `<svg viewBox="0 0 300 ${height}" role="img" aria-label="${label}">${parts.join("")}</svg>`;
const line = ([x1, y1], [x2, y2], kind = "") =>
  `<line x1="${x1}" y1="${y1}" x2="${x2}" y2="${y2}" class="${kind}" />`;
const circle = ([x, y], r, kind = "") => `<circle cx="${x}" cy="${y}" r="${r}" class="${kind}" />`;
const text = (words, [x, y], kind = "") =>
  `<text x="${x}" y="${y}" class="${kind}">${words}</text>`;
/** What is drawn in one color of the style sheet. */
const tinted = (color, ...parts) => `<g color="var(--${color})">${parts.join("")}</g>`;
/** An arrow with its head, which is small where the arrow is short. */
function arrow(from, to, color) {
  const way = add(to, from, -1), [ux, uy] = scale(unit(way), Math.min(4, Math.hypot(...way) / 3));
  const corner = (side) => [to[0] - 2 * ux + side * uy, to[1] - 2 * uy - side * ux];
  const points = [to, corner(1), corner(-1)].join(" ");
  return tinted(color, line(from, to), `<polygon points="${points}" class="filled" />`);
}

const diagrams = {
  cube(tries) {
    // World axes on paper: x to the right, z up, y into the paper.
    const at = ([x, y, z]) => [150 + 50 * (x + 0.38 * y), 92 - 50 * (z + 0.3 * y)];
    const center = at([0, 0, 0]), signs = [[-1, -1], [-1, 1], [1, -1], [1, 1]];
    const edges = [0, 1, 2].flatMap((axis) =>
      signs.map((pair) => {
        const end = (s) => at([...pair.slice(0, axis), s, ...pair.slice(axis)]);
        return line(end(-1), end(1), "faint");
      }));
    const points = tries.map((xyz, i) => {
      const [x, y] = at(xyz), number = text(i + 1, [x + 7, y - 5]);
      return i === tries.length - 1
        ? arrow(center, [x, y], "text") + tinted("text", text("●", [x, y + 5], "middle")) + number
        : tinted("extra", text("×", [x, y + 5], "middle")) + number;
    });
    return svg(184, "The cube from -1 to 1, the sphere in it, and the points drawn",
      ...edges,
      circle(center, 50, "faint dash"),
      tinted("light", circle(center, 3, "filled")),
      ...points,
      text("● taken   × rejected: outside the sphere", [6, 176]));
  },
  roulette(u, survival) {
    const x = (value) => 16 + 268 * value;
    const part = (from, to, words, color) =>
      `<path d="M ${x(from)} 54 H ${x(to)}" stroke="var(--${color})" stroke-width="20" />` +
      text(to - from > 0.25 ? words : "", [x((from + to) / 2), 58], "middle");
    return svg(92, `On a scale from 0 to 1, u is ${digits(u)} and P_r ${digits(survival)}`,
      part(0, survival, "scatters", "yes"),
      part(survival, 1, "absorbed", "no"),
      line([x(survival), 38], [x(survival), 70]),
      text("0", [x(0), 84], "middle"),
      text(`P_r = ${digits(survival)}`, [clamp(x(survival), 60, 240), 84], "middle"),
      text("1", [x(1), 84], "middle"),
      text(`u = ${digits(u)}: ${u < survival ? "scatters" : "absorbed"}`,
        [clamp(x(u), 112, 188), 18], "middle"),
      arrow([x(u), 23], [x(u), 44], "text"));
  },
  hemisphere(r, theta, z) {
    const [a, b, size] = [[78, 84], [222, 116], 62];
    const on = [a[0] + size * r * Math.cos(theta), a[1] - size * r * Math.sin(theta)];
    const foot = [b[0] + size * r, b[1]], top = [foot[0], b[1] - size * z];
    const half = `M ${b[0] - size} ${b[1]} A ${size} ${size} 0 0 1 ${b[0] + size} ${b[1]} Z`;
    return svg(172, "The point on the disk, and lifted to the hemisphere",
      circle(a, size, "box"),
      line(a, [a[0] + size, a[1]], "faint"),
      tinted("extra", line(a, on)),
      tinted("text", circle(on, 4, "filled")),
      text("disk from above", [a[0], 166], "middle"),
      `<path d="${half}" class="box" />`,
      tinted("extra", line(b, foot)) + tinted("text", line(foot, top, "dash")),
      arrow(b, [b[0], b[1] - size - 14], "one"),
      text("n", [b[0] - 14, b[1] - size - 6]),
      arrow(b, top, "text"),
      text("r", [b[0] + (size * r) / 2, 132], "middle"),
      text("z", [Math.min(foot[0] + 5, 288), (foot[1] + top[1]) / 2 + 4]),
      text("from the side", [b[0], 166], "middle"));
  },
  offset(direction, normal, offset) {
    const cosine = dot(direction, normal), sine = Math.sqrt(Math.max(0, 1 - cosine * cosine));
    const point = [110, 112], start = [110, 62];
    return svg(150, "The surface, the point hit and the start of the new ray, magnified",
      line([20, 112], [280, 112]),
      tinted("one", line(point, start, "dash")),
      tinted("text", circle(point, 4, "box"), circle(start, 4, "filled")),
      arrow(start, [110 + 110 * sine, 62 - 60 * cosine], "text"),
      text(offset === null ? "offset along n" : `${digits(offset)} n`, [118, 92]),
      text("point hit, rounded", [118, 128]),
      text("magnified about 1,000,000 times", [20, 145], "soft"),
      text("start", [20, 66]));
  },
};
