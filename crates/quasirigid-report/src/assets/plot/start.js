// Makes every chart with data a live one; the page is complete without.
const startPlots = async () => {
  if (!canUnpack) return;
  const charts = new Map();
  const seen = new IntersectionObserver((entries) => {
    for (const { target, isIntersecting } of entries) {
      const chart = charts.get(target);
      chart.visible = isIntersecting;
      if (isIntersecting) chart.refresh();
    }
  });
  const scripts = [...document.querySelectorAll("script.figure-data")].filter((script) => script.closest("figure")?.querySelector(".plot"));
  const all = await Promise.all(scripts.map(unpacked));
  scripts.forEach((script, i) => {
    const chart = new Chart(script.closest("figure"), all[i]);
    new Keys(chart, new Gestures(chart));
    new Toolbar(chart);
    new ResizeObserver(() => chart.resized()).observe(chart.over);
    charts.set(chart.box, chart);
    seen.observe(chart.box);
  });
  if (charts.size) {
    telling();
    window.addEventListener("quasirigid:time", ({ detail }) => groups.get("t")?.mark(Number.isFinite(detail?.t) ? detail.t : null));
    document.addEventListener("pointerdown", ({ target }) => {
      if (!target.closest?.(".over")) for (const chart of charts.values()) chart.group.read(null);
    });
  }
  performance.mark("quasirigid:charts");
};
startPlots();
