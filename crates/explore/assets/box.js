// The page: the box, the path in it, and the flight of the camera.

const boxMethods = {
  showBox() {
    const { run, view } = this;
    const corners = (triangle) => [0, 3, 6].map((i) => triangle.slice(i, i + 3));
    const ofCorners = (value) =>
      new Float32Array(run.faces.flatMap((face) =>
        face.triangles.flatMap((triangle) =>
          corners(triangle).flatMap((corner) => value(face, corner)))));
    const places = ofCorners((_, corner) => corner);
    view.light = run.lights[0].position;
    view.dotSize = run.dotSize;
    view.faces = run.faces.map(({ normal, triangles: [first] }) => ({
      normal, at: first.slice(0, 3),
    }));
    // What a submission stores may lie anywhere, also on no face.
    this.faceOf = new Uint16Array(this.count).fill(run.faces.length);
    for (let i = 0; i < run.stored; i++)
      this.faceOf[i] = run.sections.hit_face[run.firstHit[run.pathOf[i]] + run.bounceOf[i]];
    view.setLayer("surfaces", places.length / 3, [
      [places, 3],
      [ofCorners((face) => face.normal), 3],
      [ofCorners((face) => run.surfaces[face.surface].diffuse), 3],
    ]);
    // The outline of a face: those edges of its triangles that no other of them has.
    this.outline = run.faces.flatMap((face) => {
      const edges = new Map();
      for (const triangle of face.triangles)
        corners(triangle).forEach((a, i, all) => {
          const b = all[(i + 1) % 3];
          const key = [a.join(), b.join()].sort().join();
          if (edges.has(key)) edges.delete(key);
          else edges.set(key, { a, b, color: "edge", width: 1 });
        });
      return [...edges.values()];
    });
    const center = (x, y) => {
      const index = view.pick(x, y);
      if (index >= 0) this.moveCamera({ target: this.place(index) });
    };
    this.mouse = orbit(view, (x, y) => this.openDot(view.pick(x, y)), center);
    view.look({ ...run.camera, size: run.size });
    // From a little farther off than the handout's camera, so that the light is in sight.
    if (run.isHandout) {
      const { target, distance } = run.camera;
      view.look({
        target: add(target, [0, 0, 0.2]), distance: 1.3 * distance, yaw: 0.3, pitch: -0.16,
      });
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
    document.body.classList.add("flat");
    this.showDots();
  },

  readColors() {
    const { view } = this;
    if (!view) return;
    const style = getComputedStyle(document.documentElement);
    const value = (name) => style.getPropertyValue(`--${name}`).trim();
    const color = (name) =>
      value(name).match(/[0-9a-f]{2}/gi).map((byte) => parseInt(byte, 16) / 255);
    view.palette = COLORS.map(color);
    view.air = color("air");
    view.wash = Number(value("wash"));
    view.setLines("edges", this.outline);
    this.showDots();
    this.showStep();
  },

  drawPath(step) {
    const { view, story, run } = this;
    if (!view?.palette) return;
    const { hits, light, ending } = story;
    const isEmission = step.name === "emission";
    const reached = isEmission ? -1 : step.bounce;
    const points = [light.position, ...hits.map((hit) => hit.position)];
    const lines = [];
    // What is still to come is thin and dashed.
    const leg = (a, b, isReached) =>
      lines.push({
        a, b, color: "path", width: isReached ? 3 : 1.5, dash: isReached ? 0 : 7,
        alpha: isReached ? 1 : 0.6,
      });
    points.slice(1).forEach((b, i) => leg(points[i], b, i <= reached));
    if (ending === "left_the_scene") {
      const way = hits.at(-1)?.direction ?? story.direction;
      leg(points.at(-1), add(points.at(-1), way, run.size * 0.4), reached >= hits.length);
    }
    const marks = hits.map((hit, i) => ({
      at: hit.position,
      color: i <= reached ? "path" : "gray",
      shape: hit.stored ? "circle" : "ring",
    }));
    if (isEmission) {
      leg(light.position, add(light.position, story.direction, run.size * 0.2), true);
      // The cube of the draws, small, around the light.
      story.tries.forEach((xyz, i) => {
        const isTaken = i + 1 === story.tries.length;
        const [color, shape] = isTaken ? ["path", "circle"] : ["extra", "cross"];
        marks.push({ at: add(light.position, xyz, run.size * 0.12), color, shape });
      });
    }
    const other = this.isDivergence(step) && run.comparison.other;
    if (other) {
      const from = points[step.bounce + (isEmission || step.name === "stored" ? 0 : 1)];
      lines.push({ a: from, b: other, color: "extra", width: 3, dash: 9 });
      marks.push({ at: other, color: "extra", shape: "cross" });
    }
    for (const { position } of run.lights)
      marks.push({ at: position, color: "light", shape: "diamond" });
    view.setLines("path", [...lines, ...(step.lines ?? [])]);
    view.setMarks(marks);
    const name = (hit) => (hit.stored ? String(hit.bounce) : "0, not stored");
    this.labels = [
      ["light", light.position, -20],
      ...(step.labels ?? []).map((label) => [...label, -12]),
      ...hits.map((hit) => [name(hit), hit.position, 6]),
    ];
    const words = this.labels.map(([words]) => make("span", { textContent: words }));
    $("labels").replaceChildren(...words);
    this.placeLabels();
  },

  /** Puts each label at its point, below those before it that stand there. */
  placeLabels() {
    const { view } = this;
    const placed = [];
    [...$("labels").children].forEach((label, i) => {
      const [, point, down] = this.labels[i];
      const { clientWidth: width, clientHeight: height } = view?.canvas ?? {};
      const [x, y] = view?.project(point) ?? [-1, -1];
      label.hidden = x < 0 || y < 0 || x > width || y > height;
      if (label.hidden) return;
      const [wide, high] = [label.offsetWidth, label.offsetHeight];
      const left = Math.min(x + 8, width - wide - 2);
      let top = y + down;
      const isCovered = (other) =>
        left < other.left + other.wide && other.left < left + wide &&
        Math.abs(top - other.top) < high;
      for (let other; (other = placed.find(isCovered)); ) top = other.top + high + 1;
      placed.push({ left, top, wide });
      label.style.transform = `translate(${left}px, ${top}px)`;
    });
  },

  moveCamera(to) {
    const { view } = this;
    cancelAnimationFrame(this.flight);
    if (!view || calm.matches) return view?.look(to);
    const from = view.camera, start = performance.now();
    const fly = (now) => {
      const time = Math.min((now - start) / 350, 1), part = time * time * (3 - 2 * time);
      const mix = (a, b) =>
        Array.isArray(b) ? b.map((x, i) => mix(a[i], x)) : a + (b - a) * part;
      const flown = Object.entries(to).map(([key, value]) => [key, mix(from[key], value)]);
      view.look(Object.fromEntries(flown));
      if (time < 1) this.flight = requestAnimationFrame(fly);
    };
    fly(start);
  },
};
