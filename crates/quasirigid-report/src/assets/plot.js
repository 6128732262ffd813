// Reads the values under the pointer from the curves as drawn; the page is complete without it.
for (const chart of document.querySelectorAll(".chart")) {
  const plot = chart.querySelector(".plot");
  const [x0, x1] = chart.dataset.x.split(" ").map(Number);
  const [y0, y1] = chart.dataset.y.split(" ").map(Number);
  const { width, height } = plot.querySelector("svg").viewBox.baseVal;
  const curves = [...plot.querySelectorAll(".curve")].reverse().map((path) => ({
    label: path.dataset.label,
    points: [...path.getAttribute("d").matchAll(/(-?[\d.]+) (-?[\d.]+)/g)].map((m) => [+m[1], +m[2]]),
  }));
  const rule = chart.appendChild(document.createElement("div"));
  const readout = chart.appendChild(document.createElement("div"));
  rule.className = "rule";
  readout.className = "readout";
  rule.hidden = readout.hidden = true;

  const text = (value) => String(+value.toPrecision(3)).replace("-", "−");
  const level = (y) => {
    const value = y1 + (y0 - y1) * (y / height);
    return text("log" in chart.dataset ? 10 ** value : value);
  };
  const nearest = (points, x) => points.reduce((a, b) => (Math.abs(b[0] - x) < Math.abs(a[0] - x) ? b : a));

  chart.addEventListener("pointermove", (event) => {
    const box = plot.getBoundingClientRect();
    const part = (event.clientX - box.left) / box.width;
    const inside = part >= 0 && part <= 1;
    rule.hidden = readout.hidden = !inside;
    if (!inside) return;
    const outer = chart.getBoundingClientRect();
    rule.style.left = `${event.clientX - outer.left}px`;
    rule.style.top = `${box.top - outer.top}px`;
    rule.style.height = `${box.height}px`;
    const values = curves
      .filter((curve) => curve.points.length)
      .map((curve) => `${curve.label} ${level(nearest(curve.points, part * width)[1])}`);
    readout.textContent = [`t ${text(x0 + part * (x1 - x0))}`, ...values].join("   ");
  });
  chart.addEventListener("pointerleave", () => (rule.hidden = readout.hidden = true));
}
