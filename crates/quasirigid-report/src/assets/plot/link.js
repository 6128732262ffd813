// Charts that show the same range and read the same place: a group, whose places are in units of the link.
class Group {
  constructor(name) {
    Object.assign(this, { name, charts: [], range: null, at: null, from: null, spot: null, now: null, waiting: 0 });
  }

  get extent() {
    const ends = this.charts.map((chart) => [chart.x.low, chart.x.high].map((value) => chart.toGroup(value)));
    return [Math.min(...ends.map(([low]) => low)), Math.max(...ends.map(([, high]) => high))];
  }

  /** Shows a range, moved into that of all charts; the whole if it is as long. */
  show([low, high]) {
    const [least, most] = this.extent;
    const length = high - low;
    if (!(length > 0)) return;
    const start = clamp(low, least, Math.max(least, most - length));
    this.range = length >= (most - least) * (1 - 1e-9) ? null : [start, start + length];
    this.redraw();
  }

  whole() {
    this.range = null;
    this.redraw();
  }

  /** Reads a place, or none; `spot` is the height of the pointer in the chart that it is over. */
  read(at, from = null, spot = null) {
    Object.assign(this, { at, from, spot });
    this.redraw();
  }

  mark(now) {
    this.now = now;
    this.redraw();
  }

  redraw() {
    this.waiting ||= requestAnimationFrame(() => {
      this.waiting = 0;
      for (const chart of this.charts) if (chart.visible) chart.refresh();
    });
  }
}

const groups = new Map();

/** The group of a link; a group of its own for a chart without one. */
const groupOf = (link) => {
  if (!link) return new Group("");
  if (!groups.has(link.group)) groups.set(link.group, new Group(link.group));
  return groups.get(link.group);
};
