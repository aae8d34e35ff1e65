// The story of one photon: its steps, and what is written beside the code of each.

const about = (x) => `about ${Number(x.toPrecision(4))}`;
const near = (x) => `≈ ${Number(x.toPrecision(6))}`;
const degrees = (cosine) => `${((Math.acos(clamp(cosine, -1, 1)) * 180) / Math.PI).toFixed(1)}°`;

/** The steps of a story in order, by bounce and name. */
function stepsOf({ hits, ending }) {
  const steps = [{ bounce: 0, name: "emission" }];
  for (const { bounce, scattered } of hits) {
    const names = ["hit", "stored", "roulette"];
    if (scattered) names.push("hemisphere", "frame", "ray");
    steps.push(...names.map((name) => ({ bounce, name })));
  }
  if (ending) steps.push({ bounce: hits.length, name: ending });
  return steps;
}

/** The values of a step: those that `steps.html` and the code have places for, whether the branches
 * of both are taken, and the measures of the drawings. */
function valuesOf(run, story, { bounce, name }) {
  if (name === "emission") return valuesOfEmission(story);
  const remaining = { remaining_bounces: run.maxBounces - bounce, bounce_limit: name === "limit" };
  if (name === story.ending) return { ...remaining, "trace()": false, no_hit: name === "miss" };
  return { ...remaining, "trace()": true, no_hit: false, ...valuesOfHit(run, story, bounce) };
}

function valuesOfEmission({ tries, direction }) {
  const [x, y, z] = tries.at(-1), rejected = tries.length - 1, drawn = tries.length;
  return {
    x, y, z, direction, rejected, drawn, length_squared: lengthSquared(tries.at(-1)),
    loop: rejected === 0 ? "runs once" : `runs ${drawn} times`,
    in_sphere: true, is_first: rejected === 0,
    tries: tries.map(([x, y, z], i) => ({
      x, y, z, number: i + 1, point: [x, y, z], square: lengthSquared([x, y, z]),
      is_taken: i === rejected,
    })),
  };
}

function valuesOfHit(run, { hits, direction: emitted }, at) {
  const { bounce, surface, face, t, position, stored, scattered, ...hit } = hits[at];
  const { normal, tangent, bitangent, axis } = face;
  const arrival = bounce === 0 ? emitted : hits[bounce - 1].direction;
  const values = {
    hit_mesh_object: surface, facet: face.facet, distance: about(t), t, normal,
    intersection_point: position,
    is_front: dot(arrival, normal) <= 0, arrival: degrees(-dot(arrival, normal)),
    has_bounced: stored, "path.len()": bounce + 1, "photon_map.push()": stored ? "runs" : "skipped",
    to_light: stored ? scale(arrival, -1) : undefined,
    hit_primitive: `a triangle of face ${face.facet}`, diffuse_response: hit.diffuse,
    probability_of_reflection: hit.survival, u: hit.roulette, absorbed: !scattered,
  };
  if (!scattered) return values;
  const { u1, u2, direction } = hit;
  const r = Math.sqrt(u1), theta = 2 * Math.PI * u2, z = Math.sqrt(1 - u1);
  const start = position.map((p, i) => round(p + round(run.offset * normal[i])));
  return {
    ...values,
    u1, u2, r, z: round(Math.sqrt(round(1 - u1))), theta: near(theta),
    x: near(r * Math.cos(theta)), y: near(r * Math.sin(theta)), "ray_direction()": direction,
    about_r: about(r), about_z: about(z), turned: `${(u2 * 360).toFixed(1)}°`,
    way_to_n: degrees(z),
    parallel: about(Math.abs(normal[0])), is_parallel: isParallel(face), axis, tangent, bitangent,
    bare: about(face.bare), is_unit: isUnit(face),
    bare_to_n: degrees(dot(bareWay(hits[at]), normal)), world_space_direction: direction,
    nearly: `≈ (${direction.map((x) => Number(x.toPrecision(6))).join(", ")})`,
    bounces_left: run.maxBounces - bounce - 1,
    ...(run.offset && { start, offset: run.offset, start_error: round(run.offset / 2) }),
  };
}

/** Whether the normal is too close to the x axis, so that another axis builds t. */
const isParallel = ({ axis }) => axis[0] !== 1;
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
