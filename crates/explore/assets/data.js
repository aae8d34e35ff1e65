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

/** A run of the reference: its paths, all dots, and the story of each path. */
class Run {
  constructor(meta, columns) {
    Object.assign(this, meta, meta.scene, columns);
    this.paths = this.pathHits.length;
    // For each path: its photon, and where its hits, stored photons and directions begin.
    this.photons = new Uint32Array(this.paths);
    this.firstHit = new Uint32Array(this.paths);
    this.firstStored = new Uint32Array(this.paths);
    this.firstScattered = new Uint32Array(this.paths);
    this.dots = this.allDots(columns);
    const { photon, bounce, surface, normal } = this.dots;
    let [number, hit, stored, absorbed] = [0, 0, 0, 0];
    for (let path = 0; path < this.paths; path++) {
      this.photons[path] = number += this.pathPhoton[path];
      this.firstHit[path] = hit;
      this.firstStored[path] = stored;
      this.firstScattered[path] = hit - absorbed;
      for (let at = 1; at < this.pathHits[path]; at++, stored++) {
        const face = this.faces[this.hitFace[hit + at]];
        [photon[stored], bounce[stored], surface[stored]] = [number, at, face.surface];
        normal.set(scale(face.normal, 127), 3 * stored);
      }
      hit += this.pathHits[path];
      absorbed += this.pathEnding[path] === 0;
    }
    this.movedIndex.forEach((index, k) => {
      for (const column of [photon, bounce, surface]) column[stored + k] = column[index];
    });
  }

  /** Columns of all dots: the stored photons, then those that another list moved, then its extra
   * ones. Theirs are filled here, and those of the others when the paths are known. */
  allDots({ positions, kind = [], movedIndex = [], moved = [], extra = [], ...columns }) {
    this.movedIndex = movedIndex;
    this.stored = positions.length / 3;
    this.firstExtra = this.stored + movedIndex.length;
    const count = this.firstExtra + extra.length / 3;
    const column = (Type, ofExtra = [], size = 1) => {
      const all = new Type(size * count);
      all.set(ofExtra, size * this.firstExtra);
      return all;
    };
    const dots = {
      count,
      position: column(Float32Array, extra, 3),
      photon: column(Uint32Array, columns.extraPhoton),
      bounce: column(Uint16Array, columns.extraBounce),
      surface: column(Uint16Array, columns.extraSurface),
      normal: column(Int8Array, [], 3),
      kind: column(Uint8Array),
    };
    dots.position.set(positions);
    dots.position.set(moved, 3 * this.stored);
    dots.kind.set(kind);
    dots.kind.fill(2, this.stored, this.firstExtra).fill(3, this.firstExtra);
    return dots;
  }

  place(dot) {
    return vectorOf(this.dots.position, dot);
  }

  /** The story of path `path`: what `explain --json` prints. */
  story(path) {
    const rand = photonRandom(this.seed, this.photons[path]);
    const tries = [];
    let square;
    do {
      tries.push([rand(), rand(), rand()].map((u) => 2 * u - 1));
      square = lengthSquared(tries.at(-1));
    } while (square > 1 || square === 0);
    const light = this.lights[this.pathLight[path]];
    const count = this.pathHits[path];
    const ending = ["absorbed", "left_the_scene", "bounce_limit"][this.pathEnding[path]];
    // In f32, as Rust computes them; Rust packs them where this would give other bits.
    const by = round(1 / round(Math.sqrt(square)));
    const direction = this.emission
      ? vectorOf(this.emission, path) : tries.at(-1).map((x) => round(x * by));
    const hits = Array.from({ length: count }, (_, bounce) => {
      const at = this.firstHit[path] + bounce, t = this.hitT[at];
      const face = this.faces[this.hitFace[at]];
      const { name: surface, survival, diffuse } = this.surfaces[face.surface];
      const stored = bounce > 0;
      const position = stored ? vectorOf(this.positions, this.firstStored[path] + bounce - 1)
        : this.direct ? vectorOf(this.direct, path)
        : light.position.map((x, i) => round(x + round(t * direction[i])));
      const scattered = bounce + 1 < count || ending !== "absorbed";
      const hit = { bounce, face, surface, survival, diffuse, t, position, stored, scattered };
      hit.roulette = rand();
      if (scattered) {
        [hit.u1, hit.u2] = [rand(), rand()];
        hit.direction = vectorOf(this.scattered, this.firstScattered[path] + bounce);
      }
      return hit;
    });
    return { light, tries, direction, hits, ending };
  }
}

const vectorOf = (column, index) => [...column.subarray(3 * index, 3 * index + 3)];
const round = Math.fround;
/** x2 + y2 + z2 in f32, in the port's order. */
const lengthSquared = ([x, y, z]) => round(round(round(x * x) + round(y * y)) + round(z * z));

/** An f32 with as few digits as bring back the same bits, as Rust prints it. */
function digits(x) {
  if (!Number.isFinite(x)) return Number.isNaN(x) ? "NaN" : x > 0 ? "inf" : "-inf";
  if (x === 0) return Object.is(x, -0) ? "-0" : "0";
  let precision = 1;
  while (round(Number(x.toPrecision(precision))) !== x) precision++;
  const short = Number(x.toPrecision(precision));
  const exponent = Number(short.toExponential().split("e")[1]);
  return exponent < -6 || exponent > 20
    ? short.toFixed(Math.max(precision - 1 - exponent, 0)) : String(short);
}
const vectorText = (xyz) => `(${xyz.map(digits).join(", ")})`;
const thousands = (count) => count.toLocaleString("en-US");
