// The box in 3-D: WebGL2 and a camera that turns around a point. It draws layers and knows no
// photon's story.

const add = (a, b, by = 1) => a.map((x, i) => x + by * b[i]);
const scale = (a, by) => a.map((x) => x * by);
const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
const unit = (a) => scale(a, 1 / (Math.hypot(...a) || 1));
const clamp = (x, low, high) => Math.min(Math.max(x, low), high);
/** Of each point the position, the color, the normal, and the look. */
const ATTRIBUTES = [[3, "FLOAT"], [4, "UNSIGNED_BYTE"], [3, "BYTE"], [2, "UNSIGNED_BYTE"]];
/** So many pixels a side are looked at around a click. */
const PICK = 25;

class View {
  /** A view on `canvas`, which calls `onDraw` for every frame. Without WebGL2 it has no `gl`.
   * Its `alpha` is how opaque walls are. */
  constructor(canvas, onDraw) {
    const state = { alpha: 1, part: 1, pace: 1, moved: 0, drawn: 0, layers: {} };
    Object.assign(this, { canvas, onDraw, ...state });
    new ResizeObserver(() => this.draw()).observe(canvas);
    const gl = canvas.getContext("webgl2", { alpha: false, antialias: false });
    const program = gl?.createProgram();
    if (!program) return;
    for (const [type, source] of [[gl.VERTEX_SHADER, VERTEX], [gl.FRAGMENT_SHADER, FRAGMENT]]) {
      const shader = gl.createShader(type);
      gl.shaderSource(shader, source);
      gl.compileShader(shader);
      gl.attachShader(program, shader);
    }
    gl.linkProgram(program);
    gl.useProgram(program);
    gl.enable(gl.DEPTH_TEST);
    gl.enable(gl.BLEND);
    gl.blendFunc(gl.SRC_ALPHA, gl.ONE_MINUS_SRC_ALPHA);
    if (gl.getProgramParameter(program, gl.LINK_STATUS)) Object.assign(this, { gl, program });
  }

  /** Makes the layer `name` of TRIANGLES, LINES or POINTS from columns, in the order of ATTRIBUTES.
   * A look is a shape, then 1 for plain, 2 for lit or 3 for large. */
  setLayer(name, mode, ...columns) {
    const { gl } = this;
    const layer = (this.layers[name] ??= { mode, vao: gl?.createVertexArray(), buffers: [] });
    Object.assign(layer, { columns, count: columns[0].length / 3 });
    if (!gl) return;
    gl.bindVertexArray(layer.vao);
    for (const [index, array] of columns.entries()) {
      const [size, type] = ATTRIBUTES[index];
      gl.bindBuffer(gl.ARRAY_BUFFER, (layer.buffers[index] ??= gl.createBuffer()));
      gl.bufferData(gl.ARRAY_BUFFER, array, gl.DYNAMIC_DRAW);
      gl.enableVertexAttribArray(index);
      gl.vertexAttribPointer(index, size, gl[type], true, 0, 0);
    }
    this.draw();
  }

  /** Sets the camera: its target, its angles in radians, its distance, its picture's height. */
  look(camera) {
    if (!this.gl) return;
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

  /** Sets which part of the dots is drawn: all at rest, and while the camera moves only as many as
   * there is time for. */
  keepPace() {
    const now = performance.now(), since = now - this.drawn;
    const isMoving = this.moved > this.drawn || now - this.moved < 150;
    if (isMoving && this.wasMoving)
      this.pace = clamp(this.pace * clamp(42 / since, 0.3, 1.15), 0.02, 1);
    this.part = isMoving ? this.pace : 1;
    Object.assign(this, { drawn: now, wasMoving: isMoving });
    clearTimeout(this.rest);
    if (this.part < 1) this.rest = setTimeout(() => this.draw(), 250);
  }

  /** World to clip space, where the camera is, and half the height of its picture at distance 1. */
  lens() {
    const { canvas: { clientWidth: width, clientHeight: height }, camera } = this;
    const { yaw, pitch, target, distance, size } = camera, degrees = 180 / Math.PI;
    // A narrow view is higher, to show all of 4:3.
    const halfHeight = camera.halfHeight * Math.max(1, (4 / 3) * (height / width));
    const toCamera = new DOMMatrix().translate(0, 0, -distance)
      .rotate(-90 - pitch * degrees, 0, 0).rotate(0, 0, yaw * degrees)
      .translate(...scale(target, -1));
    const near = distance * 0.02, far = distance + 20 * size, high = 1 / halfHeight;
    const [depth, shift] = [(far + near) / (near - far), (2 * far * near) / (near - far)];
    const lens =
      [(high * height) / width, 0, 0, 0, 0, high, 0, 0, 0, 0, depth, -1, 0, 0, shift, 0];
    const matrix = new DOMMatrix(lens).multiply(toCamera);
    return { matrix, eye: toCamera.inverse().transformPoint(), halfHeight };
  }

  /** Where the line through `points` appears: its pieces before the camera, in CSS pixels. */
  outline(points) {
    const { matrix } = this.lens(), { clientWidth: width, clientHeight: height } = this.canvas;
    const nearest = 0.01;
    const ends = points.map((point) => matrix.transformPoint(new DOMPoint(...point)));
    /** The end `a` of a piece, or where its part before the camera ends. */
    const place = (a, b) => {
      const by = a.w < nearest ? (nearest - a.w) / (b.w - a.w) : 0;
      const [x, y, w] = ["x", "y", "w"].map((axis) => a[axis] + by * (b[axis] - a[axis]));
      return [((x / w + 1) / 2) * width, ((1 - y / w) / 2) * height];
    };
    return ends.slice(1).map((b, i) => [ends[i], b])
      .filter((piece) => piece.some(({ w }) => w >= nearest))
      .map(([a, b]) => [place(a, b), place(b, a)]);
  }

  /** Where `point` appears, in CSS pixels; nothing if it lies behind. */
  project(point) {
    return this.outline([point, point])[0]?.[0];
  }

  draw() {
    this.waiting ??= requestAnimationFrame(() => this.drawNow());
  }

  drawNow() {
    const { gl, canvas, camera } = this;
    this.waiting = null;
    if (!camera || !canvas.clientWidth) return;
    if (gl && !gl.isContextLost()) {
      const ratio = Math.min(window.devicePixelRatio || 1, 2);
      const [width, height] = [canvas.clientWidth, canvas.clientHeight].map((edge) =>
        Math.max(1, Math.round(edge * ratio)));
      if (canvas.width !== width || canvas.height !== height)
        Object.assign(canvas, { width, height });
      this.keepPace();
      this.begin(this.air, 0);
      if (this.alpha === 1) this.drawLayer("walls");
      // Paths are in no order, so the first part of the dots is spread evenly.
      this.drawLayer("dots", this.part);
      this.drawLayer("edges");
      gl.depthMask(false);
      if (this.alpha < 1) this.drawLayer("walls");
      this.drawLayer("moved");
      gl.depthMask(true);
    }
    this.onDraw();
  }

  /** Begins a picture on the color `back`; with `pick` 1 one of dots in colors of their own. */
  begin(back, pick) {
    const { gl, canvas: { width, height, clientWidth }, light, air, alpha } = this;
    const { matrix, eye: { x, y, z }, halfHeight } = this.lens();
    const values = {
      camera: matrix.toFloat32Array(), eye: [x, y, z], light, air, alpha, pick,
      pixels: (this.dotSize * height) / 2 / halfHeight, ratio: width / clientWidth,
      shift: [1 / width, -1 / height],
    };
    for (const [name, value] of Object.entries(values)) {
      const place = gl.getUniformLocation(this.program, name);
      if (value.length === 16) gl.uniformMatrix4fv(place, false, value);
      else gl[`uniform${value.length ?? 1}fv`](place, [value].flat());
    }
    gl.viewport(0, 0, width, height);
    gl.clearColor(...back, 1);
    gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
  }

  drawLayer(name, part = 1) {
    const { gl } = this, { mode, vao, count } = this.layers[name] ?? {};
    if (!count) return;
    gl.bindVertexArray(vao);
    gl.drawArrays(gl[mode], 0, Math.ceil(count * part));
  }

  /** Waits until everything is drawn; the function of this name in WebGL does not. */
  finish() {
    this.gl?.readPixels(0, 0, 1, 1, this.gl.RGBA, this.gl.UNSIGNED_BYTE, new Uint8Array(4));
  }

  /** The index of the dot drawn nearest to the CSS pixel (`x`, `y`), or -1. Draws the dots there
   * again, each in a color of its own; the next frame covers them. */
  pick(x, y) {
    const { gl, canvas: { width, height, clientWidth } } = this;
    const ratio = width / clientWidth, middle = (PICK - 1) / 2;
    const area = [Math.round(x * ratio) - middle, height - Math.round(y * ratio) - middle];
    gl.enable(gl.SCISSOR_TEST);
    gl.scissor(...area, PICK, PICK);
    this.begin([0, 0, 0], 1);
    if (this.alpha === 1) this.drawLayer("walls");
    gl.clear(gl.COLOR_BUFFER_BIT);
    this.drawLayer("dots");
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
