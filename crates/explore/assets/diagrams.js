// Small drawings beside the code, as SVG. Colors come from the style sheet.

const SVG = "http://www.w3.org/2000/svg";
function draw(tag, attributes = {}, ...children) {
  const node = document.createElementNS(SVG, tag);
  Object.entries(attributes).forEach(([name, value]) => node.setAttribute(name, value));
  node.append(...children);
  return node;
}
const picture = (width, height, label, ...children) =>
  draw(
    "svg",
    { viewBox: `0 0 ${width} ${height}`, role: "img", "aria-label": label, class: "diagram" },
    ...children,
  );
const line = ([x1, y1], [x2, y2], kind = "") => draw("line", { x1, y1, x2, y2, class: kind });
const circle = ([cx, cy], r, kind = "") => draw("circle", { cx, cy, r, class: kind });
const text = ([x, y], words, kind = "") => draw("text", { x, y, class: kind }, words);
/** An arrow with its head. */
function arrow(from, to, kind) {
  const [dx, dy] = [to[0] - from[0], to[1] - from[1]],
    long = Math.hypot(dx, dy) || 1,
    [ux, uy] = [dx / long, dy / long];
  const corner = (side) => [to[0] - 8 * ux + side * 4 * uy, to[1] - 8 * uy - side * 4 * ux].join();
  return draw(
    "g",
    { class: kind },
    line(from, to),
    draw("polygon", { points: `${to.join()} ${corner(1)} ${corner(-1)}` }),
  );
}
/** World axes on paper: x to the right, z up, y into the paper. */
const oblique =
  (center, size) =>
  ([x, y, z]) => [center[0] + size * (x + 0.38 * y), center[1] - size * (z + 0.3 * y)];

const diagrams = {
  cube(tries) {
    const at = oblique([150, 92], 50),
      corners = [-1, 1];
    const edges = corners.flatMap((p) =>
      corners.flatMap((q) =>
        [
          [
            [-1, p, q],
            [1, p, q],
          ],
          [
            [p, -1, q],
            [p, 1, q],
          ],
          [
            [p, q, -1],
            [p, q, 1],
          ],
        ].map(([a, b]) => line(at(a), at(b), "faint")),
      ),
    );
    const points = tries.map((xyz, i) => {
      const [x, y] = at(xyz),
        isTaken = i === tries.length - 1;
      return draw(
        "g",
        {},
        ...(isTaken
          ? [arrow(at([0, 0, 0]), [x, y], "path"), circle([x, y], 4, "path fill")]
          : [
              line([x - 4, y - 4], [x + 4, y + 4], "no"),
              line([x - 4, y + 4], [x + 4, y - 4], "no"),
            ]),
        text([x + 7, y - 5], String(i + 1), "small"),
      );
    });
    return picture(
      300,
      184,
      "The cube from -1 to 1, the sphere in it, and the points drawn",
      ...edges,
      circle(at([0, 0, 0]), 50, "faint dash"),
      circle(at([0, 0, 0]), 3, "light fill"),
      ...points,
      text([6, 176], "● taken   × rejected: outside the sphere", "small"),
    );
  },
  hit(cosine) {
    const point = [150, 96],
      angle = Math.acos(Math.min(Math.max(Math.abs(cosine), 0), 1)),
      side = cosine >= 0 ? 1 : -1;
    const from = [150 - 100 * Math.sin(angle), 96 - side * 84 * Math.cos(angle)];
    return picture(
      300,
      120,
      "The ray arrives at the surface, beside the normal",
      line([30, 96], [270, 96], "ground"),
      arrow(from, point, "path"),
      arrow(point, [150, 24], "n"),
      circle(point, 4, "path fill"),
      text([158, 30], "n"),
      text([190, 88], "front", "small"),
      text([190, 112], "back", "small"),
    );
  },
  path(bounce, hits) {
    const names = ["L", ...hits.slice(0, bounce).map((hit) => hit.surface)].slice(-4);
    const cut = bounce + 1 - names.length;
    const boxes = names.map((name, i) =>
      draw(
        "g",
        {},
        draw("rect", { x: 8 + 72 * i, y: 30, width: 68, height: 30, rx: 4, class: "box" }),
        text([42 + 72 * i, 49], name.length > 10 ? `${name.slice(0, 9)}…` : name, "middle small"),
      ),
    );
    return picture(
      300,
      92,
      "The elements of path",
      text([8, 20], `path${cut ? ` (the last ${names.length} of ${bounce + 1})` : ""}`, "small"),
      ...boxes,
      text(
        [8, 82],
        bounce > 0 ? `${bounce + 1} > 1: stored` : "1 is not > 1: not stored",
        bounce > 0 ? "strong yes" : "strong",
      ),
    );
  },
  roulette(u, survival) {
    const x = (value) => 16 + 268 * value,
      scatters = u < survival;
    return picture(
      300,
      104,
      `On a scale from 0 to 1, u is ${digits(u)} and P_r ${digits(survival)}`,
      draw("rect", { x: x(0), y: 44, width: 268 * survival, height: 20, class: "yes-area" }),
      draw("rect", {
        x: x(survival),
        y: 44,
        width: 268 * (1 - survival),
        height: 20,
        class: "no-area",
      }),
      line([x(survival), 38], [x(survival), 70], "strong-line"),
      text([x(survival), 84], `P_r = ${digits(survival)}`, "middle small"),
      text([x(0), 84], "0", "middle small"),
      text([x(1), 84], "1", "middle small"),
      text(
        [Math.min(Math.max(x(u), 95), 205), 18],
        `u = ${digits(u)}: ${scatters ? "scatters" : "absorbed"}`,
        "middle strong",
      ),
      arrow([x(u), 23], [x(u), 44], "path"),
      ...(survival > 0.25 ? [text([x(survival / 2), 58], "scatters", "middle small")] : []),
      ...(survival < 0.75 ? [text([x((1 + survival) / 2), 58], "absorbed", "middle small")] : []),
    );
  },
  hemisphere(r, theta, z) {
    const [a, b] = [
        [78, 84],
        [222, 116],
      ],
      size = 62,
      on = [a[0] + size * r * Math.cos(theta), a[1] - size * r * Math.sin(theta)];
    const foot = [b[0] + size * r, b[1]],
      top = [b[0] + size * r, b[1] - size * z];
    return picture(
      300,
      172,
      "The point on the disk from above, and lifted to the hemisphere from the side",
      circle(a, size, "box"),
      line(a, [a[0] + size, a[1]], "faint"),
      line(a, on, "t"),
      circle(on, 4, "path fill"),
      text([a[0], 166], "disk from above", "middle small"),
      draw("path", {
        d: `M ${b[0] - size} ${b[1]} A ${size} ${size} 0 0 1 ${b[0] + size} ${b[1]} Z`,
        class: "box",
      }),
      arrow(b, [b[0], b[1] - size - 14], "n"),
      text([b[0] - 14, b[1] - size - 6], "n"),
      line(b, foot, "t"),
      line(foot, top, "path dash"),
      arrow(b, top, "path"),
      text([b[0] + (size * r) / 2, 132], "r", "middle small"),
      text([Math.min(b[0] + size * r + 5, 288), b[1] - (size * z) / 2 + 4], "z", "small"),
      text([b[0], 166], "from the side", "middle small"),
    );
  },
  frame(t, b, n, direction, bare) {
    const at = oblique([150, 88], 62),
      center = at([0, 0, 0]);
    // An arrow along an axis has its name there.
    const isFree = (axis) => [t, b, n].every((arrow) => dot(arrow, axis) < 0.9);
    const axes = Object.entries({ x: [1, 0, 0], y: [0, 1, 0], z: [0, 0, 1] }).map(([name, axis]) =>
      draw(
        "g",
        {},
        line(center, at(axis), "faint"),
        ...(isFree(axis) ? [text([at(axis)[0] + 3, at(axis)[1]], name, "small faint-text")] : []),
      ),
    );
    const local = [dot(direction, t), dot(direction, b), dot(direction, n)];
    const short = unit(add(add(scale(t, bare * local[0]), b, bare * local[1]), n, local[2]));
    const named = Object.entries({ t, b, n }).map(([name, axis]) => {
      const [x, y] = at(axis);
      const place = [x + (x < center[0] - 20 ? -16 : 6), y + (y > center[1] ? 12 : -4)];
      return draw("g", {}, arrow(center, [x, y], name), text(place, name, "strong"));
    });
    const isUnit = Math.abs(bare - 1) < 1e-3;
    return picture(
      300,
      176,
      "The frame t, b, n in world axes, with the new direction",
      ...axes,
      ...named,
      arrow(center, at(direction), "path"),
      ...(isUnit ? [] : [draw("g", { class: "dash" }, arrow(center, at(short), "no"))]),
      text(
        [6, 170],
        isUnit
          ? "thick: the new direction"
          : "dashed: the direction if t and b were not normalized",
        "small",
      ),
    );
  },
  offset(direction, normal, offset) {
    const cosine = dot(direction, normal),
      sine = Math.sqrt(Math.max(0, 1 - cosine * cosine)),
      point = [110, 112],
      start = [110, 62];
    return picture(
      300,
      150,
      "The surface, the point hit and the start of the new ray, magnified",
      line([20, 112], [280, 112], "ground"),
      draw("g", { class: "dash" }, line(point, start, "n")),
      circle(point, 4, "path ring"),
      circle(start, 4, "path fill"),
      arrow(start, [110 + 110 * sine, 62 - 60 * cosine], "path"),
      text([118, 92], offset === null ? "offset along n" : `${digits(offset)} n`, "small"),
      text([118, 128], "point hit, rounded", "small"),
      text([20, 145], "magnified about 1,000,000 times", "small faint-text"),
      text([20, 66], "start", "small"),
    );
  },
};
