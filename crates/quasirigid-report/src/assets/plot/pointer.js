// The rule at the pointer or the cursor, the points nearest to it, and their values.
const FINEST = 500; // parts of what is shown that a reading tells apart

/** Digits that tell values apart on what an axis shows. */
const digitsFor = ({ log }, value, [low, high]) => {
  const part = Math.abs(high - low) / FINEST;
  const digits = log ? -Math.log10(part) : Math.log10(Math.abs(value) / part);
  return Number.isFinite(digits) ? clamp(Math.ceil(digits), 3, 7) : 3;
};

/** Digits of a value on the scale of an axis, its power of ten resolved. */
const numberOn = ({ log, power }, value, digits) => {
  if (!log) return written(value, digits, power);
  const whole = Math.floor(value);
  return written(10 ** (value - whole), digits, whole);
};

const valueWords = (axis, value, digits) => withUnit(numberOn(axis, value, digits), axis.unit);

class Reader {
  constructor(chart) {
    this.chart = chart;
    this.rule = element(chart.over, "div", "rule");
    this.spots = element(chart.over, "div", "spots");
    this.readout = element(chart.box, "div", "readout");
    this.readout.setAttribute("aria-hidden", "true");
    this.hide();
  }

  hide() {
    this.rule.hidden = this.readout.hidden = this.spots.hidden = true;
  }

  refresh() {
    const { chart } = this;
    const { at, from, spot } = chart.group;
    const value = at === null ? NaN : chart.fromGroup(at);
    const part = chart.partOf(value);
    if (!(part >= 0 && part <= 1)) return this.hide();
    this.rule.hidden = this.readout.hidden = this.spots.hidden = false;
    this.rule.style.left = percent(part);
    const read = this.read(value, from === chart ? spot : null);
    this.write(value, read);
    this.ring(read);
  }

  /** The vertical axis as it is shown. */
  get axis() {
    return this.chart.view ? this.chart.layer().scale.y : this.chart.y;
  }

  /** The point of each series that is nearest to a place, or the interval around it where the curve swings. */
  read(at, spot) {
    const { chart, axis } = this;
    const [low, high] = chart.shown;
    const steep = HEIGHT / WIDTH;
    const found = [];
    for (const series of chart.series) {
      const rise = series.apart && spot !== null ? (value) => steep * (1 - spot - place(axis, value)) : null;
      const i = series.nearest(at, high - low, rise);
      const x = series.x[i];
      const isBeyond = i < 0 || (Math.abs(x - at) > 0.02 * (high - low) && (i === 0 || i === series.x.length - 1));
      if (isBeyond || !Number.isFinite(series.y[i])) continue;
      const indices = series.thinned && series.swings[i >> 1] ? series.band(i >> 1) : [i];
      found.push({ series, points: indices.map((j) => [series.x[j], series.y[j]]) });
    }
    return found;
  }

  /** The place that a reading tells: that of the points where they share it. */
  told(at, read) {
    const places = new Set(read.flatMap(({ points }) => points.map(([x]) => x)));
    return places.size === 1 ? [...places][0] : at;
  }

  words({ series, points }) {
    const { chart, axis } = this;
    const scale = [axis.low, axis.high].map((value) => value / (axis.factor ?? 1));
    const numbers = points.map(([, value]) => numberOn(chart.y, value, digitsFor(chart.y, value, scale)));
    return `${series.label ? `${series.label} ` : ""}${numbers.join(" … ")}`;
  }

  placeWords(at, read) {
    const { x, shown } = this.chart;
    const value = this.told(at, read);
    return `${x.name} ${valueWords(x, value, digitsFor(x, value, shown))}`;
  }

  write(at, read) {
    this.readout.replaceChildren();
    element(this.readout, "span", "").textContent = this.placeWords(at, read);
    for (const each of read) {
      const part = element(this.readout, "span", each.series.color);
      part.textContent = this.words(each);
      element(part, "span", "unit").textContent = withUnit("", this.chart.y.unit);
    }
  }

  /** Rings round the points that are read. */
  ring(read) {
    const { chart, axis } = this;
    this.spots.replaceChildren();
    for (const { series, points } of read) {
      for (const [x, y] of points) {
        const [part, rise] = [chart.partOf(x), place(axis, y)];
        if (part < 0 || part > 1 || rise < -0.01 || rise > 1.01) continue;
        const ring = element(this.spots, "i", series.color);
        Object.assign(ring.style, { left: percent(part), top: percent(1 - rise) });
      }
    }
  }

  sentence() {
    return [...this.readout.children].map((part) => part.textContent).join(", ");
  }
}
