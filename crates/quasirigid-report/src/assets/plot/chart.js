// A chart: its data, what it shows now, and the layer over the plot that takes pointer and keys.
const SMALLEST = 1e-4; // of the whole range
const element = (parent, name, style) => {
  const node = parent.appendChild(document.createElement(name));
  node.className = style;
  return node;
};

class Chart {
  constructor(figure, data) {
    Object.assign(this, { figure, data, x: data.x, y: data.y, visible: false, view: null, coarse: [], banded: [] });
    this.box = figure.querySelector(".chart");
    this.plot = figure.querySelector(".plot");
    const grids = data.grids.map((bytes) => new Float32Array(bytes));
    this.series = data.series.map((source) => new Series(source, grids[source.grid]));
    this.group = groupOf(data.x.link);
    this.group.charts.push(this);
    this.over = element(this.box, "div", "over");
    this.note = element(this.box, "p", "note");
    this.layer = once(() => new Layer(this));
    this.reader = new Reader(this);
    this.now = element(this.over, "div", "now");
    this.now.hidden = true;
    this.onView = [];
  }

  get isTime() {
    return this.group.name === "t";
  }

  toGroup(value) {
    const { link, log, power } = this.x;
    return link ? link.factor * (log ? 10 ** value : value * 10 ** power) : value;
  }

  fromGroup(value) {
    const { link, log, power } = this.x;
    if (!link) return value;
    return log ? Math.log10(value / link.factor) : value / link.factor / 10 ** power;
  }

  /** The range of the group within that of this chart; none where it is the whole, or where they have nothing in common. */
  wanted() {
    if (!this.group.range) return null;
    const { low, high } = this.x;
    const [from, to] = this.group.range.map((value) => this.fromGroup(value));
    const slack = 1e-9 * (high - low);
    const [least, most] = [Math.max(low, from), Math.min(high, to)];
    const isWhole = least <= low + slack && most >= high - slack;
    return isWhole || !(most - least > slack) ? null : [least, most];
  }

  /** The part of the horizontal axis that is shown. */
  get shown() {
    return this.view ?? [this.x.low, this.x.high];
  }

  show(range) {
    this.group.show(range.map((value) => this.toGroup(value)));
  }

  valueAt(part) {
    const [low, high] = this.shown;
    return low + part * (high - low);
  }

  partOf(value) {
    const [low, high] = this.shown;
    return (value - low) / (high - low);
  }

  /** Shows less or more about a place from 0 to 1. */
  zoom(part, factor) {
    const at = this.valueAt(part);
    const { range } = this.group;
    const [low, high] = factor > 1 && range ? range.map((value) => this.fromGroup(value)) : this.shown;
    if (factor < 1 && (high - low) * factor < SMALLEST * (this.x.high - this.x.low)) return;
    this.show([at - (at - low) * factor, at + (high - at) * factor]);
  }

  /** Shows what lies beside, by a part of what is shown. */
  pan(part) {
    if (!this.view) return;
    const [low, high] = this.view;
    const { low: least, high: most } = this.x;
    const by = clamp(part * (high - low), least - low, most - high);
    this.show([low + by, high + by]);
  }

  select(a, b) {
    const [from, to] = [Math.min(a, b), Math.max(a, b)].map((part) => this.valueAt(clamp(part, 0, 1)));
    const lacks = Math.max(0, SMALLEST * (this.x.high - this.x.low) - (to - from)) / 2;
    this.show([from - lacks, to + lacks]);
  }

  seek(part) {
    const t = this.toGroup(this.valueAt(clamp(part, 0, 1)));
    if (this.isTime) window.dispatchEvent(new CustomEvent("quasirigid:seek", { detail: { t } }));
  }

  /** Brings the picture up to date with the group. */
  refresh() {
    const view = this.wanted();
    if (String(view) !== String(this.view)) {
      this.view = view;
      this.draw();
    }
    this.reader.refresh();
    this.placeNow();
  }

  /** A part is drawn for its width in pixels. */
  resized() {
    if (this.view && this.over.clientWidth) this.draw();
  }

  draw() {
    this.box.classList.toggle("zoomed", Boolean(this.view));
    this.coarse = this.banded = [];
    if (this.view) this.layer().draw(this.view);
    this.note.textContent = this.noteWords();
    for (const tell of this.onView) tell();
  }

  noteWords() {
    const each = this.coarse.map((series) => series.rowsEach * (this.banded.includes(series) ? 3 : 1));
    if (!each.length) return "";
    const [least, most] = [Math.min(...each), Math.max(...each)].map((rows) => fixed(rows, 0));
    return `Extremes of ${least === most ? most : `${least} to ${most}`} rows each`;
  }

  placeNow() {
    const { now } = this.group;
    const part = now === null ? NaN : this.partOf(this.fromGroup(now));
    this.now.hidden = !(part >= 0 && part <= 1);
    if (!this.now.hidden) this.now.style.left = `${(100 * part).toFixed(3)}%`;
  }

  /** What is shown, in words. */
  rangeWords() {
    const [low, high] = this.shown.map((value) => valueWords(this.x, value, digitsFor(this.x, value, this.shown)));
    return this.view ? `${this.x.name} from ${low} to ${high}` : `The whole: ${this.x.name} from ${low} to ${high}`;
  }
}
