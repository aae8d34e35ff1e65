// The box in 3-D: pointers and the wheel.

/** Lets pointers and the wheel turn `view`. Calls `onClick` for a click and `onCenter` for a
 * double-click. */
function orbit(view, onClick, onCenter) {
  const { canvas } = view;
  /** The last event of each finger, or of the mouse. */
  const fingers = new Map();
  let moved = 0;
  const spread = () => {
    const [a, b] = fingers.values();
    return Math.hypot(a.clientX - b.clientX, a.clientY - b.clientY);
  };
  canvas.onpointerdown = (event) => {
    canvas.setPointerCapture(event.pointerId);
    if (fingers.size === 0) moved = 0;
    fingers.set(event.pointerId, event);
  };
  canvas.onpointermove = (event) => {
    const last = fingers.get(event.pointerId);
    if (!last) return;
    const before = fingers.size > 1 && spread();
    fingers.set(event.pointerId, event);
    const [dx, dy] = [event.clientX - last.clientX, event.clientY - last.clientY];
    moved += Math.abs(dx) + Math.abs(dy);
    if (before) view.move(0, 0, before / spread());
    else view.move(dx * 0.006, dy * 0.006);
  };
  canvas.onpointerup = canvas.onpointercancel = ({ pointerId }) => fingers.delete(pointerId);
  canvas.onclick = ({ offsetX, offsetY }) => moved > 6 || onClick(offsetX, offsetY);
  canvas.ondblclick = ({ offsetX, offsetY }) => onCenter(offsetX, offsetY);
  canvas.onwheel = (event) => {
    event.preventDefault();
    view.move(0, 0, Math.exp(event.deltaY * 0.0012));
  };
}
