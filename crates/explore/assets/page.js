// The page: what the user chose, and everything that follows from it.

const $ = (id) => document.getElementById(id);
const make = (tag, properties, ...children) => {
  const node = Object.assign(document.createElement(tag), properties);
  node.append(...children);
  return node;
};
/** `words` for the page, in which no command and no option breaks at its hyphens. */
const prose = (words) =>
  words.split(/(--[\w-]+|photon-mapping \w+)/).map((part, i) =>
    i % 2 ? make("span", { className: "whole" }, part) : part);

/** What is open: a photon, its story, its steps and the place among them. Then the timer that plays
 * the steps, and the cells of the table whose photons are shown alone and lit. */
const page = { photon: null, story: null, steps: [], at: 0, timer: null, only: null, lit: null };
let run, view;

/** Colors and shapes by bounce, and by what a comparison says. */
const BOUNCE_LOOKS =
  [["one", "circle"], ["two", "square"], ["three", "diamond"], ["four", "triangle"]];
const BOUNCES = ["1", "2", "3", "4 or more"];
const KIND_LOOKS =
  [["gray", "circle"], ["missing", "ring"], ["moved", "diamond"], ["extra", "cross"]];
/** The photon of a dot whose list does not tell it. */
const UNTOLD = 0xffffffff;
/** Of the moved photons about so many have a line, and of those of a cell: more hide the box. */
const [MOST_LINES, MOST_LIT_LINES] = [150, 1000];

/** The ways to color the dots: the looks, their names in the legend, and which is a dot's. */
const WAYS = {
  bounce: () => [BOUNCE_LOOKS, BOUNCES.map((bounce) => `bounce ${bounce}`), bounceGroup],
  surface: () => [BOUNCE_LOOKS, run.surfaces.slice(0, 8).map(({ name }) => name),
    (dot) => run.dots.surface[dot] % 4],
  red: () => [[["red", "circle"]], ["stored photon"], () => 0],
  kind: () => [KIND_LOOKS, run.comparison.legend, (dot) => run.dots.kind[dot]],
};

/** The bounce of a dot, counted from 0, as the table groups them. */
const bounceGroup = (dot) => clamp(run.dots.bounce[dot], 1, 4) - 1;

/** Whether a dot is counted in a cell of the table. */
const isIn = ({ surface, bounce }, dot) =>
  (surface < 0 || surface === run.dots.surface[dot]) && (bounce < 0 || bounce === bounceGroup(dot));

/** Shows the dots that the table and the filters leave, as the user wants them colored. */
function showDots() {
  const { dots, stored, firstExtra, comparison } = run, { only, lit } = page;
  const way = $("colors").value, [styles, names, styleOf] = WAYS[way]();
  const codes = styles.map((style) => look(...style));
  const unchecked = (id) =>
    new Set([...$(id).querySelectorAll("input:not(:checked)")].map(({ value }) => +value));
  const [bounces, surfaces] = [unchecked("by-bounce"), unchecked("by-surface")];
  const from = +$("from").value, to = +($("to").value || (from ? UNTOLD - 1 : UNTOLD));
  const isShown = (dot) =>
    !bounces.has(bounceGroup(dot)) && !surfaces.has(dots.surface[dot]) &&
    (!only || isIn(only, dot)) && dots.photon[dot] >= from && dots.photon[dot] <= to;
  const isLarge = way === "kind" && comparison.areFew;
  const looks = (page.looks = new Uint8Array(2 * dots.count));
  let shown = 0;
  for (let dot = 0; dot < (way === "kind" ? dots.count : stored); dot++) {
    if (!isShown(dot)) continue;
    looks[2 * dot] = codes[styleOf(dot)];
    looks[2 * dot + 1] = lit && isIn(lit, dot) ? 2 : isLarge && dots.kind[dot] ? 3 : 1;
    // A moved photon has two dots.
    shown += dot < stored || dot >= firstExtra;
  }
  $("shown").textContent =
    `${thousands(shown)} photon${shown === 1 ? "" : "s"} shown${only ? `: ${only.name}` : ""}.`;
  $("legend").replaceChildren(...names.map((name, i) => {
    const [color, shape] = styles[i % styles.length];
    const swatch = make("span", { className: "swatch", ariaHidden: "true" }, SHAPES[shape]);
    swatch.style.color = `var(--${color})`;
    return make("li", {}, swatch, ` ${name}`);
  }));
  if (!view) return;
  view.wallAlpha = $("walls").checked ? 1 : 0.16;
  view.dim = lit ? 0.15 : 1;
  view.setLayer("dots", "dots", [[dots.position, 3], [looks, 2], [dots.normal, 3]]);
  view.setLines("moved", movedLines());
}

/** Lines from where moved photons are to where they should be: of the open one, and of the cell
 * that is lit or else of some others. */
function movedLines() {
  const { movedIndex, stored, dots, place } = run, { lit, looks, photon } = page;
  const state = (k) => looks[2 * (stored + k) + 1];
  const isOpen = (k) => dots.photon[stored + k] === photon;
  const shown = [...movedIndex.keys()].filter((k) => (lit ? state(k) === 2 : state(k)));
  const every = Math.ceil(shown.length / (lit ? MOST_LIT_LINES : MOST_LINES));
  const faint = { width: 1, alpha: lit ? 0.7 : every > 1 ? 0.3 : 1 };
  return shown.filter((k, i) => i % every === 0 || isOpen(k)).map((k) => ({
    a: place(movedIndex[k]), b: place(stored + k), color: "moved",
    ...(isOpen(k) ? { width: 2.5 } : faint),
  }));
}

/** The table's cell under `event`, as what its photons have in common: -1 is anything. */
function cellOf({ target }) {
  const button = target.closest("#table button");
  if (!button) return null;
  const [surface, bounce] = button.value.split(" ").map(Number);
  return { button, surface, bounce, name: button.title };
}

/** Keeps the photons of a cell alone, or all if they are alone already. */
function keep(cell) {
  if (!cell) return;
  page.only = page.only?.button === cell.button ? null : cell;
  for (const button of $("table").querySelectorAll("button"))
    button.ariaPressed = String(button === page.only?.button);
  showDots();
}

function showChoices() {
  const box = (name, value) =>
    make("label", {}, make("input", { type: "checkbox", checked: true, value }), ` ${name}`);
  $("by-bounce").append(...BOUNCES.map(box));
  $("by-surface").append(...run.surfaces.map(({ name }, i) => box(name, i)));
  if (run.comparison) {
    $("colors").prepend(make("option", { value: "kind", selected: true }, "by difference"));
    $("comparison").open = window.matchMedia("(min-width: 901px) and (min-height: 501px)").matches;
  }
  for (const node of document.querySelectorAll(".prose"))
    node.replaceChildren(...prose(node.textContent));
}

function listen() {
  const clicks = {
    home: () => view?.look(run.camera),
    center,
    back: () => go(page.at - 1),
    forward: () => go(page.at + 1),
    play: () => play(page.timer === null),
    previous: () => skip(-1),
    next: () => skip(1),
    table: (event) => keep(cellOf(event)),
  };
  for (const [id, action] of Object.entries(clicks)) $(id).onclick = action;
  if (run.comparison) $("divergence").onclick = () => open(...run.start);
  for (const kind of ["pointerover", "focusin", "pointerout", "focusout"])
    $("table").addEventListener(kind, (event) => {
      page.lit = kind.endsWith("out") ? null : cellOf(event);
      showDots();
    });
  $("left").oninput = showDots;
  $("photon").onchange = () => open(+$("photon").value, 0, "emission");
  $("slider").oninput = () => go(+$("slider").value);
  window.onhashchange = followLink;
  window.matchMedia("(prefers-color-scheme: dark)").onchange = readColors;
  document.onkeydown = pressKey;
}

function pressKey(event) {
  const { target, key } = event;
  const isField = target.matches("select, input:not([type=range], [type=checkbox])");
  const isPressed = key === " " && target.matches("button, summary, input");
  const isCommand = event.ctrlKey || event.metaKey || event.altKey;
  if (isField || isPressed || isCommand || !page.steps.length) return;
  const bounceBy = (by) => () => goToBounce(page.steps[page.at].bounce + by);
  const move = (...by) => () => view?.move(...by);
  const actions = event.shiftKey && key.startsWith("Arrow")
    ? {
      ArrowLeft: move(-0.1, 0), ArrowRight: move(0.1, 0),
      ArrowUp: move(0, -0.1), ArrowDown: move(0, 0.1),
    } : {
      ArrowUp: bounceBy(-1), ArrowDown: bounceBy(1),
      "+": move(0, 0, 0.85), "=": move(0, 0, 0.85), "-": move(0, 0, 1.18),
    };
  // Buttons name their keys themselves.
  const name = key === " " ? "Space" : key.length === 1 ? key.toUpperCase() : key;
  const button = document.querySelector(`[aria-keyshortcuts="${CSS.escape(name)}"]`);
  const action = actions[key] ?? (button && (() => button.click()));
  if (!action) return;
  action();
  event.preventDefault();
}

async function start() {
  const meta = JSON.parse($("meta").textContent);
  if (typeof DecompressionStream === "undefined")
    throw new Error("This browser cannot inflate the data. Use a browser of 2024 or later.");
  run = unpack(meta, await readColumns(meta.sections));
  try {
    view = new View($("view"), placeLabels);
  } catch (error) {
    console.info(`no 3-D: ${error.message}`);
  }
  showChoices();
  listen();
  if (view) showBox();
  else showPicture();
  if (run.start) open(...run.start);
  followLink();
  view?.drawNow();
  view?.finish();
  // For the console and the tests.
  const firstFrame = performance.now();
  window.page = Object.assign(page, { run, view, firstFrame, open, go, movedLines });
  document.body.dataset.ready = "yes";
}
start().catch((error) => {
  $("trouble").textContent = error.message;
  $("trouble").hidden = false;
});
