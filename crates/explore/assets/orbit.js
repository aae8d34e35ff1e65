// The box in 3-D: pointers and the wheel.

/** Lets pointers and the wheel turn `view`. Calls `onClick` for a click and `onCenter` for a
 * double-click. */
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
    return b ? Math.hypot(a.x - b.x, a.y - b.y) : null;
  };
  canvas.onpointerdown = ({ pointerId, offsetX: x, offsetY: y }) => {
    canvas.setPointerCapture(pointerId);
    pointers.set(pointerId, { x, y });
    if (pointers.size === 1) moved = 0;
  };
  canvas.onpointermove = ({ pointerId, offsetX: x, offsetY: y }) => {
    const pointer = pointers.get(pointerId);
    if (!pointer) return;
    const before = spread();
    const [dx, dy] = [x - pointer.x, y - pointer.y];
    Object.assign(pointer, { x, y });
    moved += Math.abs(dx) + Math.abs(dy);
    if (before) zoom(before / spread());
    else turn(dx * 0.006, dy * 0.006);
  };
  canvas.onpointercancel = ({ pointerId }) => pointers.delete(pointerId);
  canvas.onpointerup = ({ pointerId, offsetX, offsetY }) => {
    const isClick = pointers.size === 1 && moved <= 6;
    if (pointers.delete(pointerId) && isClick) onClick(offsetX, offsetY);
  };
  canvas.ondblclick = ({ offsetX, offsetY }) => onCenter(offsetX, offsetY);
  canvas.onwheel = (event) => {
    event.preventDefault();
    zoom(Math.exp(event.deltaY * 0.0012));
  };
  return { turn, zoom };
}
