// Typed arrays. The scene is little-endian, as is every machine that runs a browser.
const numbers = (Kind, bytes) => (bytes?.byteLength ? new Kind(bytes) : null);
const floats = (bytes) => numbers(Float32Array, bytes);
const doubles = (bytes) => numbers(Float64Array, bytes);
const indices = (bytes) => numbers(Uint16Array, bytes);
const vectors = ({ unit, values }) => Float32Array.from(numbers(Int16Array, values) ?? [], (whole) => unit * whole);

/** Index of the last entry of a rising list that is not above a value. */
const lastNotAbove = (list, value) => {
  let low = 0;
  let high = list.length - 1;
  while (low < high) {
    const middle = (low + high + 1) >> 1;
    if (list[middle] <= value) low = middle;
    else high = middle - 1;
  }
  return low;
};

/** Rows of a list. */
const chunks = (list, width) => Array.from({ length: list.length / width }, (_, i) => list.subarray(width * i, width * (i + 1)));

const clamp = (value, low, high) => Math.min(high, Math.max(low, value));
