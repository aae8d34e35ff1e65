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
    const { run } = this, path = run.photons.indexOf(photon);
    if (photon >= run.emitted)
      return this.say(`Expected a number below ${thousands(run.emitted)}, found ${photon}.`);
    if (path < 0) {
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
      if (run.comparison) this.showDots();
    }
    const exact = this.steps.findIndex((step) => step.bounce === bounce && step.name === name);
    const near = this.steps.findLastIndex((step) => step.bounce <= bounce);
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
    let path = run.photons.indexOf(this.photon) + by;
    // A path of one hit or none stores nothing.
    while (run.pathHits[path] < 2) path += by;
    if (path >= 0 && path < run.paths) this.open(run.photons[path], bounce, name);
  },

  /** Goes to the same step of another bounce, or as near to it as the path goes. */
  goToBounce(bounce) {
    this.open(this.photon, bounce, this.steps[this.at].name);
  },

  play(on) {
    const isLast = () => this.at + 1 === this.steps.length;
    clearInterval(this.timer);
    this.timer =
      on ? setInterval(() => (isLast() ? this.play(false) : this.go(this.at + 1)), 1800) : null;
    $("play").ariaPressed = String(on);
    $("play").textContent = on ? "Pause" : "Play";
    if (on && isLast()) this.go(0);
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
    $("say").replaceChildren(...step.say.map((words) => make("p", {}, words)));
    $("drawing").replaceChildren(...(step.diagram ? [step.diagram()] : []));
    $("more").replaceChildren(...(step.more ?? []).flatMap(([name, value]) =>
      [make("dt", {}, name), make("dd", {}, value)]));
    this.showChips();
    this.showSides(step);
    showCode(run.source, source, step);
    this.drawPath(step);
  },

  /** The bounces of the path, and the steps of the bounce that is open, as buttons. */
  showChips() {
    const { steps, at, run, story: { hits, ending } } = this;
    const here = steps[at], last = steps.length - 1;
    const chip = (words, isHere, onclick) => {
      const button = make("button", { onclick }, words);
      if (isHere) button.setAttribute("aria-current", "step");
      return button;
    };
    const bounces = hits.map(({ bounce, surface }) =>
      chip(`${bounce} ${surface}`, here.bounce === bounce, () => this.goToBounce(bounce)));
    const end = steps[last].bounce === hits.length
      ? chip(ENDINGS[ending], at === last, () => this.go(last))
      : make("span", {}, ENDINGS[ending]);
    $("path").replaceChildren(make("span", {}, "Bounce"), ...bounces, end);
    $("names").replaceChildren(...steps.flatMap(({ bounce, name }, i) =>
      bounce === here.bounce
        ? [chip(run.source.steps[name].short, i === at, () => this.go(i))] : []));
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
    const row = (tag, cells) => make("tr", {}, ...cells.map((words) => make(tag, {}, words)));
    $("sides").replaceChildren(
      make("caption", {}, "Here the lists part"),
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
      const inLine = here.find((branch) => branch.code)?.code;
      const [before, after] = inLine ? words.split(inLine) : [words || " ", ""];
      const className = words.trim().startsWith("//") ? "comment" : "";
      const code = make("code", { className }, before,
        ...(inLine ? [make("span", { className: "skipped" }, inLine)] : []), after);
      const told = part.values.filter(([at, key]) => at === i && values[key] !== undefined);
      const state = here.some((branch) => !branch.code) ? "skipped"
        : isIn(part.lit, i) ? "lit" : "";
      return make("li", { value: first + i, className: state }, code, ...told.map(([, key]) => {
        const value = make("span", { className: "value" }, values[key]);
        value.dataset.name = key;
        return value;
      }));
    });
    const caption = make("figcaption", {}, make("b", {}, name), ` in ${file}`);
    return make("figure", {}, caption, make("ol", {}, ...rows));
  });
  $("code").replaceChildren(...figures);
  // The first line that runs is the first in sight.
  for (const list of $("code").querySelectorAll("ol"))
    list.scrollTop = list.querySelector(".lit")?.offsetTop ?? 0;
}
