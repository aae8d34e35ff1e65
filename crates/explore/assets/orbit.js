// The box in 3-D: pointers, wheel and keyboard.

/** Lets pointers, the wheel and the keyboard turn `view`. Calls `onClick` for a click and
 * `onCentre` for a double-click. */
function orbit(view, onClick, onCentre) {
  const { canvas } = view;
  const pointers = new Map();
  let moved = 0;
  const turn = (dx, dy) => view.look({ yaw: view.camera.yaw + dx, pitch: view.camera.pitch - dy });
  const zoom = (by) =>
    view.look({
      distance: Math.min(
        Math.max(view.camera.distance * by, view.camera.size / 500),
        view.camera.size * 20,
      ),
    });
  const spread = () => {
    const [a, b] = [...pointers.values()];
    return Math.hypot(a.x - b.x, a.y - b.y);
  };
  canvas.addEventListener("pointerdown", (event) => {
    canvas.setPointerCapture(event.pointerId);
    pointers.set(event.pointerId, { x: event.offsetX, y: event.offsetY });
    if (pointers.size === 1) moved = 0;
  });
  canvas.addEventListener("pointermove", (event) => {
    const pointer = pointers.get(event.pointerId);
    if (!pointer) return;
    const before = pointers.size === 2 ? spread() : 0;
    const [dx, dy] = [event.offsetX - pointer.x, event.offsetY - pointer.y];
    Object.assign(pointer, { x: event.offsetX, y: event.offsetY });
    moved += Math.abs(dx) + Math.abs(dy);
    if (pointers.size === 2) zoom(before / spread());
    else if (event.shiftKey || event.buttons === 4) {
      const { right, up } = view.axes(),
        by = (2 * view.halfHeight * view.camera.distance) / canvas.clientHeight;
      view.look({ target: add(add(view.camera.target, right, -dx * by), up, dy * by) });
    } else turn(dx * 0.006, dy * 0.006);
  });
  const release = (event) => {
    if (
      !pointers.delete(event.pointerId) ||
      event.type !== "pointerup" ||
      moved > 6 ||
      pointers.size
    )
      return;
    onClick(event.offsetX, event.offsetY);
  };
  canvas.addEventListener("pointerup", release);
  canvas.addEventListener("pointercancel", release);
  canvas.addEventListener("dblclick", (event) => onCentre(event.offsetX, event.offsetY));
  canvas.addEventListener(
    "wheel",
    (event) => {
      event.preventDefault();
      zoom(Math.exp(event.deltaY * 0.0012));
    },
    { passive: false },
  );
  return { turn, zoom };
}
