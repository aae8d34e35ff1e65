// The page: what the user chose, and everything that follows from it.

const $ = (id) => document.getElementById(id);
const make = (tag, properties, ...children) => {
  const node = Object.assign(document.createElement(tag), properties);
  node.append(...children);
  return node;
};

/** What is open: a photon, its story and steps, and what is drawn over the box. Then the timer that
 * plays the steps. */
const page = { steps: [], over: [], timer: null };
let run, view;

/** The photon of a dot whose list does not tell it. */
const UNTOLD = 0xffffffff;

/** The ways to color the dots: colors with shapes, their names, and which is a dot's. */
const FOUR = ["one ●", "two ■", "three ◆", "four ▲"];
const WAYS = {
  bounce: () => [FOUR, ["1", "2", "3", "4 or more"].map((at) => `bounce ${at}`), bounceGroup],
  surface: () =>
    [FOUR, run.surfaces.slice(0, 8).map(({ name }) => name), (dot) => run.dotSurface[dot] % 4],
  red: () => [["red ●"], ["stored photon"], () => 0],
  kind: () => [["gray ●", "missing ○", "moved ◆", "extra ×"], run.comparison.legend,
    (dot) => run.dotKind[dot]],
};

/** The bounce of a dot, counted from 0, as the table groups them. */
const bounceGroup = (dot) => clamp(run.dotBounce[dot], 1, 4) - 1;

/** Tells of a dot whether the cell `button` of the table counts it. The button's value names a
 * surface and a bounce; -1 is any. */
function isIn(button) {
  const [surface, bounce] = button.value.split(" ").map(Number);
  return (dot) => (surface < 0 || surface === run.dotSurface[dot]) &&
    (bounce < 0 || bounce === bounceGroup(dot));
}

/** Shows the dots that the table and the range leave, as the user wants them colored. */
function showDots() {
  const { dotPosition, dotNormal, dotPhoton, dotSurface, dotKind, stored, movedIndex } = run;
  const way = $("colors").value, [styles, names, styleOf] = WAYS[way](), count = dotKind.length;
  const painted = new Uint32Array(count), looks = new Uint16Array(count);
  const [colors, shapes] = [0, 1].map((part) => styles.map((style) => style.split(" ")[part]));
  const alone = $("table").querySelector("[aria-pressed=true]");
  const lit = (page.lit = $("table").querySelector("button:is(:hover, :focus-visible)"));
  const isAlone = alone ? isIn(alone) : () => true, isLit = lit ? isIn(lit) : () => false;
  const [bounces, surfaces] = ["thead", "tbody"].map((part) =>
    [...$("table").querySelectorAll(`${part} input:not(:checked)`)].map(({ value }) => +value));
  const from = +$("from").value, to = +($("to").value || (from ? UNTOLD - 1 : UNTOLD));
  const isShown = (dot) => isAlone(dot) && dotPhoton[dot] >= from && dotPhoton[dot] <= to &&
    !bounces.includes(bounceGroup(dot)) && !surfaces.includes(dotSurface[dot]);
  const isLarge = way === "kind" && run.comparison.areFew;
  const paints = colors.map((color) =>
    new Uint32Array(Uint8Array.from(colorOf(color, lit ? 0.15 : 1)).buffer)[0]);
  let shown = 0;
  for (let dot = 0; dot < (way === "kind" ? count : stored); dot++) {
    if (!isShown(dot)) continue;
    const style = styleOf(dot), state = isLit(dot) ? 2 : isLarge && dotKind[dot] ? 3 : 1;
    painted[dot] = paints[style] | (state === 2 ? 0xff000000 : 0);
    looks[dot] = SHAPES.indexOf(shapes[style]) | (state << 8);
    // A moved photon has two dots.
    shown += dot < stored || dot >= stored + movedIndex.length;
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
  view.air = scale(colorOf("air").slice(0, 3), 1 / 255);
  setLines("edges", run.edgeEnds, colorOf("edge"));
  page.looks = new Uint8Array(looks.buffer);
  view.setLayer("dots", "POINTS",
    dotPosition, new Uint8Array(painted.buffer), dotNormal, page.looks);
  showMoved();
}

/** Lines from where moved photons are to where they should be: of the cell that is lit, or else of
 * some. More would hide the box. */
function showMoved() {
  const { movedIndex, stored, place } = run, { lit, looks } = page, most = lit ? 1000 : 150;
  const state = (k) => looks[2 * (stored + k) + 1];
  const shown = [...movedIndex.keys()].filter((k) => (lit ? state(k) === 2 : state(k)));
  const ends = shown.slice(0, most).flatMap((k) => [...place(movedIndex[k]), ...place(stored + k)]);
  const alpha = lit ? 0.7 : shown.length > most ? 0.3 : 1;
  setLines("moved", new Float32Array(ends), colorOf("moved", alpha));
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
  ["", "-", () => view.move(0, 0, 1.18)],
  ["", "Shift+ArrowLeft", () => view.move(-0.1, 0)],
  ["", "Shift+ArrowRight", () => view.move(0.1, 0)],
  ["", "Shift+ArrowUp", () => view.move(0, -0.1)],
  ["", "Shift+ArrowDown", () => view.move(0, 0.1)],
];

function listen() {
  for (const [id, key, action] of ACTIONS)
    if (id) Object.assign($(id), { onclick: () => page.step && action(), ariaKeyShortcuts: key });
  for (const kind of ["mouseover", "focusin", "mouseout", "focusout"])
    $("table").addEventListener(kind, showDots);
  $("table").onclick = keep;
  $("left").oninput = showDots;
  $("photon").onchange = () => open($("photon").valueAsNumber, 0, "emission");
  $("slider").oninput = () => go(+$("slider").value);
  window.onhashchange = () => followLink(location.hash);
  // The address lags behind what is open, so it may not change when a link is followed.
  document.onclick = ({ target }) => followLink(target.closest("a")?.hash ?? "");
  window.matchMedia("(prefers-color-scheme: dark)").onchange = showDots;
  document.onkeydown = pressKey;
}

function pressKey(event) {
  const { target, key } = event;
  const isField = target.matches("select, input:not([type=range], [type=checkbox])");
  const isPressed = key === " " && target.matches("button, summary, input");
  if (isField || isPressed || event.ctrlKey || event.metaKey || event.altKey) return;
  const shift = event.shiftKey && key.startsWith("Arrow") ? "Shift+" : "";
  const name = { " ": "Space", "=": "+" }[key] ?? (key.length > 1 ? key : key.toUpperCase());
  const found = ACTIONS.find(([, key]) => key === shift + name);
  if (!found || !page.step) return;
  found[2]();
  event.preventDefault();
}

async function start() {
  const { sections, scene, ...meta } = JSON.parse($("meta").textContent);
  run = addPaths({ ...meta, ...scene, ...(await readColumns(sections)) });
  run.place = (dot) => vectorOf(run.dotPosition, dot);
  view = new View($("view"), placePath);
  if (run.comparison)
    $("comparison").open = window.matchMedia("(min-width: 901px) and (min-height: 501px)").matches;
  listen();
  if (view.gl) showBox();
  else showPicture();
  if (run.start) open(...run.start);
  followLink(location.hash);
  view.drawNow();
  view.finish();
  // For the console and the tests.
  window.page = Object.assign(page, { run, view, firstFrame: performance.now(), open, go });
  document.body.dataset.ready = "yes";
}
start().catch((error) => {
  $("trouble").textContent = `This page needs a browser of 2024 or later. ${error.message}`;
  $("trouble").hidden = false;
});
