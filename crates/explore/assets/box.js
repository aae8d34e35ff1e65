// The page: the box, the path in it, and the flight of the camera.

const boxMethods = {
  showBox() {
    const { run, view } = this;
    const corners = run.faces.flatMap((face) =>
      face.triangles.flatMap((triangle) => [0, 3, 6].map((i) => triangle.slice(i, i + 3))),
    );
    const of = (value) =>
      new Float32Array(
        run.faces.flatMap((face) =>
          face.triangles.flatMap(() => [0, 1, 2].flatMap(() => value(face))),
        ),
      );
    view.light = run.lights[0].position;
    view.dotSize = run.dotSize;
    view.faces = run.faces.map(({ normal, triangles: [first] }) => ({
      normal,
      at: first.slice(0, 3),
    }));
    // What a submission stores may lie anywhere, also on no face.
    this.faceOf = new Uint16Array(this.count).fill(run.faces.length);
    for (let i = 0; i < run.stored; i++)
      this.faceOf[i] = run.sections.hit_face[run.firstHit[run.pathOf[i]] + run.bounceOf[i]];
    view.setLayer("surfaces", corners.length, [
      [new Float32Array(corners.flat()), 3],
      [of((face) => face.normal), 3],
      [of((face) => run.surfaces[face.surface].diffuse), 3],
    ]);
    this.mouse = orbit(
      view,
      (x, y) => this.openDot(view.pick(x, y)),
      (x, y) => {
        const index = view.pick(x, y);
        if (index >= 0)
          this.moveCamera({ target: [...this.positions.subarray(3 * index, 3 * index + 3)] });
      },
    );
    // From a little farther off than the handout's camera, so that the light is in sight.
    const { camera } = run;
    view.look({
      ...camera,
      size: run.size,
      ...(run.isHandout
        ? {
            target: add(camera.target, [0, 0, 0.2]),
            distance: 1.3 * camera.distance,
            yaw: 0.3,
            pitch: -0.16,
          }
        : {}),
    });
    this.readColors();
    view.canvas.addEventListener("webglcontextlost", () => {
      this.view = null;
      this.showPicture();
    });
  },

  /** What stands in for the box where there is no WebGL. */
  showPicture() {
    $("trouble").textContent =
      "This browser has no WebGL2, so you see the picture instead of the box. " +
      "The table and the stories work.";
    $("trouble").hidden = false;
    $("picture").src = this.run.picture;
    $("picture").hidden = false;
    $("view").hidden = true;
    document.body.classList.add("flat");
    this.showDots();
  },

  readColors() {
    const { view, run } = this;
    if (!view) return;
    const style = getComputedStyle(document.documentElement);
    const color = (name) =>
      style
        .getPropertyValue(`--${name}`)
        .trim()
        .match(/[0-9a-f]{2}/gi)
        .map((byte) => parseInt(byte, 16) / 255);
    view.palette = COLORS.map(color);
    view.air = color("air");
    view.wash = Number(style.getPropertyValue("--wash"));
    // The outline of a face: those edges of its triangles that no other of them has.
    const outline = run.faces.flatMap((face) => {
      const edges = new Map();
      for (const t of face.triangles) {
        const corners = [0, 3, 6].map((i) => t.slice(i, i + 3));
        corners.forEach((a, i) => {
          const b = corners[(i + 1) % 3],
            key = [a.join(), b.join()].sort().join();
          if (edges.has(key)) edges.delete(key);
          else edges.set(key, { a, b, color: "edge", width: 1 });
        });
      }
      return [...edges.values()];
    });
    view.setLines("edges", outline);
    this.showDots();
    this.showStep();
  },

  drawPath(step) {
    const { view, story, run } = this;
    if (!view?.palette) return;
    const { hits, light } = story,
      reached = step.name === "emission" ? -1 : step.bounce;
    const points = [light.position, ...hits.map((hit) => hit.position)];
    const lines = points.slice(1).map((b, i) => ({
      a: points[i],
      b,
      color: "path",
      width: i <= reached ? 3 : 1.5,
      dash: i <= reached ? 0 : 7,
      alpha: i <= reached ? 1 : 0.6,
    }));
    if (story.ending === "left_the_scene") {
      const way = hits.length ? hits.at(-1).direction : story.direction,
        end = points.at(-1);
      lines.push({
        a: end,
        b: add(end, way, run.size * 0.4),
        color: "path",
        width: reached >= hits.length ? 3 : 1.5,
        dash: reached >= hits.length ? 0 : 7,
        alpha: 0.8,
      });
    }
    if (step.name === "emission")
      lines.push({
        a: light.position,
        b: add(light.position, story.direction, run.size * 0.2),
        color: "path",
        width: 3.5,
      });
    const { comparison } = run;
    if (comparison?.other && this.isDivergence(step))
      lines.push({
        a: points[step.bounce + (step.name === "emission" || step.name === "stored" ? 0 : 1)],
        b: comparison.other,
        color: "extra",
        width: 3,
        dash: 9,
      });
    view.setLines("path", [...lines, ...(step.lines ?? [])]);
    const marks = hits.map((hit, i) => ({
      at: hit.position,
      color: i <= reached ? "path" : "grey",
      shape: hit.stored ? "circle" : "ring",
    }));
    if (step.name === "emission") {
      // The cube of the draws, small, around the light.
      story.tries.forEach((xyz, i) =>
        marks.push({
          at: add(light.position, xyz, run.size * 0.12),
          color: i + 1 === story.tries.length ? "path" : "extra",
          shape: i + 1 === story.tries.length ? "circle" : "cross",
        }),
      );
    }
    if (comparison?.other && this.isDivergence(step))
      marks.push({ at: comparison.other, color: "extra", shape: "cross" });
    run.lights.forEach(({ position }) =>
      marks.push({ at: position, color: "light", shape: "diamond" }),
    );
    view.setMarks(marks);
    const name = (hit) => (hit.stored ? String(hit.bounce) : "0, not stored");
    this.labels = [
      ["light", light.position, -20],
      ...hits.map((hit) => [name(hit), hit.position, 6]),
      ...(step.labels ?? []).map((label) => [...label, -12]),
    ];
    $("labels").replaceChildren(
      ...this.labels.map(([words]) => make("span", { textContent: words })),
    );
    this.placeLabels();
  },

  placeLabels() {
    const { view } = this;
    [...$("labels").children].forEach((label, i) => {
      const place = view?.project(this.labels[i][1]);
      label.hidden =
        !place ||
        place[0] < 0 ||
        place[1] < 0 ||
        place[0] > view.canvas.clientWidth ||
        place[1] > view.canvas.clientHeight;
      if (label.hidden) return;
      const left = Math.min(place[0] + 8, view.canvas.clientWidth - label.offsetWidth - 2);
      label.style.transform = `translate(${left}px, ${place[1] + this.labels[i][2]}px)`;
    });
  },

  moveCamera(to) {
    const { view } = this;
    if (!view) return;
    const from = { ...view.camera },
      start = performance.now();
    cancelAnimationFrame(this.flight);
    if (calm.matches) return view.look(to);
    const fly = (now) => {
      const part = Math.min((now - start) / 350, 1),
        mix = (a, b) => a + (b - a) * part * part * (3 - 2 * part);
      view.look(
        Object.fromEntries(
          Object.entries(to).map(([key, value]) => [
            key,
            Array.isArray(value)
              ? value.map((x, i) => mix(from[key][i], x))
              : mix(from[key], value),
          ]),
        ),
      );
      if (part < 1) this.flight = requestAnimationFrame(fly);
    };
    fly(start);
  },
};
