// The page: the box, and the path in it.

const boxMethods = {
  showBox() {
    const { run, view } = this;
    const corners = (triangle) => [0, 3, 6].map((i) => triangle.slice(i, i + 3));
    const column = (value) =>
      [new Float32Array(run.faces.flatMap((face) =>
        face.triangles.flatMap(corners).flatMap((corner) => value(face, corner)))), 3];
    const places = column((_, corner) => corner);
    view.setLayer("surfaces", "surfaces", places[0].length / 3, [
      places, column((face) => face.normal), column((face) => run.surfaces[face.surface].diffuse),
    ]);
    view.light = run.lights[0].position;
    view.dotSize = run.dotSize;
    // The outline of a face: those edges of its triangles that no other of them has.
    this.outline = run.faces.flatMap((face) => {
      const edges = new Map();
      for (const triangle of face.triangles)
        corners(triangle).forEach((a, i, all) => {
          const b = all[(i + 1) % 3];
          const key = [a.join(), b.join()].sort().join();
          if (!edges.delete(key)) edges.set(key, { a, b, color: "edge", width: 1 });
        });
      return [...edges.values()];
    });
    this.mouse = orbit(view, (x, y) => this.openDot(view.pick(x, y)), (x, y) => {
      const dot = view.pick(x, y);
      if (dot >= 0) view.look({ target: run.place(dot) });
    });
    view.look({ ...run.camera, size: run.size });
    // From a little farther off than the handout's camera, so that the light is in sight.
    if (run.isHandout) {
      const { target, distance } = run.camera;
      const [yaw, pitch] = [0.3, -0.16];
      view.look({ target: add(target, [0, 0, 0.2]), distance: 1.3 * distance, yaw, pitch });
    }
    this.readColors();
    view.canvas.addEventListener("webglcontextlost", () => {
      this.view = null;
      this.showPicture();
    });
  },

  /** What stands in for the box where there is no WebGL. */
  showPicture() {
    const whose = this.run.comparison ? "the reference's picture" : "the picture";
    $("trouble").textContent =
      `This browser has no WebGL2, so you see ${whose} instead of the box. ` +
      "The table and the stories work.";
    $("picture").src = this.run.picture;
    $("trouble").hidden = $("picture").hidden = false;
    $("view").hidden = true;
    this.showDots();
  },

  readColors() {
    const { view } = this;
    if (!view) return;
    const style = getComputedStyle(document.documentElement);
    const value = (name) => style.getPropertyValue(`--${name}`).trim();
    const color = (name) =>
      value(name).match(/[0-9a-f]{2}/gi).map((byte) => parseInt(byte, 16) / 255);
    Object.assign(view, { palette: COLORS.map(color), air: color("air"), wash: +value("wash") });
    view.setLines("edges", this.outline);
    this.showDots();
    this.showStep();
  },

  drawPath(step) {
    const { view, story, run } = this;
    if (!view?.palette) return;
    const { hits, light, direction } = story;
    const isEmission = step.name === "emission", reached = isEmission ? -1 : step.bounce;
    const points = [light.position, ...hits.map((hit) => hit.position)];
    const lines = [];
    // What is still to come is thin and dashed.
    const leg = (a, b, isReached) =>
      lines.push({ a, b, color: "path", ...(isReached ? { width: 3 } : { dash: 7, alpha: 0.6 }) });
    points.slice(1).forEach((b, i) => leg(points[i], b, i <= reached));
    if (story.ending === "left_the_scene") {
      const way = hits.at(-1)?.direction ?? direction;
      leg(points.at(-1), add(points.at(-1), way, run.size * 0.4), reached >= hits.length);
    }
    const marks = hits.map(({ position: at, stored }, i) =>
      ({ at, color: i <= reached ? "path" : "gray", shape: stored ? "circle" : "ring" }));
    if (isEmission) leg(light.position, add(light.position, direction, run.size * 0.2), true);
    const other = this.isDivergence(step) && run.comparison.other;
    if (other) {
      const from = points[step.bounce + (isEmission || step.name === "stored" ? 0 : 1)];
      lines.push({ a: from, b: other, color: "extra", width: 3, dash: 9 });
      marks.push({ at: other, color: "extra", shape: "cross" });
    }
    for (const { position: at } of run.lights) marks.push({ at, color: "light", shape: "diamond" });
    lines.push(...(step.lines ?? []));
    view.setLines("path", lines);
    view.setMarks(marks);
    const label = (words, point, down) =>
      Object.assign(make("span", {}, words), { point, down });
    $("labels").replaceChildren(
      label("light", light.position, -20),
      ...lines.filter(({ name }) => name).map(({ name, b }) => label(name, b, -12)),
      ...hits.map(({ stored, bounce, position }) =>
        label(stored ? String(bounce) : "0, not stored", position, 6)));
    this.placeLabels();
  },

  /** Puts each label at its point, below those before it that stand there. */
  placeLabels() {
    const { clientWidth: width, clientHeight: height } = $("view");
    const placed = [];
    for (const label of $("labels").children) {
      const [x, y] = this.view?.project(label.point) ?? [-1, -1];
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
  },

  center() {
    const { light, hits } = this.story, { name, bounce } = this.steps[this.at];
    const hit = name === "emission" ? light : hits[Math.min(bounce, hits.length - 1)] ?? light;
    this.view?.look({ target: hit.position, distance: this.run.size * 0.9 });
  },
};
