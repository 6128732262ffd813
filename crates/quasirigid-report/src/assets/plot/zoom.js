// Pointers on a chart: drag selects a range, shift and drag or two fingers move it, a wheel with Ctrl zooms, a click seeks.
const CLICK = 4; // pixels that a click may move
const PER_PIXEL = 0.01;
const MOST_OF_A_WHEEL = 40;

class Gestures {
  constructor(chart) {
    Object.assign(this, { chart, over: chart.over, fingers: new Map(), drag: null });
    this.band = element(chart.over, "div", "band-of-range");
    this.band.hidden = true;
    const on = (name) => this.over.addEventListener(`pointer${name}`, (event) => this[name](event));
    ["down", "move", "up", "cancel", "leave"].forEach(on);
    this.over.addEventListener("dblclick", (event) => this.change(event, () => chart.group.whole()));
    this.over.addEventListener("wheel", (event) => this.wheel(event), { passive: false });
  }

  spot({ clientX, clientY }) {
    const box = this.over.getBoundingClientRect();
    return [(clientX - box.left) / box.width, (clientY - box.top) / box.height];
  }

  down(event) {
    if (event.button !== 0) return;
    this.over.setPointerCapture(event.pointerId);
    const [part, rise] = this.spot(event);
    this.fingers.set(event.pointerId, part);
    if (this.fingers.size > 1) return this.cancelDrag();
    this.drag = { from: part, to: part, x: event.clientX, moved: false, pans: event.shiftKey };
    this.read(part, rise);
  }

  move(event) {
    const [part, rise] = this.spot(event);
    if (this.fingers.size > 1) return this.pinch(event.pointerId, part);
    this.read(clamp(part, 0, 1), rise);
    const { drag } = this;
    if (!drag) return;
    drag.moved ||= Math.abs(event.clientX - drag.x) > CLICK;
    if (!drag.moved) return;
    if (drag.pans) this.change(event, () => this.chart.pan(drag.to - part));
    drag.to = part;
    if (!drag.pans) this.mark();
  }

  up(event) {
    const { drag } = this;
    this.fingers.delete(event.pointerId);
    this.cancelDrag();
    if (!drag) return;
    if (drag.moved && !drag.pans) this.change(event, () => this.chart.select(drag.from, drag.to));
    else if (!drag.moved) this.chart.seek(drag.from);
  }

  /** Changes what is shown, and reads the place that is under the pointer then. */
  change(event, act) {
    act();
    this.chart.refresh();
    const [part, rise] = this.spot(event);
    this.read(clamp(part, 0, 1), rise);
  }

  cancel(event) {
    this.fingers.delete(event.pointerId);
    this.cancelDrag();
    this.read(null);
  }

  cancelDrag() {
    const had = this.drag;
    this.drag = null;
    this.band.hidden = true;
    return Boolean(had);
  }

  leave(event) {
    if (event.pointerType !== "touch") this.read(null);
  }

  read(part, rise) {
    const { chart } = this;
    chart.cursor = null;
    chart.group.read(part === null ? null : chart.toGroup(chart.valueAt(part)), chart, rise);
  }

  mark() {
    const [from, to] = [this.drag.from, this.drag.to].map((part) => clamp(part, 0, 1));
    this.band.hidden = false;
    Object.assign(this.band.style, { left: percent(Math.min(from, to)), width: percent(Math.abs(to - from)) });
  }

  /** Two fingers keep the places under them. */
  pinch(id, part) {
    if (!this.fingers.has(id)) return;
    const [other] = [...this.fingers].filter(([key]) => key !== id).map(([, at]) => at);
    const before = this.fingers.get(id);
    this.fingers.set(id, part);
    const [was, is] = [before - other, part - other];
    if (was * is <= 0 || Math.abs(is) < 0.02) return;
    this.chart.zoom(other, was / is);
    this.chart.refresh();
  }

  wheel(event) {
    if (!event.ctrlKey && !event.metaKey) return;
    event.preventDefault();
    const pixels = event.deltaY * (event.deltaMode === 1 ? 16 : 1);
    this.chart.zoom(clamp(this.spot(event)[0], 0, 1), Math.exp(PER_PIXEL * clamp(pixels, -MOST_OF_A_WHEEL, MOST_OF_A_WHEEL)));
  }
}
