// Two curves over time in one SVG: these settings and the run, each a band where it swings within a column.
const SVG = "http://www.w3.org/2000/svg";
const PLOT = { left: 46, right: 10, top: 10, bottom: 26, width: 400, height: 190 };

const svgNode = (parent, name, attributes, words) => {
  const node = parent.appendChild(document.createElementNS(SVG, name));
  for (const [key, value] of Object.entries(attributes)) node.setAttribute(key, value);
  if (words !== undefined) node.textContent = words;
  return node;
};

/** Round ticks within a range. */
const ticksOf = (low, high, most) => {
  const step = [1, 2, 5, 10].map((m) => m * 10 ** Math.floor(Math.log10((high - low) / most))).find((s) => (high - low) / s <= most);
  const first = Math.ceil(low / step - 1e-9);
  return Array.from({ length: Math.floor(high / step + 1e-9) - first + 1 }, (_, i) => (first + i) * step);
};

/** Outline of a band, or a line where it is thin; columns without values are left out. */
const outline = (curve, x, y) => {
  const known = curve.map(([low, high], i) => ({ i, low, high })).filter(({ low }) => Number.isFinite(low));
  const at = (list) => list.map(({ i, value }) => `${x(i).toFixed(1)} ${y(value).toFixed(1)}`).join("L");
  const upper = known.map(({ i, high }) => ({ i, value: high }));
  const lower = known.map(({ i, low }) => ({ i, value: low })).reverse();
  if (!known.length) return "";
  const band = known.some(({ low, high }) => Math.abs(y(low) - y(high)) > 1);
  return band ? `M${at([...upper, ...lower])}Z` : `M${at(upper)}`;
};

/** Draws curves, each a list of [least, greatest] by column, with the time on the abscissa. */
const drawCurves = (svg, duration, curves) => {
  const { left, right, top, bottom, width, height } = PLOT;
  svg.replaceChildren();
  svg.setAttribute("viewBox", `0 0 ${width} ${height}`);
  const values = curves.flatMap(({ curve }) => curve.flat()).filter(Number.isFinite);
  let low = Math.min(0, ...values);
  let high = Math.max(...values, low);
  if (values.length === 0 || high === low) high = low + 1;
  if (low > 0.6 * high) low = 0;
  const x = (i) => left + ((width - left - right) * (i + 0.5)) / COLUMNS;
  const y = (value) => height - bottom - ((height - top - bottom) * (value - low)) / (high - low);
  for (const tick of ticksOf(low, high, 4)) {
    svgNode(svg, "line", { class: "grid", x1: left, x2: width - right, y1: y(tick), y2: y(tick) });
    svgNode(svg, "text", { class: "tick", x: left - 6, y: y(tick), dy: "0.32em", "text-anchor": "end" }, numeral(tick, 3));
  }
  const scale = timeUnit(duration);
  for (const tick of ticksOf(0, duration / scale[0], 5)) {
    const place = left + ((width - left - right) * tick * scale[0]) / duration;
    const words = tick === 0 ? `0 ${scale[1]}` : numeral(tick, 4);
    svgNode(svg, "text", { class: "tick", x: place, y: height - 8, "text-anchor": "middle" }, words);
  }
  svgNode(svg, "line", { class: "base", x1: left, x2: width - right, y1: y(low), y2: y(low) });
  for (const { curve, name } of curves) {
    svgNode(svg, "path", { class: `viewer-curve ${name}`, d: outline(curve, x, y) });
  }
  svgNode(svg, "line", { class: "viewer-now", y1: top, y2: height - bottom });
};

/** Moves the mark of the present time. */
const markTime = (svg, part) => {
  const mark = svg.querySelector(".viewer-now");
  const place = PLOT.left + (PLOT.width - PLOT.left - PLOT.right) * clamp(part, 0, 1);
  mark?.setAttribute("x1", place);
  mark?.setAttribute("x2", place);
};
