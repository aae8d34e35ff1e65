// The story of one photon as steps: the text, the values beside each line, the lines in the box.

const ENDINGS =
  { left_the_scene: "leaves the scene", bounce_limit: "bounced as often as it may" };
const about = (x) => `about ${Number(x.toPrecision(4))}`;
const near = (x) => `≈ ${Number(x.toPrecision(6))}`;
const degrees = (cosine) => `${((Math.acos(clamp(cosine, -1, 1)) * 180) / Math.PI).toFixed(1)}°`;
/** Whether the normal is too close to the x axis, so that another axis builds t. */
const isParallel = ({ axis }) => axis[0] !== 1;
/** Whether n × axis is as long as t: to see, not to compute with. */
const isUnit = (bare) => Math.abs(bare - 1) < 1e-3;

/** The steps of `story` in order: {bounce, name, holds, say, values, more, lines, diagram}. `holds`
 * has the conditions of the port's branches. The `values` stand beside lines of the code, and
 * `more` stands beside none. Lines with a `name` have it at their end. */
function stepsOf(run, story) {
  const { hits, ending } = story;
  const steps = [emissionStep(story), ...hits.flatMap((hit) => stepsOfHit(run, story, hit))];
  const isLimit = ending === "bounce_limit";
  if (ending !== "absorbed")
    steps.push({
      bounce: hits.length,
      name: isLimit ? "limit" : "miss",
      holds: { bounce_limit: isLimit, no_hit: !isLimit },
      say: [isLimit
        ? "remainingBounces is less than 0, so the path ends."
        : "The ray meets no surface, so the photon leaves the scene and the path ends."],
      values: { remaining_bounces: String(run.maxBounces - hits.length), "trace()": "false" },
    });
  return steps;
}

function emissionStep({ tries, direction }) {
  const last = tries.length - 1, [x, y, z] = tries[last].map(digits);
  const square = (xyz) => digits(lengthSquared(xyz));
  return {
    bounce: 0,
    name: "emission",
    holds: { in_sphere: true },
    say: [
      "Points are drawn in the cube until one lies in the sphere. " +
        `Here ${last === 0 ? "the first one does" : `${last} of ${tries.length} are rejected`}.`,
      "The last point, normalized, is the direction in which the photon leaves the light.",
    ],
    values: {
      loop: `runs ${last === 0 ? "once" : `${tries.length} times`}`, x, y, z,
      length_squared: square(tries[last]), direction: vectorText(direction),
    },
    more: tries.map((xyz, i) => {
      const outcome = i === last ? "taken" : "rejected";
      return [`try ${i + 1}`, `${vectorText(xyz)}, x² + y² + z² = ${square(xyz)}: ${outcome}`];
    }),
    diagram: () => diagrams.cube(tries),
  };
}

function stepsOfHit(run, story, hit) {
  const { bounce, face, scattered, stored, position, direction } = hit;
  const size = run.size * 0.13;
  /** An arrow from the hit. */
  const arrow = (axis, color, name) =>
    ({ a: position, b: add(position, axis, size), color, width: 3, name });
  const arrows = {
    n: arrow(face.normal, "one", "n"), t: arrow(face.tangent, "extra", "t"),
    b: arrow(face.bitangent, "three", "b"), ray: direction && arrow(scale(direction, 1.5), "text"),
  };
  const arrival = bounce === 0 ? story.direction : story.hits[bounce - 1].direction;
  const steps = [hitStep(run, hit, arrival, arrows), storedStep(hit, arrival), rouletteStep(hit)];
  if (scattered)
    steps.push(hemisphereStep(hit, size), frameStep(hit, arrows), rayStep(run, hit, arrows));
  const holds = {
    bounce_limit: false, no_hit: false, has_bounced: stored, absorbed: !scattered,
    is_parallel: isParallel(face),
  };
  return steps.map((step) => ({ bounce, holds, ...step }));
}

function hitStep({ maxBounces }, { bounce, t, surface, position, face }, arrival, { n }) {
  const cosine = -dot(arrival, face.normal);
  return {
    name: "hit",
    say: [
      `The ray meets ${surface}, face ${face.facet}, at distance ${about(t)}.`,
      cosine >= 0
        ? `It arrives on the front: the angle to the normal is ${degrees(cosine)}.`
        : "It arrives from behind: the normal points away from it.",
    ],
    values: {
      remaining_bounces: String(maxBounces - bounce), "trace()": "true",
      intersection_point: vectorText(position),
    },
    more: [["t", digits(t)], ["normal", vectorText(face.normal)]],
    lines: [n],
  };
}

function storedStep({ bounce, stored }, arrival) {
  return {
    name: "stored",
    say: stored
      ? [`path has ${bounce + 1} elements: the photon has bounced before.`,
        "It is stored, with the way back to where it came from."]
      : ["path has one element, L: the photon comes straight from the light.",
        "It is not stored. The handout stores only photons that have bounced; " +
          "shadow rays bring the direct light."],
    values: {
      "path.len()": `${bounce + 1}`,
      "photon_map.push()": stored ? "runs" : "skipped",
      ...(stored && { to_light: vectorText(scale(arrival, -1)) }),
    },
  };
}

function rouletteStep({ surface, diffuse, survival, roulette, scattered, face }) {
  const [u, p] = [roulette, survival].map(digits);
  const outcome = scattered
    ? "less, so the photon scatters"
    : "not less, so the photon is absorbed here and its path ends";
  return {
    name: "roulette",
    say: [
      `P_r is the largest channel of the diffuse response: ${p}.`,
      `The random number ${u} is ${outcome}.`,
    ],
    values: {
      hit_primitive: `a triangle of face ${face.facet}`, hit_mesh_object: surface,
      diffuse_response: vectorText(diffuse), probability_of_reflection: p, "rand()": u,
    },
    diagram: () => diagrams.roulette(roulette, survival),
  };
}

function hemisphereStep({ position, direction, face, u1, u2 }, size) {
  const { normal, tangent, bitangent } = face;
  const r = Math.sqrt(u1), theta = 2 * Math.PI * u2, up = Math.sqrt(1 - u1);
  const [x, y] = [r * Math.cos(theta), r * Math.sin(theta)];
  const world = ([x, y, z]) =>
    add(add(add(position, tangent, size * x), bitangent, size * y), normal, size * z);
  // The rim of the hemisphere, and two arcs over it.
  const arc = (alpha, place) => {
    const points = Array.from({ length: 33 }, (_, i) => world(place((Math.PI * i) / 32)));
    return points.slice(1).map((b, i) => ({ a: points[i], b, color: "text", alpha }));
  };
  const [foot, top] = [world([x, y, 0]), world([x, y, up])];
  return {
    name: "hemisphere",
    say: [
      `u1 sets how far from the center of the disk: r is ${about(r)}. ` +
        `u2 sets the angle: theta is ${(u2 * 360).toFixed(1)}°.`,
      `Lifted to the hemisphere, the point has height ${about(up)}: ` +
        `the new direction is ${degrees(up)} from the normal.`,
    ],
    values: {
      u1: digits(u1), u2: digits(u2), r: digits(round(r)), theta: near(theta),
      x: near(x), y: near(y), z: digits(round(Math.sqrt(round(1 - u1)))),
      "ray_direction()": vectorText(direction),
    },
    lines: [
      ...arc(0.8, (at) => [Math.cos(2 * at), Math.sin(2 * at), 0]),
      ...arc(0.35, (at) => [Math.cos(at), 0, Math.sin(at)]),
      ...arc(0.35, (at) => [0, Math.cos(at), Math.sin(at)]),
      { a: foot, b: top, color: "text", dash: 6 },
      { a: position, b: foot, color: "extra", width: 2.5 },
      { a: position, b: top, color: "text", width: 3 },
    ],
    diagram: () => diagrams.hemisphere(r, theta, up),
  };
}

function frameStep({ face, direction, u1 }, { n, t, b, ray }) {
  const { normal, tangent, bitangent, bare, axis } = face;
  const axisName = `(${axis.join(", ")})`, parallel = about(Math.abs(normal[0]));
  // The direction as it would be with t and b of the length `bare`. In the box it is longer than
  // the true one, so that it is in sight behind it.
  const up = Math.sqrt(1 - u1), across = add(direction, normal, -up);
  const bareWay = unit(add(scale(across, bare), normal, up));
  const end = add(n.a, bareWay, 1.3 * Math.hypot(...add(ray.b, ray.a, -1)));
  const bareRay = { ...ray, b: end, color: "extra", dash: 7 };
  return {
    name: "frame",
    say: [
      `|n · x| is ${parallel}, ` + (isParallel(face)
        ? `too close to 1: n is parallel to the x axis, so ${axisName} builds t.`
        : `so the x axis ${axisName} builds t.`),
      isUnit(bare)
        ? "Here n × axis has length 1 already, so normalizing t and b changes nothing."
        : `n × axis has length ${about(bare)} before it is normalized. If t and b kept this ` +
          `length, the ray would leave ${degrees(dot(bareWay, normal))} from the normal, ` +
          `not ${degrees(up)}: the orange line. ` +
          "Over many photons, directions crowd around the normal.",
    ],
    values: {
      normal: vectorText(normal), is_parallel: String(isParallel(face)), axis: axisName,
      tangent: vectorText(tangent), bitangent: vectorText(bitangent),
      world_space_direction: `≈ (${direction.map((x) => Number(x.toPrecision(6))).join(", ")})`,
    },
    lines: isUnit(bare) ? [t, b, n, ray] : [bareRay, t, b, n, ray],
  };
}

function rayStep({ maxBounces, offset }, { position, direction, bounce, face }, { n, ray }) {
  const { normal } = face;
  const start = position.map((p, i) => round(p + round(offset * normal[i])));
  return {
    name: "ray",
    say: [
      "The new ray leaves along (x, y, z) in the frame: x t + y b + z n.",
      "It starts a little above the surface. The point hit is rounded and may lie below; " +
        "a ray from there would meet the same surface again.",
    ],
    values: {
      world_space_direction: vectorText(direction),
      ...(offset !== null && {
        start: vectorText(start), offset: digits(offset), start_error: digits(round(offset / 2)),
      }),
      remaining_bounces: String(maxBounces - bounce - 1),
    },
    lines: [ray, n],
    diagram: () => diagrams.offset(direction, normal, offset),
  };
}
