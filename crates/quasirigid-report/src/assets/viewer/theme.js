// Colours of the page as they are now, light or dark, for the canvases.
const PIECE_COLORS = ["--v1", "--v2", "--v3", "--v4", "--v5", "--v6"];
const KIND_COLORS = { carrier: "--v0", ellipsoid: "--v0", surface: "--v0", liquid: "--v7", spring: "--v8", bushing: "--v8" };

const currentTheme = () => {
  const style = getComputedStyle(document.documentElement);
  const known = new Map();
  const once = (key, value) => known.get(key) ?? known.set(key, value()).get(key);
  const text = (name) => once(name, () => style.getPropertyValue(name).trim());
  const rgb = (name) =>
    once(`rgb ${name}`, () => {
      const digits = text(name).slice(1);
      const wide = digits.length === 3 ? [...digits].map((digit) => digit + digit).join("") : digits;
      return [0, 2, 4].map((i) => parseInt(wide.slice(i, i + 2), 16) / 255);
    });
  return { text, rgb };
};

/** Legend entries: the pieces one by one, or by kind where there are many of a kind, each with a colour. */
const legendOf = (pieces) => {
  const ofKind = grouped(pieces);
  const entries = [];
  for (const [kind, list] of ofKind) {
    const together = list.length > 1 && (pieces.length > 12 || list.length > 6 || kind === "spring" || kind === "bushing");
    if (together) entries.push({ name: `${list.length} ${kind}s`, kind, pieces: list });
    else for (const piece of list) entries.push({ name: piece.name, kind, pieces: [piece] });
  }
  let next = 0;
  for (const entry of entries) {
    entry.color = KIND_COLORS[entry.kind] ?? PIECE_COLORS[next++ % PIECE_COLORS.length];
    for (const piece of entry.pieces) piece.color = entry.color;
  }
  return entries;
};

const grouped = (pieces) => {
  const map = new Map();
  for (const piece of pieces) map.set(piece.kind, [...(map.get(piece.kind) ?? []), piece]);
  return map;
};
