// The page: the story of the open photon, step by step, beside the code.

const panelMethods = {
  openStart() {
    const { comparison, start } = this.run;
    if (comparison && comparison.photon !== null) this.openDivergence();
    else if (this.run.paths) this.open(start, 0, "emission");
  },

  openDivergence() {
    const { photon, bounce, step } = this.run.comparison;
    this.open(photon, bounce, step);
  },

  say(words) {
    $("no-story").textContent = words;
    $("no-story").hidden = words === "";
  },

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
  },

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
  },

  /** Opens what the address names; says whether it names anything. */
  followLink() {
    if (location.hash === this.link) return true;
    const link = new URLSearchParams(location.hash.slice(1)),
      photon = Number(link.get("photon") ?? NaN);
    if (!Number.isInteger(photon) || photon < 0) return false;
    this.open(photon, Number(link.get("bounce") ?? 0), link.get("step") ?? "emission");
    return this.photon !== null;
  },

  /** Goes to the photon `by` stored paths on. */
  skip(by) {
    const { run } = this,
      here = run.pathOfPhoton(this.photon);
    let path = here + by;
    while (path >= 0 && path < run.paths && run.firstStored[path + 1] === run.firstStored[path])
      path += by;
    if (path >= 0 && path < run.paths)
      this.open(run.photons[path], this.steps[this.at].bounce, this.steps[this.at].name);
  },

  /** Goes to the same step of the bounce before (-1) or after (1). */
  changeBounce(by) {
    const { bounce, name } = this.steps[this.at],
      other = bounce + by;
    const of = this.steps.findIndex((step) => step.bounce === other && step.name === name);
    const first = this.steps.findIndex((step) => step.bounce === other);
    if (of >= 0 || first >= 0) this.go(of >= 0 ? of : first);
  },

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
  },

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
  },

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
  },

  /** Whether the lists part at `step`. */
  isDivergence(step) {
    const { comparison } = this.run;
    return (
      comparison !== null &&
      comparison.photon === this.photon &&
      comparison.bounce === step.bounce &&
      comparison.step === step.name
    );
  },

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
  },
};

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
