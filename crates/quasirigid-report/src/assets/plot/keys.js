// Keys on a chart, and the one live region of the page, which tells what they did.
const HELP = "Plus and minus zoom, arrows move, 0 or Escape shows all. Alt and arrows move a cursor that reads the values; Enter goes to its time.";
const KEY_ZOOM = 1.5;
const KEY_PAN = 0.15;
const KEY_STEPS = 50; // of the cursor over what is shown

const telling = once(() => {
  const place = document.querySelector("main") ?? document.body;
  const region = element(place, "div", "unseen");
  region.setAttribute("aria-live", "polite");
  const help = element(place, "p", "unseen");
  Object.assign(help, { id: "plot-keys", textContent: HELP });
  return region;
});

class Keys {
  constructor(chart, gestures) {
    Object.assign(this, { chart, gestures });
    const { over } = chart;
    over.tabIndex = 0;
    const attributes = { role: "application", "aria-roledescription": "chart", "aria-label": chart.data.title, "aria-describedby": "plot-keys" };
    for (const [key, value] of Object.entries(attributes)) over.setAttribute(key, value);
    chart.figure.addEventListener("keydown", (event) => (event.target === over || event.key === "Escape") && this.key(event));
    over.addEventListener("blur", () => this.readAt(null));
  }

  key(event) {
    if (event.ctrlKey || event.metaKey) return;
    const { chart } = this;
    const sign = { ArrowLeft: -1, ArrowRight: 1 }[event.key];
    const at = chart.cursor == null ? 0.5 : clamp(chart.partOf(chart.cursor), 0, 1);
    const zoom = (factor) => () => chart.zoom(at, factor);
    const whole = () => this.escape();
    const actions = { "+": zoom(1 / KEY_ZOOM), "=": zoom(1 / KEY_ZOOM), "-": zoom(KEY_ZOOM), 0: whole, Escape: whole };
    if (sign && event.altKey) this.step(sign);
    else if (event.altKey) return;
    else if (event.key === "Enter" && chart.cursor != null) chart.seek(at);
    else if (sign || actions[event.key]) this.change(sign ? () => chart.pan(sign * KEY_PAN) : actions[event.key]);
    else return;
    event.preventDefault();
  }

  escape() {
    if (!this.gestures.cancelDrag()) this.chart.group.whole();
  }

  change(act) {
    act();
    this.chart.refresh();
    telling().textContent = this.chart.rangeWords();
  }

  /** Moves the cursor, at least to the next point of the first series. */
  step(sign) {
    const { chart } = this;
    const [low, high] = chart.shown;
    const { x, sorted } = chart.series[0];
    const start = chart.cursor ?? (sign > 0 ? low : high);
    let at = chart.cursor == null || start < low || start > high ? clamp(start, low, high) : start + (sign * (high - low)) / KEY_STEPS;
    if (sorted) {
      const i = chart.series[0].nearest(at);
      const beyond = sign > 0 ? x[i] > start : x[i] < start;
      at = beyond || chart.cursor == null ? x[i] : x[clamp(i + sign, 0, x.length - 1)];
    }
    this.readAt(clamp(at, low, high));
    chart.refresh();
    telling().textContent = chart.reader.sentence();
  }

  readAt(value) {
    this.chart.group.read(value === null ? null : this.chart.toGroup(value), this.chart);
    this.chart.cursor = value;
  }
}
