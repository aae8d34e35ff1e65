// The box in 3-D: WebGL2 and an orbiting camera. It draws layers and knows no photon's story.

const add = (a, b, by = 1) => [a[0] + by * b[0], a[1] + by * b[1], a[2] + by * b[2]];
const scale = (a, by) => [a[0] * by, a[1] * by, a[2] * by];
const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
const cross = ([a, b, c], [x, y, z]) => [b * z - c * y, c * x - a * z, a * y - b * x];
const unit = (a) => scale(a, 1 / (Math.hypot(...a) || 1));
const clamp = (x, low, high) => Math.min(Math.max(x, low), high);

/** A program of the graphics card; `set` sets a uniform, as `set("1f", "alpha", 0.5)`. */
function compile(gl, vertex, fragment) {
  const program = gl.createProgram();
  const sources = { VERTEX_SHADER: vertex, FRAGMENT_SHADER: fragment };
  for (const [type, source] of Object.entries(sources)) {
    const shader = gl.createShader(gl[type]);
    gl.shaderSource(shader, source);
    gl.compileShader(shader);
    if (!gl.getShaderParameter(shader, gl.COMPILE_STATUS))
      throw new Error(gl.getShaderInfoLog(shader) ?? "lost");
    gl.attachShader(program, shader);
  }
  gl.linkProgram(program);
  if (!gl.getProgramParameter(program, gl.LINK_STATUS))
    throw new Error(gl.getProgramInfoLog(program) ?? "lost");
  const places = {};
  const set = (kind, name, ...value) => {
    places[name] ??= gl.getUniformLocation(program, name);
    gl[`uniform${kind}`](places[name], ...value);
  };
  return { program, set };
}

class View {
  /** So many pixels a side are looked at around a click. */
  static PICK = 25;
  wallAlpha = 1;
  dotScale = 1;
  /** How opaque dots are that are not lit. */
  dim = 1;
  /** The part of the dots drawn, and that for which there is time while the camera moves. */
  part = 1;
  pace = 1;
  moved = 0;
  drawn = 0;
  layers = {};

  /** A view on `canvas`; throws where there is no WebGL2. */
  constructor(canvas, onDraw) {
    const gl = canvas.getContext("webgl2", { alpha: false, antialias: false });
    if (!gl) throw new Error("no WebGL2");
    Object.assign(this, { canvas, onDraw, gl });
    this.programs = {
      surface: compile(gl, SURFACE_VERTEX, SURFACE_FRAGMENT),
      dot: compile(gl, DOT_VERTEX, DOT_FRAGMENT),
      line: compile(gl, LINE_VERTEX, LINE_FRAGMENT),
    };
    new ResizeObserver(() => this.draw()).observe(canvas);
  }

  /** Makes the layer `name` of `columns`: arrays with their number of components. With `step` 1
   * there is one entry for each instance. */
  setLayer(name, count, columns, step = 0) {
    const { gl } = this;
    const layer = (this.layers[name] ??= { vao: gl.createVertexArray(), buffers: [] });
    layer.count = count;
    gl.bindVertexArray(layer.vao);
    columns.forEach(([array, components, stride = 0, offset = 0], index) => {
      layer.buffers[index] ??= array ? { id: gl.createBuffer() } : layer.buffers[0];
      const buffer = layer.buffers[index];
      gl.bindBuffer(gl.ARRAY_BUFFER, buffer.id);
      if (array && buffer.array !== array)
        gl.bufferData(gl.ARRAY_BUFFER, (buffer.array = array), gl.DYNAMIC_DRAW);
      gl.enableVertexAttribArray(index);
      if (array instanceof Uint8Array)
        gl.vertexAttribIPointer(index, components, gl.UNSIGNED_BYTE, 0, 0);
      else gl.vertexAttribPointer(index, components, gl.FLOAT, false, stride, offset);
      gl.vertexAttribDivisor(index, step);
    });
    gl.bindVertexArray(null);
    this.draw();
  }

  /** Shows dots at `positions`. A look is a palette entry and a shape, then 0 hidden, 1 plain,
   * 2 lit or 3 large. `faceOf` has the index of each dot's face, or one beyond the last. Dots are
   * drawn face by face, so that those on the far side can be left out. */
  setDots(positions, looks, faceOf) {
    const { gl, faces } = this;
    const starts = new Uint32Array(faces.length + 2);
    for (let i = 0; i < faceOf.length; i++) if (looks[2 * i + 1]) starts[faceOf[i] + 1]++;
    for (let face = 0; face <= faces.length; face++) starts[face + 1] += starts[face];
    const next = starts.slice();
    const order = new Uint32Array(starts.at(-1));
    for (let i = 0; i < faceOf.length; i++) if (looks[2 * i + 1]) order[next[faceOf[i]]++] = i;
    this.setLayer("dots", order.length, [[positions, 3], [looks, 2]]);
    this.layers.dots.starts = starts;
    gl.bindVertexArray(this.layers.dots.vao);
    gl.bindBuffer(gl.ELEMENT_ARRAY_BUFFER, (this.dotOrder ??= gl.createBuffer()));
    gl.bufferData(gl.ELEMENT_ARRAY_BUFFER, order, gl.DYNAMIC_DRAW);
    gl.bindVertexArray(null);
  }

  /** Draws larger dots over all others: of {at, color, shape}. */
  setMarks(marks) {
    const places = new Float32Array(marks.flatMap(({ at }) => at));
    const looks = new Uint8Array(marks.flatMap(({ color, shape }) => [look(color, shape), 1]));
    this.setLayer("marks", marks.length, [[places, 3], [looks, 2]]);
  }

  /** Draws lines of {a, b, color, width, dash, alpha}, lengths in pixels, as the layer `name`. */
  setLines(name, lines) {
    const numbers = lines.flatMap(({ a, b, color, width = 1.5, dash = 0, alpha = 1 }) =>
      [...a, ...b, ...this.palette[COLORS.indexOf(color)], alpha, width, dash]);
    const columns = [[3, 0], [3, 12], [4, 24], [2, 40]].map(([components, offset]) =>
      [offset ? null : new Float32Array(numbers), components, 48, offset]);
    this.setLayer(name, lines.length, columns, 1);
  }

  /** Sets the camera: its target, its angles in radians, its distance, its picture's height. */
  look(camera) {
    this.camera = { ...this.camera, ...camera };
    const limit = Math.PI / 2 - 0.001;
    this.camera.pitch = clamp(this.camera.pitch, -limit, limit);
    this.moved = performance.now();
    this.draw();
  }

  /** While the camera moves, draws only as many dots as there is time for. At rest, draws all. */
  keepPace() {
    const now = performance.now(), since = now - this.drawn;
    const isMoving = this.moved > this.drawn || now - this.moved < 150;
    if (isMoving && since < 1000)
      this.pace = clamp(this.pace * clamp(42 / since, 0.6, 1.15), 0.02, 1);
    this.part = isMoving ? this.pace : 1;
    this.drawn = now;
    clearTimeout(this.rest);
    if (this.part < 1) this.rest = setTimeout(() => this.draw(), 200);
  }

  /** The way the camera looks, and what is right and up to it. */
  axes() {
    const { yaw, pitch } = this.camera;
    const across = Math.cos(pitch);
    const forward = [Math.sin(yaw) * across, Math.cos(yaw) * across, Math.sin(pitch)];
    const right = [Math.cos(yaw), -Math.sin(yaw), 0];
    return { forward, right, up: cross(right, forward) };
  }

  get eye() {
    return add(this.camera.target, this.axes().forward, -this.camera.distance);
  }

  /** Half the height of the picture at distance 1. A narrow view is higher, to show all of 4:3. */
  get halfHeight() {
    const { clientWidth: width, clientHeight: height } = this.canvas;
    return this.camera.halfHeight * Math.max(1, 4 / 3 / (width / height));
  }

  /** World to clip space, column by column. */
  matrix() {
    const { canvas, camera, eye, halfHeight } = this;
    const { forward, right, up } = this.axes();
    const [near, far] = [camera.distance * 0.02, camera.distance + 20 * camera.size];
    const deep = (far + near) / (far - near);
    const rows = [
      [scale(right, canvas.clientHeight / canvas.clientWidth / halfHeight), 0],
      [scale(up, 1 / halfHeight), 0],
      [scale(forward, deep), (-2 * far * near) / (far - near)],
      [forward, 0],
    ];
    const row = rows.map(([v, more]) => [...v, more - dot(v, eye)]);
    return new Float32Array([0, 1, 2, 3].flatMap((column) => row.map((r) => r[column])));
  }

  /** Where `point` appears, in CSS pixels; nothing if it lies behind. */
  project([x, y, z]) {
    const { clientWidth: width, clientHeight: height } = this.canvas;
    const m = this.matrix();
    const row = (r) => m[r] * x + m[4 + r] * y + m[8 + r] * z + m[12 + r];
    const w = row(3);
    return w > 0 ? [((row(0) / w + 1) / 2) * width, ((1 - row(1) / w) / 2) * height] : null;
  }

  draw() {
    this.waiting ??= requestAnimationFrame(() => {
      this.waiting = null;
      this.drawNow();
    });
  }

  drawNow() {
    const { gl, canvas } = this;
    if (!this.camera || !this.palette || gl.isContextLost()) return;
    const ratio = Math.min(window.devicePixelRatio || 1, 2);
    const [width, height] = [canvas.clientWidth, canvas.clientHeight].map((edge) =>
      Math.max(1, Math.round(edge * ratio)));
    if (canvas.width !== width || canvas.height !== height)
      Object.assign(canvas, { width, height });
    const camera = this.matrix();
    this.keepPace();
    gl.viewport(0, 0, width, height);
    gl.clearColor(...this.air, 1);
    gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
    gl.enable(gl.DEPTH_TEST);
    gl.blendFunc(gl.SRC_ALPHA, gl.ONE_MINUS_SRC_ALPHA);
    if (this.wallAlpha === 1) this.drawSurfaces(camera);
    this.drawDots("dots", camera);
    this.drawLines("edges", camera);
    if (this.wallAlpha < 1) {
      gl.depthMask(false);
      this.drawSurfaces(camera);
      gl.depthMask(true);
    }
    this.drawLines("moved", camera);
    // A path is seen through walls.
    gl.disable(gl.DEPTH_TEST);
    this.drawLines("path", camera);
    this.drawDots("marks", camera);
    this.onDraw();
  }

  /** Waits until everything is drawn; the function of this name in WebGL does not. */
  finish() {
    const { gl } = this;
    gl.readPixels(0, 0, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, new Uint8Array(4));
  }

  /** Device pixels for each CSS pixel. */
  get ratio() {
    return this.canvas.width / this.canvas.clientWidth;
  }

  drawSurfaces(camera) {
    const { gl, programs: { surface } } = this;
    this.drawLayer("surfaces", surface, camera, this.wallAlpha < 1, ({ count }) => {
      surface.set("3fv", "light", this.light);
      surface.set("3fv", "air", this.air);
      surface.set("1f", "wash", this.wash);
      surface.set("1f", "alpha", this.wallAlpha);
      gl.drawArrays(gl.TRIANGLES, 0, count);
    });
  }

  drawDots(name, camera, pick = false) {
    const { gl, canvas, ratio, programs: { dot: program } } = this;
    const isMark = name === "marks";
    const least = isMark ? 13 : pick ? 5 : Math.max(1.5, 1.2 * this.dotScale);
    const blend = !pick && (isMark || this.dim < 1);
    this.drawLayer(name, program, camera, blend, (layer) => {
      program.set("3fv", "palette", this.palette.flat());
      program.set("1f", "pixels", (canvas.height / 2 / this.halfHeight) * this.dotScale);
      program.set("1f", "size", isMark ? 0 : this.dotSize);
      program.set("1f", "least", least * ratio);
      program.set("1f", "most", 30 * ratio);
      program.set("1f", "large", 8 * ratio);
      program.set("1f", "dim", isMark ? 1 : this.dim);
      program.set("1i", "pick", pick ? 1 : 0);
      // The handout's rays go through upper left corners: half a pixel off the middle.
      program.set("2f", "shift", pick ? 0 : 1 / canvas.width, pick ? 0 : -1 / canvas.height);
      if (isMark) gl.drawArrays(gl.POINTS, 0, layer.count);
      else this.drawFaces(layer.starts, pick ? 1 : this.part);
    });
  }

  /** Draws the dots in sight. Paths are in no order, so a part of the dots covers a whole face. */
  drawFaces(starts, part) {
    const { gl, eye } = this;
    for (let face = 0; face <= this.faces.length; face++) {
      const count = Math.ceil((starts[face + 1] - starts[face]) * part);
      const { normal, at } = this.faces[face] ?? {};
      const isTurnedAway = normal && this.wallAlpha === 1 && dot(normal, add(eye, at, -1)) < 0;
      if (count && !isTurnedAway)
        gl.drawElements(gl.POINTS, count, gl.UNSIGNED_INT, 4 * starts[face]);
    }
  }

  drawLines(name, camera) {
    const { gl, canvas, ratio, programs: { line } } = this;
    this.drawLayer(name, line, camera, true, ({ count }) => {
      line.set("2f", "size", canvas.width / ratio, canvas.height / ratio);
      gl.drawArraysInstanced(gl.TRIANGLE_STRIP, 0, 4, count);
    });
  }

  /** Draws the layer `name` by `drawArrays`, if it has anything. */
  drawLayer(name, { program, set }, camera, blend, drawArrays) {
    const { gl } = this;
    const layer = this.layers[name];
    if (!layer?.count) return;
    gl.useProgram(program);
    set("Matrix4fv", "camera", false, camera);
    set("3fv", "eye", this.eye);
    if (blend) gl.enable(gl.BLEND);
    else gl.disable(gl.BLEND);
    gl.bindVertexArray(layer.vao);
    drawArrays(layer);
    gl.bindVertexArray(null);
  }

  /** The index of the dot drawn nearest to the CSS pixel (`x`, `y`), or -1. Draws the dots there
   * again, each in a color of its own, into a corner of the next frame that is then cleared. */
  pick(x, y) {
    const { gl, canvas } = this, side = View.PICK;
    // Clip space, cropped to a square around the pixel.
    const crop = this.matrix();
    const [cx, cy] = [(2 * x) / canvas.clientWidth - 1, 1 - (2 * y) / canvas.clientHeight];
    for (let at = 0; at < 16; at += 4) {
      crop[at] = ((crop[at] - cx * crop[at + 3]) * canvas.width) / side;
      crop[at + 1] = ((crop[at + 1] - cy * crop[at + 3]) * canvas.height) / side;
    }
    gl.viewport(0, 0, side, side);
    gl.clearColor(0, 0, 0, 0);
    gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
    gl.enable(gl.DEPTH_TEST);
    if (this.wallAlpha === 1) {
      gl.colorMask(false, false, false, false);
      this.drawSurfaces(crop);
      gl.colorMask(true, true, true, true);
    }
    this.drawDots("dots", crop, true);
    const pixels = new Uint8Array(4 * side * side);
    gl.readPixels(0, 0, side, side, gl.RGBA, gl.UNSIGNED_BYTE, pixels);
    this.draw();
    const numbers = new Uint32Array(pixels.buffer), middle = (side - 1) / 2;
    let [best, nearest] = [-1, Infinity];
    numbers.forEach((pixel, i) => {
      const number = pixel & 0xffffff;
      const away = Math.hypot((i % side) - middle, Math.floor(i / side) - middle);
      if (number > 0 && away < nearest) [best, nearest] = [number - 1, away];
    });
    return best;
  }
}
