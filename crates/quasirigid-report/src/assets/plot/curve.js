// Path data of a curve in view: a line with gaps, dots, and bands where the curve swings between two points.
const WIDTH = 8000; // of the drawing, in tenths of the static one's: whole numbers are short and fast to write
const HEIGHT = 2400;
const FAR = 1e6;

class Pen {
  constructor(x, y) {
    Object.assign(this, { x, y, line: "", dots: "", before: "", drawn: 0 });
    this.wide = WIDTH / (x.high - x.low);
    this.tall = HEIGHT / (y.high - y.low);
  }

  across(value) {
    return clamp(Math.round((value - this.x.low) * this.wide), -FAR, FAR);
  }

  down(value) {
    return clamp(Math.round(HEIGHT - ((this.y.factor ?? 1) * value - this.y.low) * this.tall), -FAR, FAR);
  }

  draw(x, y) {
    if (!Number.isFinite(y)) return this.lift();
    const spot = `${this.across(x)} ${this.down(y)}`;
    if (spot === this.before) return;
    if (this.drawn === 1) this.line += `M${this.before}`;
    if (this.drawn > 0) this.line += `L${spot}`;
    this.before = spot;
    this.drawn++;
  }

  lift() {
    if (this.drawn === 1) this.dots += `M${this.before}h0`;
    this.before = "";
    this.drawn = 0;
  }

  result(area = "") {
    this.lift();
    return { line: this.line, dots: this.dots, area };
  }
}

const dotted = (series, pen) => {
  const { x, y } = series;
  const [first, end] = series.inside(pen.x.low, pen.x.high);
  for (let i = first; i < end; i++) {
    if (Number.isFinite(y[i]) && x[i] >= pen.x.low && x[i] <= pen.x.high) pen.dots += `M${pen.across(x[i])} ${pen.down(y[i])}h0`;
  }
  return pen.result();
};

const lined = (series, pen) => {
  const { x, y } = series;
  const { low, high } = pen.x;
  const [first, end] = series.inside(low, high);
  const [enters, leaves] = series.edges(low, high);
  if (Number.isFinite(enters)) pen.draw(low, enters);
  for (let i = first; i < end; i++) pen.draw(x[i], y[i]);
  if (Number.isFinite(leaves)) pen.draw(high, leaves);
  return pen.result();
};

/** The bands of all intervals in view, as one outline from gap to gap. */
const banded = (series, pen) => {
  const { x, y, intervals } = series;
  const [first, end] = series.inside(pen.x.low, pen.x.high);
  const edge = (k) => pen.across(k === 0 ? x[0] : k >= intervals ? x[x.length - 1] : (x[2 * k - 1] + x[2 * k]) / 2);
  let [area, tops, bottoms] = ["", [], []];
  const close = () => {
    if (tops.length) area += `M${[...tops, ...bottoms.reverse()].join("L")}Z`;
    [tops, bottoms] = [[], []];
  };
  for (let k = Math.max(0, (first >> 1) - 1); k < Math.min(intervals, (end >> 1) + 2); k++) {
    const [bottom, top] = series.band(k).map((i) => pen.down(y[i]));
    if (series.isGap(k)) close();
    else {
      const [left, right] = [edge(k), edge(k + 1)];
      tops.push(`${left} ${top}`, `${right} ${top}`);
      bottoms.push(`${left} ${bottom}`, `${right} ${bottom}`);
    }
  }
  close();
  return pen.result(area);
};

/** Bars from zero. */
const barred = ({ x, y, bar }, pen) => {
  let area = "";
  for (let i = 0; i < x.length; i++) {
    const [left, right] = bar.map((edge) => pen.across(x[i] + edge));
    if (Number.isFinite(y[i])) area += `M${left} ${pen.down(0)}V${pen.down(y[i])}H${right}V${pen.down(0)}Z`;
  }
  return pen.result(area);
};

const outline = (series, x, y, asBand) => (series.bar ? barred : series.apart ? dotted : asBand ? banded : lined)(series, new Pen(x, y));
