// A picture of what a chart shows, as a file of its own: light colours, all styles written out, no unit but the pixel.
const FONT = 13;
const AREA = { left: 64, top: 66, width: 800, height: 240, bottom: 56 };
const TITLE = { x: 16, y: 28, "font-size": 16, "font-weight": 600, fill: "#1b1f24" };
const COLORS = { s1: "#0068a8", s2: "#c24a00", s3: "#00805c", s4: "#9a4f8a" };
const MUTED = "#59626d";
const ROUND = { "stroke-opacity": 0.8, "stroke-linejoin": "round", "stroke-linecap": "round" };
const STYLES = {
  base: { stroke: MUTED }, grid: { stroke: "#d9dde2" }, event: { stroke: MUTED, "stroke-dasharray": "3 3" },
  end: { "text-anchor": "end" }, middle: { "text-anchor": "middle" }, label: { "font-weight": 600 },
  curve: { fill: "none", "stroke-width": 1.7, ...ROUND }, reach: { "fill-opacity": 0.2, ...ROUND }, dashed: { "stroke-dasharray": "5 4" },
};
const HALO = { fill: "#fff", stroke: "#fff", "stroke-width": 4, "stroke-linejoin": "round" };

/** Text that XML can hold. */
const printable = (text) => text.replace(/[\u0000-\u0008\u000b\u000c\u000e-\u001f\ufffe\uffff]/g, "");
const colorOf = ({ classList }) => COLORS[Object.keys(COLORS).find((style) => classList.contains(style))];
const stylesOf = ({ classList }) => Object.assign({}, ...[...classList].map((style) => STYLES[style]));
const tenths = (number) => Number(number.toFixed(1));

/** Pixels of a length in percent of the area, in em, or alone. */
const pixels = (node, name) => {
  const text = node.getAttribute(name) ?? "0";
  const whole = name.startsWith("x") ? AREA.width : AREA.height;
  return parseFloat(text) * (text.endsWith("%") ? whole / 100 : text.endsWith("em") ? FONT : 1);
};

const pictureLine = (parent, node) => {
  const places = ["x1", "x2", "y1", "y2"].map((name) => [name, tenths(pixels(node, name))]);
  svgNode(parent, "line", { ...Object.fromEntries(places), ...stylesOf(node) });
};

const pictureText = (parent, node) => {
  const { stroke, "stroke-dasharray": none, ...styles } = stylesOf(node);
  const [x, y] = ["x", "y"].map((name) => tenths(pixels(node, name) + pixels(node, `d${name}`)));
  const write = (more) => svgNode(parent, "text", { x, y, ...styles, ...more }, printable(node.textContent));
  if (stroke) write(HALO);
  write({ fill: colorOf(node) ?? MUTED });
};

const picturePath = (parent, node, scale) => {
  const d = (node.getAttribute("d") ?? "").replace(/-?[\d.]+/g, (number) => tenths(number * scale));
  const color = colorOf(node);
  if (node.classList.contains("dots")) {
    for (const [, cx, cy] of d.matchAll(/M(\S+) (\S+)h0/g)) svgNode(parent, "circle", { cx, cy, r: 3, fill: color, "fill-opacity": 0.8 });
  } else if (d) {
    const filled = node.classList.contains("bars") ? { fill: color, "fill-opacity": 1, stroke: "none" } : {};
    svgNode(parent, "path", { d, fill: color, stroke: color, ...stylesOf(node), ...filled });
  }
};

/** The curves, cut to the area. */
const pictureCurves = (parent, inner) => {
  const { width, height } = AREA;
  svgNode(svgNode(parent, "clipPath", { id: "area" }), "rect", { width, height });
  const curves = svgNode(parent, "g", { "clip-path": "url(#area)" });
  for (const path of inner.children) picturePath(curves, path, width / inner.viewBox.baseVal.width);
};

const DRAW = { line: pictureLine, text: pictureText, svg: pictureCurves, g: (parent, { children }) => drawPicture(parent, children) };
const drawPicture = (parent, nodes) => {
  for (const node of nodes) DRAW[node.localName]?.(parent, node);
};

/** The picture as XML, with its size. */
const pictureOf = ({ plot, data, note, view }) => {
  const longest = Math.max(0, ...data.series.map(({ label }) => label.length));
  const title = printable(data.title);
  const width = Math.ceil(Math.max(AREA.left + AREA.width + 24 + CHARACTER * longest, 32 + 10 * title.length));
  const height = AREA.top + AREA.height + AREA.bottom;
  const svg = svgNode(document.createDocumentFragment(), "svg", { width, height, viewBox: `0 0 ${width} ${height}`, "font-family": "sans-serif", "font-size": FONT });
  svgNode(svg, "title", {}, title);
  svgNode(svg, "desc", {}, printable(plot.querySelector("desc").textContent));
  svgNode(svg, "rect", { width, height, fill: "#fff" });
  svgNode(svg, "text", TITLE, title);
  const area = svgNode(svg, "g", { transform: `translate(${AREA.left} ${AREA.top})` });
  const part = plot.querySelector(view ? ".part" : ".whole") ?? plot;
  drawPicture(area, part.children);
  svgNode(area, "text", { x: 0, y: AREA.height + 3.1 * FONT, fill: MUTED }, note.textContent);
  return { xml: new XMLSerializer().serializeToString(svg), width, height };
};

const svgFile = (chart) => new Blob([pictureOf(chart).xml], { type: "image/svg+xml" });

/** The picture in pixels, two for one. */
const pngFile = async (chart) => {
  const { xml, width, height } = pictureOf(chart);
  const image = new Image();
  image.src = `data:image/svg+xml;charset=utf-8,${encodeURIComponent(xml)}`;
  await image.decode();
  const canvas = document.createElement("canvas");
  Object.assign(canvas, { width: 2 * width, height: 2 * height });
  canvas.getContext("2d").drawImage(image, 0, 0, canvas.width, canvas.height);
  return new Promise((done) => canvas.toBlob(done, "image/png"));
};
