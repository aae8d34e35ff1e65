// The page: the box, and the path over it.

function showBox() {
  const { wallPosition, wallColor, wallNormal, lights, dotSize, firstCamera } = run;
  view.setLayer("walls", "TRIANGLES", wallPosition, wallColor, wallNormal);
  Object.assign(view, { light: lights[0], dotSize });
  view.look(firstCamera);
  view.canvas.addEventListener("webglcontextlost", showPicture);
  orbit();
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

function setLines(name, ends, color) {
  const colors = Uint8Array.from({ length: (4 * ends.length) / 3 }, (_, i) => color[i % 4]);
  view.setLayer(name, "LINES", ends, colors);
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
  // Labels stand over all else.
  page.over.sort((a, b) => (a.kind === "label") - (b.kind === "label"));
  $("over").innerHTML = page.over.map(({ kind, text }) =>
    text === "" ? `<path class="${kind}" />` : `<text class="${kind}">${text}</text>`).join("");
  view.draw();
}

/** The arrows of a step: kind, start and way. Those of one letter have it at their tip. */
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
  for (const [i, entry] of page.over.entries()) {
    const { kind, at } = entry, node = $("over").children[i];
    if (at.length > 1) {
      node.setAttribute("d", view.outline(at).map(([a, b]) => `M${a}L${b}`).join(""));
      continue;
    }
    let [left, top] = view.project(at[0]) ?? [-1, -1];
    const isOut = left < 0 || top < 0 || left > width || top > height;
    node.style.display = isOut ? "none" : "";
    if (kind === "label" && !isOut) {
      const { width: wide, height: high } = (entry.box ??= node.getBBox());
      left = Math.min(left + 8, width - wide - 2);
      top += 13;
      const isCovered = (other) =>
        left < other.left + other.wide + 6 && other.left < left + wide + 6 &&
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

/** Lets pointers and the wheel turn the box. A click opens a dot, and a double-click centers it. */
function orbit() {
  const { canvas } = view;
  /** The last place of each finger, or of the mouse. */
  const fingers = new Map();
  let moved = 0;
  const spread = () => {
    const [a, b] = fingers.values();
    return Math.hypot(a.x - b.x, a.y - b.y);
  };
  canvas.onpointerdown = ({ pointerId, x, y }) => {
    canvas.setPointerCapture(pointerId);
    if (fingers.size === 0) moved = 0;
    fingers.set(pointerId, { x, y });
  };
  canvas.onpointermove = ({ pointerId, x, y }) => {
    const last = fingers.get(pointerId);
    if (!last) return;
    const before = fingers.size > 1 && spread();
    fingers.set(pointerId, { x, y });
    moved += Math.abs(x - last.x) + Math.abs(y - last.y);
    if (before) view.move(0, 0, before / spread());
    else view.move((x - last.x) * 0.006, (y - last.y) * 0.006);
  };
  canvas.onpointerup = canvas.onpointercancel = ({ pointerId }) => fingers.delete(pointerId);
  canvas.onclick = ({ offsetX, offsetY }) => moved > 6 || openDot(view.pick(offsetX, offsetY));
  canvas.ondblclick = ({ offsetX, offsetY }) => {
    const dot = view.pick(offsetX, offsetY);
    if (dot >= 0) view.look({ target: run.place(dot) });
  };
  canvas.onwheel = (event) => {
    event.preventDefault();
    view.move(0, 0, Math.exp(event.deltaY * 0.0012));
  };
}
