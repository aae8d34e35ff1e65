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
      for (let i = plane; i < raw.length; i += planes) raw[i] = bytes[at++];
    return [name, new types[type](raw.buffer)];
  });
  return Object.fromEntries(columns);
}

/** The random numbers of `photon`: ChaCha with 8 rounds, as in the port's `random.rs`. The numbers
 * of all photons would double the page, so they are drawn again here. Rust computed the rest. */
function* photonRandom(seed, photon) {
  const key = new Uint32Array(BigUint64Array.of(BigInt(seed)).buffer);
  const start = Uint32Array.of(0x61707865, 0x3320646e, 0x79622d32, 0x6b206574, ...key, 0, 0, 0, 0,
    0, 0, 0, 0, photon, 0);
  for (; ; start[12]++) {
    const block = start.slice();
    const mix = (a, b, d, by) => {
      block[a] += block[b];
      block[d] ^= block[a];
      block[d] = (block[d] << by) | (block[d] >>> (32 - by));
    };
    // Four columns, four diagonals, and so on.
    for (let i = 0; i < 32; i++) {
      const [a, b, c, d] = [0, 1, 2, 3].map((row) => 4 * row + ((i + row * ((i >> 2) % 2)) % 4));
      mix(a, b, d, 16);
      mix(c, d, b, 12);
      mix(a, b, d, 8);
      mix(c, d, b, 7);
    }
    for (const [i, word] of block.entries()) yield ((word + start[i]) >>> 8) / 2 ** 24;
  }
}

/** A run of the reference. Its `dots` are the stored photons, then those that another list moved,
 * then the extra ones of that list. A path of `paths` tells where its numbers begin in the columns
 * of hits, dots and directions. */
function unpack({ scene, ...meta }, columns) {
  const run = { ...meta, ...scene, ...columns, paths: [] };
  const { positions: position, kind, movedIndex, extraPhoton, extraBounce, extraSurface } = run;
  const count = position.length / 3, firstExtra = count - extraPhoton.length;
  const stored = firstExtra - movedIndex.length;
  const photon = new Uint32Array(count), bounce = new Uint16Array(count);
  const surface = new Uint16Array(count), normal = new Int8Array(3 * count);
  const normals = run.faces.map((face) => scale(face.normal, 127));
  let next = { photon: 0, hit: 0, dot: 0, direction: 0 };
  run.pathHits.forEach((hits, path) => {
    next.photon += run.pathPhoton[path];
    run.paths.push({ path, hits, ...next });
    for (let at = 1; at < hits; at++, next.dot++) {
      const face = run.hitFace[next.hit + at];
      [photon[next.dot], bounce[next.dot]] = [next.photon, at];
      surface[next.dot] = run.faces[face].surface;
      normal.set(normals[face], 3 * next.dot);
    }
    next.hit += hits;
    next.direction += hits - (run.pathEnding[path] === 0);
  });
  const others = [[photon, extraPhoton], [bounce, extraBounce], [surface, extraSurface]];
  for (const [column, extra] of others) {
    column.set(movedIndex.map((index) => column[index]), stored);
    column.set(extra, firstExtra);
  }
  const dots = { count, position, kind, photon, bounce, surface, normal };
  return { ...run, dots, stored, firstExtra, place: (dot) => vectorOf(position, dot) };
}

/** The story of `photon`, as `explain --json` prints it; nothing if the page does not have it. */
function storyOf(run, photon) {
  const found = run.paths.find((path) => path.photon === photon);
  if (!found) return null;
  const { path, hits: count } = found;
  const random = photonRandom(run.seed, photon), rand = () => random.next().value;
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
    const { name: surface, ...material } = run.surfaces[face.surface];
    const stored = bounce > 0, scattered = bounce + 1 < count || ending !== null;
    const position = stored ? run.place(found.dot + bounce - 1)
      : run.direct ? vectorOf(run.direct, path)
      : light.map((x, i) => round(x + round(t * direction[i])));
    const hit =
      { ...material, bounce, face, surface, t, position, stored, scattered, u: rand() };
    if (scattered) Object.assign(hit, { u1: rand(), u2: rand() });
    if (scattered) hit.direction = vectorOf(run.scattered, found.direction + bounce);
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
const thousands = (count) => count.toLocaleString("en-US");
