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
      const every = Math.ceil(moved.length / 800);
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

  listen() {
    const on = (id, kind, action) => $(id).addEventListener(kind, action);
    const center = () => {
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
    on("center", "click", center);
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
      c: center,
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
// Files of their own have the methods for the counts, the box and the panel.
Object.assign(Page.prototype, countsMethods, boxMethods, panelMethods);

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
