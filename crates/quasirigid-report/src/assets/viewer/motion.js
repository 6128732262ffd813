// Free motion of the reduced body by the energy form, dK/dt = K x omega(K), dW/dt = power, and the attitude.
// K is fixed in inertial axes, so the attitude is T R(e, psi) A, where A is the smallest rotation of k = K/|K| into a
// body axis e, and T turns e into the inertial direction of K. The angle psi obeys
//   dpsi/dt = omega . (k + e) / (1 + k . e),
// a quadrature: long steps stay exact where the spin is much faster than the nutation, and K never leaves its line.
class FreeMotion {
  constructor(equations, tolerance) {
    this.equations = equations;
    /** Angular velocity, rate of the angular momentum, power. */
    this.now = new Float64Array(7);
    this.axis = [0, 0, 1];
    /** Relative changes of |K| by the integrator, added up; every step takes its own out. */
    this.drift = 0;
    this.solver = new Dop853(5, (y, out) => this.rate(y, out), (y, out) => this.allowed(y, out, tolerance));
  }

  get omega() {
    return this.now.subarray(0, 3);
  }

  get t() {
    return this.solver.t;
  }

  start(t, K, attitude, W = 0) {
    this.size = size(K);
    this.solver.start(t, [...K, 0, W]);
    this.chart(K, attitude);
    this.spin();
    this.energy = 0.5 * dot(K, this.omega);
  }

  chart(K, attitude) {
    this.axis = unit(K);
    this.turn = attitude;
    this.solver.y[3] = 0;
  }

  rate(y, out) {
    const { now, axis } = this;
    const [K1, K2, K3] = y;
    this.equations.form.at(K1, K2, K3, now);
    const [w1, w2, w3] = now;
    [out[0], out[1], out[2]] = [now[3], now[4], now[5]];
    const scale = 1 / this.size;
    const [e1, e2, e3] = axis;
    const along = w1 * (scale * K1 + e1) + w2 * (scale * K2 + e2) + w3 * (scale * K3 + e3);
    out[3] = along / (1 + scale * (K1 * e1 + K2 * e2 + K3 * e3));
    out[4] = now[6];
  }

  allowed(y, out, tolerance) {
    out[0] = out[1] = out[2] = tolerance * this.size;
    out[3] = tolerance;
    out[4] = tolerance * (Math.abs(y[4]) + 1e-9 * this.energy);
  }

  step(end) {
    this.solver.step(end);
    this.settle();
  }

  fixedStep(h) {
    this.solver.fixedStep(h);
    this.settle();
  }

  /** Takes the error of |K| out, and moves the axis of the angle when K has gone far from it. */
  settle() {
    const { y } = this.solver;
    const factor = this.size / Math.hypot(y[0], y[1], y[2]);
    this.drift += Math.abs(factor - 1);
    for (let i = 0; i < 3; i++) y[i] *= factor;
    if (dot(y, this.axis) < -0.5 * this.size) this.chart(this.momentum(), this.attitude());
  }

  /** Steps to a time; gives up after so many steps. */
  to(end, most = Infinity) {
    for (let steps = 0; this.t < end; steps++) {
      if (steps === most) return false;
      this.step(end);
    }
    return true;
  }

  momentum() {
    return Array.from(this.solver.y.subarray(0, 3));
  }

  dissipated() {
    return this.solver.y[4];
  }

  /** Angular velocity of the state reached. */
  spin() {
    const { y } = this.solver;
    this.equations.form.at(y[0], y[1], y[2], this.now);
    return Array.from(this.omega);
  }

  attitude() {
    const k = times(1 / this.size, this.solver.y);
    return normalized(product(product(this.turn, rotation(this.axis, this.solver.y[3])), shortest(k, this.axis)));
  }
}
