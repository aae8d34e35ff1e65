// The page: the run in numbers, its table, and the filters.

const countsMethods = {
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
  },

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
  },

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
  },
};

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
