// The story of one photon as steps: the text, the values beside each line, the lines in the box.

const ENDINGS = {
  absorbed: "absorbed",
  left_the_scene: "leaves the scene",
  bounce_limit: "bounced as often as it may",
};
const about = (x, places = 4) => `about ${Number(x.toPrecision(places))}`;
const near = (x) => `≈ ${Number(x.toPrecision(6))}`;
const degrees = (cosine) =>
  `${((Math.acos(Math.min(Math.max(cosine, -1), 1)) * 180) / Math.PI).toFixed(1)}°`;

/** The steps of `story` in order: {bounce, name, say, values, more, marks, lines, diagram}. */
function stepsOf(run, story) {
  const { tries, direction, hits, light } = story;
  const [x, y, z] = tries.at(-1);
  const rejected = tries.length - 1;
  const [lies, they] = rejected === 1 ? ["lies", "it is"] : ["lie", "they are"];
  const steps = [
    {
      bounce: 0,
      name: "emission",
      say: [
        rejected === 0
          ? "The first point drawn in the cube lies in the sphere, so it is taken."
          : `${rejected} of ${tries.length} points drawn in the cube ${lies} outside the sphere, ` +
            `so ${they} rejected. The last one is taken.`,
        "Normalized, it is the direction in which the photon leaves the light.",
      ],
      values: {
        x: digits(x),
        y: digits(y),
        z: digits(z),
        length_squared: digits(lengthSquared([x, y, z])),
        direction: vectorText(direction),
      },
      more: tries.map((xyz, i) => [
        `try ${i + 1}`,
        `${vectorText(xyz)}, x² + y² + z² = ${digits(lengthSquared(xyz))}: ` +
          (i === rejected ? "taken" : "rejected"),
      ]),
      diagram: () => diagrams.cube(tries),
    },
  ];
  hits.forEach((hit, bounce) => steps.push(...stepsOfHit(run, story, hit, bounce)));
  if (story.ending !== "absorbed") {
    const isLimit = story.ending === "bounce_limit";
    steps.push({
      bounce: hits.length,
      name: isLimit ? "limit" : "miss",
      say: [
        isLimit
          ? "remainingBounces is less than 0, so the path ends."
          : "The ray meets no surface, so the photon leaves the scene and the path ends.",
      ],
      values: { remaining_bounces: String(run.maxBounces - hits.length), "trace()": "false" },
      more: [],
    });
  }
  return steps;
}

function stepsOfHit(run, story, hit, bounce) {
  const { hits } = story;
  const arrival = bounce === 0 ? story.direction : hits[bounce - 1].direction;
  const from = bounce === 0 ? story.light.position : hits[bounce - 1].position;
  const { normal, surface, roulette, survival, scattered, position } = hit;
  const cosine = -dot(arrival, normal);
  const place = `${surface}, face ${hit.facet}`;
  const arrow = run.size * 0.13;
  const normalLine = { a: position, b: add(position, normal, arrow), color: "n", width: 3 };
  const steps = [
    {
      name: "hit",
      say: [
        `The ray meets ${place}, at distance ${about(hit.t)}.`,
        cosine >= 0
          ? `It arrives on the front: the angle to the normal is ${degrees(cosine)}.`
          : "It arrives from behind: the normal points away from it.",
      ],
      values: {
        remaining_bounces: String(run.maxBounces - bounce),
        intersection_t: digits(hit.t),
        intersection_point: vectorText(position),
        "trace()": "true",
      },
      more: [
        ["surface", place],
        ["t", digits(hit.t)],
        ["point", vectorText(position)],
        ["normal", vectorText(normal)],
      ],
      lines: [normalLine],
      labels: [["n", normalLine.b]],
      diagram: () => diagrams.hit(cosine),
    },
    {
      name: "stored",
      say: hit.stored
        ? [
            `path has ${bounce + 1} elements: the photon has bounced before.`,
            "It is stored, with the way back to where it came from.",
          ]
        : [
            "path has one element, L: the photon comes straight from the light.",
            "It is not stored. The handout stores only photons that have bounced; " +
              "shadow rays bring the direct light.",
          ],
      values: {
        "path.len()": `${bounce + 1}`,
        "photon_map.push()": hit.stored ? "runs" : "skipped",
        ...(hit.stored ? { to_light: vectorText(scale(arrival, -1)) } : {}),
      },
      more: [["stored", hit.stored ? "yes" : "no"]],
      diagram: () => diagrams.path(bounce, hits),
    },
    {
      name: "roulette",
      say: [
        `P_r is the largest channel of the diffuse response: ${digits(survival)}.`,
        scattered
          ? `The random number ${digits(roulette)} is less, so the photon scatters.`
          : `The random number ${digits(roulette)} is not less, ` +
            "so the photon is absorbed here and its path ends.",
      ],
      values: {
        diffuse_response: vectorText(hit.diffuse),
        probability_of_reflection: digits(survival),
        "rand()": digits(roulette),
      },
      more: [
        ["u", digits(roulette)],
        ["P_r", digits(survival)],
        ["decision", scattered ? "scatters" : "absorbed"],
      ],
      diagram: () => diagrams.roulette(roulette, survival),
    },
  ];
  if (scattered) steps.push(...stepsOfScattering(run, hit, normalLine, arrow));
  const way = { a: from, b: position };
  return steps.map((step) => ({ bounce, way, ...step }));
}

function stepsOfScattering(run, hit, normalLine, arrow) {
  const { position, normal, tangent, bitangent, direction, u1, u2, face } = hit;
  const r = Math.sqrt(u1),
    theta = 2 * Math.PI * u2,
    up = Math.sqrt(1 - u1);
  const [x, y] = [r * Math.cos(theta), r * Math.sin(theta)];
  const bare = face.bare,
    isUnit = Math.abs(bare - 1) < 1e-3;
  const bareCosine = up / Math.hypot(up, bare * r);
  const world = (local) =>
    add(
      add(add(position, tangent, arrow * local[0]), bitangent, arrow * local[1]),
      normal,
      arrow * local[2],
    );
  const around = (place) => Array.from({ length: 33 }, (_, i) => world(place(i / 32)));
  const strip = (points, more) => points.slice(1).map((b, i) => ({ a: points[i], b, ...more }));
  const full = (at) => [Math.cos(2 * Math.PI * at), Math.sin(2 * Math.PI * at), 0];
  const dome = [
    ...strip(around(full), { color: "ink", alpha: 0.8 }),
    ...strip(
      around((at) => [Math.cos(Math.PI * at), 0, Math.sin(Math.PI * at)]),
      { color: "ink", alpha: 0.35 },
    ),
    ...strip(
      around((at) => [0, Math.cos(Math.PI * at), Math.sin(Math.PI * at)]),
      { color: "ink", alpha: 0.35 },
    ),
  ];
  const frame = [
    ["t", tangent, "t"],
    ["b", bitangent, "b"],
  ].map(([, axis, color]) => ({ a: position, b: add(position, axis, arrow), color, width: 3 }));
  const ray = { a: position, b: add(position, direction, arrow * 1.5), color: "path", width: 3.5 };
  const start = position.map((p, i) => round(p + round((run.offset ?? 0) * normal[i])));
  const axis = face.axis,
    axisName = `(${axis.join(", ")})`,
    isX = axis[0] === 1,
    alongX = about(Math.abs(normal[0]));
  return [
    {
      name: "hemisphere",
      say: [
        `u1 sets how far from the center of the disk: r is ${about(r)}. ` +
          `u2 sets the angle: theta is ${(u2 * 360).toFixed(1)}°.`,
        `Lifted to the hemisphere, the point has height ${about(up)}: ` +
          `the new direction is ${degrees(up)} from the normal.`,
      ],
      values: {
        u1: digits(u1),
        u2: digits(u2),
        r: digits(round(r)),
        theta: near(theta),
        x: near(x),
        y: near(y),
        z: digits(round(Math.sqrt(round(1 - u1)))),
      },
      more: [
        ["u1", digits(u1)],
        ["u2", digits(u2)],
      ],
      lines: [
        ...dome,
        { a: world([x, y, 0]), b: world([x, y, up]), color: "path", dash: 6 },
        { a: position, b: world([x, y, 0]), color: "t", width: 2.5 },
        { a: position, b: world([x, y, up]), color: "path", width: 3 },
      ],
      diagram: () => diagrams.hemisphere(r, theta, up),
    },
    {
      name: "frame",
      say: [
        isX
          ? `|n · x| is ${alongX}, so the x axis ${axisName} builds t.`
          : `|n · x| is ${alongX}, too close to 1: ` +
            `n is parallel to the x axis, so ${axisName} builds t.`,
        isUnit
          ? "Here n × axis has length 1 already, so normalizing t and b changes nothing."
          : `n × axis has length ${about(bare)} before it is normalized. ` +
            `If t and b kept this length, the ray would leave ${degrees(bareCosine)} ` +
            `from the normal, not ${degrees(up)}. ` +
            "Over many photons, directions crowd around the normal.",
      ],
      values: {
        normal: vectorText(normal),
        is_parallel: String(!isX),
        axis: axisName,
        tangent: vectorText(tangent),
        bitangent: vectorText(bitangent),
      },
      more: [
        ["t", vectorText(tangent)],
        ["b", vectorText(bitangent)],
        ["n", vectorText(normal)],
        ["|n × axis|", digits(round(bare))],
      ],
      lines: [...frame, normalLine, ray],
      labels: [
        ["t", frame[0].b],
        ["b", frame[1].b],
        ["n", normalLine.b],
      ],
      diagram: () => diagrams.frame(tangent, bitangent, normal, direction, bare),
    },
    {
      name: "ray",
      say: [
        `The new ray leaves along (x, y, z) in the frame: x t + y b + z n.`,
        "It starts a little above the surface. The point hit is rounded and may lie below; " +
          "a ray from there would meet the same surface again.",
      ],
      values: {
        world_space_direction: vectorText(direction),
        ...(run.offset === null ? {} : { start: vectorText(start), offset: digits(run.offset) }),
        remaining_bounces: String(run.maxBounces - hit.bounce - 1),
      },
      more: [
        ["direction", vectorText(direction)],
        ["offset", run.offset === null ? "as this scene needs" : `${digits(run.offset)} along n`],
      ],
      lines: [ray, normalLine],
      labels: [["n", normalLine.b]],
      diagram: () => diagrams.offset(direction, normal, run.offset),
    },
  ];
}
