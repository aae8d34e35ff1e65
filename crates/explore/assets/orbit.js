// The box in 3-D: pointers, wheel and keyboard.

/** Lets pointers, the wheel and the keyboard turn `view`. Calls `onClick` for a click and
 * `onCenter` for a double-click. */
function orbit(view, onClick, onCenter) {
  const { canvas } = view;
  const pointers = new Map();
  let moved = 0;
  const turn = (dx, dy) => view.look({ yaw: view.camera.yaw + dx, pitch: view.camera.pitch - dy });
  const zoom = (by) => {
    const { distance, size } = view.camera;
    view.look({ distance: clamp(distance * by, size / 500, size * 20) });
  };
  const spread = () => {
    const [a, b] = [...pointers.values()];
    return Math.hypot(a.x - b.x, a.y - b.y);
  };
  canvas.addEventListener("pointerdown", ({ pointerId, offsetX: x, offsetY: y }) => {
    canvas.setPointerCapture(pointerId);
    pointers.set(pointerId, { x, y });
    if (pointers.size === 1) moved = 0;
  });
  canvas.addEventListener("pointermove", ({ pointerId, offsetX: x, offsetY: y }) => {
    const pointer = pointers.get(pointerId);
    if (!pointer) return;
    const before = pointers.size === 2 ? spread() : 0;
    const [dx, dy] = [x - pointer.x, y - pointer.y];
    Object.assign(pointer, { x, y });
    moved += Math.abs(dx) + Math.abs(dy);
    if (pointers.size === 2) zoom(before / spread());
    else turn(dx * 0.006, dy * 0.006);
  });
  const release = ({ type, pointerId, offsetX, offsetY }) => {
    const isClick = type === "pointerup" && pointers.size === 1 && moved <= 6;
    if (pointers.delete(pointerId) && isClick) onClick(offsetX, offsetY);
  };
  canvas.addEventListener("pointerup", release);
  canvas.addEventListener("pointercancel", release);
  canvas.addEventListener("dblclick", ({ offsetX, offsetY }) => onCenter(offsetX, offsetY));
  const onWheel = (event) => {
    event.preventDefault();
    zoom(Math.exp(event.deltaY * 0.0012));
  };
  canvas.addEventListener("wheel", onWheel, { passive: false });
  return { turn, zoom };
}
