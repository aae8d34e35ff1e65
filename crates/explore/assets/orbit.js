// The box in 3-D: pointers and the wheel.

/** Lets pointers and the wheel turn `view`, and tells of clicks and double-clicks. */
function orbit(view, onClick, onCenter) {
  const { canvas } = view;
  /** The last place of each finger, or of the mouse. */
  const fingers = new Map();
  let moved = 0;
  const spread = () => {
    const [a, b] = fingers.values();
    return Math.hypot(a.x - b.x, a.y - b.y);
  };
  canvas.onpointerdown = ({ pointerId, x, y }) => {
    canvas.setPointerCapture(pointerId);
    if (fingers.size === 0) moved = 0;
    fingers.set(pointerId, { x, y });
  };
  canvas.onpointermove = ({ pointerId, x, y }) => {
    const last = fingers.get(pointerId);
    if (!last) return;
    const before = fingers.size > 1 && spread();
    fingers.set(pointerId, { x, y });
    moved += Math.abs(x - last.x) + Math.abs(y - last.y);
    if (before) view.move(0, 0, before / spread());
    else view.move((x - last.x) * 0.006, (y - last.y) * 0.006);
  };
  canvas.onpointerup = canvas.onpointercancel = ({ pointerId }) => fingers.delete(pointerId);
  canvas.onclick = ({ offsetX, offsetY }) => moved > 6 || onClick(offsetX, offsetY);
  canvas.ondblclick = ({ offsetX, offsetY }) => onCenter(offsetX, offsetY);
  canvas.onwheel = (event) => {
    event.preventDefault();
    view.move(0, 0, Math.exp(event.deltaY * 0.0012));
  };
}
