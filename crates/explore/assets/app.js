// The page: what the user chose, and everything that follows from it.

const $ = (id) => document.getElementById(id);
const make = (tag, properties = {}, ...children) => {
  const node = Object.assign(document.createElement(tag), properties);
  node.append(...children);
  return node;
};
const theme = window.matchMedia("(prefers-color-scheme: dark)");
const calm = window.matchMedia("(prefers-reduced-motion: reduce)");
/** Colors and shapes by bounce, and by what a comparison says. */
const BOUNCE_LOOKS =
  [["one", "circle"], ["two", "square"], ["three", "diamond"], ["four", "triangle"]];
const RED = ["red", "circle"];
const KINDS = ["matched", "missing", "moved", "extra"];
const KIND_LOOKS = {
  matched: ["gray", "circle"],
  missing: ["missing", "ring"],
  moved: ["moved", "diamond"],
  extra: ["extra", "cross"],
};
/** Up to so many differing dots are drawn large. */
const MOST_LARGE = 2000;
/** Of the moved photons about so many have a line, and of those of a cell: more hide the box. */
const [MOST_LINES, MOST_LIT_LINES] = [150, 1000];

class Page {
  photon = null;
  steps = [];
  at = 0;
  /** Cells of the table: whose photons are shown alone, and whose are lit. */
  only = null;
  lit = null;
  /** What the filters hide. */
  bounces = new Set();
  surfaces = new Set();
  timer = null;

  constructor(run, view) {
    Object.assign(this, { run, view });
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
    this.openStart();
  }

  /** All dots: the stored photons, then those that a submission moved, then its extra ones. */
  collectDots() {
    const { run } = this, { sections } = run;
    const { moved_index: moved = [], extra_x: extra = [] } = sections;
    const firstExtra = run.stored + moved.length;
    this.count = firstExtra + extra.length;
    this.positions = new Float32Array(3 * this.count);
    this.positions.set(run.positions);
    const put = (first, name) =>
      ["x", "y", "z"].forEach((axis, i) =>
        sections[`${name}_${axis}`]?.forEach((coordinate, k) => {
          this.positions[3 * (first + k) + i] = coordinate;
        }));
    put(run.stored, "moved");
    put(firstExtra, "extra");
    this.kinds = new Uint8Array(this.count);
    this.kinds.set(sections.kind ?? []);
    this.kinds.fill(2, run.stored, firstExtra).fill(3, firstExtra);
    this.differing = this.kinds.reduce((count, kind) => count + (kind > 0), 0);
  }

  place(index) {
    return [...this.positions.subarray(3 * index, 3 * index + 3)];
  }

  /** Puts photon (-1 if not known), bounce and surface of dot `index` into `dot`. */
  readDot(index, dot) {
    const { run } = this, { sections } = run;
    const moved = sections.moved_index?.length ?? 0;
    const k = index - run.stored - moved;
    if (k >= 0) {
      const photon = sections.extra_photon[k];
      dot.photon = photon === 0xffffffff ? -1 : photon;
      dot.bounce = sections.extra_bounce[k];
      dot.surface = sections.extra_surface[k];
    } else {
      const stored = index < run.stored ? index : sections.moved_index[index - run.stored];
      dot.photon = run.photons[run.pathOf[stored]];
      dot.bounce = run.bounceOf[stored];
      dot.surface = run.surfaceOf[stored];
    }
    return dot;
  }

  showDots() {
    const { run, view, only, lit, kinds } = this;
    const mode = $("colors").value;
    const number = (id, otherwise) => ($(id).value === "" ? otherwise : Number($(id).value));
    const to = number("to", Infinity);
    // Dots of a list without numbers have -1: only a range hides them.
    const from = number("from", to === Infinity ? -1 : 0);
    const names = BOUNCE_LOOKS.map((_, i) => (i === 3 ? "bounce 4 or more" : `bounce ${i + 1}`));
    // For each way to color: the looks, those of the legend with their names, and a dot's look.
    const ways = {
      bounce: [BOUNCE_LOOKS, names, (i, { bounce }) => clamp(bounce, 1, 4) - 1],
      surface: [BOUNCE_LOOKS, run.surfaces.slice(0, 8).map(({ name }) => name),
        (i, { surface }) => surface % 4],
      red: [[RED], ["stored photon"], () => 0],
      kind: [KINDS.map((kind) => KIND_LOOKS[kind]), KINDS, (i) => kinds[i]],
    };
    const [styles, legend, styleOf] = ways[mode];
    const codes = styles.map((style) => look(...style));
    const isIn = ({ surface, bounces: [low, high] }, dot) =>
      (surface === null || surface === dot.surface) && dot.bounce >= low && dot.bounce <= high;
    const looks = new Uint8Array(2 * this.count), dot = {};
    const isLarge = mode === "kind" && this.differing <= MOST_LARGE;
    const firstExtra = run.stored + (run.sections.moved_index?.length ?? 0);
    let shown = 0;
    for (let i = 0; i < this.count; i++) {
      if (i >= run.stored && mode !== "kind") break;
      this.readDot(i, dot);
      const isHidden =
        this.bounces.has(clamp(dot.bounce, 1, 4) - 1) || this.surfaces.has(dot.surface) ||
        dot.photon < from || dot.photon > to || (only && !isIn(only, dot));
      if (isHidden) continue;
      looks[2 * i] = codes[styleOf(i, dot)];
      looks[2 * i + 1] = lit && isIn(lit, dot) ? 2 : isLarge && kinds[i] ? 3 : 1;
      // A moved photon has two dots.
      if (i < run.stored || i >= firstExtra) shown++;
    }
    this.looks = looks;
    $("shown").textContent =
      `${thousands(shown)} photon${shown === 1 ? "" : "s"} shown${only ? `: ${only.name}` : ""}.`;
    $("legend").replaceChildren(
      ...legend.map((name, i) => make("li", {}, swatch(...styles[i % styles.length]), ` ${name}`)));
    if (!view) return;
    view.dim = lit ? 0.15 : 1;
    view.setDots(this.positions, looks, this.faceOf);
    view.setLines("moved", mode === "kind" ? this.movedLines() : []);
  }

  /** Lines from where moved photons are to where they should be: full ones of the open photon and
   * of the cell that is lit, faint ones of some of the others. */
  movedLines() {
    const { run } = this, { moved_index: moved = [] } = run.sections;
    const state = (k) => this.looks[2 * (run.stored + k) + 1];
    const isOpen = (k) => run.photons[run.pathOf[moved[k]]] === this.photon;
    const lines = (list, width, alpha) => list.map((k) => {
      const [a, b] = [this.place(moved[k]), this.place(run.stored + k)];
      return { a, b, color: "moved", width, alpha };
    });
    const all = [...moved.keys()].filter(state), others = all.filter((k) => !isOpen(k));
    const lit = others.filter((k) => state(k) === 2);
    const some = (list, most) => list.filter((_, i) => i % Math.ceil(list.length / most) === 0);
    const thin = lit.length ? lines(some(lit, MOST_LIT_LINES), 1, 0.7)
      : lines(some(others, MOST_LINES), 1, others.length > MOST_LINES ? 0.3 : 1);
    return [...thin, ...lines(all.filter(isOpen), 2.5, 1)];
  }

  openDot(index) {
    if (index < 0) return;
    const { photon, bounce } = this.readDot(index, {});
    if (photon < 0) return this.say("This list does not tell the photon of its records.");
    this.open(photon, bounce, "stored");
  }

  listen() {
    const on = (id, kind, action) => $(id).addEventListener(kind, action);
    const center = () => {
      const { light, hits } = this.story, { name, bounce } = this.steps[this.at];
      const hit = name === "emission" ? null : hits[Math.min(bounce, hits.length - 1)];
      this.moveCamera({ target: (hit ?? light).position, distance: this.run.size * 0.9 });
    };
    const home = () => {
      // The shorter way round.
      const turns = Math.round(((this.view?.camera.yaw ?? 0) - this.run.camera.yaw) / 2 / Math.PI);
      this.moveCamera({ ...this.run.camera, yaw: this.run.camera.yaw + 2 * Math.PI * turns });
    };
    const set = (name, value) => {
      if (!this.view) return;
      this.view[name] = value;
      this.view.draw();
    };
    const openNumber = () => this.open(Number($("photon").value), 0, "emission");
    const actions = {
      home, center,
      back: () => this.go(this.at - 1),
      forward: () => this.go(this.at + 1),
      play: () => this.play(this.timer === null),
      previous: () => this.skip(-1),
      next: () => this.skip(1),
      divergence: () => this.openDivergence(),
    };
    for (const [id, action] of Object.entries(actions)) on(id, "click", action);
    for (const id of ["colors", "from", "to"]) on(id, "input", () => this.showDots());
    on("walls", "input", () => set("wallAlpha", $("walls").checked ? 1 : 0.16));
    on("dots", "input", () => set("dotScale", Number($("dots").value)));
    on("photon", "change", openNumber);
    on("choose", "submit", (event) => {
      event.preventDefault();
      openNumber();
    });
    on("slider", "input", () => this.go(Number($("slider").value)));
    const keys = {
      ArrowLeft: actions.back,
      ArrowRight: actions.forward,
      ArrowUp: () => this.changeBounce(-1),
      ArrowDown: () => this.changeBounce(1),
      " ": actions.play,
      n: actions.next,
      p: actions.previous,
      h: home,
      c: center,
      "+": () => this.mouse?.zoom(0.85),
      "=": () => this.mouse?.zoom(0.85),
      "-": () => this.mouse?.zoom(1.18),
    };
    const turns =
      { ArrowLeft: [-0.1, 0], ArrowRight: [0.1, 0], ArrowUp: [0, -0.1], ArrowDown: [0, 0.1] };
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
  view?.finish();
  window.page.firstFrame = performance.now();
  document.body.dataset.ready = "yes";
}
start().catch((error) => {
  $("trouble").textContent = error.message;
  $("trouble").hidden = false;
});
