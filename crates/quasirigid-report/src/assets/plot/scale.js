// Axes: the range that fits the values in view, places along it, and round ticks. The rules are those of the static page.
const NARROWEST = 1e-5; // of the values: a narrower range is drawn as a constant
const AROUND_CONSTANT = 0.1;
const MARGIN = 0.05;
const DECADES = 30;
const FEW_DECADES = 2.5;
const PART_OF_A_DECADE = 0.7; // below it, 1-2-5 gives too few ticks
const FLAT = 1e-4; // decades
const TICKS = 6;

const roundStep = (step) => {
  const power = 10 ** Math.floor(Math.log10(step));
  return power * [1, 2, 5, 10].find((leading) => leading * power >= step * (1 - 1e-9));
};

/** The power of ten that an axis takes out of numbers of this size. */
const powerFor = (exponent) => (exponent >= -3 && exponent < 5 ? 0 : 3 * Math.floor(exponent / 3));

/** Place of a value on the scale of the data, from 0 to 1. */
const place = (axis, value) => ((axis.factor ?? 1) * value - axis.low) / (axis.high - axis.low);

/** Place of the top or bottom of the values: 1, 2 or 5 times a power of ten. */
const roundDecade = (value, upwards) => {
  const power = Math.floor(value);
  const leading = 10 ** (value - power);
  const rounds = upwards ? [1, 2, 5, 10].find((round) => round >= leading * (1 - NARROWEST)) : [10, 5, 2, 1].find((round) => round <= leading * (1 + NARROWEST));
  return power + Math.log10(rounds);
};

const fittedDecades = (axis, least, most) => {
  if (most - least >= PART_OF_A_DECADE) {
    const high = Math.ceil(most - 1e-6);
    return { ...axis, high, low: clamp(Math.floor(least + 1e-6), high - DECADES, high - 1) };
  }
  const [low, high] = [roundDecade(least, false), roundDecade(most, true)];
  if (high > low && high - low < 3 * (most - least)) return { ...axis, low, high };
  const extra = most - least < FLAT ? Math.log10(1 + AROUND_CONSTANT) : MARGIN * (most - least);
  return { ...axis, low: least - extra, high: most + extra };
};

const fittedLinear = (axis, least, most) => {
  const largest = Math.max(Math.abs(least), Math.abs(most));
  if (largest === 0) return { ...axis, low: -1, high: 1, power: 0, factor: 1 };
  const power = powerFor(Math.floor(Math.log10(largest)) + axis.power);
  const factor = 10 ** (axis.power - power);
  const constant = most - least < NARROWEST * largest;
  const extra = constant ? AROUND_CONSTANT * largest : MARGIN * (most - least);
  return { ...axis, low: factor * (least - extra), high: factor * (most + extra), power, factor };
};

/** The axis over values from least to most, with the margin of the static page. */
const fitted = (axis, least, most) => (axis.log ? fittedDecades : fittedLinear)(axis, least, most);

const roundTicks = (low, high, most, at, whole) => {
  const step = Math.max(roundStep((high - low) / most), whole ? 1 : 0);
  const decimals = Math.max(0, -Math.floor(Math.log10(step) + 1e-9));
  const first = Math.ceil(low / step - 1e-9);
  const count = Math.floor(high / step + 1e-9) - first + 1;
  return Array.from({ length: count }, (_, i) => ({ at: at((first + i) * step), label: fixed((first + i) * step, decimals) }));
};

const ticksWithinDecades = (low, high) => {
  const powers = Array.from({ length: Math.floor(high) - Math.floor(low) + 1 }, (_, i) => Math.floor(low) + i);
  const all = powers.flatMap((power) => [1, 2, 5].map((leading) => ({ at: (power + Math.log10(leading) - low) / (high - low), label: short(leading, 4, power) })));
  return all.filter(({ at }) => at >= -1e-9 && at <= 1 + 1e-9);
};

/** Ticks of part of a decade, even in the values; they are over a power of ten, which the name of the axis takes. */
const ticksOfPart = (low, high, most) => {
  const power = powerFor(Math.floor(high));
  const [least, greatest] = [low, high].map((value) => 10 ** (value - power));
  return { power, ticks: roundTicks(least, greatest, most, (value) => (Math.log10(value) + power - low) / (high - low)) };
};

const decadeLabel = (exponent) => (exponent === 0 ? "1" : powerOfTen(exponent));

/** Ticks at round numbers, each with its place and label, and the power of ten that the labels leave out. */
const ticksOf = ({ low, high, log, whole, power = 0 }, most = TICKS) => {
  const length = high - low;
  if (!log) return { power, ticks: roundTicks(low, high, most, (value) => (value - low) / length, whole) };
  if (length < PART_OF_A_DECADE) return ticksOfPart(low, high, most);
  if (length < FEW_DECADES) return { power: 0, ticks: ticksWithinDecades(low, high) };
  const step = Math.ceil(length / most);
  const first = Math.ceil(low / step - 1e-9);
  const ticks = Array.from({ length: Math.floor(high / step + 1e-9) - first + 1 }, (_, i) => (first + i) * step);
  return { power: 0, ticks: ticks.map((exponent) => ({ at: (exponent - low) / length, label: decadeLabel(exponent) })) };
};
