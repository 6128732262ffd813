// The points in view as CSV (RFC 4180): true values in the units of the axes, with seven digits.
const DIGITS = 7;

/** Text that no spreadsheet takes for a formula, as in the tables of the program: an apostrophe before the sign that begins a cell. */
const guarded = (text) => text.replace(/(^|[;\t\r\n])([\s']*)(?=[=+\-@＝＋－＠])/g, "$1$2'");
const quoted = (text) => (/[",\r\n]/.test(text) ? `"${text.replaceAll('"', '""')}"` : text);
const headed = (name, { unit }) => guarded(unit ? `${name} [${unit}]` : name);

/** A value on the scale of an axis as a true number; empty in a gap. */
const cell = ({ log, power }, value) => {
  if (!Number.isFinite(value)) return "";
  if (log) return String(Number((10 ** value).toPrecision(DIGITS)));
  const [mantissa, exponent] = value.toExponential(DIGITS - 1).split("e");
  return String(Number(`${mantissa}e${Number(exponent) + power}`));
};

const rowsIn = (series, [low, high]) => {
  const [first, end] = series.inside(low, high);
  const all = Array.from({ length: end - first }, (_, i) => first + i);
  return series.sorted ? all : all.filter((i) => series.x[i] >= low && series.x[i] <= high);
};

/** Wide where the series share their abscissas, long otherwise. */
const tableOf = ({ series, data, x, y, shown }) => {
  const isShared = data.series.every(({ grid }) => grid === data.series[0].grid);
  if (isShared) {
    const head = [headed(x.name, x), ...series.map(({ label }) => headed(label || y.name, y))];
    const rows = rowsIn(series[0], shown).map((i) => [cell(x, series[0].x[i]), ...series.map((each) => cell(y, each.y[i]))]);
    return [head, ...rows];
  }
  const rows = series.flatMap((each) => rowsIn(each, shown).map((i) => [guarded(each.label), cell(x, each.x[i]), cell(y, each.y[i])]));
  return [["series", headed(x.name, x), headed(y.name, y)], ...rows];
};

const csvFile = (chart) => new Blob([tableOf(chart).map((row) => `${row.map(quoted).join(",")}\r\n`).join("")], { type: "text/csv;charset=utf-8" });
