// The page: the box, and the path over it.

function showBox() {
  const column = (type, value) => new type(run.faces.flatMap((face) =>
    face.triangles.flat().flatMap((corner) => value(face, corner))));
  const color = ({ surface }) => [...scale(run.surfaces[surface].diffuse_response, 255), 255];
  view.setLayer("walls", "TRIANGLES", column(Float32Array, (_, corner) => corner),
    column(Uint8Array, color), column(Int8Array, (face) => scale(face.normal, 127)));
  Object.assign(view, { light: run.lights[0], dotSize: run.dotSize });
  orbit(view, (x, y) => openDot(view.pick(x, y)), (x, y) => {
    const dot = view.pick(x, y);
    if (dot >= 0) view.look({ target: run.place(dot) });
  });
  view.look(run.firstCamera);
  view.canvas.addEventListener("webglcontextlost", showPicture);
  showDots();
}

/** Shows what stands in for the box where there is no WebGL: the picture, and the path over it. */
function showPicture() {
  $("trouble").hidden = $("picture").hidden = false;
  Object.assign(view, { gl: null, camera: run.pictureCamera });
  showDots();
}

/** The four bytes of a color of the style sheet. */
function colorOf(name, alpha = 1) {
  $("over").style.color = `var(--${name})`;
  const { color } = getComputedStyle($("over"));
  $("over").style.color = "";
  return [...color.match(/\d+/g).map(Number), 255 * alpha];
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
  const way = hits.at(-1)?.direction ?? direction;
  if (ending === "miss") points.push(add(points.at(-1), way, run.size * 0.4));
  page.over = [];
  const put = (kind, text, ...at) => page.over.push({ kind, text, at });
  points.slice(1).forEach((b, i) => put(i < reached ? "leg" : "leg ahead", "", points[i], b));
  run.movedIndex.forEach((dot, k) => {
    if (run.dotPhoton[dot] === photon) put("moved", "", run.place(dot), run.place(run.stored + k));
  });
  const other = isDivergence() && run.comparison.other;
  if (other) {
    put("extra dash", "", points[step.name === "stored" ? step.bounce : reached], other);
    put("mark extra", "×", other);
  }
  for (const [kind, from, way] of arrowsOf(step.name, page.story, hits[step.bounce])) {
    const tip = add(from, way, run.size * 0.13);
    put(kind, "", from, tip);
    if (kind.length === 1) put("label", kind, tip);
  }
  for (const at of run.lights) put("mark light", "◆", at);
  put("label", "light", light);
  for (const { stored, bounce, position } of hits) {
    put(bounce < reached ? "mark" : "mark ahead", stored ? "●" : "○", position);
    put("label", stored ? bounce : "0, not stored", position);
  }
  $("over").innerHTML = page.over.map(({ kind, text }) =>
    text === "" ? `<path class="${kind}" />` : `<text class="${kind}">${text}</text>`).join("");
  view.draw();
}

/** The arrows of a step: a kind, the start and the way. Those of one letter have it at their tip. */
function arrowsOf(step, { light, direction: emitted }, hit) {
  if (step === "emission") return [["leg", light, emitted]];
  if (!hit || ["stored", "roulette"].includes(step)) return [];
  const { position, direction, face: { normal, tangent, bitangent } } = hit;
  const arrows = [["n", position, normal]];
  if (step !== "hit") arrows.push(["leg", position, scale(direction, 1.5)]);
  // The orange line is longer than the true one, so that it is in sight behind it.
  if (step === "frame")
    arrows.unshift(["extra dash", position, scale(bareWay(hit), isUnit(hit.face) ? 0 : 1.95)],
      ["t", position, tangent], ["b", position, bitangent]);
  return arrows;
}

/** Puts everything over the box in its place, each label below those before it that stand there. */
function placePath() {
  const { clientWidth: width, clientHeight: height } = view.canvas, placed = [];
  for (const [i, { kind, at }] of page.over.entries()) {
    const node = $("over").children[i];
    if (at.length > 1) {
      node.setAttribute("d", view.outline(at).map(([a, b]) => `M${a}L${b}`).join(""));
      continue;
    }
    let [left, top] = view.project(at[0]) ?? [-1, -1];
    const isOut = left < 0 || top < 0 || left > width || top > height;
    node.style.display = isOut ? "none" : "";
    if (kind === "label" && !isOut) {
      const { width: wide, height: high } = node.getBBox();
      left = Math.min(left + 8, width - wide - 2);
      top += 13;
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
