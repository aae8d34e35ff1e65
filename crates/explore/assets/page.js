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

/** What is open: a photon, its story and its steps, and what is drawn over the box. Then the timer
 * that plays the steps, and the cell of the table that is lit. */
const page = { steps: [], over: [], timer: null, lit: null };
let run, view;

/** The photon of a dot whose list does not tell it. */
const UNTOLD = 0xffffffff;

/** The ways to color the dots: colors with shapes, their names, and which is a dot's. */
const FOUR = ["one ●", "two ■", "three ◆", "four ▲"];
const WAYS = {
  bounce: () => [FOUR, ["1", "2", "3", "4 or more"].map((at) => `bounce ${at}`), bounceGroup],
  surface: () =>
    [FOUR, run.surfaces.slice(0, 8).map(({ name }) => name), (dot) => run.dots.surface[dot] % 4],
  red: () => [["red ●"], ["stored photon"], () => 0],
  kind: () => [["gray ●", "missing ○", "moved ◆", "extra ×"], run.comparison.legend,
    (dot) => run.dots.kind[dot]],
};

/** The bounce of a dot, counted from 0, as the table groups them. */
const bounceGroup = (dot) => clamp(run.dots.bounce[dot], 1, 4) - 1;

/** Which dots are counted in the cell `button` of the table, whose value names a surface and a
 * bounce; -1 is any. */
function isIn(button) {
  const [surface, bounce] = button.value.split(" ").map(Number);
  return (dot) => (surface < 0 || surface === run.dots.surface[dot]) &&
    (bounce < 0 || bounce === bounceGroup(dot));
}

/** Shows the dots that the table and the filters leave, as the user wants them colored. */
function showDots() {
  const { dots, stored, firstExtra, comparison } = run, way = $("colors").value;
  const [styles, names, styleOf] = WAYS[way](), [colors, shapes] = [0, 1].map((part) =>
    styles.map((style) => style.split(" ")[part]));
  const alone = $("table").querySelector("[aria-pressed=true]");
  const isAlone = alone && isIn(alone), isLit = page.lit && isIn(page.lit);
  const [bounces, surfaces] = ["thead", "tbody"].map((part) => new Set(
    [...$("table").querySelectorAll(`${part} input:not(:checked)`)].map(({ value }) => +value)));
  const from = +$("from").value, to = +($("to").value || (from ? UNTOLD - 1 : UNTOLD));
  const isShown = (dot) =>
    !bounces.has(bounceGroup(dot)) && !surfaces.has(dots.surface[dot]) &&
    isAlone?.(dot) !== false && dots.photon[dot] >= from && dots.photon[dot] <= to;
  const isLarge = way === "kind" && comparison.areFew;
  const bytes = colors.map((color) => colorOf(color, isLit ? 0.15 : 1));
  const [painted, looks] = [new Uint8Array(4 * dots.count), new Uint8Array(2 * dots.count)];
  let shown = 0;
  for (let dot = 0; dot < (way === "kind" ? dots.count : stored); dot++) {
    if (!isShown(dot)) continue;
    const style = styleOf(dot), state = isLit?.(dot) ? 2 : isLarge && dots.kind[dot] ? 3 : 1;
    painted.set(bytes[style], 4 * dot);
    if (state === 2) painted[4 * dot + 3] = 255;
    looks.set([SHAPES.indexOf(shapes[style]), state], 2 * dot);
    // A moved photon has two dots.
    shown += dot < stored || dot >= firstExtra;
  }
  $("shown").textContent =
    `${thousands(shown)} photon${shown === 1 ? "" : "s"} shown${alone ? `: ${alone.title}` : ""}.`;
  $("legend").replaceChildren(...names.map((name, i) => {
    const style = i % styles.length;
    const swatch = make("span", { className: "swatch", ariaHidden: "true" }, shapes[style]);
    swatch.style.color = `var(--${colors[style]})`;
    return make("li", {}, swatch, ` ${name}`);
  }));
  view.alpha = $("walls").checked ? 1 : 0.16;
  view.setLayer("dots", "POINTS", dots.position, painted, dots.normal, looks);
  page.looks = looks;
  showMoved();
}

/** Lines from where moved photons are to where they should be: of the cell that is lit, or else of
 * some. More would hide the box. */
function showMoved() {
  const { movedIndex, stored, place } = run, { lit, looks } = page, most = lit ? 1000 : 150;
  const state = (k) => looks[2 * (stored + k) + 1];
  const shown = [...movedIndex.keys()].filter((k) => (lit ? state(k) === 2 : state(k)));
  const every = Math.ceil(shown.length / most);
  const lines = shown.filter((k, i) => i % every === 0)
    .map((k) => [place(movedIndex[k]), place(stored + k)]);
  setLines("moved", lines, colorOf("moved", lit ? 0.7 : every > 1 ? 0.3 : 1));
}

/** Keeps the photons of a cell alone, or all if they are alone already. */
function keep({ target }) {
  const cell = target.closest("#table button"), isAlone = cell?.ariaPressed === "true";
  if (!cell) return;
  for (const button of $("table").querySelectorAll("button"))
    button.ariaPressed = String(button === cell && !isAlone);
  showDots();
}

/** What buttons and keys do: the button's id if there is one, its key, the action. */
const ACTIONS = [
  ["back", "ArrowLeft", () => go(page.at - 1)],
  ["forward", "ArrowRight", () => go(page.at + 1)],
  ["", "ArrowUp", () => goToBounce(-1)],
  ["", "ArrowDown", () => goToBounce(1)],
  ["play", "Space", () => play(!page.timer)],
  ["previous", "P", () => skip(-1)],
  ["next", "N", () => skip(1)],
  ["home", "H", () => view.look(run.camera)],
  ["center", "C", center],
  ["", "+", () => view.move(0, 0, 0.85)],
  ["", "=", () => view.move(0, 0, 0.85)],
  ["", "-", () => view.move(0, 0, 1.18)],
  ["", "Shift+ArrowLeft", () => view.move(-0.1, 0)],
  ["", "Shift+ArrowRight", () => view.move(0.1, 0)],
  ["", "Shift+ArrowUp", () => view.move(0, -0.1)],
  ["", "Shift+ArrowDown", () => view.move(0, 0.1)],
];

function listen() {
  for (const [id, key, action] of ACTIONS)
    if (id) Object.assign($(id), { onclick: action, ariaKeyShortcuts: key });
  $("table").onclick = keep;
  for (const kind of ["pointerover", "focusin", "pointerout", "focusout"])
    $("table").addEventListener(kind, ({ target }) => {
      page.lit = kind.endsWith("out") ? null : target.closest("#table button");
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
  if (isField || isPressed || event.ctrlKey || event.metaKey || event.altKey) return;
  const shift = event.shiftKey && key.startsWith("Arrow") ? "Shift+" : "";
  const name = key === " " ? "Space" : key.length === 1 ? key.toUpperCase() : key;
  const found = ACTIONS.find(([, key]) => key === shift + name);
  if (!found || !page.steps.length) return;
  found[2]();
  event.preventDefault();
}

async function start() {
  const meta = JSON.parse($("meta").textContent);
  run = unpack(meta, await readColumns(meta.sections));
  view = new View($("view"), placePath);
  for (const node of document.querySelectorAll(".prose"))
    node.replaceChildren(...prose(node.textContent));
  if (run.comparison) {
    $("colors").prepend(make("option", { value: "kind", selected: true }, "by difference"));
    $("comparison").open = window.matchMedia("(min-width: 901px) and (min-height: 501px)").matches;
  }
  listen();
  if (view.gl) showBox();
  else showPicture();
  if (run.start) open(...run.start);
  followLink();
  view.drawNow();
  view.finish();
  // For the console and the tests.
  const firstFrame = performance.now();
  window.page = Object.assign(page, { run, view, firstFrame, open, go });
  document.body.dataset.ready = "yes";
}
start().catch((error) => {
  $("trouble").textContent = `This page needs a browser of 2024 or later. ${error.message}`;
  $("trouble").hidden = false;
});
