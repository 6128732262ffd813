// A run of the reduced equations for settings of the sliders, integrated in slices so that the page stays awake.
// Beside the frames it keeps what the curves need: in each column the range of the nutation angle from each axis.
const COLUMNS = 360;
const MOST_FRAMES = 4096;
const RESOLVED = 5; // columns a period, from which on the curve shows each swing

class Curves {
  constructor(duration, axes) {
    const column = (value) => new Float64Array(COLUMNS).fill(value);
    const band = (axis) => ({ axis, least: column(Infinity), greatest: column(-Infinity), last: NaN, rising: true, swings: 0 });
    Object.assign(this, { duration, bands: axes.map(band), dissipated: column(NaN), reached: 0 });
  }

  add(t, K, dissipated) {
    const column = clamp(Math.floor((t / this.duration) * COLUMNS), 0, COLUMNS - 1);
    for (const band of this.bands) {
      const angle = angleBetween(K, band.axis);
      band.least[column] = Math.min(band.least[column], angle);
      band.greatest[column] = Math.max(band.greatest[column], angle);
      const rising = angle > band.last;
      if (rising !== band.rising) band.swings += 0.5;
      Object.assign(band, { last: angle, rising });
    }
    this.dissipated[column] = dissipated;
    this.reached = Math.max(this.reached, t);
  }

  /** Range of the angle (degrees) from an axis by column; of a whole period where the columns do not resolve one. */
  angle(axis) {
    const { least, greatest, swings } = this.bands[axis];
    const period = (COLUMNS * this.reached) / this.duration / swings;
    const reach = period < RESOLVED ? Math.ceil(0.6 * period) : 0;
    const near = (list, i) => list.subarray(Math.max(0, i - reach), i + reach + 1);
    const known = (i) => greatest[i] >= least[i];
    return Array.from(least, (_, i) => (known(i) ? [Math.min(...near(least, i)), Math.max(...near(greatest, i))].map(degrees) : [NaN, NaN]));
  }

  energy() {
    return Array.from(this.dissipated, (value) => [value, value]);
  }
}

/** Curves of a list of frames, from its start. */
const curvesOf = (frames, axes, duration) => {
  const curves = new Curves(duration, axes);
  for (let i = 0; i < frames.count; i++) curves.add(frames.t[i] - frames.start, vectorAt(frames.momentum, i), frames.dissipated[i]);
  return curves;
};

class Run {
  constructor(equations, { K, attitude, duration }, axes, tolerance) {
    Object.assign(this, { equations, duration });
    this.motion = new FreeMotion(equations, tolerance);
    this.motion.start(0, K, attitude);
    this.energy = this.motion.energy;
    this.curves = new Curves(duration, axes);
    this.list = [];
    this.every = 1;
    this.fastest = size(this.motion.omega);
    this.keep();
    this.curves.add(0, K, 0);
  }

  get finished() {
    return this.motion.t >= this.duration;
  }

  /** Steps for so many milliseconds. */
  advance(milliseconds) {
    const until = performance.now() + milliseconds;
    while (!this.finished && performance.now() < until) {
      for (let i = 0; i < 16 && !this.finished; i++) this.step();
    }
  }

  step() {
    const { motion } = this;
    const before = { t: motion.t, K: motion.momentum(), W: motion.dissipated() };
    const rate = cross(before.K, motion.spin());
    motion.step(this.duration);
    const after = { t: motion.t, K: motion.momentum(), W: motion.dissipated() };
    const h = after.t - before.t;
    const end = cross(after.K, motion.spin());
    this.fastest = Math.max(this.fastest, size(motion.omega));
    const samples = Math.max(4, Math.ceil((2 * COLUMNS * h) / this.duration));
    for (let i = 1; i <= samples; i++) {
      const x = i / samples;
      const K = [0, 1, 2].map((j) => hermite(before.K[j], h * rate[j], after.K[j], h * end[j], x));
      this.curves.add(before.t + x * h, K, before.W + x * (after.W - before.W));
    }
    if (motion.solver.steps % this.every === 0 || this.finished) this.keep();
  }

  /** Keeps the state as a frame; when there are too many, every other one goes. */
  keep() {
    const { motion } = this;
    this.list.push({ t: motion.t, attitude: motion.attitude(), momentum: motion.momentum(), W: motion.dissipated() });
    if (this.list.length > MOST_FRAMES) {
      this.list = this.list.filter((_, i) => i % 2 === 0);
      this.every *= 2;
    }
  }

  frames() {
    const { list } = this;
    const arrays = {
      t: Float64Array.from(list, (frame) => frame.t),
      attitude: Float64Array.from(list.flatMap((frame) => frame.attitude)),
      momentum: Float64Array.from(list.flatMap((frame) => frame.momentum)),
      dissipated: Float64Array.from(list, (frame) => frame.W),
    };
    return new Frames(arrays, this.equations, true);
  }
}

/** Cubic from a to b with given changes at its ends. */
const hermite = (a, da, b, db, x) => {
  const change = b - a;
  return a + x * (da + x * (3 * change - 2 * da - db + x * (da + db - 2 * change)));
};
