// Buttons beside the title of a figure: downloads, and back to the whole.
const LONGEST = 60;

/** Letters and digits of a name, for the name of a file. */
const slug = (name) => {
  const plain = name.normalize("NFKD").replace(/[^\x20-\x7e]/g, " ").toLowerCase();
  return plain.replace(/[^a-z0-9]+/g, "-").slice(0, LONGEST).replace(/^-+|-+$/g, "") || "figure";
};

const save = (name, blob) => {
  const link = document.createElement("a");
  Object.assign(link, { href: URL.createObjectURL(blob), download: name });
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 10_000);
};

const FILES = { svg: svgFile, png: pngFile, csv: csvFile };

class Toolbar {
  constructor(chart) {
    this.chart = chart;
    const { figure, data } = chart;
    const title = figure.querySelector("h3");
    const head = document.createElement("div");
    figure.classList.add("plotted");
    head.className = "head";
    title.replaceWith(head);
    head.append(title);
    this.node = element(head, "div", "tools");
    this.node.setAttribute("role", "group");
    this.node.setAttribute("aria-label", `Tools of the figure: ${data.title}`);
    const whole = this.button("whole", "Show the whole range", () => chart.group.whole());
    whole.classList.add("back");
    whole.hidden = true;
    chart.onView.push(() => this.showBack(whole));
    for (const kind in FILES) this.button(kind.toUpperCase(), `Download as ${kind.toUpperCase()}`, () => this.download(kind));
  }

  button(words, title, act) {
    const node = element(this.node, "button", "");
    Object.assign(node, { type: "button", textContent: words, title });
    node.addEventListener("click", act);
    return node;
  }

  /** The button back goes when the whole is shown; the focus it had goes to the chart. */
  showBack(button) {
    const had = document.activeElement === button;
    button.hidden = !this.chart.view;
    if (had && button.hidden) this.chart.over.focus();
  }

  async download(kind) {
    this.chart.refresh();
    const name = `${slug(document.title)}-${slug(this.chart.data.name)}.${kind}`;
    save(name, await FILES[kind](this.chart));
  }
}
