// Draws the scatter of the two chosen columns: linear or logarithmic axes, ticks at round numbers.
(() => {
  const holder = document.getElementById("rows");
  if (!holder) return;
  const columns = JSON.parse(holder.textContent);
  const plot = document.getElementById("scatter");
  const choices = ["scatter-x", "scatter-y"].map((id) => document.getElementById(id));
  const make = (name, attributes, text) => {
    const node = document.createElementNS(plot.namespaceURI, name);
    Object.entries(attributes).forEach(([key, value]) => node.setAttribute(key, value));
    if (text !== undefined) node.textContent = text;
    return plot.appendChild(node);
  };
  const label = (value) => {
    const size = Math.abs(value);
    return size === 0 || (size >= 1e-3 && size < 1e6) ? String(Number(value.toPrecision(4))) : value.toExponential(1).replace(/\.0e/, "e").replace("e+", "e");
  };
  const axis = (column) => {
    const values = column.values.filter((value) => value !== null);
    let low = Math.min(...values), high = Math.max(...values);
    const log = low > 0 && high > 30 * low;
    const of = (value) => (log ? Math.log10(value) : value);
    [low, high] = [of(low), of(high)];
    const extra = 0.03 * (high - low) || Math.abs(high) * 0.1 || 1;
    low -= extra; high += extra;
    const ticks = [];
    const tick = (value) => ticks.push({ at: (of(value) - low) / (high - low), label: label(value) });
    if (log) {
      const [first, last] = [Math.floor(low), Math.ceil(high)];
      const every = Math.ceil((last - first) / 7);
      const leading = high - low < 2.5 ? [1, 2, 5] : [1];
      for (let power = first; power <= last; power += every) leading.forEach((digit) => tick(digit * 10 ** power));
    } else {
      let step = 10 ** Math.floor(Math.log10((high - low) / 6));
      step *= [1, 2, 5, 10].find((leading) => leading * step >= (high - low) / 6);
      for (let i = Math.ceil(low / step); i * step <= high; i++) tick(i * step);
    }
    return { place: (value) => (of(value) - low) / (high - low), ticks: ticks.filter(({ at }) => at >= 0 && at <= 1) };
  };
  const named = (column) => (column.unit && column.unit !== "1" ? `${column.name} [${column.unit}]` : column.name);
  const draw = () => {
    const [x, y] = choices.map((choice) => columns[choice.value]);
    const [across, up] = [axis(x), axis(y)];
    plot.replaceChildren();
    make("line", { class: "base", x1: "0", x2: "100%", y1: "100%", y2: "100%" });
    for (const { at, label } of up.ticks) {
      const y = `${100 * (1 - at)}%`;
      make("line", { class: "grid", x1: "0", x2: "100%", y1: y, y2: y });
      make("text", { class: "tick end", x: "0", y, dx: "-0.6em", dy: "0.35em" }, label);
    }
    for (const { at, label } of across.ticks) {
      const x = `${100 * at}%`;
      make("line", { class: "grid", x1: x, x2: x, y1: "0", y2: "100%" });
      make("text", { class: "tick middle", x, y: "100%", dy: "1.5em" }, label);
    }
    make("text", { class: "name", x: "-3.6em", y: "-0.9em" }, named(y));
    make("text", { class: "name end", x: "100%", y: "100%", dy: "3.1em" }, named(x));
    x.values.forEach((value, row) => {
      if (value === null || y.values[row] === null) return;
      make("circle", { class: "point", r: 2.4, cx: `${100 * across.place(value)}%`, cy: `${100 * (1 - up.place(y.values[row]))}%` });
    });
    plot.setAttribute("aria-label", `Scatter of ${named(y)} against ${named(x)}`);
  };
  choices.forEach((choice) => choice.addEventListener("change", draw));
  draw();
})();
