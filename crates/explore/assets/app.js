// The page: what the user chose, and everything that follows from it.

const $ = (id) => document.getElementById(id);
const make = (tag, properties = {}, ...children) => {
  const node = Object.assign(document.createElement(tag), properties);
  node.append(...children);
  return node;
};
const theme = window.matchMedia("(prefers-color-scheme: dark)");
const calm = window.matchMedia("(prefers-reduced-motion: reduce)");
const BOUNCE_LOOKS = [
  ["one", "circle"],
  ["two", "square"],
  ["three", "diamond"],
  ["four", "triangle"],
];
const KINDS = ["matched", "missing", "moved", "extra"];
const KIND_LOOKS = {
  matched: ["grey", "circle"],
  missing: ["missing", "ring"],
  moved: ["moved", "diamond"],
  extra: ["extra", "cross"],
};

class Page {
  constructor(run, view) {
    Object.assign(this, {
      run,
      view,
      photon: null,
      steps: [],
      at: 0,
      only: null,
      lit: null,
      bounces: new Set(),
      surfaces: new Set(),
      timer: null,
    });
    this.collectDots();
    this.showRun();
    this.showComparison();
    this.showTable();
    this.showFilters();
    this.listen();
    if (view) this.showBox();
    else this.showPicture();
    theme.addEventListener("change", () => this.readColors());
    window.addEventListener("hashchange", () => this.followLink());
    if (!this.followLink()) this.openStart();
  }

  // What there is to show.

  /** All dots: the stored photons, then those that a submission moved, then its extra ones. */
  collectDots() {
    const { run } = this,
      { sections, comparison } = run;
    const moved = sections.moved_index ?? [],
      extra = sections.extra_x ?? [];
    this.count = run.stored + moved.length + extra.length;
    this.positions = new Float32Array(3 * this.count);
    this.positions.set(run.positions);
    this.kinds = new Uint8Array(this.count);
    if (comparison) this.kinds.set(sections.kind);
    ["x", "y", "z"].forEach((axis, i) => {
      [
        ["moved", run.stored],
        ["extra", run.stored + moved.length],
      ].forEach(([name, first]) =>
        sections[`${name}_${axis}`]?.forEach((coordinate, k) => {
          this.positions[3 * (first + k) + i] = coordinate;
        }),
      );
    });
    this.kinds.fill(2, run.stored, run.stored + moved.length).fill(3, run.stored + moved.length);
  }

  /** Photon (-1 if not known), bounce and surface of dot `index`. */
  dot(index) {
    const { run } = this,
      { sections } = run,
      moved = sections.moved_index?.length ?? 0;
    const stored =
      index < run.stored
        ? index
        : index < run.stored + moved
          ? sections.moved_index[index - run.stored]
          : -1;
    if (stored >= 0)
      return {
        photon: run.photons[run.pathOf[stored]],
        bounce: run.bounceOf[stored],
        surface: run.surfaceOf[stored],
      };
    const k = index - run.stored - moved,
      photon = sections.extra_photon[k];
    return {
      photon: photon === 0xffffffff ? -1 : photon,
      bounce: sections.extra_bounce[k],
      surface: sections.extra_surface[k],
    };
  }

  showRun() {
    const { run } = this;
    const thinned =
      run.keptOf > run.stored
        ? ` Of these the page has ${thousands(run.stored)}, evenly thinned.`
        : "";
    const counts = `${thousands(run.emitted)} emitted, ${thousands(run.keptOf)} stored`;
    $("run").textContent = `${counts}, seed ${run.seed}.${thinned}`;
    $("home").textContent = run.isHandout ? "Handout's camera" : "Whole scene";
    $("photon").max = run.emitted - 1;
  }

  showComparison() {
    const { comparison } = this.run;
    if (!comparison) return;
    $("comparison").hidden = false;
    $("verdict").textContent = comparison.verdict;
    $("reason").textContent = comparison.reason;
    $("advice").textContent = comparison.advice;
    $("report").textContent = comparison.report;
    $("divergence").hidden = comparison.photon === null;
    for (const kind of KINDS) {
      const [color, shape] = KIND_LOOKS[kind];
      $("differences").append(
        make("li", {}, swatch(color, shape), ` ${thousands(comparison.counts[kind])} ${kind}`),
      );
    }
  }

  showTable() {
    const { run } = this,
      table = $("table");
    const cell = ({ stored, expected, z }, only) => {
      const words = [make("b", { textContent: thousands(stored) })];
      if (expected !== null)
        words.push(
          make("span", {
            textContent: expected.toLocaleString("en-US", {
              maximumFractionDigits: 1,
              minimumFractionDigits: 1,
            }),
          }),
        );
      if (z !== null)
        words.push(
          make("span", {
            className: Math.abs(z) > 4 ? "far" : "",
            textContent: `${z < 0 ? "−" : "+"}${Math.abs(z).toFixed(1)} σ`,
          }),
        );
      const button = make("button", { type: "button", ariaPressed: "false" }, ...words);
      const beside = expected === null ? "" : `, ${expected.toFixed(1)} expected`;
      button.setAttribute("aria-label", `${only.name}: ${stored} stored${beside}`);
      const light = (lit) => {
        this.lit = lit;
        this.showDots();
      };
      for (const kind of ["pointerenter", "focus"])
        button.addEventListener(kind, () => light(only));
      for (const kind of ["pointerleave", "blur"]) button.addEventListener(kind, () => light(null));
      button.addEventListener("click", () => {
        this.only = this.only === only ? null : only;
        table.querySelectorAll("button").forEach((other) => {
          other.ariaPressed = String(this.only !== null && other === button);
        });
        this.showDots();
      });
      return make("td", {}, button);
    };
    table.append(
      make(
        "thead",
        {},
        make(
          "tr",
          {},
          ...["surface", ...run.columns].map((name) =>
            make("th", { scope: "col", textContent: name }),
          ),
        ),
      ),
    );
    table.append(
      make(
        "tbody",
        {},
        ...run.rows.map((row, surface) =>
          make(
            "tr",
            {},
            make("th", { scope: "row", textContent: row.name }),
            ...row.cells.map((each, column) =>
              cell(each, {
                name: `${row.name}, ${run.columns[column]}`,
                surface: surface < run.surfaces.length ? surface : null,
                bounces:
                  column === run.columns.length - 1
                    ? [1, Infinity]
                    : column === run.columns.length - 2
                      ? [column + 1, Infinity]
                      : [column + 1, column + 1],
              }),
            ),
          ),
        ),
      ),
    );
  }

  showFilters() {
    const { run } = this;
    const box = (label, set, value) => {
      const input = make("input", { type: "checkbox", checked: true });
      input.addEventListener("change", () => {
        if (input.checked) set.delete(value);
        else set.add(value);
        this.showDots();
      });
      return make("label", {}, input, ` ${label}`);
    };
    $("by-bounce").append(
      ...BOUNCE_LOOKS.map((_, i) => box(i === 3 ? "4 or more" : String(i + 1), this.bounces, i)),
    );
    $("by-surface").append(...run.surfaces.map(({ name }, i) => box(name, this.surfaces, i)));
    const modes = [
      ["bounce", "by bounce"],
      ["surface", "by surface"],
      ["red", "plain red"],
    ];
    if (run.comparison) modes.unshift(["kind", "by difference"]);
    $("colors").append(
      ...modes.map(([value, name]) => make("option", { value, textContent: name })),
    );
  }

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
  }

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
  }

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
  }

  // The dots.

  showDots() {
    const { run, view, only, lit } = this;
    const mode = $("colors").value,
      from = Number($("from").value || 0),
      to = $("to").value === "" ? Infinity : Number($("to").value);
    const looks = new Uint8Array(2 * this.count);
    const code = ([color, shape]) => COLORS.indexOf(color) | (SHAPES[shape] << 4);
    const byBounce = BOUNCE_LOOKS.map(code),
      byKind = KINDS.map((kind) => code(KIND_LOOKS[kind])),
      red = code(["red", "circle"]);
    const inCell = ({ surface, bounces: [low, high] }, dot) =>
      (surface === null || surface === dot.surface) && dot.bounce >= low && dot.bounce <= high;
    const isolated = $("alone").checked,
      dot = {};
    let shown = 0;
    for (let i = 0; i < this.count; i++) {
      if (i < run.stored) {
        dot.photon = run.photons[run.pathOf[i]];
        dot.bounce = run.bounceOf[i];
        dot.surface = run.surfaceOf[i];
      } else Object.assign(dot, this.dot(i));
      const bounce = Math.min(Math.max(dot.bounce, 1), 4) - 1;
      const hidden =
        this.bounces.has(bounce) ||
        this.surfaces.has(dot.surface) ||
        dot.photon < from ||
        dot.photon > to ||
        (only && !inCell(only, dot)) ||
        (isolated && dot.photon !== this.photon) ||
        (i >= run.stored && mode !== "kind");
      looks[2 * i] =
        mode === "kind"
          ? byKind[this.kinds[i]]
          : mode === "red"
            ? red
            : byBounce[mode === "surface" ? dot.surface % 4 : bounce];
      looks[2 * i + 1] = hidden ? 0 : lit && inCell(lit, dot) ? 2 : 1;
      if (!hidden) shown++;
    }
    this.looks = looks;
    $("shown").textContent =
      `${thousands(shown)} photon${shown === 1 ? "" : "s"} shown${only ? `: ${only.name}` : ""}.`;
    const legend =
      mode === "kind"
        ? KINDS.map((kind) => [KIND_LOOKS[kind], kind])
        : mode === "red"
          ? [[["red", "circle"], "stored photon"]]
          : mode === "surface"
            ? run.surfaces.slice(0, 8).map(({ name }, i) => [BOUNCE_LOOKS[i % 4], name])
            : BOUNCE_LOOKS.map((look, i) => [
                look,
                i === 3 ? "bounce 4 or more" : `bounce ${i + 1}`,
              ]);
    $("legend").replaceChildren(
      ...legend.map(([look, name]) => make("li", {}, swatch(...look), ` ${name}`)),
    );
    if (!view) return;
    view.dim = lit ? 0.15 : 1;
    view.setDots(this.positions, looks, this.faceOf);
    const { moved_index: moved } = run.sections;
    const lines = [];
    if (moved && mode === "kind") {
      // More lines than this hide the box; those of the photon that is open are always drawn.
      const every = Math.ceil(moved.length / 3000);
      for (let k = 0; k < moved.length; k++) {
        const index = run.stored + k,
          isOpen = run.photons[run.pathOf[moved[k]]] === this.photon;
        if (!looks[2 * index + 1] || (k % every && !isOpen)) continue;
        const place = (i) => [...this.positions.subarray(3 * i, 3 * i + 3)];
        lines.push({
          a: place(moved[k]),
          b: place(index),
          color: "moved",
          width: isOpen ? 2.5 : 1,
          alpha: isOpen ? 1 : Math.min(1, 60 / Math.sqrt(moved.length) / 3),
        });
      }
    }
    view.setLines("moved", lines);
  }

  openDot(index) {
    if (index < 0) return;
    const { photon, bounce } = this.dot(index);
    if (photon < 0) return this.say("This list does not tell the photon of its records.");
    this.open(photon, bounce, "stored");
  }

  // The story.

  openStart() {
    const { comparison, start } = this.run;
    if (comparison && comparison.photon !== null) this.openDivergence();
    else if (this.run.paths) this.open(start, 0, "emission");
  }

  openDivergence() {
    const { photon, bounce, step } = this.run.comparison;
    this.open(photon, bounce, step);
  }

  say(words) {
    $("no-story").textContent = words;
    $("no-story").hidden = words === "";
  }

  /** Opens `photon` at the step `name` of `bounce`, or as near to it as its path goes. */
  open(photon, bounce, name) {
    const { run } = this,
      path = run.pathOfPhoton(photon);
    if (path < 0) {
      const why =
        photon >= run.emitted
          ? `expected a number below ${thousands(run.emitted)}`
          : run.keptOf > run.stored
            ? "it stores no photon, or the page leaves it out"
            : "it stores no photon";
      return this.say(
        `Photon ${thousands(photon)} has no story here: ${why}. ` +
          `Run photon-mapping explore --photon ${photon} to get it.`,
      );
    }
    this.say("");
    if (photon !== this.photon) {
      this.photon = photon;
      this.story = run.story(path);
      this.steps = stepsOf(run, this.story);
      $("slider").max = this.steps.length - 1;
      if ($("alone").checked || run.sections.moved_index) this.showDots();
    }
    const exact = this.steps.findIndex((step) => step.bounce === bounce && step.name === name);
    const near = this.steps.findLastIndex(
      (step) => step.bounce <= bounce && (step.bounce < bounce || name !== "emission"),
    );
    this.go(exact >= 0 ? exact : Math.max(near, 0));
  }

  go(at) {
    this.at = Math.min(Math.max(at, 0), this.steps.length - 1);
    const { bounce, name } = this.steps[this.at];
    this.link = `#photon=${this.photon}&bounce=${bounce}&step=${name}`;
    // Browsers refuse more than a few changes of the address a second.
    this.address ??= setTimeout(() => {
      this.address = null;
      history.replaceState(null, "", this.link);
    }, 120);
    this.showStep();
  }

  /** Opens what the address names; says whether it names anything. */
  followLink() {
    if (location.hash === this.link) return true;
    const link = new URLSearchParams(location.hash.slice(1)),
      photon = Number(link.get("photon") ?? NaN);
    if (!Number.isInteger(photon) || photon < 0) return false;
    this.open(photon, Number(link.get("bounce") ?? 0), link.get("step") ?? "emission");
    return this.photon !== null;
  }

  /** Goes to the photon `by` stored paths on. */
  skip(by) {
    const { run } = this,
      here = run.pathOfPhoton(this.photon);
    let path = here + by;
    while (path >= 0 && path < run.paths && run.firstStored[path + 1] === run.firstStored[path])
      path += by;
    if (path >= 0 && path < run.paths)
      this.open(run.photons[path], this.steps[this.at].bounce, this.steps[this.at].name);
  }

  /** Goes to the same step of the bounce before (-1) or after (1). */
  changeBounce(by) {
    const { bounce, name } = this.steps[this.at],
      other = bounce + by;
    const of = this.steps.findIndex((step) => step.bounce === other && step.name === name);
    const first = this.steps.findIndex((step) => step.bounce === other);
    if (of >= 0 || first >= 0) this.go(of >= 0 ? of : first);
  }

  play(on) {
    clearInterval(this.timer);
    this.timer = on
      ? setInterval(() => {
          if (this.at + 1 < this.steps.length) this.go(this.at + 1);
          else this.play(false);
        }, 1800)
      : null;
    $("play").ariaPressed = String(on);
    $("play").textContent = on ? "Pause" : "Play";
    if (on && this.at + 1 === this.steps.length) this.go(0);
  }

  showStep() {
    const { run, steps, at } = this,
      step = steps[at];
    if (!step) return;
    const source = run.source.steps[step.name];
    $("photon").value = this.photon;
    $("slider").value = at;
    $("slider").setAttribute("aria-valuetext", `bounce ${step.bounce}, ${source.short}`);
    $("place").textContent = `${at + 1} of ${steps.length}`;
    $("step-title").textContent = source.title;
    $("say").replaceChildren(...step.say.map((words) => make("p", { textContent: words })));
    $("drawing").replaceChildren(...(step.diagram ? [step.diagram()] : []));
    $("more").replaceChildren(
      ...step.more.flatMap(([name, value]) => [
        make("dt", { textContent: name }),
        make("dd", { textContent: value }),
      ]),
    );
    this.showChips();
    this.showSides(step);
    showCode(run.source, source, step.values);
    this.drawPath(step);
  }

  showChips() {
    const { steps, at, story } = this,
      step = steps[at];
    const chip = (words, isHere, action) => {
      const button = make("button", { type: "button", textContent: words });
      if (isHere) button.setAttribute("aria-current", "step");
      button.addEventListener("click", action);
      return button;
    };
    const ends = steps.at(-1);
    const bounces = story.hits.map((hit) =>
      chip(`${hit.bounce} ${hit.surface}`, step.bounce === hit.bounce, () =>
        this.changeBounce(hit.bounce - step.bounce),
      ),
    );
    if (ends.bounce === story.hits.length)
      bounces.push(chip(ENDINGS[story.ending], step === ends, () => this.go(steps.length - 1)));
    else bounces.push(make("span", { textContent: ENDINGS[story.ending] }));
    $("path").replaceChildren(make("span", { textContent: "Bounce" }), ...bounces);
    $("names").replaceChildren(
      ...steps.flatMap((other, i) =>
        other.bounce === step.bounce
          ? [chip(this.run.source.steps[other.name].short, i === at, () => this.go(i))]
          : [],
      ),
    );
  }

  /** Whether the lists part at `step`. */
  isDivergence(step) {
    const { comparison } = this.run;
    return (
      comparison !== null &&
      comparison.photon === this.photon &&
      comparison.bounce === step.bounce &&
      comparison.step === step.name
    );
  }

  /** Both lists' values side by side, at the step where they part. */
  showSides(step) {
    const { comparison } = this.run,
      isHere = this.isDivergence(step);
    $("sides").hidden = !isHere;
    if (!isHere) return;
    const row = (tag, cells) =>
      make("tr", {}, ...cells.map((words) => make(tag, { textContent: words })));
    $("sides").replaceChildren(
      make("caption", { textContent: "Here the lists part" }),
      row("th", ["", "reference", comparison.kind]),
      ...comparison.sides.map((cells) => row("td", cells)),
    );
  }

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
  }

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
  }

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
  }

  // What the user does.

  listen() {
    const on = (id, kind, action) => $(id).addEventListener(kind, action);
    const centre = () => {
      const step = this.steps[this.at],
        hit = this.story?.hits[Math.min(step.bounce, this.story.hits.length - 1)];
      this.moveCamera({
        target: step?.name === "emission" || !hit ? this.story.light.position : hit.position,
        distance: this.run.size * 0.9,
      });
    };
    const home = () => {
      const { yaw } = this.view?.camera ?? {};
      this.moveCamera({
        ...this.run.camera,
        yaw:
          yaw === undefined
            ? 0
            : this.run.camera.yaw +
              2 * Math.PI * Math.round((yaw - this.run.camera.yaw) / 2 / Math.PI),
      });
    };
    on("home", "click", home);
    on("centre", "click", centre);
    for (const id of ["colors", "from", "to", "alone"]) on(id, "input", () => this.showDots());
    on("walls", "input", () => {
      if (this.view) {
        this.view.wallAlpha = $("walls").checked ? 1 : 0.16;
        this.view.draw();
      }
    });
    on("dots", "input", () => {
      if (this.view) {
        this.view.dotScale = Number($("dots").value);
        this.view.draw();
      }
    });
    on("previous", "click", () => this.skip(-1));
    on("next", "click", () => this.skip(1));
    on("choose", "submit", (event) => {
      event.preventDefault();
      this.open(Number($("photon").value), 0, "emission");
    });
    on("photon", "change", () => this.open(Number($("photon").value), 0, "emission"));
    on("play", "click", () => this.play(this.timer === null));
    on("slider", "input", () => this.go(Number($("slider").value)));
    on("divergence", "click", () => this.openDivergence());
    const keys = {
      ArrowLeft: () => this.go(this.at - 1),
      ArrowRight: () => this.go(this.at + 1),
      ArrowUp: () => this.changeBounce(-1),
      ArrowDown: () => this.changeBounce(1),
      " ": () => this.play(this.timer === null),
      n: () => this.skip(1),
      p: () => this.skip(-1),
      h: home,
      c: centre,
      "+": () => this.mouse?.zoom(0.85),
      "=": () => this.mouse?.zoom(0.85),
      "-": () => this.mouse?.zoom(1.18),
    };
    const turns = {
      ArrowLeft: [-0.1, 0],
      ArrowRight: [0.1, 0],
      ArrowUp: [0, -0.1],
      ArrowDown: [0, 0.1],
    };
    document.addEventListener("keydown", (event) => {
      const { target, key } = event;
      if (event.ctrlKey || event.metaKey || event.altKey || !this.steps.length) return;
      const isField =
        target.matches("select, input:not([type=range]):not([type=checkbox])") ||
        (target.id === "dots" && key.startsWith("Arrow"));
      const isPressed = key === " " && target.matches("button, summary, input");
      if (isField || isPressed) return;
      const turn = event.shiftKey && turns[key];
      if (turn) this.mouse?.turn(...turn);
      else if (keys[key]) keys[key]();
      else return;
      event.preventDefault();
    });
  }
}

/** A small picture of a dot, for legends. */
function swatch(color, shape) {
  const shapes = {
    circle: () => circle([7, 7], 4.5, "fill"),
    square: () => draw("rect", { x: 3, y: 3, width: 8, height: 8, class: "fill" }),
    diamond: () => draw("polygon", { points: "7,1.5 12.5,7 7,12.5 1.5,7", class: "fill" }),
    triangle: () => draw("polygon", { points: "7,2 12,11.5 2,11.5", class: "fill" }),
    ring: () => circle([7, 7], 4.5, "ring"),
    cross: () => draw("g", {}, line([3, 3], [11, 11]), line([3, 11], [11, 3])),
  };
  return draw(
    "svg",
    { viewBox: "0 0 14 14", class: `swatch ${color}`, "aria-hidden": "true" },
    shapes[shape](),
  );
}

/** The port's functions of a step, its lines lit, values beside the lines that make them. */
function showCode(source, step, values) {
  const parts = step.parts.map((part) => {
    const { name, file, first, lines } = source.functions[part.function];
    const rows = lines.map((words, i) => {
      const isLit = i >= part.lit[0] && i <= part.lit[1];
      const row = make(
        "li",
        { value: first + i, className: isLit ? "lit" : "" },
        make("code", {
          className: words.trim().startsWith("//") ? "comment" : "",
          textContent: words || " ",
        }),
      );
      for (const [, value] of part.values.filter(
        ([at, key]) => at === i && values[key] !== undefined,
      )) {
        const node = make("span", { className: "value", textContent: values[value] });
        node.dataset.name = value;
        row.append(node);
      }
      return row;
    });
    return make(
      "figure",
      {},
      make("figcaption", {}, make("b", { textContent: name }), ` in ${file}`),
      make("ol", {}, ...rows),
    );
  });
  $("code").replaceChildren(...parts);
  for (const list of $("code").querySelectorAll("ol")) {
    const lit = list.querySelector(".lit");
    if (lit) list.scrollTop = lit.offsetTop - 28;
  }
}

async function start() {
  const meta = JSON.parse($("meta").textContent);
  if (typeof DecompressionStream === "undefined")
    throw new Error("This browser cannot inflate the data. Use a browser of 2023 or later.");
  const run = new Run(meta, await readSections(meta.sections));
  let view = null;
  try {
    view = new View($("view"), () => window.page?.placeLabels());
  } catch (error) {
    console.info(`no 3-D: ${error.message}`);
  }
  // For the console and the tests.
  window.page = new Page(run, view);
  view?.drawNow();
  view?.gl.finish();
  window.page.firstFrame = performance.now();
  document.body.dataset.ready = "yes";
}
start().catch((error) => {
  $("trouble").textContent = error.message;
  $("trouble").hidden = false;
});
