// Numbers, times and speeds in words, as the page's tables write them.
const SUPERSCRIPTS = "⁰¹²³⁴⁵⁶⁷⁸⁹";
const powerOfTen = (power) =>
  `10${String(power).replace("-", "⁻").replace(/\d/g, (digit) => SUPERSCRIPTS[digit])}`;

/** At most so many significant digits; a power of ten below 0.001 and from a million. */
const numeral = (value, digits = 3) => {
  if (!Number.isFinite(value)) return "not finite";
  if (value === 0) return "0";
  const [mantissa, power] = value.toExponential(digits - 1).split("e");
  const tidy = (number) => String(Number(number)).replace("-", "−");
  if (power >= -3 && power < 6) return tidy(value.toPrecision(digits));
  return `${tidy(mantissa)}×${powerOfTen(Number(power))}`;
};

const TIME_UNITS = [
  [365.25 * 86400, "years"], [86400, "days"], [3600, "h"], [60, "min"], [1, "s"], [1e-3, "ms"], [1e-6, "µs"],
];
/** The largest unit that leaves at least two of it, or one second. */
const timeUnit = (seconds) => TIME_UNITS.find(([length]) => Math.abs(seconds) >= (length > 1 ? 2 * length : length)) ?? TIME_UNITS[4];
const timeIn = (seconds, [length, name], digits = 3) => `${numeral(seconds / length, digits)} ${name}`;
const timeWords = (seconds) => timeIn(seconds, timeUnit(seconds));

const degrees = (angle) => (angle * 180) / Math.PI;
const angleWords = (angle) => `${numeral(degrees(angle))}°`;
const factorWords = (factor) => `${numeral(factor, 2)} times`;
const LENGTH_UNITS = [[1000, "km"], [1, "m"], [1e-3, "mm"], [1e-6, "µm"], [1e-9, "nm"]];
const lengthWords = (metres) => {
  const [length, name] = LENGTH_UNITS.find(([length]) => metres >= length) ?? LENGTH_UNITS[4];
  return `${numeral(metres / length)} ${name}`;
};

const speedWords = (speed, rate) => {
  const pace = Math.abs(speed - 1) < 1e-3 ? "real time" : `${numeral(speed)} times real time`;
  const revolution = (2 * Math.PI) / (rate * speed);
  const turning = revolution > 0.02 ? `one revolution in ${timeWords(revolution)}` : `${numeral(1 / revolution)} revolutions a second`;
  return rate > 0 && Number.isFinite(revolution) ? `${pace}: ${turning}` : pace;
};

/** A round number near a given one: 1, 2 or 5 times a power of ten. */
const rounded = (value) => {
  const power = 10 ** Math.floor(Math.log10(value));
  return power * [1, 2, 5, 10].reduce((a, b) => (Math.abs(Math.log(b * power / value)) < Math.abs(Math.log(a * power / value)) ? b : a));
};
