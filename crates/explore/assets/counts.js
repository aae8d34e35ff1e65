// The page: the run in numbers, its table, and the filters.

const countsMethods = {
  showRun() {
    const { run } = this;
    const thinned = run.keptOf > run.stored
      ? ` Of these the page has ${thousands(run.stored)}, evenly thinned.` : "";
    const counts = `${thousands(run.emitted)} emitted, ${thousands(run.keptOf)} stored`;
    $("run").textContent = `${counts}, seed ${run.seed}.${thinned}`;
    $("home").textContent = run.isHandout ? "Handout's camera" : "Whole scene";
    $("photon").max = run.emitted - 1;
  },

  showComparison() {
    const { comparison } = this.run;
    if (!comparison) return;
    $("comparison").hidden = false;
    $("comparison").classList.add(comparison.outcome);
    for (const id of ["verdict", "reason", "advice", "report"])
      $(id).replaceChildren(...prose(comparison[id]));
    $("divergence").hidden = comparison.photon === null;
    for (const kind of KINDS) {
      const words = ` ${thousands(comparison.counts[kind])} ${kind}`;
      $("differences").append(make("li", {}, swatch(...KIND_LOOKS[kind]), words));
    }
  },

  showTable() {
    const { run } = this;
    if (run.comparison)
      $("cells").textContent =
        `Stored by the reference, in orange by the ${run.comparison.kind}, then expected, ` +
        "then the reference's difference in standard deviations.";
    const heading = (name, scope) => make("th", { scope, textContent: name });
    const top = ["surface", ...run.columns].map((name) => heading(name, "col"));
    const row = ({ name, cells }, index) => {
      const surface = index < run.surfaces.length ? index : null;
      const made = cells.map((cell, column) => {
        const other = run.comparison?.table[index][column] ?? null;
        // The last column has all bounces, and the one before it all late ones.
        const last = cells.length - 1;
        const most = column < last - 1 ? column + 1 : Infinity;
        const bounces = [column === last ? 1 : column + 1, most];
        const only = { name: `${name}, ${run.columns[column]}`, surface, bounces };
        return this.cell({ ...cell, other }, only);
      });
      return make("tr", {}, heading(name, "row"), ...made);
    };
    $("table").append(
      make("thead", {}, make("tr", {}, ...top)), make("tbody", {}, ...run.rows.map(row)));
  },

  /** A cell of the table that lights and keeps the photons `only`. */
  cell({ stored, other, expected, z }, only) {
    const oneDigit = { maximumFractionDigits: 1, minimumFractionDigits: 1 };
    const words = [make("b", { textContent: thousands(stored) })];
    if (other !== null)
      words.push(make("b", { className: "extra", textContent: thousands(other) }));
    if (expected !== null)
      words.push(make("span", { textContent: expected.toLocaleString("en-US", oneDigit) }));
    if (z !== null) {
      const textContent = `${z < 0 ? "−" : "+"}${Math.abs(z).toFixed(1)} σ`;
      words.push(make("span", { className: Math.abs(z) > 4 ? "far" : "", textContent }));
    }
    const beside = expected === null ? "" : `, ${expected.toFixed(1)} expected`;
    const theirs = other === null ? "" : `, ${other} in the ${this.run.comparison.kind}`;
    const ariaLabel = `${only.name}: ${stored} stored${theirs}${beside}`;
    const button = make("button", { type: "button", ariaPressed: "false", ariaLabel }, ...words);
    const light = (lit) => {
      this.lit = lit;
      this.showDots();
    };
    for (const kind of ["pointerenter", "focus"]) button.addEventListener(kind, () => light(only));
    for (const kind of ["pointerleave", "blur"]) button.addEventListener(kind, () => light(null));
    button.addEventListener("click", () => {
      this.only = this.only === only ? null : only;
      for (const other of $("table").querySelectorAll("button"))
        other.ariaPressed = String(this.only !== null && other === button);
      this.showDots();
    });
    return make("td", {}, button);
  },

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
    const bounces = ["1", "2", "3", "4 or more"];
    $("by-bounce").append(...bounces.map((label, i) => box(label, this.bounces, i)));
    $("by-surface").append(...run.surfaces.map(({ name }, i) => box(name, this.surfaces, i)));
    const modes = { bounce: "by bounce", surface: "by surface", red: "plain red" };
    for (const [value, textContent] of Object.entries(modes))
      $("colors").append(make("option", { value, textContent }));
    if (run.comparison)
      $("colors").prepend(
        make("option", { value: "kind", textContent: "by difference", selected: true }));
  },
};

/** `words` for the page, in which no command and no option breaks at its hyphens. */
const prose = (words) =>
  words.split(/(--[\w-]+|photon-mapping \w+)/).map((part, i) =>
    i % 2 ? make("span", { className: "whole", textContent: part }) : part);

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
  const attributes = { viewBox: "0 0 14 14", class: `swatch ${color}`, "aria-hidden": "true" };
  return draw("svg", attributes, shapes[shape]());
}
