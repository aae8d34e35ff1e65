// The page: the box, and the path over it.

function showBox() {
  const points = run.faces.flatMap(({ triangles, normal, surface }) =>
    triangles.flat().map((at) => [at, [...run.surfaces[surface].diffuse_response, 1], normal]));
  view.setLayer("walls", "TRIANGLES",
    ...[0, 1, 2].map((i) => new Float32Array(points.flatMap((point) => point[i]))));
  Object.assign(view, { light: run.lights[0], dotSize: run.dotSize });
  orbit(view, (x, y) => openDot(view.pick(x, y)), (x, y) => {
    const dot = view.pick(x, y);
    if (dot >= 0) view.look({ target: run.place(dot) });
  });
  view.look(run.firstCamera);
  view.canvas.addEventListener("webglcontextlost", showPicture);
  readColors();
}

/** Shows what stands in for the box where there is no WebGL: the picture, and the path over it. */
function showPicture() {
  $("trouble").hidden = $("picture").hidden = false;
  Object.assign(view, { gl: null, camera: run.camera });
  // Of another scene, the camera of the picture is not known here.
  $("over").style.display = run.isHandout ? "" : "none";
  showDots();
}

/** The four bytes of a color of the style sheet. */
function colorOf(name, alpha = 1) {
  $("over").style.color = `var(--${name})`;
  const { color } = getComputedStyle($("over"));
  $("over").style.color = "";
  return [...color.match(/\d+/g).map(Number), 255 * alpha];
}

function readColors() {
  view.air = scale(colorOf("air").slice(0, 3), 1 / 255);
  setLines("edges", run.edges, colorOf("edge"));
  showDots();
}

function setLines(name, lines, color) {
  const points = lines.flat();
  view.setLayer(name, "LINES", new Float32Array(points.flat()),
    new Uint8Array(points.flatMap(() => color)));
}

/** Draws the path over the box: lines and texts, each of a kind that the style sheet knows. */
function showPath() {
  const { step, photon, story: { hits, light, direction, ending } } = page;
  const reached = step.name === "emission" ? 0 : step.bounce + 1;
  const points = [light, ...hits.map(({ position }) => position)];
  if (ending === "miss")
    points.push(add(points.at(-1), hits.at(-1)?.direction ?? direction, run.size * 0.4));
  const lines = points.slice(1).map((b, i) =>
    ({ kind: i < reached ? "leg" : "leg ahead", line: [points[i], b] }));
  const marks = hits.map(({ position, stored }, i) =>
    ({ kind: i < reached ? "mark" : "mark ahead", text: stored ? "●" : "○", at: position }));
  marks.push(...run.lights.map((at) => ({ kind: "mark light", text: "◆", at })));
  run.movedIndex.forEach((dot, k) => {
    if (run.dots.photon[dot] === photon)
      lines.push({ kind: "moved", line: [run.place(dot), run.place(run.stored + k)] });
  });
  const other = isDivergence() && run.comparison.other;
  if (other) {
    const from = points[step.name === "stored" ? step.bounce : reached];
    lines.push({ kind: "extra dash", line: [from, other] });
    marks.push({ kind: "mark extra", text: "×", at: other });
  }
  lines.push(...linesOf(step.name, page.story, hits[step.bounce]));
  const label = (text, at, down) => ({ kind: "label", text, at, down });
  page.over = [
    ...lines, ...marks, label("light", light, -14),
    ...lines.filter(({ name }) => name).map(({ name, line }) => label(name, line[1], -6)),
    ...hits.map(({ stored, bounce, position }) =>
      label(stored ? `${bounce}` : "0, not stored", position, 14)),
  ];
  $("over").innerHTML = page.over.map(({ kind, text }) =>
    text ? `<text class="${kind}">${text}</text>` : `<path class="${kind}" />`).join("");
  view.draw();
}

/** What a step draws at its hit, or at the light. */
function linesOf(step, { light, direction: emitted }, hit) {
  const arrow = (from, way, kind, name) =>
    ({ kind, name, line: [from, add(from, way, run.size * 0.13)] });
  if (step === "emission") return [arrow(light, emitted, "leg")];
  if (!hit) return [];
  const { position, direction, face: { normal, tangent, bitangent } } = hit;
  const n = arrow(position, normal, "n", "n");
  if (step === "hit") return [n];
  if (!["hemisphere", "frame", "ray"].includes(step)) return [];
  const lines = [n, arrow(position, scale(direction, 1.5), "leg")];
  // The orange line is longer than the true one, so that it is in sight behind it.
  if (step === "frame")
    lines.unshift(arrow(position, scale(bareWay(hit), isUnit(hit.face) ? 0 : 1.95), "extra dash"),
      arrow(position, tangent, "t", "t"), arrow(position, bitangent, "b", "b"));
  return lines;
}

/** Puts everything over the box in its place, each label below those before it that stand there. */
function placePath() {
  const { clientWidth: width, clientHeight: height } = view.canvas, placed = [];
  for (const [i, { line, at, down }] of page.over.entries()) {
    const node = $("over").children[i];
    if (line) {
      node.setAttribute("d", view.outline(line).map(([a, b]) => `M${a}L${b}`).join(""));
      continue;
    }
    let [left, top] = view.project(at) ?? [-1, -1];
    const isOut = left < 0 || top < 0 || left > width || top > height;
    node.style.display = isOut ? "none" : "";
    if (down && !isOut) {
      const { width: wide, height: high } = node.getBBox();
      left = Math.min(left + 8, width - wide - 2);
      top += down;
      const isCovered = (other) =>
        left < other.left + other.wide && other.left < left + wide &&
        Math.abs(top - other.top) < high;
      for (let other; (other = placed.find(isCovered)); ) top = other.top + high + 1;
      placed.push({ left, top, wide });
    }
    node.setAttribute("transform", `translate(${left} ${top})`);
  }
}

/** Brings the open photon's hit to the middle. */
function center() {
  const { step: { name, bounce }, story: { light, hits } } = page;
  const hit = name === "emission" ? null : hits[Math.min(bounce, hits.length - 1)];
  view.look({ target: hit?.position ?? light, distance: run.size * 0.9 });
}
