// A picture of what a chart shows, as a file of its own: light colours, all styles written out, no unit but the pixel.
const LIGHT = {
  paper: "#fff", ink: "#1b1f24", muted: "#59626d", rule: "#d9dde2", s1: "#0068a8", s2: "#c24a00", s3: "#00805c", s4: "#9a4f8a",
};
const FONT = 13;
const AREA = { left: 64, top: 66, width: 800, height: 240, bottom: 56 };
const TITLE = 16;

const colorOf = (node) => LIGHT[["s1", "s2", "s3", "s4"].find((style) => node.classList.contains(style))] ?? LIGHT.ink;

/** Text that XML can hold. */
const printable = (text) => text.replace(/[\u0000-\u0008\u000b\u000c\u000e-\u001f\ufffe\uffff]/g, "");

/** Pixels of a length in percent of the area, in em, or alone. */
const pixels = (node, name, whole) => {
  const text = node.getAttribute(name) ?? "0";
  const number = parseFloat(text) || 0;
  const scale = text.endsWith("%") ? whole / 100 : text.endsWith("em") ? FONT : 1;
  return Number((number * scale).toFixed(2));
};

const pictureLine = (parent, node) => {
  const ends = { x1: AREA.width, x2: AREA.width, y1: AREA.height, y2: AREA.height };
  const places = Object.fromEntries(Object.entries(ends).map(([name, whole]) => [name, pixels(node, name, whole)]));
  const isGrid = node.classList.contains("grid");
  const dashes = node.classList.contains("event") ? { "stroke-dasharray": "3 3" } : {};
  svgNode(parent, "line", { ...places, stroke: isGrid ? LIGHT.rule : LIGHT.muted, "stroke-width": 1, ...dashes });
};

const pictureText = (parent, node) => {
  const styles = node.classList;
  const isLabel = styles.contains("label");
  const place = {
    x: Number((pixels(node, "x", AREA.width) + pixels(node, "dx")).toFixed(2)),
    y: Number((pixels(node, "y", AREA.height) + pixels(node, "dy")).toFixed(2)),
    "text-anchor": styles.contains("end") ? "end" : styles.contains("middle") ? "middle" : "start",
  };
  const words = printable(node.textContent);
  if (styles.contains("event")) svgNode(parent, "text", { ...place, fill: LIGHT.paper, stroke: LIGHT.paper, "stroke-width": 4, "stroke-linejoin": "round" }, words);
  svgNode(parent, "text", { ...place, fill: isLabel ? colorOf(node) : LIGHT.muted, ...(isLabel ? { "font-weight": 600 } : {}) }, words);
};

const picturePath = (parent, node, scale) => {
  const d = (node.getAttribute("d") ?? "").replace(/-?[\d.]+/g, (number) => String(Number((number * scale).toFixed(1))));
  const color = colorOf(node);
  if (!d) return;
  if (node.classList.contains("dots")) {
    for (const [, cx, cy] of d.matchAll(/M(\S+) (\S+)h0/g)) svgNode(parent, "circle", { cx, cy, r: 3, fill: color, "fill-opacity": 0.8 });
    return;
  }
  const dashes = node.classList.contains("dashed") ? { "stroke-dasharray": "5 4" } : {};
  const isArea = node.classList.contains("reach");
  const fill = isArea ? { fill: color, "fill-opacity": 0.2 } : { fill: "none" };
  const stroke = { stroke: color, "stroke-opacity": 0.8, "stroke-width": isArea ? 1 : 1.7, "stroke-linejoin": "round", "stroke-linecap": "round" };
  svgNode(parent, "path", { d, ...fill, ...stroke, ...dashes });
};

/** The curves, cut to the area. */
const pictureCurves = (svg, parent, inner) => {
  const clip = svgNode(svgNode(svg, "defs", {}), "clipPath", { id: "area" });
  svgNode(clip, "rect", { width: AREA.width, height: AREA.height });
  const curves = svgNode(parent, "g", { "clip-path": "url(#area)" });
  const scale = AREA.width / inner.viewBox.baseVal.width;
  for (const path of inner.children) picturePath(curves, path, scale);
};

/** The picture as an SVG node, with its size. */
const pictureOf = (chart) => {
  const { plot, data } = chart;
  const layer = plot.querySelector(chart.view ? ".part" : ".whole") ?? plot;
  const names = data.series.map(({ label }) => label.length);
  const title = printable(data.title);
  const right = 24 + CHARACTER * Math.max(0, ...names);
  const width = Math.ceil(Math.max(AREA.left + AREA.width + right, 32 + title.length * 0.62 * TITLE));
  const height = AREA.top + AREA.height + AREA.bottom;
  const svg = document.createElementNS(SVG, "svg");
  for (const [key, value] of Object.entries({ width, height, viewBox: `0 0 ${width} ${height}`, "font-family": "sans-serif", "font-size": FONT })) svg.setAttribute(key, value);
  svgNode(svg, "title", {}, title);
  svgNode(svg, "desc", {}, printable(plot.querySelector("desc")?.textContent ?? ""));
  svgNode(svg, "rect", { width, height, fill: LIGHT.paper });
  svgNode(svg, "text", { x: 16, y: 28, "font-size": TITLE, "font-weight": 600, fill: LIGHT.ink }, title);
  const area = svgNode(svg, "g", { transform: `translate(${AREA.left} ${AREA.top})` });
  const draw = (node) => {
    if (node.localName === "line") pictureLine(area, node);
    else if (node.localName === "text") pictureText(area, node);
    else if (node.localName === "svg") pictureCurves(svg, area, node);
    else if (node.localName === "g") [...node.children].forEach(draw);
  };
  [...layer.children].forEach(draw);
  if (chart.note.textContent) svgNode(area, "text", { x: 0, y: AREA.height + 3.1 * FONT, fill: LIGHT.muted }, chart.note.textContent);
  return { svg, width, height };
};

const asXml = (svg) => new XMLSerializer().serializeToString(svg);

const svgFile = (chart) => new Blob([asXml(pictureOf(chart).svg)], { type: "image/svg+xml" });

/** The picture in pixels, two for one. */
const pngFile = async (chart) => {
  const { svg, width, height } = pictureOf(chart);
  const image = new Image(width, height);
  image.src = `data:image/svg+xml;charset=utf-8,${encodeURIComponent(asXml(svg))}`;
  await image.decode();
  const canvas = document.createElement("canvas");
  Object.assign(canvas, { width: 2 * width, height: 2 * height });
  canvas.getContext("2d").drawImage(image, 0, 0, canvas.width, canvas.height);
  return new Promise((done) => canvas.toBlob(done, "image/png"));
};
