// Typed arrays from base64. The scene is little-endian, as is every machine that runs a browser.
const bytes = (text) => Uint8Array.from(atob(text), (character) => character.charCodeAt(0)).buffer;
const floats = (text) => (text ? new Float32Array(bytes(text)) : null);
const doubles = (text) => (text ? new Float64Array(bytes(text)) : null);
const indices = (text) => (text ? new Uint16Array(bytes(text)) : null);
const vectors = ({ unit, values }) => Float32Array.from(new Int16Array(bytes(values)), (whole) => unit * whole);

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
