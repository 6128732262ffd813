// Typed arrays from base64. The data are little-endian, as is every machine that runs a browser.
const floats = (text) => {
  const characters = atob(text);
  const bytes = new Uint8Array(characters.length);
  for (let i = 0; i < bytes.length; i++) bytes[i] = characters.charCodeAt(i);
  return new Float32Array(bytes.buffer);
};

/** Calls a function once, when its result is first asked for. */
const once = (make) => {
  let made = null;
  return () => (made ??= make());
};

/** Index of the first entry of a rising list that is not below a value. */
const firstFrom = (list, value) => {
  let low = 0;
  let high = list.length;
  while (low < high) {
    const middle = (low + high) >> 1;
    if (list[middle] < value) low = middle + 1;
    else high = middle;
  }
  return low;
};

const clamp = (value, low, high) => Math.min(high, Math.max(low, value));
