// Numbers as the page writes them: true minus signs, thin spaces between thousands, powers of ten as superscripts.
const SUPERSCRIPTS = "⁰¹²³⁴⁵⁶⁷⁸⁹";
const powerOfTen = (power) => `10${String(power).replace("-", "⁻").replace(/\d/g, (digit) => SUPERSCRIPTS[digit])}`;

const fixed = (value, decimals) => {
  const [whole, fraction] = Math.abs(value).toFixed(decimals).split(".");
  const spaced = whole.length > 4 ? whole.replace(/\B(?=(\d{3})+$)/g, "\u202f") : whole;
  const text = fraction ? `${spaced}.${fraction}` : spaced;
  return value < 0 && /[1-9]/.test(text) ? `−${text}` : text;
};

/** `value · 10ᵖᵒʷᵉʳ` with so many significant digits: plain from 0.001 to a million, with a power of ten outside. */
const written = (value, significant, power = 0) => {
  if (value === 0) return "0";
  const [mantissa, shift] = value.toExponential(significant - 1).split("e");
  const exponent = Number(shift) + power;
  if (exponent < -3 || exponent >= 6) return `${mantissa.replace("-", "−")}×${powerOfTen(exponent)}`;
  return fixed(Number(`${mantissa}e${exponent}`), Math.max(0, significant - 1 - exponent));
};

/** The same without zeros at the end. */
const short = (value, significant, power = 0) => {
  const [number, ...rest] = written(value, significant, power).split("×");
  return [number.includes(".") ? number.replace(/\.?0+$/, "") : number, ...rest].join("×");
};

const withUnit = (number, unit) => {
  if (!unit || unit === "1") return number;
  return /^[°′″]/.test(unit) ? number + unit : `${number}\u00a0${unit}`;
};

const unitWithPower = (power, unit) => (power ? `${powerOfTen(power)} ${unit}` : unit);
