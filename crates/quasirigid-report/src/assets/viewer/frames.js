// A motion as a list of frames, with the state at any time between them.
// Where the body turns little from frame to frame, the frames are interpolated. Where it turns much, the motion is
// integrated from the frame before, by the reduced equations; the difference at the frame after is spread over the
// interval, unless the frames come from the same equations.
const SMOOTH = 1.2; // rad from frame to frame
const TRAIL = 0.3; // rad from point to point of a trail
const MOST_STEPS = 4000;

class Frames {
  /** Arrays t, attitude, momentum and dissipated; optionally omega, q and rotors; the equations between frames. */
  constructor(arrays, equations, own = false) {
    Object.assign(this, arrays, { equations, own, rotors: arrays.rotors ?? null, q: arrays.q ?? null });
    this.count = this.t.length;
    this.coordinates = this.q ? this.q.length / this.count : 0;
    this.rotorCount = this.rotors ? this.rotors.length / this.count : 0;
    this.motion = new FreeMotion(equations, 1e-8);
    this.interval = -1;
    this.closure = { interval: -1, turn: [0, 0, 0] };
  }

  get start() {
    return this.t[0];
  }

  get end() {
    return this.t[this.count - 1];
  }

  spinAt(i) {
    if (this.omega) return vectorAt(this.omega, i);
    const out = new Float64Array(7);
    this.equations.form.at(...vectorAt(this.momentum, i), out);
    return Array.from(out.subarray(0, 3));
  }

  row(list, width, i) {
    return list ? Array.from(list.subarray(width * i, width * (i + 1))) : null;
  }

  frame(i) {
    return {
      t: this.t[i],
      attitude: quaternionAt(this.attitude, i),
      momentum: vectorAt(this.momentum, i),
      omega: this.spinAt(i),
      q: this.row(this.q, this.coordinates, i) ?? this.displaced(this.spinAt(i)),
      rotors: this.row(this.rotors, this.rotorCount, i),
      dissipated: this.dissipated[i],
    };
  }

  displaced(omega) {
    if (!this.equations.displacements) return null;
    const out = new Float64Array(this.equations.displacements.rows);
    this.equations.displacements.at(...omega, out);
    return Array.from(out);
  }

  /** State at a time; `step` is the time from one drawn picture to the next. */
  at(time, step = 0) {
    const t = clamp(time, this.start, this.end);
    const i = Math.min(lastNotAbove(this.t, t), Math.max(0, this.count - 2));
    const length = this.count > 1 ? this.t[i + 1] - this.t[i] : 0;
    if (length === 0 || t === this.t[i]) return this.frame(i);
    const part = (t - this.t[i]) / length;
    if (step > length) return this.frame(part > 0.5 ? i + 1 : i);
    return size(this.spinAt(i)) * length < SMOOTH ? this.between(i, part, t) : this.integrated(i, part, t);
  }

  between(i, part, t) {
    const blend = (list, width) => {
      if (!list) return null;
      const at = (k) => clamp(k, 0, this.count - 1) * width;
      const [p, a, b, n] = [at(i - 1), at(i), at(i + 1), at(i + 2)];
      return Array.from({ length: width }, (_, j) => cubic(list[p + j], list[a + j], list[b + j], list[n + j], part));
    };
    const momentum = blend(this.momentum, 3);
    const omega = this.omega ? blend(this.omega, 3) : this.spinAt(i);
    return {
      t,
      attitude: slerp(quaternionAt(this.attitude, i), quaternionAt(this.attitude, i + 1), part),
      momentum,
      omega,
      q: blend(this.q, this.coordinates) ?? this.displaced(omega),
      rotors: this.linear(this.rotors, this.rotorCount, i, part),
      dissipated: this.linear(this.dissipated, 1, i, part)[0],
    };
  }

  /** States of the last revolutions before a state: stored ones where they are dense, others by the equations. */
  recent(state, revolutions, perRevolution) {
    const i = lastNotAbove(this.t, state.t);
    const next = Math.min(i + 1, this.count - 1);
    if (size(state.omega) * (this.t[next] - this.t[Math.max(0, next - 1)]) >= TRAIL) {
      return trail(this.equations, state, revolutions, perRevolution);
    }
    const points = [state];
    let angle = 0;
    for (let k = i; k >= 0 && angle < 2 * Math.PI * revolutions; k--) {
      points.push({ momentum: vectorAt(this.momentum, k), omega: this.spinAt(k), attitude: quaternionAt(this.attitude, k) });
      if (k > 0) angle += size(this.spinAt(k)) * (this.t[k] - this.t[k - 1]);
    }
    return points;
  }

  linear(list, width, i, part) {
    if (!list) return null;
    return Array.from({ length: width }, (_, j) => list[width * i + j] * (1 - part) + list[width * (i + 1) + j] * part);
  }

  begin(motion, i) {
    motion.start(this.t[i], vectorAt(this.momentum, i), quaternionAt(this.attitude, i), this.dissipated[i]);
  }

  integrated(i, part, t) {
    const { motion } = this;
    if (this.interval !== i || motion.t > t) this.begin(motion, i);
    this.interval = i;
    if (!motion.to(t, MOST_STEPS)) return this.frame(part > 0.5 ? i + 1 : i);
    const turn = times(part, this.own ? [0, 0, 0] : this.difference(i));
    const omega = motion.spin();
    return {
      t,
      attitude: product(motion.attitude(), exponential(turn)),
      momentum: turned(exponential(times(-1, turn)), motion.momentum()),
      omega,
      q: this.displaced(omega) ?? this.linear(this.q, this.coordinates, i, part),
      rotors: this.linear(this.rotors, this.rotorCount, i, part),
      dissipated: this.own ? motion.dissipated() : this.linear(this.dissipated, 1, i, part)[0],
    };
  }

  /** Rotation from the integrated to the stored attitude at the end of an interval; none if they have parted. */
  difference(i) {
    if (this.closure.interval !== i) {
      const motion = new FreeMotion(this.equations, 1e-8);
      this.begin(motion, i);
      const arrived = motion.to(this.t[i + 1], MOST_STEPS);
      const turn = logarithm(product(inverse(motion.attitude()), quaternionAt(this.attitude, i + 1)));
      this.closure = { interval: i, turn: arrived && size(turn) < 1 ? turn : [0, 0, 0] };
    }
    return this.closure.turn;
  }
}

/** Catmull-Rom curve from b to c. */
const cubic = (a, b, c, d, x) =>
  b + 0.5 * x * (c - a + x * (2 * a - 5 * b + 4 * c - d + x * (3 * (b - c) + d - a)));

/** Times, angular velocities and attitudes of the last revolutions before a state, by the reduced equations. */
const trail = (equations, state, revolutions, perRevolution) => {
  const motion = new FreeMotion(equations, 1e-8);
  motion.start(state.t, state.momentum, state.attitude);
  const h = (2 * Math.PI) / (perRevolution * size(motion.omega));
  const points = [];
  for (let i = 0; i <= revolutions * perRevolution; i++) {
    if (i > 0) motion.fixedStep(-h);
    points.push({ momentum: motion.momentum(), omega: motion.spin(), attitude: motion.attitude() });
  }
  return points;
};
