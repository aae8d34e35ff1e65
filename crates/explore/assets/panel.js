// The page: the story of the open photon, step by step, beside the code.

const panelMethods = {
  /** Opens what the address names, or else the first divergence or the first photon. */
  openStart() {
    if (this.followLink()) return;
    const words = $("no-story").textContent;
    const { comparison, start, paths } = this.run;
    if (comparison && comparison.photon !== null) this.openDivergence();
    else if (paths) this.open(start, 0, "emission");
    // The photon of the address may have no story.
    this.say(words);
  },

  openDivergence() {
    const { photon, bounce, step } = this.run.comparison;
    this.open(photon, bounce, step);
  },

  say(words) {
    $("no-story").replaceChildren(...prose(words));
    $("no-story").hidden = words === "";
  },

  /** Opens `photon` at the step `name` of `bounce`, or as near to it as its path goes. */
  open(photon, bounce, name) {
    const { run } = this, path = run.pathOfPhoton(photon);
    if (path < 0) {
      if (photon >= run.emitted) {
        return this.say(`Expected a number below ${thousands(run.emitted)}, found ${photon}.`);
      }
      const orLeftOut = run.keptOf > run.stored ? ", or the page leaves it out" : "";
      return this.say(
        `Photon ${thousands(photon)} has no story here: it stores no photon${orLeftOut}. ` +
          `Run photon-mapping explore --photon ${photon} to get it.`);
    }
    this.say("");
    if (photon !== this.photon) {
      this.photon = photon;
      this.story = run.story(path);
      this.steps = stepsOf(run, this.story);
      $("slider").max = this.steps.length - 1;
      if (run.sections.moved_index) this.showDots();
    }
    const exact = this.steps.findIndex((step) => step.bounce === bounce && step.name === name);
    const near = this.steps.findLastIndex((step) =>
      step.bounce <= bounce && (step.bounce < bounce || name !== "emission"));
    this.go(exact >= 0 ? exact : near);
  },

  go(at) {
    this.at = clamp(at, 0, this.steps.length - 1);
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
    const link = new URLSearchParams(location.hash.slice(1));
    const photon = Number(link.get("photon") ?? NaN);
    if (!Number.isInteger(photon) || photon < 0) return false;
    this.open(photon, Number(link.get("bounce") ?? 0), link.get("step") ?? "emission");
    return this.photon !== null;
  },

  /** Goes to the photon `by` stored paths on. */
  skip(by) {
    const { run } = this, { bounce, name } = this.steps[this.at];
    let path = run.pathOfPhoton(this.photon) + by;
    while (run.firstStored[path + 1] === run.firstStored[path] && path >= 0 && path < run.paths)
      path += by;
    if (path >= 0 && path < run.paths) this.open(run.photons[path], bounce, name);
  },

  /** Goes to the same step of the bounce before (-1) or after (1). */
  changeBounce(by) {
    const { bounce, name } = this.steps[this.at];
    const isThere = (step) => step.bounce === bounce + by;
    const same = this.steps.findIndex((step) => isThere(step) && step.name === name);
    const at = same >= 0 ? same : this.steps.findIndex(isThere);
    if (at >= 0) this.go(at);
  },

  play(on) {
    const next = () => (this.at + 1 < this.steps.length ? this.go(this.at + 1) : this.play(false));
    clearInterval(this.timer);
    this.timer = on ? setInterval(next, 1800) : null;
    $("play").ariaPressed = String(on);
    $("play").textContent = on ? "Pause" : "Play";
    if (on && this.at + 1 === this.steps.length) this.go(0);
  },

  showStep() {
    const { run, steps, at } = this, step = steps[at];
    if (!step) return;
    const source = run.source.steps[step.name];
    $("photon").value = this.photon;
    $("slider").value = at;
    $("slider").setAttribute("aria-valuetext", `bounce ${step.bounce}, ${source.short}`);
    $("place").textContent = `${at + 1} of ${steps.length}`;
    $("step-title").textContent = source.title;
    $("say").replaceChildren(...step.say.map((words) => make("p", { textContent: words })));
    $("drawing").replaceChildren(...(step.diagram ? [step.diagram()] : []));
    const more = (step.more ?? []).map(([name, value]) =>
      [make("dt", { textContent: name }), make("dd", { textContent: value })]);
    $("more").replaceChildren(...more.flat());
    this.showChips();
    this.showSides(step);
    showCode(run.source, source, step);
    this.drawPath(step);
  },

  showChips() {
    const { steps, at, run, story: { hits, ending } } = this;
    const here = steps[at], last = steps.length - 1;
    const chip = (words, isHere, action) => {
      const button = make("button", { type: "button", textContent: words });
      if (isHere) button.setAttribute("aria-current", "step");
      button.addEventListener("click", action);
      return button;
    };
    const bounces = hits.map(({ bounce, surface }) =>
      chip(`${bounce} ${surface}`, here.bounce === bounce, () =>
        this.changeBounce(bounce - this.steps[this.at].bounce)));
    const end = ENDINGS[ending];
    bounces.push(steps[last].bounce === hits.length
      ? chip(end, at === last, () => this.go(last))
      : make("span", { textContent: end }));
    $("path").replaceChildren(make("span", { textContent: "Bounce" }), ...bounces);
    const names = steps.flatMap(({ bounce, name }, i) =>
      bounce === here.bounce
        ? [chip(run.source.steps[name].short, i === at, () => this.go(i))] : []);
    $("names").replaceChildren(...names);
    // Where a row does not fit, the one that is open is in sight.
    for (const row of [$("path"), $("names")]) {
      const open = row.querySelector("[aria-current]");
      row.scrollLeft = open ? open.offsetLeft - row.offsetLeft - row.clientWidth / 3 : 0;
    }
  },

  /** Whether the lists part at `step`. */
  isDivergence({ bounce, name }) {
    const parting = this.run.comparison;
    return parting?.photon === this.photon && parting.bounce === bounce && parting.step === name;
  },

  /** Both lists' values side by side, at the step where they part. */
  showSides(step) {
    const { comparison } = this.run, isHere = this.isDivergence(step);
    $("sides").hidden = !isHere;
    if (!isHere) return;
    const row = (tag, cells) =>
      make("tr", {}, ...cells.map((words) => make(tag, { textContent: words })));
    $("sides").replaceChildren(
      make("caption", { textContent: "Here the lists part" }),
      row("th", ["", "reference", comparison.kind]),
      ...comparison.sides.map((cells) => row("td", cells)));
  },
};

/** The port's functions of a step, the lines that run lit, values beside the lines that make
 * them. */
function showCode(source, { parts }, { holds, values }) {
  const isIn = ([from, to], i) => i >= from && i <= to;
  const figures = parts.map((part) => {
    const { name, file, first, lines, branches } = source.functions[part.function];
    const skipped = branches.filter((branch) => holds[branch.condition] !== branch.holds);
    const rows = lines.map((words, i) => {
      const here = skipped.filter((branch) => isIn(branch.lines, i));
      const isSkipped = here.some((branch) => !branch.code), isLit = isIn(part.lit, i);
      const code = make("code", { textContent: words || " " });
      code.classList.toggle("comment", words.trim().startsWith("//"));
      for (const { code: part } of here.filter((branch) => branch.code)) {
        const [before, after] = words.split(part);
        code.replaceChildren(before, make("span", { className: "skipped", textContent: part }),
          after);
      }
      const className = isSkipped ? "skipped" : isLit ? "lit" : "";
      const row = make("li", { value: first + i, className }, code);
      for (const [at, key] of part.values) {
        if (at !== i || values[key] === undefined) continue;
        const value = make("span", { className: "value", textContent: values[key] });
        value.dataset.name = key;
        row.append(value);
      }
      return row;
    });
    const caption = make("figcaption", {}, make("b", { textContent: name }), ` in ${file}`);
    return make("figure", {}, caption, make("ol", {}, ...rows));
  });
  $("code").replaceChildren(...figures);
  // The first line that runs is the first in sight.
  for (const list of $("code").querySelectorAll("ol"))
    list.scrollTop = list.querySelector(".lit")?.offsetTop ?? 0;
}
