// The data of the page: what Rust packed, unpacked.

/** The columns of the block `data`: typed arrays by name. An entry's bytes come plane by plane, all
 * first bytes first, because that deflates better. */
async function readColumns(list) {
  const text = $("data").textContent.trim();
  const packed =
    Uint8Array.fromBase64?.(text) ?? Uint8Array.from(atob(text), (c) => c.charCodeAt(0));
  const inflated = new Blob([packed]).stream().pipeThrough(new DecompressionStream("deflate"));
  const bytes = new Uint8Array(await new Response(inflated).arrayBuffer());
  const types =
    { i8: Int8Array, u8: Uint8Array, u16: Uint16Array, u32: Uint32Array, f32: Float32Array };
  let at = 0;
  return Object.fromEntries(list.map(([name, type, count, planes]) => {
    const raw = new Uint8Array(count * planes);
    for (let plane = 0; plane < planes; plane++)
      for (let i = plane; i < raw.length; i += planes) raw[i] = bytes[at++];
    return [name, new types[type](raw.buffer)];
  }));
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

/** Adds to `run` where each of its paths begins in the columns of hits, dots and directions. Adds
 * what each dot is: first the stored photons, then those that another list moved, then its extra
 * ones. */
function addPaths(run) {
  const count = run.dotKind.length, next = { photon: 0, hit: 0, dot: 0, direction: 0 };
  Object.assign(run, {
    paths: [], dotPhoton: new Uint32Array(count), dotBounce: new Uint16Array(count),
    dotSurface: new Uint16Array(count), dotNormal: new Int8Array(3 * count),
  });
  run.pathHits.forEach((hits, path) => {
    next.photon += run.pathPhoton[path];
    run.paths.push({ path, hits, ...next });
    for (let bounce = 1; bounce < hits; bounce++, next.dot++) {
      const { surface, normal } = run.faces[run.hitFace[next.hit + bounce]];
      run.dotPhoton[next.dot] = next.photon;
      run.dotBounce[next.dot] = bounce;
      run.dotSurface[next.dot] = surface;
      normal.forEach((x, i) => (run.dotNormal[3 * next.dot + i] = 127 * x));
    }
    next.hit += hits;
    next.direction += hits - (run.pathEnding[path] === 0);
  });
  for (const what of ["Photon", "Bounce", "Surface"])
    run[`dot${what}`].set(run[`other${what}`], next.dot);
  return Object.assign(run, { stored: next.dot });
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
const digits = (x) => FORMATS.find((_, more) => round(x.toPrecision(1 + more)) === x)?.format(x);
const thousands = (count) => count.toLocaleString("en-US");
