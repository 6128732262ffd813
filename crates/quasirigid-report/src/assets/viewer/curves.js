// Two curves over time in one SVG: these settings and the run, each a band where it swings within a column.
const SVG = "http://www.w3.org/2000/svg";
const PLOT = { left: 40, right: 10, top: 10, bottom: 26, width: 400, height: 190 };

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
  return Array.from({ length: Math.floor(high / step + 1e-3) - first + 1 }, (_, i) => (first + i) * step);
};

/** Area and edges of a band, or a line where it is thin; columns without values are left out. */
const outlines = (curve, x, y) => {
  const known = curve.map(([low, high], i) => ({ i, low, high })).filter(({ low, high }) => Number.isFinite(low + high));
  const path = (list) => list.map(({ i, value }) => `${x(i).toFixed(1)} ${y(value).toFixed(1)}`).join("L");
  const upper = known.map(({ i, high }) => ({ i, value: high }));
  const lower = known.map(({ i, low }) => ({ i, value: low })).reverse();
  if (!known.length) return { area: "", edges: "" };
  const band = known.some(({ low, high }) => Math.abs(y(low) - y(high)) > 1);
  if (!band) return { area: "", edges: `M${path(upper)}` };
  return { area: `M${path([...upper, ...lower])}Z`, edges: `M${path(upper)}M${path(lower)}` };
};

/** Draws curves, each a list of [least, greatest] by column, over time; returns the power of ten of the numbers. */
const drawCurves = (svg, duration, curves) => {
  const { left, right, top, bottom, width, height } = PLOT;
  svg.replaceChildren();
  svg.setAttribute("viewBox", `0 0 ${width} ${height}`);
  const values = curves.flatMap(({ curve }) => curve.flat()).filter(Number.isFinite);
  const low = Math.min(0, ...values);
  const most = Math.max(low, ...values);
  const high = most > low ? most : low + 1;
  const exponent = Math.floor(Math.log10(Math.max(high, -low)));
  const power = exponent < -2 || exponent > 4 ? exponent : 0;
  const x = (i) => left + ((width - left - right) * (i + 0.5)) / COLUMNS;
  const y = (value) => height - bottom - ((height - top - bottom) * (value - low)) / (high - low);
  for (const tick of ticksOf(low, high, 4)) {
    svgNode(svg, "line", { class: "grid", x1: left, x2: width - right, y1: y(tick), y2: y(tick) });
    svgNode(svg, "text", { class: "tick", x: left - 6, y: y(tick), dy: "0.32em", "text-anchor": "end" }, numeral(tick / 10 ** power));
  }
  const scale = timeUnit(duration);
  for (const tick of ticksOf(0, duration / scale[0], 5)) {
    const place = left + ((width - left - right) * tick * scale[0]) / duration;
    const words = tick === 0 ? `0 ${scale[1]}` : numeral(tick, 4);
    svgNode(svg, "text", { class: "tick", x: place, y: height - 8, "text-anchor": "middle" }, words);
  }
  svgNode(svg, "line", { class: "base", x1: left, x2: width - right, y1: y(low), y2: y(low) });
  for (const { curve, name } of curves) {
    const { area, edges } = outlines(curve, x, y);
    svgNode(svg, "path", { class: `viewer-curve ${name}`, d: edges });
    svgNode(svg, "path", { class: `viewer-band ${name}`, d: area });
  }
  svgNode(svg, "line", { class: "viewer-now", y1: top, y2: height - bottom });
  return power;
};

/** Moves the mark of the present time. */
const markTime = (svg, part) => {
  const mark = svg.querySelector(".viewer-now");
  const place = PLOT.left + (PLOT.width - PLOT.left - PLOT.right) * clamp(part, 0, 1);
  mark?.setAttribute("x1", place);
  mark?.setAttribute("x2", place);
};
