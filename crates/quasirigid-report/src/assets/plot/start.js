// Makes every chart with data a live one; the page is complete without.
const startPlots = () => {
  const charts = new Map();
  const seen = new IntersectionObserver((entries) => {
    for (const { target, isIntersecting } of entries) {
      const chart = charts.get(target);
      chart.visible = isIntersecting;
      if (isIntersecting) chart.refresh();
    }
  });
  for (const data of document.querySelectorAll("script.figure-data")) {
    const figure = data.closest("figure");
    if (!figure?.querySelector(".plot")) continue;
    const chart = new Chart(figure, JSON.parse(data.textContent));
    new Keys(chart, new Gestures(chart));
    new Toolbar(chart);
    new ResizeObserver(() => chart.resized()).observe(chart.over);
    charts.set(chart.box, chart);
    seen.observe(chart.box);
  }
  if (!charts.size) return;
  telling();
  window.addEventListener("quasirigid:time", ({ detail }) => groups.get("t")?.mark(Number.isFinite(detail?.t) ? detail.t : null));
  document.addEventListener("pointerdown", ({ target }) => {
    if (!target.closest?.(".over")) for (const chart of charts.values()) chart.group.read(null);
  });
};
startPlots();
