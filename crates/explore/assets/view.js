// The box in 3-D: WebGL2 and an orbiting camera. It draws layers and knows no photon's story.

const add = (a, b, by = 1) => [a[0] + by * b[0], a[1] + by * b[1], a[2] + by * b[2]];
const scale = (a, by) => [a[0] * by, a[1] * by, a[2] * by];
const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
const cross = (a, b) => [
  a[1] * b[2] - a[2] * b[1],
  a[2] * b[0] - a[0] * b[2],
  a[0] * b[1] - a[1] * b[0],
];
const length = (a) => Math.hypot(...a);
const unit = (a) => scale(a, 1 / (length(a) || 1));

class View {
  /** A view on `canvas`; throws where there is no WebGL2. */
  constructor(canvas, onDraw) {
    this.canvas = canvas;
    this.onDraw = onDraw;
    const gl = (this.gl = canvas.getContext("webgl2", { alpha: false, antialias: false }));
    if (!gl) throw new Error("no WebGL2");
    const program = (vertex, fragment) => {
      const made = gl.createProgram();
      for (const [type, source] of [
        [gl.VERTEX_SHADER, vertex],
        [gl.FRAGMENT_SHADER, fragment],
      ]) {
        const shader = gl.createShader(type);
        gl.shaderSource(shader, source);
        gl.compileShader(shader);
        if (!gl.getShaderParameter(shader, gl.COMPILE_STATUS))
          throw new Error(gl.getShaderInfoLog(shader) ?? "lost");
        gl.attachShader(made, shader);
      }
      gl.linkProgram(made);
      if (!gl.getProgramParameter(made, gl.LINK_STATUS))
        throw new Error(gl.getProgramInfoLog(made) ?? "lost");
      return { made, at: (name) => gl.getUniformLocation(made, name) };
    };
    this.programs = {
      surface: program(SURFACE_VERTEX, SURFACE_FRAGMENT),
      dot: program(DOT_VERTEX, DOT_FRAGMENT),
      line: program(LINE_VERTEX, LINE_FRAGMENT),
    };
    this.layers = {};
    this.wallAlpha = 1;
    this.dotScale = 1;
    this.dim = 1;
    this.part = this.pace = 1;
    this.pickTarget = gl.createFramebuffer();
    gl.bindFramebuffer(gl.FRAMEBUFFER, this.pickTarget);
    for (const [point, format] of [
      [gl.COLOR_ATTACHMENT0, gl.RGBA8],
      [gl.DEPTH_ATTACHMENT, gl.DEPTH_COMPONENT24],
    ]) {
      const buffer = gl.createRenderbuffer();
      gl.bindRenderbuffer(gl.RENDERBUFFER, buffer);
      gl.renderbufferStorage(gl.RENDERBUFFER, format, View.PICK, View.PICK);
      gl.framebufferRenderbuffer(gl.FRAMEBUFFER, point, gl.RENDERBUFFER, buffer);
    }
    gl.bindFramebuffer(gl.FRAMEBUFFER, null);
    new ResizeObserver(() => this.draw()).observe(canvas);
  }

  /** So many pixels a side are looked at around a click. */
  static PICK = 25;

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

  /** Shows dots at `positions`. A look is a palette entry and a shape, then 0 hidden, 1 plain or
   * 2 lit. `faceOf` has the index of each dot's face, or one beyond the last. Dots are drawn face
   * by face, so that those on the far side can be left out. */
  setDots(positions, looks, faceOf) {
    const { gl } = this,
      starts = new Uint32Array(this.faces.length + 2);
    for (let i = 0; i < faceOf.length; i++) if (looks[2 * i + 1]) starts[faceOf[i] + 1]++;
    for (let face = 0; face <= this.faces.length; face++) starts[face + 1] += starts[face];
    const next = starts.slice(),
      order = new Uint32Array(starts.at(-1));
    for (let i = 0; i < faceOf.length; i++) if (looks[2 * i + 1]) order[next[faceOf[i]]++] = i;
    this.setLayer("dots", order.length, [
      [positions, 3],
      [looks, 2],
    ]);
    this.layers.dots.starts = starts;
    gl.bindVertexArray(this.layers.dots.vao);
    gl.bindBuffer(gl.ELEMENT_ARRAY_BUFFER, (this.dotOrder ??= gl.createBuffer()));
    gl.bufferData(gl.ELEMENT_ARRAY_BUFFER, order, gl.DYNAMIC_DRAW);
    gl.bindVertexArray(null);
  }

  /** Draws the dots in sight. Paths are in no order, so a part of the dots covers a whole face. */
  drawFaces({ starts }, part) {
    const { gl, eye } = this;
    for (let face = 0; face <= this.faces.length; face++) {
      const count = Math.ceil((starts[face + 1] - starts[face]) * part),
        { normal, at } = this.faces[face] ?? {};
      const isTurnedAway = normal && this.wallAlpha === 1 && dot(normal, add(eye, at, -1)) < 0;
      if (count && !isTurnedAway)
        gl.drawElements(gl.POINTS, count, gl.UNSIGNED_INT, 4 * starts[face]);
    }
  }

  /** Draws larger dots over all others: of {at, color, shape}. */
  setMarks(marks) {
    const looks = marks.flatMap(({ color, shape }) => [
      COLORS.indexOf(color) | (SHAPES[shape] << 4),
      1,
    ]);
    this.setLayer("marks", marks.length, [
      [new Float32Array(marks.flatMap((mark) => mark.at)), 3],
      [new Uint8Array(looks), 2],
    ]);
  }

  /** Draws lines of {a, b, color, width, dash, alpha}, lengths in pixels, as the layer `name`. */
  setLines(name, lines) {
    const numbers = lines.flatMap(({ a, b, color, width = 1.5, dash = 0, alpha = 1 }) => [
      ...a,
      ...b,
      ...this.palette[COLORS.indexOf(color)],
      alpha,
      width,
      dash,
    ]);
    this.setLayer(
      name,
      lines.length,
      [
        [new Float32Array(numbers), 3, 48, 0],
        [null, 3, 48, 12],
        [null, 4, 48, 24],
        [null, 2, 48, 40],
      ],
      1,
    );
  }

  /** Sets the camera: its target, its angles in radians, its distance, its picture's height. */
  look(camera) {
    Object.assign((this.camera ??= {}), camera);
    const limit = Math.PI / 2 - 0.001;
    this.camera.pitch = Math.min(Math.max(this.camera.pitch, -limit), limit);
    this.moved = performance.now();
    this.draw();
  }

  /** While the camera moves, draws only as many dots as there is time for. At rest, draws all. */
  keepPace() {
    const now = performance.now(),
      since = now - (this.drawn ?? 0),
      isMoving = (this.moved ?? 0) > (this.drawn ?? 0) || now - (this.moved ?? 0) < 150;
    if (isMoving && since < 1000)
      this.pace = Math.min(
        Math.max(this.pace * Math.min(Math.max(42 / since, 0.6), 1.15), 0.02),
        1,
      );
    this.part = isMoving ? this.pace : 1;
    this.drawn = now;
    clearTimeout(this.rest);
    if (this.part < 1) this.rest = setTimeout(() => this.draw(), 200);
  }

  /** The way the camera looks, and what is right and up to it. */
  axes() {
    const { yaw, pitch } = this.camera;
    const forward = [
      Math.sin(yaw) * Math.cos(pitch),
      Math.cos(yaw) * Math.cos(pitch),
      Math.sin(pitch),
    ];
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
    const { forward, right, up } = this.axes(),
      eye = this.eye;
    const { clientWidth: width, clientHeight: height } = this.canvas;
    const y = 1 / this.halfHeight,
      x = (y * height) / width;
    const near = this.camera.distance * 0.02,
      far = this.camera.distance + 20 * this.camera.size;
    const a = (far + near) / (far - near),
      b = (-2 * far * near) / (far - near);
    const rows = [
      [scale(right, x), 0],
      [scale(up, y), 0],
      [scale(forward, a), b],
      [forward, 0],
    ];
    const row = rows.map(([v, more]) => [...v, more - dot(v, eye)]);
    return new Float32Array([0, 1, 2, 3].flatMap((column) => row.map((r) => r[column])));
  }

  /** Where `point` appears, in CSS pixels; nothing if it lies behind. */
  project(point) {
    const m = this.projection ?? this.matrix();
    const [x, y, , w] = [0, 1, 2, 3].map(
      (r) => m[r] * point[0] + m[4 + r] * point[1] + m[8 + r] * point[2] + m[12 + r],
    );
    return w > 0
      ? [((x / w + 1) / 2) * this.canvas.clientWidth, ((1 - y / w) / 2) * this.canvas.clientHeight]
      : null;
  }

  draw() {
    this.waiting ??= requestAnimationFrame(() => {
      this.waiting = null;
      this.drawNow();
    });
  }

  drawNow() {
    const { gl, canvas, programs, layers } = this;
    if (!this.camera || !this.palette || gl.isContextLost()) return;
    const ratio = Math.min(window.devicePixelRatio || 1, 2);
    const [width, height] = [canvas.clientWidth, canvas.clientHeight].map((edge) =>
      Math.max(1, Math.round(edge * ratio)),
    );
    if (canvas.width !== width || canvas.height !== height)
      Object.assign(canvas, { width, height });
    this.projection = this.matrix();
    this.keepPace();
    gl.viewport(0, 0, width, height);
    gl.clearColor(...this.air, 1);
    gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
    gl.enable(gl.DEPTH_TEST);
    gl.blendFunc(gl.SRC_ALPHA, gl.ONE_MINUS_SRC_ALPHA);
    if (this.wallAlpha === 1) this.drawSurfaces(this.projection);
    this.drawDots("dots", this.projection, this.dim < 1);
    this.drawLines("edges", ratio);
    if (this.wallAlpha < 1) {
      gl.depthMask(false);
      this.drawSurfaces(this.projection);
      gl.depthMask(true);
    }
    this.drawLines("moved", ratio);
    // A path is seen through walls, but fainter.
    gl.disable(gl.DEPTH_TEST);
    this.drawLines("path", ratio);
    this.drawDots("marks", this.projection, true);
    this.frames = (this.frames ?? 0) + 1;
    this.onDraw();
  }

  drawSurfaces(camera) {
    const {
      gl,
      programs: { surface },
      layers: { surfaces },
    } = this;
    gl.useProgram(surface.made);
    gl.uniformMatrix4fv(surface.at("camera"), false, camera);
    gl.uniform3fv(surface.at("light"), this.light);
    gl.uniform3fv(surface.at("air"), this.air);
    gl.uniform3fv(surface.at("eye"), this.eye);
    gl.uniform1f(surface.at("wash"), this.wash);
    gl.uniform1f(surface.at("alpha"), this.wallAlpha);
    this.drawLayer(surfaces, this.wallAlpha < 1, () =>
      gl.drawArrays(gl.TRIANGLES, 0, surfaces.count),
    );
  }

  drawDots(name, camera, blend, pick = false) {
    const {
        gl,
        programs: { dot: program },
        canvas,
      } = this,
      layer = this.layers[name];
    if (!layer?.count) return;
    const ratio = canvas.width / canvas.clientWidth,
      isMark = name === "marks";
    gl.useProgram(program.made);
    gl.uniformMatrix4fv(program.at("camera"), false, camera);
    gl.uniform3fv(program.at("eye"), this.eye);
    gl.uniform3fv(program.at("palette"), this.palette.flat());
    gl.uniform1f(program.at("pixels"), (canvas.height / 2 / this.halfHeight) * this.dotScale);
    gl.uniform1f(program.at("size"), isMark ? 0 : this.dotSize);
    gl.uniform1f(
      program.at("least"),
      (isMark ? 13 : pick ? 5 : Math.max(1.5, 1.2 * this.dotScale)) * ratio,
    );
    gl.uniform1f(program.at("most"), 30 * ratio);
    gl.uniform1f(program.at("dim"), isMark ? 1 : this.dim);
    gl.uniform1i(program.at("pick"), pick ? 1 : 0);
    // The handout's rays go through upper left corners: half a pixel off the middle.
    gl.uniform2f(program.at("shift"), pick ? 0 : 1 / canvas.width, pick ? 0 : -1 / canvas.height);
    this.drawLayer(layer, blend && !pick, () => {
      if (isMark) gl.drawArrays(gl.POINTS, 0, layer.count);
      else this.drawFaces(layer, pick ? 1 : this.part);
    });
  }

  drawLines(name, ratio) {
    const {
        gl,
        programs: { line },
        canvas,
      } = this,
      layer = this.layers[name];
    if (!layer?.count) return;
    gl.useProgram(line.made);
    gl.uniformMatrix4fv(line.at("camera"), false, this.projection);
    gl.uniform3fv(line.at("eye"), this.eye);
    gl.uniform2f(line.at("size"), canvas.width / ratio, canvas.height / ratio);
    this.drawLayer(layer, true, () => gl.drawArraysInstanced(gl.TRIANGLE_STRIP, 0, 4, layer.count));
  }

  drawLayer(layer, blend, drawArrays) {
    const { gl } = this;
    if (blend) gl.enable(gl.BLEND);
    else gl.disable(gl.BLEND);
    gl.bindVertexArray(layer.vao);
    drawArrays();
    gl.bindVertexArray(null);
  }

  /** The index of the dot drawn nearest to the CSS pixel (`x`, `y`), or -1. Draws the dots there
   * again, each in a color of its own. */
  pick(x, y) {
    const { gl, canvas } = this,
      side = View.PICK,
      ratio = canvas.width / canvas.clientWidth;
    const wide = canvas.width / side,
      high = canvas.height / side;
    const [cx, cy] = [(2 * x * ratio) / canvas.width - 1, 1 - (2 * y * ratio) / canvas.height];
    const whole = this.matrix(),
      crop = new Float32Array(whole);
    for (let column = 0; column < 4; column++) {
      crop[4 * column] = wide * (whole[4 * column] - cx * whole[4 * column + 3]);
      crop[4 * column + 1] = high * (whole[4 * column + 1] - cy * whole[4 * column + 3]);
    }
    gl.bindFramebuffer(gl.FRAMEBUFFER, this.pickTarget);
    gl.viewport(0, 0, side, side);
    gl.clearColor(0, 0, 0, 0);
    gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
    gl.enable(gl.DEPTH_TEST);
    if (this.wallAlpha === 1) {
      gl.colorMask(false, false, false, false);
      this.drawSurfaces(crop);
      gl.colorMask(true, true, true, true);
    }
    this.drawDots("dots", crop, false, true);
    const pixels = new Uint8Array(4 * side * side);
    gl.readPixels(0, 0, side, side, gl.RGBA, gl.UNSIGNED_BYTE, pixels);
    gl.bindFramebuffer(gl.FRAMEBUFFER, null);
    let best = -1,
      nearest = Infinity;
    for (let i = 0; i < side * side; i++) {
      const id =
        pixels[4 * i] +
        256 * (pixels[4 * i + 1] + 256 * (pixels[4 * i + 2] + 256 * pixels[4 * i + 3]));
      const away = Math.hypot((i % side) - (side - 1) / 2, Math.floor(i / side) - (side - 1) / 2);
      if (id > 0 && away < nearest) [best, nearest] = [id - 1, away];
    }
    return best;
  }
}
