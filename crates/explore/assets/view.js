// The box in 3-D: WebGL2 and an orbiting camera. It draws layers and knows no photon's story.

const add = (a, b, by = 1) => a.map((x, i) => x + by * b[i]);
const scale = (a, by) => a.map((x) => x * by);
const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
const unit = (a) => scale(a, 1 / (Math.hypot(...a) || 1));
const clamp = (x, low, high) => Math.min(Math.max(x, low), high);
const DEGREES = 180 / Math.PI;
/** So many pixels a side are looked at around a click. */
const PICK = 25;
/** So many dots are drawn in no time. */
const QUICK = 20_000;

/** A program of the graphics card; `set` sets those of the values that are uniforms of it. */
function compile(gl, vertex, fragment) {
  const program = gl.createProgram();
  for (const [type, source] of [["VERTEX_SHADER", vertex], ["FRAGMENT_SHADER", fragment]]) {
    const shader = gl.createShader(gl[type]);
    gl.shaderSource(shader, source);
    gl.compileShader(shader);
    gl.attachShader(program, shader);
  }
  gl.linkProgram(program);
  if (!gl.getProgramParameter(program, gl.LINK_STATUS))
    throw new Error(gl.getProgramInfoLog(program) ?? "lost");
  const places = {};
  const set = (values) => {
    for (const [name, value] of Object.entries(values)) {
      const place = (places[name] ??= gl.getUniformLocation(program, name));
      if (value.length === 16) gl.uniformMatrix4fv(place, false, value);
      else gl[`uniform${Math.min(value.length ?? 1, 3)}fv`](place, [value].flat());
    }
  };
  return { program, set };
}

class View {
  wallAlpha = 1;
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
      surfaces: compile(gl, SURFACE_VERTEX, SURFACE_FRAGMENT),
      dots: compile(gl, DOT_VERTEX, DOT_FRAGMENT),
      lines: compile(gl, LINE_VERTEX, LINE_FRAGMENT),
    };
    gl.enable(gl.DEPTH_TEST);
    gl.blendFunc(gl.SRC_ALPHA, gl.ONE_MINUS_SRC_ALPHA);
    new ResizeObserver(() => this.draw()).observe(canvas);
  }

  /** Makes the layer `name` of surfaces, dots or lines (its `kind`) from columns: arrays, and how
   * many of their numbers an entry has. An entry is a vertex, or one line. A dot has a position, a
   * look and perhaps the normal of its face. A look is a color and a shape, then 0 hidden, 1 plain,
   * 2 lit or 3 large. */
  setLayer(name, kind, columns) {
    const { gl } = this;
    const layer = (this.layers[name] ??= { kind, vao: gl.createVertexArray(), buffers: [] });
    layer.count = columns[0][0].length / columns[0][1];
    gl.bindVertexArray(layer.vao);
    columns.forEach(([array, size], index) => {
      const buffer = (layer.buffers[index] ??= { id: gl.createBuffer() });
      gl.bindBuffer(gl.ARRAY_BUFFER, buffer.id);
      if (buffer.array !== array)
        gl.bufferData(gl.ARRAY_BUFFER, (buffer.array = array), gl.DYNAMIC_DRAW);
      gl.enableVertexAttribArray(index);
      const type = array instanceof Int8Array ? gl.BYTE : gl.FLOAT;
      if (array instanceof Uint8Array)
        gl.vertexAttribIPointer(index, size, gl.UNSIGNED_BYTE, 0, 0);
      else gl.vertexAttribPointer(index, size, type, true, 0, 0);
      gl.vertexAttribDivisor(index, kind === "lines" ? 1 : 0);
    });
    this.draw();
  }

  /** Draws larger dots over all others: of {at, color, shape}. */
  setMarks(marks) {
    const looks = marks.flatMap(({ color, shape }) => [look(color, shape), 1]);
    const places = marks.flatMap(({ at }) => at);
    this.setLayer("marks", "dots", [[new Float32Array(places), 3], [new Uint8Array(looks), 2]]);
  }

  /** Draws lines of {a, b, color, width, dash, alpha}, lengths in pixels, as the layer `name`. */
  setLines(name, lines) {
    const column = (size, numbers) => [new Float32Array(lines.flatMap(numbers)), size];
    this.setLayer(name, "lines", [
      column(3, ({ a }) => a),
      column(3, ({ b }) => b),
      column(4, ({ color, alpha = 1 }) => [...this.palette[COLORS.indexOf(color)], alpha]),
      column(2, ({ width = 1.5, dash = 0 }) => [width, dash]),
    ]);
  }

  /** Sets the camera: its target, its angles in radians, its distance, its picture's height. */
  look(camera) {
    this.camera = { ...this.camera, ...camera };
    this.camera.pitch = clamp(this.camera.pitch, -1.57, 1.57);
    this.moved = performance.now();
    this.draw();
  }

  /** Turns the camera around its target, in radians, and brings it nearer or farther. */
  move(dx, dy, zoom = 1) {
    const { yaw, pitch, distance, size } = this.camera;
    const to = clamp(distance * zoom, size / 500, size * 20);
    this.look({ yaw: yaw + dx, pitch: pitch - dy, distance: to });
  }

  /** While the camera moves, draws only as many dots as there is time for. At rest, draws all. */
  keepPace() {
    const now = performance.now(), since = now - this.drawn;
    const isMoving = this.moved > this.drawn || now - this.moved < 150;
    const least = Math.min(1, QUICK / this.layers.dots.count);
    if (isMoving && since < 1000)
      this.pace = clamp(this.pace * clamp(42 / since, 0.6, 1.15), least, 1);
    this.part = isMoving ? this.pace : 1;
    this.drawn = now;
    clearTimeout(this.rest);
    if (this.part < 1) this.rest = setTimeout(() => this.draw(), 200);
  }

  /** Half the height of the picture at distance 1. A narrow view is higher, to show all of 4:3. */
  get halfHeight() {
    const { clientWidth: width, clientHeight: height } = this.canvas;
    return this.camera.halfHeight * Math.max(1, 4 / 3 / (width / height));
  }

  /** World to what the camera sees: to its right, above it, and behind it. */
  worldToCamera() {
    const { yaw, pitch, target, distance } = this.camera;
    return new DOMMatrix().translate(0, 0, -distance)
      .rotateAxisAngle(1, 0, 0, -90 - pitch * DEGREES).rotateAxisAngle(0, 0, 1, yaw * DEGREES)
      .translate(...scale(target, -1));
  }

  /** World to clip space. */
  matrix() {
    const { canvas, halfHeight, camera: { distance, size } } = this;
    const [near, far] = [distance * 0.02, distance + 20 * size];
    const across = canvas.clientHeight / canvas.clientWidth / halfHeight;
    const [depth, shift] = [(far + near) / (near - far), (2 * far * near) / (near - far)];
    const lens = [across, 0, 0, 0, 0, 1 / halfHeight, 0, 0, 0, 0, depth, -1, 0, 0, shift, 0];
    return new DOMMatrix(lens).multiply(this.worldToCamera());
  }

  /** Where `point` appears, in CSS pixels; nothing if it lies behind. */
  project(point) {
    const { clientWidth: width, clientHeight: height } = this.canvas;
    const { x, y, w } = this.matrix().transformPoint(new DOMPoint(...point));
    return w > 0 ? [((x / w + 1) / 2) * width, ((1 - y / w) / 2) * height] : null;
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
    this.keepPace();
    gl.viewport(0, 0, width, height);
    gl.clearColor(...this.air, 1);
    gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
    const uniforms = this.uniforms();
    if (this.wallAlpha === 1) this.drawLayer("surfaces", uniforms, false);
    // Paths are in no order, so the first part of the dots is spread evenly.
    this.drawLayer("dots", uniforms, this.dim < 1, this.part);
    this.drawLayer("edges", uniforms);
    gl.depthMask(false);
    if (this.wallAlpha < 1) this.drawLayer("surfaces", uniforms);
    this.drawLayer("moved", uniforms);
    // A path is seen through walls.
    gl.disable(gl.DEPTH_TEST);
    this.drawLayer("path", uniforms);
    this.drawLayer("marks", { ...uniforms, least: 13 * ratio, most: 13 * ratio, dim: 1 });
    gl.enable(gl.DEPTH_TEST);
    gl.depthMask(true);
    this.onDraw();
  }

  /** What the programs of a frame are told. */
  uniforms() {
    const { canvas, light, air, wallAlpha: alpha, palette, dim } = this;
    const { width, height, clientWidth, clientHeight } = canvas;
    const ratio = width / clientWidth;
    const { x, y, z } = this.worldToCamera().inverse().transformPoint();
    return {
      camera: this.matrix().toFloat32Array(), eye: [x, y, z], light, air, alpha, dim, pick: 0,
      palette: palette.flat(), size: [clientWidth, clientHeight],
      pixels: (this.dotSize * height) / 2 / this.halfHeight,
      least: 1.5 * ratio, most: 30 * ratio, large: 8 * ratio,
      // The handout's rays go through upper left corners: half a pixel off the middle.
      shift: [1 / width, -1 / height],
    };
  }

  /** Waits until everything is drawn; the function of this name in WebGL does not. */
  finish() {
    const { gl } = this;
    gl.readPixels(0, 0, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, new Uint8Array(4));
  }

  drawLayer(name, uniforms, blend = true, part = 1) {
    const { gl } = this;
    const { kind, vao, count } = this.layers[name] ?? {};
    if (!count) return;
    const { program, set } = this.programs[kind];
    gl.useProgram(program);
    set(uniforms);
    gl[blend ? "enable" : "disable"](gl.BLEND);
    gl.bindVertexArray(vao);
    if (kind === "lines") gl.drawArraysInstanced(gl.TRIANGLE_STRIP, 0, 4, count);
    else gl.drawArrays(kind === "dots" ? gl.POINTS : gl.TRIANGLES, 0, Math.ceil(count * part));
  }

  /** The index of the dot drawn nearest to the CSS pixel (`x`, `y`), or -1. Draws the dots there
   * again, each in a color of its own; the next frame covers them. */
  pick(x, y) {
    const { gl, canvas: { width, height, clientWidth } } = this;
    const uniforms = { ...this.uniforms(), pick: 1, least: 5 };
    const ratio = width / clientWidth, middle = (PICK - 1) / 2;
    const area = [Math.round(x * ratio) - middle, height - Math.round(y * ratio) - middle];
    gl.enable(gl.SCISSOR_TEST);
    gl.scissor(...area, PICK, PICK);
    gl.clearColor(0, 0, 0, 0);
    gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
    gl.colorMask(false, false, false, false);
    if (this.wallAlpha === 1) this.drawLayer("surfaces", uniforms, false);
    gl.colorMask(true, true, true, true);
    this.drawLayer("dots", uniforms, false);
    gl.disable(gl.SCISSOR_TEST);
    const pixels = new Uint8Array(4 * PICK * PICK);
    gl.readPixels(...area, PICK, PICK, gl.RGBA, gl.UNSIGNED_BYTE, pixels);
    this.draw();
    let [best, nearest] = [-1, Infinity];
    new Uint32Array(pixels.buffer).forEach((pixel, i) => {
      const away = Math.hypot((i % PICK) - middle, Math.floor(i / PICK) - middle);
      const number = pixel & 0xffffff;
      if (number > 0 && away < nearest) [best, nearest] = [number - 1, away];
    });
    return best;
  }
}
