// The page: what the user chose, and everything that follows from it.

const theme = window.matchMedia("(prefers-color-scheme: dark)");
/** Colors and shapes by bounce, and by what a comparison says. */
const BOUNCE_LOOKS =
  [["one", "circle"], ["two", "square"], ["three", "diamond"], ["four", "triangle"]];
const BOUNCES = ["1", "2", "3", "4 or more"];
const KIND_LOOKS = {
  matched: ["gray", "circle"],
  missing: ["missing", "ring"],
  moved: ["moved", "diamond"],
  extra: ["extra", "cross"],
};
/** The photon of a dot whose list does not tell it. */
const UNTOLD = 0xffffffff;
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
  /** The timer that plays the steps. */
  timer = null;

  constructor(run, view) {
    Object.assign(this, { run, view });
    this.showRun();
    this.showComparison();
    this.showTable();
    this.showFilters();
    this.listen();
    if (view) this.showBox();
    else this.showPicture();
    this.openStart();
  }

  /** Shows the dots that the table and the filters leave, as the user wants them colored. */
  showDots() {
    const { run, view, only, lit, run: { dots } } = this;
    const mode = $("colors").value, group = (dot) => clamp(dots.bounce[dot], 1, 4) - 1;
    const number = (id, otherwise) => ($(id).value === "" ? otherwise : Number($(id).value));
    const [from, to] = [number("from", 0), number("to", Infinity)];
    const isRange = $("from").value + $("to").value !== "";
    const unchecked = (id) =>
      new Set([...$(id).querySelectorAll("input:not(:checked)")].map(({ value }) => +value));
    const [bounces, surfaces] = [unchecked("by-bounce"), unchecked("by-surface")];
    const counts = run.comparison?.counts;
    const kinds =
      Object.keys(KIND_LOOKS).map((kind) => (counts ? `${thousands(counts[kind])} ${kind}` : kind));
    // For each way to color: the looks, their names in the legend, and a dot's look.
    const ways = {
      bounce: [BOUNCE_LOOKS, BOUNCES.map((bounce) => `bounce ${bounce}`), group],
      surface: [BOUNCE_LOOKS, run.surfaces.slice(0, 8).map(({ name }) => name),
        (dot) => dots.surface[dot] % 4],
      red: [[["red", "circle"]], ["stored photon"], () => 0],
      kind: [Object.values(KIND_LOOKS), kinds, (dot) => dots.kind[dot]],
    };
    const [styles, legend, styleOf] = ways[mode];
    const codes = styles.map((style) => look(...style));
    const isIn = ({ surface, least, most }, dot) =>
      (surface === null || surface === dots.surface[dot]) &&
      dots.bounce[dot] >= least && dots.bounce[dot] <= most;
    const isHidden = (dot) =>
      bounces.has(group(dot)) || surfaces.has(dots.surface[dot]) || (only && !isIn(only, dot)) ||
      (isRange && (dots.photon[dot] < from || dots.photon[dot] > to ||
        dots.photon[dot] === UNTOLD));
    const isLarge = counts && mode === "kind" &&
      counts.missing + counts.moved + counts.extra <= MOST_LARGE;
    const looks = (this.looks = new Uint8Array(2 * dots.count));
    let shown = 0;
    for (let dot = 0; dot < (mode === "kind" ? dots.count : run.stored); dot++) {
      if (isHidden(dot)) continue;
      looks[2 * dot] = codes[styleOf(dot)];
      looks[2 * dot + 1] = lit && isIn(lit, dot) ? 2 : isLarge && dots.kind[dot] ? 3 : 1;
      // A moved photon has two dots.
      shown += dot < run.stored || dot >= run.firstExtra;
    }
    $("shown").textContent =
      `${thousands(shown)} photon${shown === 1 ? "" : "s"} shown${only ? `: ${only.name}` : ""}.`;
    $("legend").replaceChildren(
      ...legend.map((name, i) => make("li", {}, swatch(...styles[i % styles.length]), ` ${name}`)));
    if (!view) return;
    view.wallAlpha = $("walls").checked ? 1 : 0.16;
    view.dim = lit ? 0.15 : 1;
    view.setDots(dots.position, looks, dots.normal);
    view.setLines("moved", this.movedLines());
  }

  /** Lines from where moved photons are to where they should be: of the open one, and of the cell
   * that is lit or else of some others. */
  movedLines() {
    const { run, looks, lit } = this;
    const state = (k) => looks[2 * (run.stored + k) + 1];
    const isOpen = (k) => run.dots.photon[run.stored + k] === this.photon;
    const shown = [...run.movedIndex.keys()].filter((k) => (lit ? state(k) === 2 : state(k)));
    const every = Math.ceil(shown.length / (lit ? MOST_LIT_LINES : MOST_LINES));
    const faint = { width: 1, alpha: lit ? 0.7 : every > 1 ? 0.3 : 1 };
    return shown.filter((k, i) => i % every === 0 || isOpen(k)).map((k) => {
      const [a, b] = [run.place(run.movedIndex[k]), run.place(run.stored + k)];
      return { a, b, color: "moved", ...(isOpen(k) ? { width: 2.5 } : faint) };
    });
  }

  openDot(dot) {
    if (dot < 0) return;
    const { photon, bounce } = this.run.dots;
    if (photon[dot] === UNTOLD)
      this.say("This list does not tell the photon of its records.");
    else this.open(photon[dot], bounce[dot], "stored");
  }

  listen() {
    const { run, view } = this;
    const buttons = {
      home: () => view?.look(run.camera),
      center: () => this.center(),
      back: () => this.go(this.at - 1),
      forward: () => this.go(this.at + 1),
      play: () => this.play(this.timer === null),
      previous: () => this.skip(-1),
      next: () => this.skip(1),
      divergence: () => this.openDivergence(),
    };
    for (const [id, action] of Object.entries(buttons)) $(id).onclick = action;
    $("left").oninput = () => this.showDots();
    $("photon").onchange = () => this.open(Number($("photon").value), 0, "emission");
    $("slider").oninput = () => this.go(Number($("slider").value));
    window.onhashchange = () => this.followLink();
    theme.onchange = () => this.readColors();
    // Buttons name their keys themselves.
    const keys = {
      ArrowUp: () => this.goToBounce(this.steps[this.at].bounce - 1),
      ArrowDown: () => this.goToBounce(this.steps[this.at].bounce + 1),
      "+": () => this.mouse?.zoom(0.85),
      "=": () => this.mouse?.zoom(0.85),
      "-": () => this.mouse?.zoom(1.18),
    };
    const turns =
      { ArrowLeft: [-0.1, 0], ArrowRight: [0.1, 0], ArrowUp: [0, -0.1], ArrowDown: [0, 0.1] };
    document.onkeydown = (event) => {
      const { target, key } = event;
      const isField = target.matches("select, input:not([type=range], [type=checkbox])");
      const isPressed = key === " " && target.matches("button, summary, input");
      const isCommand = event.ctrlKey || event.metaKey || event.altKey;
      if (isField || isPressed || isCommand || !this.steps.length) return;
      const name = key === " " ? "Space" : key.length === 1 ? key.toUpperCase() : key;
      const button = document.querySelector(`[aria-keyshortcuts="${CSS.escape(name)}"]`);
      const turn = event.shiftKey && turns[key];
      if (turn) this.mouse?.turn(...turn);
      else if (keys[key]) keys[key]();
      else if (button) button.click();
      else return;
      event.preventDefault();
    };
  }
}
// Files of their own have the methods for the counts, the box and the panel.
Object.assign(Page.prototype, countsMethods, boxMethods, panelMethods);

async function start() {
  const meta = JSON.parse($("meta").textContent);
  if (typeof DecompressionStream === "undefined")
    throw new Error("This browser cannot inflate the data. Use a browser of 2023 or later.");
  const run = new Run(meta, await readColumns(meta.sections));
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
