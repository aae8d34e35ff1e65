// The data of the page: what Rust packed, unpacked.

/** The columns of the block `data`: typed arrays by name. An entry's bytes come plane by plane, all
 * first bytes first, because that deflates better. */
async function readColumns(list) {
  const text = $("data").textContent.trim();
  const packed =
    Uint8Array.fromBase64?.(text) ?? Uint8Array.from(atob(text), (c) => c.charCodeAt(0));
  const inflated = new Blob([packed]).stream().pipeThrough(new DecompressionStream("deflate"));
  const bytes = new Uint8Array(await new Response(inflated).arrayBuffer());
  const types = { u8: Uint8Array, u16: Uint16Array, u32: Uint32Array, f32: Float32Array };
  let at = 0;
  const columns = list.map(([name, type, count, planes]) => {
    const raw = new Uint8Array(count * planes);
    for (let plane = 0; plane < planes; plane++)
      for (let i = 0; i < count; i++) raw[i * planes + plane] = bytes[at++];
    return [name, new types[type](raw.buffer)];
  });
  return Object.fromEntries(columns);
}

/** The random numbers of `photon`: ChaCha with 8 rounds, as in the port's `random.rs`. The numbers
 * of all photons would double the page, so they are drawn again here. Rust computed the rest. */
function photonRandom(seed, photon) {
  const [block, start] = [new Uint32Array(16), new Uint32Array(16)];
  start.set([0x61707865, 0x3320646e, 0x79622d32, 0x6b206574]);
  start.set(new Uint32Array(BigUint64Array.of(BigInt(seed)).buffer), 4);
  start[14] = photon;
  const mix = (a, b, d, by) => {
    block[a] += block[b];
    block[d] ^= block[a];
    block[d] = (block[d] << by) | (block[d] >>> (32 - by));
  };
  /** Mixes the words of a column, or with `by` 1 of a diagonal. */
  const quarter = (a, by) => {
    const [b, c, d] = [1, 2, 3].map((row) => 4 * row + ((a + row * by) % 4));
    mix(a, b, d, 16);
    mix(c, d, b, 12);
    mix(a, b, d, 8);
    mix(c, d, b, 7);
  };
  let next = 16;
  return () => {
    if (next === 16) {
      block.set(start);
      for (let round = 0; round < 8; round++)
        for (let a = 0; a < 4; a++) quarter(a, round % 2);
      start.forEach((word, i) => (block[i] += word));
      start[12] += 1;
      next = 0;
    }
    return (block[next++] >>> 8) / 16777216;
  };
}

/** Each path of `run`: its photon, how many hits it has, and where its hits, its stored photons and
 * its directions begin in their columns. */
function* pathsOf({ pathPhoton, pathHits, pathEnding }) {
  let [photon, hit, dot, direction] = [0, 0, 0, 0];
  for (let path = 0; path < pathHits.length; path++) {
    const hits = pathHits[path];
    photon += pathPhoton[path];
    yield { path, photon, hits, hit, dot, direction };
    hit += hits;
    dot += Math.max(hits - 1, 0);
    direction += hits - (pathEnding[path] === 0);
  }
}

/** A run of the reference. Its `dots` are the stored photons, then those that another list moved,
 * then the extra ones of that list. */
function unpack({ scene, ...meta }, columns) {
  const run = { ...meta, ...scene, ...columns };
  const { positions: position, kind, movedIndex, extraPhoton, extraBounce, extraSurface } = run;
  const count = position.length / 3, firstExtra = count - extraPhoton.length;
  const stored = firstExtra - movedIndex.length;
  const photon = new Uint32Array(count), bounce = new Uint16Array(count);
  const surface = new Uint16Array(count), normal = new Int8Array(3 * count);
  const dots = { count, position, kind, photon, bounce, surface, normal };
  const normals = run.faces.map((face) => scale(face.normal, 127));
  run.paths = [...pathsOf(run)];
  for (const path of run.paths)
    for (let at = 1, dot = path.dot; at < path.hits; at++, dot++) {
      const face = run.hitFace[path.hit + at];
      [photon[dot], bounce[dot], surface[dot]] = [path.photon, at, run.faces[face].surface];
      normal.set(normals[face], 3 * dot);
    }
  const others = [[photon, extraPhoton], [bounce, extraBounce], [surface, extraSurface]];
  for (const [column, extra] of others) {
    column.set(movedIndex.map((index) => column[index]), stored);
    column.set(extra, firstExtra);
  }
  return { ...run, dots, stored, firstExtra, place: (dot) => vectorOf(position, dot) };
}

/** The story of `photon`, as `explain --json` prints it; nothing if the page does not have it. */
function storyOf(run, photon) {
  const found = run.paths.find((path) => path.photon === photon);
  if (!found) return null;
  const { path, hits: count } = found;
  const rand = photonRandom(run.seed, photon);
  const tries = [];
  let square;
  do {
    tries.push([rand(), rand(), rand()].map((u) => 2 * u - 1));
    square = lengthSquared(tries.at(-1));
  } while (square > 1 || square === 0);
  const light = run.lights[run.pathLight[path]];
  /** The step after the last hit, if the photon was not absorbed there. */
  const ending = [null, "miss", "limit"][run.pathEnding[path]];
  // In f32, as Rust computes them; Rust packs them where this would give other bits.
  const by = round(1 / round(Math.sqrt(square)));
  const direction = run.emission
    ? vectorOf(run.emission, path) : tries.at(-1).map((x) => round(x * by));
  const hits = Array.from({ length: count }, (_, bounce) => {
    const at = found.hit + bounce, t = run.hitT[at], face = run.faces[run.hitFace[at]];
    const { name: surface, survival, diffuse } = run.surfaces[face.surface];
    const stored = bounce > 0;
    const position = stored ? run.place(found.dot + bounce - 1)
      : run.direct ? vectorOf(run.direct, path)
      : light.map((x, i) => round(x + round(t * direction[i])));
    const scattered = bounce + 1 < count || ending !== null;
    const hit = { bounce, face, surface, survival, diffuse, t, position, stored, scattered };
    hit.roulette = rand();
    if (scattered) {
      [hit.u1, hit.u2] = [rand(), rand()];
      hit.direction = vectorOf(run.scattered, found.direction + bounce);
    }
    return hit;
  });
  return { light, tries, direction, hits, ending };
}

const vectorOf = (column, index) => [...column.subarray(3 * index, 3 * index + 3)];
const round = Math.fround;
/** x2 + y2 + z2 in f32, in the port's order. */
const lengthSquared = ([x, y, z]) => round(round(round(x * x) + round(y * y)) + round(z * z));

const FORMATS = [1, 2, 3, 4, 5, 6, 7, 8, 9].map((maximumSignificantDigits) =>
  new Intl.NumberFormat("en-US", { maximumSignificantDigits, useGrouping: false }));
/** An f32 with as few digits as bring back the same bits, as Rust prints it. */
const digits = (x) => FORMATS.map((format) => format.format(x)).find((text) => round(text) === x);
const vectorText = (xyz) => `(${xyz.map(digits).join(", ")})`;
const thousands = (count) => count.toLocaleString("en-US");
