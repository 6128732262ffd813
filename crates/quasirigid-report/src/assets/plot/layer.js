// The drawing of a part of a chart, in place of the static one, which stays for the whole and for paper.
const SVG = "http://www.w3.org/2000/svg";
const LINE = 16 / 240; // height of a line of text
const CHARACTER = 7.3; // pixels
const MARK_ROW = 1.4; // em from the label of an event to that of the next

const svgNode = (parent, name, attributes, words) => {
  const node = parent.appendChild(document.createElementNS(SVG, name));
  for (const key in attributes) node.setAttribute(key, attributes[key]);
  if (words !== undefined) node.textContent = words;
  return node;
};

/** A line across the plot, but for the ends that are given. */
const line = (parent, style, ends) => svgNode(parent, "line", { class: style, x1: 0, x2: "100%", y1: 0, y2: "100%", ...ends });

const percent = (part) => `${(100 * part).toFixed(2)}%`;

/** Moves sorted places apart to the height of a line of text, keeping them within the plot. */
const apart = (places) => {
  const moved = [];
  for (const at of places) moved.push(Math.max(at, moved.length ? moved[moved.length - 1] + LINE : -1));
  let limit = 1;
  for (let i = moved.length - 1; i >= 0; i--) {
    moved[i] = Math.min(moved[i], limit);
    limit = moved[i] - LINE;
  }
  return moved;
};

class Layer {
  constructor(chart) {
    const { plot, series } = chart;
    this.chart = chart;
    const [nameOfY, nameOfX] = plot.querySelectorAll(".name:not(.event)");
    const drawn = [...plot.children].filter((node) => !/^(title|desc)$/.test(node.localName));
    svgNode(plot, "g", { class: "whole" }).append(...drawn);
    const own = svgNode(plot, "g", { class: "part" });
    this.grid = svgNode(own, "g", {});
    this.names = { x: own.appendChild(nameOfX.cloneNode(true)), y: own.appendChild(nameOfY.cloneNode(true)) };
    this.named = { x: nameOfX.textContent, y: nameOfY.textContent };
    const box = { viewBox: `0 0 ${WIDTH} ${HEIGHT}`, preserveAspectRatio: "none", width: "100%", height: "100%" };
    const inner = svgNode(own, "svg", box);
    const path = (kind, { style, label }) => svgNode(inner, "path", { class: `${kind} ${style}`, "data-label": label });
    const paths = (source) => ({ area: path("reach", source), line: path("curve", source), dots: path("dots", source) });
    this.paths = new Map([...series].reverse().map((source) => [source, paths(source)]));
    this.over = svgNode(own, "g", {});
  }

  draw([low, high]) {
    const { chart } = this;
    const { series } = chart;
    const x = { ...chart.x, low, high };
    chart.coarse = series.filter((each) => each.isCoarse(low, high, chart.over.clientWidth));
    chart.banded = chart.coarse.filter((each) => each.swingsIn(low, high));
    const ends = series.map((each) => each.extremes(low, high, chart.banded.includes(each)));
    const [least, most] = [Math.min(...ends.map(([least]) => least)), Math.max(...ends.map(([, most]) => most))];
    const y = least <= most ? fitted(chart.y, least, most) : { ...chart.y };
    if (series.some(({ bar }) => bar)) y.low = 0;
    this.scale = { x, y };
    this.drawGrid(x, y);
    for (const [each, nodes] of this.paths) {
      const parts = outline(each, x, y, chart.banded.includes(each));
      for (const part in nodes) nodes[part].setAttribute("d", parts[part]);
    }
    this.over.replaceChildren();
    this.drawLabels(x, y);
    chart.data.marks.forEach((mark, row) => this.drawMark(place(x, mark.x), mark, row));
  }

  drawGrid(x, y) {
    const { grid, chart } = this;
    grid.replaceChildren();
    line(grid, "base", { y1: "100%" });
    const vertical = ticksOf(y);
    for (const tick of vertical.ticks) {
      const at = percent(1 - tick.at);
      line(grid, "grid", { y1: at, y2: at });
      svgNode(grid, "text", { class: "tick end", x: 0, y: at, dx: "-0.6em", dy: "0.35em" }, tick.label);
    }
    const horizontal = this.ticksThatFit(x, chart.over.clientWidth);
    for (const tick of horizontal.ticks) {
      const at = percent(tick.at);
      line(grid, "grid", { x1: at, x2: at });
      svgNode(grid, "text", { class: "tick middle", x: at, y: "100%", dy: "1.5em" }, tick.label);
    }
    this.names.x.textContent = this.nameOf("x", horizontal.power);
    this.names.y.textContent = this.nameOf("y", vertical.power);
  }

  /** As many ticks as have room for their labels. */
  ticksThatFit(axis, pixels) {
    for (let most = TICKS; ; most--) {
      const found = ticksOf(axis, most);
      const longest = Math.max(...found.ticks.map(({ label }) => label.length));
      if (most === 1 || found.ticks.length * (longest + 2) * CHARACTER <= pixels) return found;
    }
  }

  nameOf(which, power) {
    const { name, unit, log, power: usual } = this.chart[which];
    const asDrawn = power === (log ? 0 : usual);
    return asDrawn ? this.named[which] : `${name} [${unitWithPower(power, unit === "1" ? "" : unit).trim()}]`;
  }

  /** Names at the right ends of the curves. */
  drawLabels(x, y) {
    if (this.chart.series.some(({ bar }) => bar)) return this.listLabels();
    const ends = this.chart.series.filter(({ label }) => label).map((series) => [series, this.endOf(series, x, y)]);
    const known = ends.filter(([, at]) => Number.isFinite(at)).sort((a, b) => a[1] - b[1]);
    const places = apart(known.map(([, at]) => at));
    known.forEach(([series], i) => {
      const attributes = { class: `label ${series.style}`, x: "100%", y: percent(places[i]), dx: "0.6em", dy: "0.35em" };
      svgNode(this.over, "text", attributes, series.label);
    });
  }

  /** Names of bars, in the upper right corner. */
  listLabels() {
    this.chart.series.filter(({ label }) => label).forEach(({ style, label }, i) => {
      const attributes = { class: `label ${style} end`, x: "100%", y: percent((i + 0.7) * LINE), dx: "-0.6em", dy: "0.35em" };
      svgNode(this.over, "text", attributes, label);
    });
  }

  endOf(series, x, y) {
    const [first, end] = series.inside(x.low, x.high);
    const [enters, leaves] = series.edges(x.low, x.high);
    const middle = this.chart.banded.includes(series) ? series.band(Math.max(0, end - 1) >> 1).map((i) => series.y[i]) : null;
    let last = middle ? (middle[0] + middle[1]) / 2 : leaves;
    for (let i = end - 1; i >= first && !Number.isFinite(last); i--) if (series.sorted || place(x, series.x[i]) <= 1) last = series.y[i];
    return clamp(1 - place(y, Number.isFinite(last) ? last : enters), 0, 1);
  }

  drawMark(part, { label, above }, row) {
    if (!(part >= 0 && part <= 1)) return;
    const at = percent(part);
    const left = part > 0.5;
    const down = above ? 1.1 + MARK_ROW * row : -0.6 - MARK_ROW * row;
    line(this.over, "event", { x1: at, x2: at });
    svgNode(this.over, "text", { class: `name event${left ? " end" : ""}`, x: at, y: above ? "0%" : "100%", dx: left ? "-0.5em" : "0.5em", dy: `${down}em` }, label);
  }
}
