// Small motions about the steady spin, one by one: the real part of amplitude times exp((rate + i frequency) t), with
// the decay left out so that the shape stays in view.
const PERIOD_SHOWN = 3; // s

class Mode {
  constructor(source, spin, pieces, radius) {
    Object.assign(this, { source, spin });
    const parts = [0, 0.25].map((phase) => this.shape(phase, 1));
    const turn = Math.max(...parts.map((part) => size(part.turn)));
    const moved = Math.max(0, ...parts.flatMap((part) => pieces.map((piece) => piece.largest(part.q)))) / radius;
    this.unit = 1 / (Math.max(turn, moved) || 1);
    /** Magnification that makes the deformation as large as the picture bears, at an amplitude of one. */
    this.magnified = moved > 0 ? Math.max(1, rounded(0.5 * Math.max(turn, moved) / moved)) : 1;
    this.period = source.frequency ? (2 * Math.PI) / Math.abs(source.frequency) : PERIOD_SHOWN;
  }

  /** Small rotation and internal coordinates at a phase in revolutions. */
  shape(phase, amplitude) {
    const [c, s] = [Math.cos(2 * Math.PI * phase), Math.sin(2 * Math.PI * phase)];
    const real = ([re, im]) => amplitude * (re * c - im * s);
    return { turn: (this.source.rotation ?? []).map(real), q: (this.source.q ?? []).map(real) };
  }

  at(time, amplitude) {
    const { turn, q } = this.shape(time / this.period, amplitude * this.unit);
    const small = turn.length ? exponential(turn) : [1, 0, 0, 0];
    const spin = this.spin ?? [0, 0, 0];
    const steady = rotation(unit(spin), size(spin) * time);
    const omega = this.spin ? turned(inverse(small), spin) : null;
    return { t: time, small, attitude: product(steady, small), omega, momentum: null, q, rotors: null };
  }

  words() {
    const { frequency, rate } = this.source;
    const change = rate === 0 ? "undamped" : `${rate < 0 ? "decays" : "grows"} e-fold in ${timeWords(1 / Math.abs(rate))} (not shown)`;
    if (!frequency) return `does not swing in the body, shown as if it did; ${change}`;
    const slow = this.period / PERIOD_SHOWN;
    return `${numeral(frequency)} rad/s in the body, period ${timeWords(this.period)}, shown ${numeral(slow)} times as fast; ${change}`;
  }
}
