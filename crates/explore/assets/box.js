// The page: the box, and the path in it.

function showBox() {
  const column = (value) =>
    [new Float32Array(run.faces.flatMap((face) =>
      face.triangles.flat().flatMap((corner) => value(face, corner)))), 3];
  view.setLayer("surfaces", "surfaces", [
    column((_, corner) => corner),
    column((face) => face.normal),
    column((face) => run.surfaces[face.surface].diffuse),
  ]);
  view.light = run.lights[0];
  view.dotSize = run.dotSize;
  orbit(view, (x, y) => openDot(view.pick(x, y)), (x, y) => {
    const dot = view.pick(x, y);
    if (dot >= 0) view.look({ target: run.place(dot) });
  });
  view.look({ ...run.firstCamera, size: run.size });
  readColors();
  view.canvas.addEventListener("webglcontextlost", () => {
    view = null;
    showPicture();
  });
}

/** What stands in for the box where there is no WebGL. */
function showPicture() {
  $("trouble").hidden = $("picture").hidden = false;
  $("view").hidden = true;
  showDots();
}

function readColors() {
  if (!view) return;
  const probe = $("labels");
  const color = (name) => {
    probe.style.color = `var(--${name})`;
    return getComputedStyle(probe).color.match(/\d+/g).map((byte) => byte / 255);
  };
  Object.assign(view, { palette: COLORS.map(color), air: color("air") });
  probe.style.color = "";
  view.setLines("edges", run.edges.map(([a, b]) => ({ a, b, color: "edge", width: 1 })));
  showDots();
  showStep();
}

function drawPath(step) {
  if (!view) return;
  const { hits, light, direction, ending } = page.story, { comparison, size } = run;
  const isEmission = step.name === "emission", reached = isEmission ? -1 : step.bounce;
  const points = [light, ...hits.map((hit) => hit.position)];
  const lines = [];
  // What is still to come is thin and dashed.
  const leg = (a, b, isReached) =>
    lines.push({ a, b, color: "text", ...(isReached ? { width: 3 } : { dash: 7, alpha: 0.6 }) });
  points.slice(1).forEach((b, i) => leg(points[i], b, i <= reached));
  if (ending === "miss") {
    const way = hits.at(-1)?.direction ?? direction;
    leg(points.at(-1), add(points.at(-1), way, size * 0.4), reached >= hits.length);
  }
  if (isEmission) leg(light, add(light, direction, size * 0.2), true);
  const marks = hits.map(({ position: at, stored }, i) =>
    ({ at, color: i <= reached ? "text" : "gray", shape: stored ? "circle" : "ring" }));
  const other = isDivergence(step) && comparison.other;
  if (other) {
    const from = points[step.bounce + (isEmission || step.name === "stored" ? 0 : 1)];
    lines.push({ a: from, b: other, color: "extra", width: 3, dash: 9 });
    marks.push({ at: other, color: "extra", shape: "cross" });
  }
  marks.push(...run.lights.map((at) => ({ at, color: "light", shape: "diamond" })));
  if (hits[step.bounce]) lines.push(...linesOf(step.name, hits[step.bounce]));
  view.setLines("path", lines);
  view.setMarks(marks);
  const label = (words, point, down) => Object.assign(make("span", {}, words), { point, down });
  $("labels").replaceChildren(
    label("light", light, -20),
    ...lines.filter(({ name }) => name).map(({ name, b }) => label(name, b, -12)),
    ...hits.map(({ stored, bounce, position }) =>
      label(stored ? String(bounce) : "0, not stored", position, 6)));
  placeLabels();
}

/** What a step draws at its hit. Lines with a `name` have it at their end. */
function linesOf(name, hit) {
  const { position, direction, face: { normal, tangent, bitangent }, u1 } = hit;
  const arrow = (axis, color, more) =>
    ({ a: position, b: add(position, axis, run.size * 0.13), color, width: 3, ...more });
  const n = arrow(normal, "one", { name: "n" });
  if (name === "hit") return [n];
  if (!direction) return [];
  const ray = arrow(scale(direction, 1.5), "text");
  const flat = add(direction, normal, -Math.sqrt(1 - u1));
  const disk = (angle) => add(scale(tangent, Math.cos(angle)), bitangent, Math.sin(angle));
  return {
    hemisphere: () => [
      n, arrow(flat, "extra", { name: "r" }), arrow(direction, "text"),
      { ...arrow(direction, "text"), a: arrow(flat).b, width: 1.5, dash: 6 },
      ...Array.from({ length: 32 }, (_, i) => (Math.PI * i) / 16).map((angle) =>
        ({ a: arrow(disk(angle)).b, b: arrow(disk(angle + Math.PI / 16)).b, color: "text" })),
    ],
    frame: () => [
      // Longer than the true one, so that it is in sight behind it.
      ...(isUnit(hit.face) ? [] : [arrow(scale(bareWay(hit), 1.95), "extra", { dash: 7 })]),
      arrow(tangent, "extra", { name: "t" }), arrow(bitangent, "three", { name: "b" }), n, ray,
    ],
    ray: () => [ray, n],
  }[name]?.() ?? [];
}

/** Puts each label at its point, below those before it that stand there. */
function placeLabels() {
  const { clientWidth: width, clientHeight: height } = $("view");
  const placed = [];
  for (const label of $("labels").children) {
    const [x, y] = view?.project(label.point) ?? [-1, -1];
    label.hidden = x < 0 || y < 0 || x > width || y > height;
    if (label.hidden) continue;
    const [wide, high] = [label.offsetWidth, label.offsetHeight];
    const left = Math.min(x + 8, width - wide - 2);
    let top = y + label.down;
    const isCovered = (other) =>
      left < other.left + other.wide && other.left < left + wide &&
      Math.abs(top - other.top) < high;
    for (let other; (other = placed.find(isCovered)); ) top = other.top + high + 1;
    placed.push({ left, top, wide });
    label.style.transform = `translate(${left}px, ${top}px)`;
  }
}

/** Brings the open photon's hit to the middle. */
function center() {
  const { light, hits } = page.story, { name, bounce } = page.steps[page.at];
  const hit = name === "emission" ? null : hits[Math.min(bounce, hits.length - 1)];
  view?.look({ target: hit?.position ?? light, distance: run.size * 0.9 });
}
