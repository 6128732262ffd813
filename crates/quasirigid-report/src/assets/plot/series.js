// Points of a curve. Where they stand for more rows of the record, two and two are the extremes of an interval of rows.
const OVERLAP = 0.2; // of the range of an interval with those of both neighbours, where the curve swings within it
const WIDEST = 1.7; // pixels: the width of a line
const ROUNDING = 1.2e-7; // of numbers of four bytes
const WINDOW = 6; // intervals on either side
const MOST_TURNS = 5; // of a curve that a line through its extremes shows

const isSorted = (list, sign) => list.every((value, i) => i === 0 || sign * (value - list[i - 1]) >= 0);

class Series {
  constructor({ label, class: style, values, rows, points, bar }, grid) {
    Object.assign(this, { label, style, rows, bar, apart: points || Boolean(bar), color: style.split(" ")[0] });
    this.read = once(() => this.decoded(grid, new Float32Array(values)));
    this.search = once(() => this.found());
  }

  decoded(x, y) {
    const falls = x.length > 1 && x[0] > x[x.length - 1] && isSorted(x, -1);
    if (falls) return { x: x.slice().reverse(), y: y.slice().reverse(), sorted: true };
    return { x, y, sorted: isSorted(x, 1) };
  }

  get x() {
    return this.read().x;
  }

  get y() {
    return this.read().y;
  }

  get sorted() {
    return this.read().sorted;
  }

  get thinned() {
    return !this.apart && this.sorted && this.rows > this.x.length;
  }

  get intervals() {
    return (this.x.length + 1) >> 1;
  }

  /** Rows of the record in an interval. */
  get rowsEach() {
    return Math.ceil(this.rows / this.intervals);
  }

  /** Whether the intervals in a range are so wide on the screen that a line does not fill them. */
  isCoarse(low, high, pixels) {
    if (!this.thinned) return false;
    const [first, end] = this.inside(low, high);
    return (end - first) * WIDEST < 2 * pixels;
  }

  swingsIn(low, high) {
    const [first, end] = this.inside(low, high);
    return this.swings.subarray(Math.max(0, first - 1) >> 1, (end >> 1) + 1).includes(1);
  }

  /** Indices of the lowest and the highest of some points; none where all are gaps. */
  extremesOf(from, to) {
    let [least, most] = [-1, -1];
    for (let i = Math.max(0, from); i < Math.min(to, this.y.length); i++) {
      if (Number.isNaN(this.y[i])) continue;
      if (least < 0 || this.y[i] < this.y[least]) least = i;
      if (most < 0 || this.y[i] > this.y[most]) most = i;
    }
    return [least, most];
  }

  /** The band at an interval: lowest and highest of it and its neighbours, so that it spans slow swings too. */
  band(k) {
    return this.isGap(k) ? [-1, -1] : this.extremesOf(2 * k - 2, 2 * k + 4);
  }

  isGap(k) {
    return Number.isNaN(this.y[2 * k]);
  }

  /** Interval by interval, whether the curve swings too fast for a line through its extremes. */
  get swings() {
    return this.search();
  }

  found() {
    const count = this.intervals;
    const [lows, highs] = [new Float32Array(count), new Float32Array(count)];
    for (let k = 0; k < count; k++) [lows[k], highs[k]] = this.extremesOf(2 * k, 2 * k + 2).map((i) => this.y[i]);
    const overlaps = (k, j) => j < 0 || j >= count || Math.min(highs[k], highs[j]) - Math.max(lows[k], lows[j]) > OVERLAP * (highs[k] - lows[k]);
    const rises = (k) => lows[k] + highs[k] > lows[k - 1] + highs[k - 1];
    const sums = (is) => {
      const sum = new Uint32Array(count + 1);
      for (let k = 0; k < count; k++) sum[k + 1] = sum[k] + is(k);
      return (k, reach) => sum[Math.min(count, k + reach + 1)] - sum[Math.max(0, k - reach)];
    };
    const fast = sums((k) => overlaps(k, k - 1) && overlaps(k, k + 1));
    const turns = sums((k) => k > 1 && highs[k] > lows[k] && rises(k) !== rises(k - 1));
    return new Uint8Array(count).map((_, k) => fast(k, 1) > 0 || turns(k, WINDOW) > MOST_TURNS);
  }

  /** Indices from the first point inside a range to the one after the last. */
  inside(low, high) {
    if (!this.sorted) return [0, this.x.length];
    const slack = ROUNDING * Math.max(Math.abs(low), Math.abs(high));
    return [firstFrom(this.x, low - slack), firstFrom(this.x, high + slack)];
  }

  /** Value between a point and the next. */
  between(i, at) {
    const { x, y } = this;
    return y[i] + ((at - x[i]) / (x[i + 1] - x[i])) * (y[i + 1] - y[i]);
  }

  /** Values where the line enters and leaves a range between two points. */
  edges(low, high) {
    if (!this.sorted || this.apart) return [NaN, NaN];
    const [first, end] = this.inside(low, high);
    const crosses = (i, at) => (i >= 0 && i + 1 < this.x.length && this.x[i + 1] > this.x[i] ? this.between(i, at) : NaN);
    return [this.x[first] > low ? crosses(first - 1, low) : NaN, this.x[end - 1] < high || end === first ? crosses(end - 1, high) : NaN];
  }

  /** Lowest and highest value in a range; infinite if there is none. */
  extremes(low, high, banded) {
    const [first, end] = this.inside(low, high);
    let [least, most] = [Infinity, -Infinity];
    const meet = (value) => {
      if (value < least) least = value;
      if (value > most) most = value;
    };
    const [from, to] = banded ? [Math.max(0, first - 4), Math.min(this.y.length, end + 4)] : [first, end];
    for (let i = from; i < to; i++) if (this.sorted || (this.x[i] >= low && this.x[i] <= high)) meet(this.y[i]);
    if (!banded) this.edges(low, high).forEach(meet);
    return [least, most];
  }

  /** Index of the point nearest to a place, or to a spot if `rise` tells how far a value is from it. */
  nearest(at, scale, rise) {
    const { x, y } = this;
    if (this.sorted && !rise) {
      const next = firstFrom(x, at);
      if (next === 0) return 0;
      return next === x.length || at - x[next - 1] <= x[next] - at ? next - 1 : next;
    }
    let [found, least] = [-1, Infinity];
    for (let i = 0; i < x.length; i++) {
      const far = Math.hypot((x[i] - at) / scale, rise ? rise(y[i]) : 0);
      if (far < least) [found, least] = [i, far];
    }
    return found;
  }
}
