// The page: the story of the open photon, step by step, beside the code.

function openDot(dot) {
  const photon = run.dotPhoton[dot];
  if (photon === UNTOLD) say("This list does not tell the photon of its records.");
  else if (dot >= 0) open(photon, run.dotBounce[dot], "stored");
}

/** Says `words`, and then a command that does not break at its hyphens. */
function say(words, command = "") {
  $("no-story").replaceChildren(words, make("span", { className: "whole" }, command));
  $("no-story").hidden = words === "";
}

/** Opens `photon` at the step `name` of `bounce`, or as near to it as its path goes. */
function open(photon, bounce, name) {
  if (!Number.isInteger(photon) || photon < 0 || photon >= run.emitted)
    return say(`Expected a whole number, 0 or more and below ${thousands(run.emitted)}.`);
  if (photon !== page.photon) {
    const story = storyOf(run, photon);
    if (!story)
      return say(
        `Photon ${thousands(photon)} has no story here: it stores no photon${run.orLeftOut}. ` +
          "To get it, run ", `photon-mapping explore --photon ${photon}`);
    Object.assign(page, { photon, story, steps: stepsOf(story) });
    $("slider").max = page.steps.length - 1;
  }
  say("");
  const exact = page.steps.findIndex((step) => step.bounce === bounce && step.name === name);
  go(exact >= 0 ? exact : page.steps.findLastIndex((step) => step.bounce <= bounce));
}

const linkTo = (photon, bounce, name) => `#photon=${photon}&bounce=${bounce}&step=${name}`;

/** Opens what the end of an address names, if it names anything that is not open. */
function followLink(hash) {
  const link = new URLSearchParams(hash.slice(1)), photon = link.get("photon");
  if (hash === page.link || !/^\d+$/.test(photon)) return;
  open(+photon, +link.get("bounce"), link.get("step") ?? "emission");
}

/** Goes to the step at the place `at`. */
function go(at) {
  page.at = clamp(at, 0, page.steps.length - 1);
  const step = (page.step = page.steps[page.at]);
  page.link = linkTo(page.photon, step.bounce, step.name);
  // Browsers refuse more than a few changes of the address a second.
  page.address ??= setTimeout(() => {
    page.address = null;
    history.replaceState(null, "", page.link);
  }, 120);
  showStep();
}

/** Goes to the same step of another bounce, or as near to it as the path goes. */
const goToBounce = (by) => open(page.photon, page.step.bounce + by, page.step.name);

/** Opens the next stored photon, or with `by` -1 the one before. */
function skip(by) {
  const stored = run.dotPhoton.subarray(0, run.stored), isNext = (x) => (x - page.photon) * by > 0;
  const photon = by > 0 ? stored.find(isNext) : stored.findLast(isNext);
  if (photon !== undefined) open(photon, page.step.bounce, page.step.name);
}

function play(on) {
  const isLast = () => page.at + 1 === page.steps.length;
  clearInterval(page.timer);
  page.timer = on ? setInterval(() => (isLast() ? play(false) : go(page.at + 1)), 1800) : null;
  $("play").ariaPressed = String(on);
  $("play").textContent = on ? "Pause" : "Play";
  if (on && isLast()) go(0);
}

function showStep() {
  const { photon, story, steps, at, step } = page;
  const { title, content, dataset: { short } } = $(`step-${step.name}`);
  $("photon").value = photon;
  $("slider").value = at;
  $("slider").ariaValueText = `bounce ${step.bounce}, ${short}`;
  $("place").textContent = `${at + 1} of ${steps.length}`;
  $("step-title").textContent = title;
  $("code").replaceChildren(content.cloneNode(true));
  fill($("code"), valuesOf(run, story, step));
  $("say").replaceChildren(...$("code").querySelectorAll("p"));
  // The first line that runs is the first in sight.
  for (const list of $("code").querySelectorAll("ol"))
    list.scrollTop = list.querySelector(".lit")?.offsetTop ?? 0;
  $("sides").hidden = !isDivergence();
  showChips();
  showPath();
}

/** Whether the lists part at the step that is open. */
const isDivergence = () => page.link === $("divergence")?.getAttribute("href");

/** The bounces of the path, and the steps of the bounce that is open, as links. */
function showChips() {
  const { photon, steps, step: here, story: { hits, ending } } = page;
  const short = (name) => $(`step-${name}`).dataset.short;
  const chip = (words, { bounce, name }, isHere) =>
    make("a", { href: linkTo(photon, bounce, name), ariaCurrent: isHere ? "step" : null }, words);
  const toBounce = (words, bounce) =>
    chip(words, { ...here, bounce }, bounce === here.bounce);
  const bounces = hits.map(({ bounce, surface }) => toBounce(`${bounce} ${surface}`, bounce));
  const end = ending ? toBounce(short(ending), hits.length) : "absorbed";
  $("path").replaceChildren("Bounce", ...bounces, end);
  $("names").replaceChildren(...steps.filter(({ bounce }) => bounce === here.bounce)
    .map((step) => chip(short(step.name), step, step === here)));
  // Where a row does not fit, the one that is open is in sight.
  for (const row of [$("path"), $("names")]) {
    const { offsetLeft } = row.querySelector("[aria-current]");
    row.scrollLeft = offsetLeft - row.offsetLeft - row.clientWidth / 3;
  }
}
