// The data of the page: what Rust packed, unpacked.

/** The sections of the block `data`: typed arrays by name. Their bytes come plane by plane, all
 * lowest bytes first, because that deflates better. */
async function readSections(list) {
  const text = document.getElementById("data").textContent.trim();
  const packed =
    Uint8Array.fromBase64?.(text) ?? Uint8Array.from(atob(text), (c) => c.charCodeAt(0));
  const inflated = new Blob([packed]).stream().pipeThrough(new DecompressionStream("deflate"));
  const bytes = new Uint8Array(await new Response(inflated).arrayBuffer());
  const types = { u8: Uint8Array, u16: Uint16Array, u32: Uint32Array, f32: Float32Array };
  const sections = {};
  let at = 0;
  for (const [name, type, count] of list) {
    const section = new types[type](count);
    const planes = section.BYTES_PER_ELEMENT;
    const raw = new Uint8Array(section.buffer);
    for (let plane = 0; plane < planes; plane++, at += count) {
      for (let i = 0; i < count; i++) raw[i * planes + plane] = bytes[at + i];
    }
    sections[name] = section;
  }
  return sections;
}

/** The random numbers of `photon`: ChaCha with 8 rounds, as in the port's `random.rs`. The numbers
 * of all photons would double the page, so they are drawn again here. Rust computed the rest. */
function photonRandom(seed, photon) {
  const [block, start] = [new Uint32Array(16), new Uint32Array(16)];
  const key = BigInt(seed);
  start.set([0x61707865, 0x3320646e, 0x79622d32, 0x6b206574]);
  start.set([Number(key & 0xffffffffn), Number(key >> 32n)], 4);
  start[14] = photon;
  let next = 16;
  const mix = (a, b, d, by) => {
    block[a] += block[b];
    block[d] ^= block[a];
    block[d] = (block[d] << by) | (block[d] >>> (32 - by));
  };
  const quarter = (a, b, c, d) => {
    mix(a, b, d, 16);
    mix(c, d, b, 12);
    mix(a, b, d, 8);
    mix(c, d, b, 7);
  };
  return () => {
    if (next === 16) {
      block.set(start);
      for (let round = 0; round < 4; round++) {
        for (let i = 0; i < 4; i++) quarter(i, i + 4, i + 8, i + 12);
        for (let i = 0; i < 4; i++)
          quarter(i, 4 + ((i + 1) % 4), 8 + ((i + 2) % 4), 12 + ((i + 3) % 4));
      }
      for (let i = 0; i < 16; i++) block[i] += start[i];
      start[12] += 1;
      next = 0;
    }
    return (block[next++] >>> 8) / 16777216;
  };
}

/** A run of the reference: its paths, its stored photons, and the story of each path. */
class Run {
  constructor(meta, sections) {
    Object.assign(this, meta, { sections });
    const { path_photon: steps, path_hits: hits, path_ending: endings } = sections;
    this.paths = hits.length;
    const stored = hits.reduce((sum, count) => sum + Math.max(count - 1, 0), 0);
    // For each path: its photon, and where its hits, stored photons and directions begin.
    this.photons = new Uint32Array(this.paths);
    this.firstHit = new Uint32Array(this.paths + 1);
    this.firstStored = new Uint32Array(this.paths + 1);
    this.firstScattered = new Uint32Array(this.paths + 1);
    // Of each stored photon: its path, bounce and surface.
    this.pathOf = new Uint32Array(stored);
    this.bounceOf = new Uint16Array(stored);
    this.surfaceOf = new Uint16Array(stored);
    let photon = 0;
    for (let path = 0; path < this.paths; path++) {
      this.photons[path] = photon += steps[path];
      const count = hits[path];
      const [first, at] = [this.firstHit[path], this.firstStored[path]];
      for (let bounce = 1; bounce < count; bounce++) {
        this.pathOf[at + bounce - 1] = path;
        this.bounceOf[at + bounce - 1] = bounce;
        this.surfaceOf[at + bounce - 1] = this.faces[sections.hit_face[first + bounce]].surface;
      }
      this.firstHit[path + 1] = first + count;
      this.firstStored[path + 1] = at + Math.max(count - 1, 0);
      const scattered = count - (endings[path] === 0 ? 1 : 0);
      this.firstScattered[path + 1] = this.firstScattered[path] + scattered;
    }
    this.positions = new Float32Array(3 * stored);
    ["x", "y", "z"].forEach((axis, i) => {
      const column = sections[`stored_${axis}`];
      for (let k = 0; k < stored; k++) this.positions[3 * k + i] = column[k];
    });
  }

  get stored() {
    return this.pathOf.length;
  }

  /** The path of `photon`, or -1. */
  pathOfPhoton(photon) {
    let [low, high] = [0, this.paths];
    while (low < high) {
      const middle = (low + high) >> 1;
      if (this.photons[middle] < photon) low = middle + 1;
      else high = middle;
    }
    return this.photons[low] === photon ? low : -1;
  }

  vector(name, index) {
    return ["x", "y", "z"].map((axis) => this.sections[`${name}_${axis}`][index]);
  }

  /** The story of path `path`: what `explain --json` prints. */
  story(path) {
    const { sections } = this;
    const photon = this.photons[path];
    const rand = photonRandom(this.seed, photon);
    const tries = [];
    let square;
    do {
      const xyz = [rand(), rand(), rand()].map((u) => 2 * u - 1);
      square = lengthSquared(xyz);
      tries.push(xyz);
    } while (square > 1 || square === 0);
    const light = this.lights[sections.path_light[path]];
    const count = sections.path_hits[path];
    const ending = ["absorbed", "left_the_scene", "bounce_limit"][sections.path_ending[path]];
    // In f32, as Rust computes them; Rust packs them where this would give other bits.
    const by = round(1 / round(Math.sqrt(square)));
    const direction = sections.emission_x
      ? this.vector("emission", path)
      : tries.at(-1).map((x) => round(x * by));
    const hits = Array.from({ length: count }, (_, bounce) => {
      const at = this.firstHit[path] + bounce;
      const face = this.faces[sections.hit_face[at]];
      const { name: surface, survival, diffuse } = this.surfaces[face.surface];
      const t = sections.hit_t[at];
      const direct = () =>
        sections.direct_x
          ? this.vector("direct", path)
          : light.position.map((x, i) => round(x + round(t * direction[i])));
      const stored = bounce > 0;
      const position = stored
        ? this.vector("stored", this.firstStored[path] + bounce - 1)
        : direct();
      const scattered = bounce + 1 < count || ending !== "absorbed";
      const hit = { bounce, face, surface, survival, diffuse, t, position, stored, scattered };
      hit.roulette = rand();
      if (scattered) {
        [hit.u1, hit.u2] = [rand(), rand()];
        hit.direction = this.vector("scattered", this.firstScattered[path] + bounce);
      }
      return hit;
    });
    return { photon, light, tries, direction, hits, ending };
  }
}

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
    ? short.toFixed(Math.max(precision - 1 - exponent, 0))
    : String(short);
}

const vectorText = (xyz) => `(${xyz.map(digits).join(", ")})`;
const thousands = (count) => count.toLocaleString("en-US");
