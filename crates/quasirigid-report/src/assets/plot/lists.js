// Lists of numbers, and results that are worked out when they are first asked for.
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
