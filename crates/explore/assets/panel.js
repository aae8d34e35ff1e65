// The page: the story of the open photon, step by step, beside the code.

function openDot(dot) {
  if (dot < 0) return;
  const photon = run.dots.photon[dot];
  if (photon === UNTOLD) say("This list does not tell the photon of its records.");
  else open(photon, run.dots.bounce[dot], "stored");
}

function say(words) {
  $("no-story").replaceChildren(...prose(words));
  $("no-story").hidden = words === "";
}

/** Opens `photon` at the step `name` of `bounce`, or as near to it as its path goes. */
function open(photon, bounce, name) {
  if (photon >= run.emitted)
    return say(`Expected a number below ${thousands(run.emitted)}, found ${photon}.`);
  if (photon !== page.photon) {
    const story = storyOf(run, photon);
    if (!story)
      return say(
        `Photon ${thousands(photon)} has no story here: it stores no photon${run.orLeftOut}. ` +
          `Run photon-mapping explore --photon ${photon} to get it.`);
    Object.assign(page, { photon, story, steps: stepsOf(run, story) });
    $("slider").max = page.steps.length - 1;
    if (run.comparison) showDots();
  }
  say("");
  const exact = page.steps.findIndex((step) => step.bounce === bounce && step.name === name);
  const near = page.steps.findLastIndex((step) => step.bounce <= bounce);
  go(exact >= 0 ? exact : near);
}

function go(at) {
  page.at = clamp(at, 0, page.steps.length - 1);
  const { bounce, name } = page.steps[page.at];
  page.link = `#photon=${page.photon}&bounce=${bounce}&step=${name}`;
  // Browsers refuse more than a few changes of the address a second.
  page.address ??= setTimeout(() => {
    page.address = null;
    history.replaceState(null, "", page.link);
  }, 120);
  showStep();
}

/** Opens what the address names, if it names anything. */
function followLink() {
  const link = new URLSearchParams(location.hash.slice(1));
  const photon = link.get("photon");
  if (location.hash === page.link || !/^\d+$/.test(photon)) return;
  open(Number(photon), Number(link.get("bounce")), link.get("step") ?? "emission");
}

/** Opens the next stored photon, or with `by` -1 the one before. */
function skip(by) {
  const { bounce, name } = page.steps[page.at];
  const stored = run.dots.photon.subarray(0, run.stored);
  const photon = by > 0
    ? stored.find((photon) => photon > page.photon)
    : stored.findLast((photon) => photon < page.photon);
  if (photon !== undefined) open(photon, bounce, name);
}

/** Goes to the same step of another bounce, or as near to it as the path goes. */
function goToBounce(bounce) {
  open(page.photon, bounce, page.steps[page.at].name);
}

function play(on) {
  const isLast = () => page.at + 1 === page.steps.length;
  clearInterval(page.timer);
  page.timer = on ? setInterval(() => (isLast() ? play(false) : go(page.at + 1)), 1800) : null;
  $("play").ariaPressed = String(on);
  $("play").textContent = on ? "Pause" : "Play";
  if (on && isLast()) go(0);
}

/** The code of the step `name`, which Rust wrote, with its titles. */
const codeOf = (name) => $(`code-${name}`);

function showStep() {
  const { steps, at } = page, step = steps[at];
  if (!step) return;
  const { title, dataset: { short } } = codeOf(step.name);
  $("photon").value = page.photon;
  $("slider").value = at;
  $("slider").setAttribute("aria-valuetext", `bounce ${step.bounce}, ${short}`);
  $("place").textContent = `${at + 1} of ${steps.length}`;
  $("step-title").textContent = title;
  $("say").replaceChildren(...step.say.map((words) => make("p", {}, words)));
  $("drawing").innerHTML = step.diagram?.() ?? "";
  $("more").replaceChildren(...(step.more ?? []).flatMap(([name, value]) =>
    [make("dt", {}, name), make("dd", {}, value)]));
  $("sides").hidden = !isDivergence(step);
  showChips(step);
  showCode(step);
  drawPath(step);
}

/** The bounces of the path, and the steps of the bounce that is open, as buttons. */
function showChips(here) {
  const { steps, at, story: { hits, ending } } = page, last = steps.length - 1;
  const chip = (words, isHere, onclick) => {
    const button = make("button", { onclick }, words);
    if (isHere) button.setAttribute("aria-current", "step");
    return button;
  };
  const bounces = hits.map(({ bounce, surface }) =>
    chip(`${bounce} ${surface}`, here.bounce === bounce, () => goToBounce(bounce)));
  const end = ending === "absorbed" ? "absorbed"
    : chip(ENDINGS[ending], at === last, () => go(last));
  const names = steps.map(({ bounce, name }, i) =>
    bounce === here.bounce ? chip(codeOf(name).dataset.short, i === at, () => go(i)) : "");
  $("path").replaceChildren("Bounce", ...bounces, end);
  $("names").replaceChildren(...names);
  // Where a row does not fit, the one that is open is in sight.
  for (const row of [$("path"), $("names")]) {
    const open = row.querySelector("[aria-current]");
    row.scrollLeft = open ? open.offsetLeft - row.offsetLeft - row.clientWidth / 3 : 0;
  }
}

/** Whether the lists part at `step`. */
const isDivergence = ({ bounce, name }) =>
  run.comparison?.parts && [page.photon, bounce, name].join() === run.start.join();

/** The code of a step, with values beside the lines that make them. */
function showCode({ name, holds, values }) {
  const code = $("code");
  code.replaceChildren(codeOf(name).content.cloneNode(true));
  for (const place of code.querySelectorAll(".value"))
    if (place.dataset.name in values) place.textContent = values[place.dataset.name];
    else place.remove();
  for (const [condition, is] of Object.entries(holds))
    for (const line of code.querySelectorAll(`.${condition}-${!is}`)) line.className = "skipped";
  // The first line that runs is the first in sight.
  for (const list of code.querySelectorAll("ol"))
    list.scrollTop = list.querySelector(".lit")?.offsetTop ?? 0;
}
