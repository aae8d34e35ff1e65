// The page: the run in numbers, its table, and the filters.

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
/** A dot, for legends. */
const swatch = (color, shape) => {
  const letter = make("span", { className: "swatch", ariaHidden: "true" }, SHAPES[shape]);
  letter.style.color = `var(--${color})`;
  return letter;
};

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
    $("comparison").open = window.matchMedia("(min-width: 901px) and (min-height: 501px)").matches;
    $("comparison").classList.add(comparison.outcome);
    for (const id of ["verdict", "reason", "advice", "report"])
      $(id).replaceChildren(...prose(comparison[id]));
    $("divergence").hidden = comparison.photon === null;
  },

  showTable() {
    const { run } = this;
    if (run.comparison)
      $("cells").textContent =
        `Stored by the reference, in orange by the ${run.comparison.kind}, then expected, ` +
        "then the reference's difference in standard deviations.";
    const heading = (name, scope) => make("th", { scope }, name);
    const last = run.headings.length - 1;
    const row = ({ name, cells }, index) => {
      const made = cells.map((cell, column) => {
        const other = run.comparison?.table[index][column] ?? null;
        // The last column has all bounces, and the one before it all late ones.
        return this.cell({ ...cell, other }, {
          name: `${name}, ${run.headings[column]}`,
          surface: index < run.surfaces.length ? index : null,
          least: column === last ? 1 : column + 1,
          most: column < last - 1 ? column + 1 : Infinity,
        });
      });
      return make("tr", {}, heading(name, "row"), ...made);
    };
    const top = ["surface", ...run.headings].map((name) => heading(name, "col"));
    $("table").append(
      make("thead", {}, make("tr", {}, ...top)), make("tbody", {}, ...run.rows.map(row)));
  },

  /** A cell of the table that lights and keeps the photons `only`. */
  cell({ stored, other, expected, z }, only) {
    const oneDigit = { maximumFractionDigits: 1, minimumFractionDigits: 1 };
    const words = [make("b", {}, thousands(stored))];
    if (other !== null) words.push(make("b", { className: "extra" }, thousands(other)));
    if (expected !== null)
      words.push(make("span", {}, expected.toLocaleString("en-US", oneDigit)));
    if (z !== null) {
      const className = Math.abs(z) > 4 ? "far" : "";
      words.push(make("span", { className }, `${z < 0 ? "−" : "+"}${Math.abs(z).toFixed(1)} σ`));
    }
    const button = make("button", { ariaPressed: "false" }, ...words);
    const light = (lit) => () => {
      this.lit = lit;
      this.showDots();
    };
    button.onpointerenter = button.onfocus = light(only);
    button.onpointerleave = button.onblur = light(null);
    button.onclick = () => {
      this.only = this.only === only ? null : only;
      for (const other of $("table").querySelectorAll("button"))
        other.ariaPressed = String(this.only !== null && other === button);
      this.showDots();
    };
    return make("td", {}, button);
  },

  showFilters() {
    const box = (name, value) =>
      make("label", {}, make("input", { type: "checkbox", checked: true, value }), ` ${name}`);
    $("by-bounce").append(...BOUNCES.map(box));
    $("by-surface").append(...this.run.surfaces.map(({ name }, i) => box(name, i)));
    if (this.run.comparison)
      $("colors").prepend(make("option", { value: "kind", selected: true }, "by difference"));
  },
};
