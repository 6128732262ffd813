// Data of the page: JSON, and behind it the arrays as bytes, deflated and in base64, as src/packed.rs writes them.
const canUnpack = "DecompressionStream" in window;

const inflated = async (text) => {
  const bytes = Uint8Array.from(atob(text), (character) => character.charCodeAt(0));
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("deflate-raw"));
  return new Uint8Array(await new Response(stream).arrayBuffer());
};

/** Bytes of an array from those of its differences, which hold all lowest bytes first; a sum carries from byte to byte. */
const restored = (coded, width, distance, times) => {
  const count = coded.length / width;
  const bytes = new Uint8Array(coded.length);
  for (let i = 0; i < count; i++) for (let place = 0; place < width; place++) bytes[width * i + place] = coded[count * place + i];
  for (let time = 0; time < times; time++) {
    for (let i = width * distance; i < bytes.length; i += width) {
      let carry = 0;
      for (let at = i; at < i + width; at++) {
        carry += bytes[at] + bytes[at - width * distance];
        bytes[at] = carry;
        carry >>= 8;
      }
    }
  }
  return bytes.buffer;
};

/** The data of a script of the page, each array as its bytes. */
const unpacked = async (script) => {
  const all = await inflated(script.textContent);
  const end = all.indexOf(10);
  const arrays = all.subarray(end + 1);
  const array = ([offset, length, ...coding]) => restored(arrays.subarray(offset, offset + length), ...coding);
  return JSON.parse(new TextDecoder().decode(all.subarray(0, end)), (_, value) => (value?.packed ? array(value.packed) : value));
};
