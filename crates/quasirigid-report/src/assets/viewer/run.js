// A run of the reduced equations for settings of the sliders, integrated in slices so that the page stays awake.
// Beside the frames it keeps what the curves need: in each column the least and the greatest nutation angle.
const COLUMNS = 360;
const MOST_FRAMES = 4096;

class Curves {
  constructor(duration) {
    this.duration = duration;
    this.least = new Float64Array(COLUMNS).fill(Infinity);
    this.greatest = new Float64Array(COLUMNS).fill(-Infinity);
    this.dissipated = new Float64Array(COLUMNS).fill(NaN);
    this.reached = 0;
  }

  add(t, angle, dissipated) {
    const column = clamp(Math.floor((t / this.duration) * COLUMNS), 0, COLUMNS - 1);
    this.least[column] = Math.min(this.least[column], angle);
    this.greatest[column] = Math.max(this.greatest[column], angle);
    this.dissipated[column] = dissipated;
    this.reached = Math.max(this.reached, t);
  }
}

/** Curves of a list of frames, from its start. */
const curvesOf = (frames, axis, duration) => {
  const curves = new Curves(duration);
  for (let i = 0; i < frames.count; i++) {
    curves.add(frames.t[i] - frames.start, angleBetween(vectorAt(frames.momentum, i), axis), frames.dissipated[i]);
  }
  return curves;
};

class Run {
  constructor(equations, { K, attitude, duration }, axis, tolerance) {
    Object.assign(this, { equations, duration, axis });
    this.motion = new FreeMotion(equations, tolerance);
    this.motion.start(0, K, attitude);
    this.energy = this.motion.energy;
    this.curves = new Curves(duration);
    this.list = [];
    this.every = 1;
    this.fastest = 0;
    this.keep();
    this.note(0, K, 0);
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
      this.note(before.t + x * h, K, before.W + x * (after.W - before.W));
    }
    if (motion.solver.steps % this.every === 0 || this.finished) this.keep();
  }

  note(t, K, W) {
    this.curves.add(t, angleBetween(K, this.axis), W);
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
