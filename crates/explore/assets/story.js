// The story of one photon: its steps, and what is written beside the code of each.

const about = (x) => `about ${Number(x.toPrecision(4))}`;
const near = (x) => `≈ ${Number(x.toPrecision(6))}`;
const degrees = (cosine) => `${((Math.acos(clamp(cosine, -1, 1)) * 180) / Math.PI).toFixed(1)}°`;

/** The steps of a story in order, by bounce and name. */
function stepsOf({ hits, ending }) {
  const names = ["hit", "stored", "roulette", "hemisphere", "frame", "ray"];
  const ofHit = ({ bounce, scattered }) =>
    names.slice(0, scattered ? 6 : 3).map((name) => ({ bounce, name }));
  const end = ending ? [{ bounce: hits.length, name: ending }] : [];
  return [{ bounce: 0, name: "emission" }, ...hits.flatMap(ofHit), ...end];
}

/** What a step shows: the values that `steps.html` and the code have places for, whether each of
 * their branches is taken, and the measures of the drawings. */
function valuesOf(run, story, { bounce, name }) {
  if (name === "emission") return valuesOfEmission(story);
  const remaining = { remaining_bounces: run.maxBounces - bounce, bounce_limit: name === "limit" };
  if (name === story.ending) return { ...remaining, "trace()": false, no_hit: name === "miss" };
  return { ...remaining, "trace()": true, no_hit: false, ...valuesOfHit(run, story, bounce) };
}

function valuesOfEmission({ tries, direction }) {
  const drawn = tries.length, is_first = drawn === 1, [x, y, z] = tries.at(-1);
  return {
    x, y, z, length_squared: lengthSquared([x, y, z]), in_sphere: true, direction,
    loop: is_first ? "runs once" : `runs ${drawn} times`, is_first, drawn, rejected: drawn - 1,
    tries: tries.map((point, i) => ({
      point, number: i + 1, x: point[0], y: point[1], z: point[2], square: lengthSquared(point),
      is_taken: i + 1 === drawn,
    })),
  };
}

function valuesOfHit(run, { hits, direction: emitted }, at) {
  const { face, bounce, position, stored, scattered, u1, u2, direction, ...hit } = hits[at];
  const { normal, bare } = face, arrival = hits[at - 1]?.direction ?? emitted;
  const values = {
    ...hit, ...face, hit_mesh_object: hit.surface, intersection_point: position,
    is_front: dot(arrival, normal) <= 0,
    arrival: degrees(-dot(arrival, normal)),
    has_bounced: stored, "path.len()": bounce + 1, "photon_map.push()": stored ? "runs" : "skipped",
    to_light: stored ? scale(arrival, -1) : undefined,
    hit_primitive: `a triangle of face ${face.facet}`, absorbed: !scattered,
  };
  if (!scattered) return values;
  const r = Math.sqrt(u1), theta = 2 * Math.PI * u2, z = Math.sqrt(1 - u1), { offset } = run;
  const start = position.map((p, i) => round(p + round(offset * normal[i])));
  return {
    ...values,
    u1, u2, r, z: round(Math.sqrt(round(1 - u1))), theta: near(theta),
    x: near(r * Math.cos(theta)), y: near(r * Math.sin(theta)), "ray_direction()": direction,
    about_r: about(r), about_z: about(z), turned: `${(u2 * 360).toFixed(1)}°`,
    way_to_n: degrees(z), bare_to_n: degrees(dot(bareWay(hits[at]), normal)),
    about_bare: about(bare), is_unit: isUnit(face),
    parallel: about(Math.abs(normal[0])), is_parallel: face.axis[0] !== 1,
    world_space_direction: direction, bounces_left: run.maxBounces - bounce - 1,
    nearly: `≈ (${direction.map((x) => Number(x.toPrecision(6))).join(", ")})`,
    ...(offset && { start, offset, start_error: round(offset / 2) }),
  };
}

/** Whether n × axis is as long as t: to see, not to compute with. */
const isUnit = ({ bare }) => Math.abs(bare - 1) < 1e-3;

/** The direction in which a hit would scatter if t and b had the length of n × axis. */
function bareWay({ face: { normal, bare }, direction, u1 }) {
  const up = scale(normal, Math.sqrt(1 - u1));
  return unit(add(up, add(direction, up, -1), bare));
}

/** Puts `values` into the places of `root` that have their names: numbers as their digits, and of a
 * list an entry into each copy of the place. Of a branch that is not taken, code is marked, and
 * words go. The style sheet reads numbers as the properties of their names. */
function fill(root, values) {
  for (const [name, value] of Object.entries(values))
    if (typeof value === "number") root.style.setProperty(`--${name}`, value);
    else if (typeof value === "boolean")
      for (const arm of root.querySelectorAll(`.${CSS.escape(name)}-${!value}`))
        if (arm.closest("ol")) arm.className = "skipped";
        else arm.remove();
  for (const place of root.querySelectorAll("[data-name]")) {
    const value = values[place.dataset.name];
    if (typeof value?.[0] === "object")
      place.replaceWith(...value.map((entry) => fill(place.cloneNode(true), entry)));
    else if (value === undefined) place.remove();
    else place.textContent = textOf(value);
  }
  return root;
}

const textOf = (value) =>
  typeof value === "number" ? digits(round(value))
    : Array.isArray(value) ? `(${value.map(textOf).join(", ")})` : String(value);
