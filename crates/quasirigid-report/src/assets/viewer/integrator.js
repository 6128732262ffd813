// Explicit Runge-Kutta method of order 8 with error control (DOP853), for autonomous systems.
// There is no dense output: a step that ends at the wanted time costs as much and is as exact as the others.
const STAGES = RESULT_WEIGHTS.length;

class Dop853 {
  /** rate(y, out) writes dy/dt; allowed(y, out) writes the error allowed per step in each component. */
  constructor(dimension, rate, allowed) {
    Object.assign(this, { dimension, rate, allowed });
    const vector = () => new Float64Array(dimension);
    this.stages = Array.from({ length: STAGES }, vector);
    [this.y, this.place, this.result, this.errors] = [vector(), vector(), vector(), vector()];
    this.steps = 0;
  }

  start(t, y) {
    this.t = t;
    this.y.set(y);
    this.h = 0;
  }

  /** One step towards a time, shortened to end there. */
  step(end) {
    const left = end - this.t;
    this.rate(this.y, this.stages[0]);
    this.allowed(this.y, this.errors);
    if (this.h === 0) this.h = this.firstStep();
    let shrunk = false;
    for (;;) {
      const reaches = this.h >= left * (1 - 1e-12);
      const h = reaches ? left : this.h;
      this.trial(h);
      const error = this.error(h);
      const factor = Number.isFinite(error) ? clamp(0.9 * error ** -0.125, 0.333, 6) : 0.333;
      if (error <= 1) {
        const next = h * (shrunk ? Math.min(1, factor) : factor);
        this.h = reaches ? Math.max(this.h, next) : next;
        this.t = reaches ? end : this.t + h;
        this.y.set(this.result);
        this.steps++;
        return;
      }
      shrunk = true;
      this.h = h * factor;
      if (!(this.h > 1e-14 * (Math.abs(this.t) + left))) throw new Error("the step has become too small");
    }
  }

  /** A step of a given length, without error control; negative lengths go back in time. */
  fixedStep(h) {
    this.rate(this.y, this.stages[0]);
    this.trial(h);
    this.y.set(this.result);
    this.t += h;
  }

  trial(h) {
    const { dimension: n, stages, y, place, result } = this;
    for (let s = 1; s < STAGES; s++) {
      this.combine(STAGE_WEIGHTS[s - 1], h, place);
      this.rate(place, stages[s]);
    }
    this.combine(RESULT_WEIGHTS, h, result);
  }

  combine(weights, h, out) {
    const { dimension: n, stages, y } = this;
    out.set(y);
    for (let s = 0; s < weights.length; s++) {
      const weight = h * weights[s];
      if (weight === 0) continue;
      const stage = stages[s];
      for (let i = 0; i < n; i++) out[i] += weight * stage[i];
    }
  }

  /** Error estimate of a trial in units of the allowed error. */
  error(h) {
    let fifth = 0;
    let third = 0;
    for (let i = 0; i < this.dimension; i++) {
      let e5 = 0;
      let e3 = 0;
      for (let s = 0; s < STAGES; s++) {
        e5 += ERROR_WEIGHTS_5[s] * this.stages[s][i];
        e3 += ERROR_WEIGHTS_3[s] * this.stages[s][i];
      }
      fifth += (e5 / this.errors[i]) ** 2;
      third += (e3 / this.errors[i]) ** 2;
    }
    return fifth === 0 ? 1e-30 : (h * fifth) / Math.sqrt(fifth + 0.01 * third);
  }

  /** A hundredth of the time in which the state would change by itself. */
  firstStep() {
    let time = Infinity;
    for (let i = 0; i < this.dimension; i++) {
      const rate = Math.abs(this.stages[0][i]);
      if (rate > 0 && this.y[i] !== 0) time = Math.min(time, Math.abs(this.y[i]) / rate);
    }
    return Number.isFinite(time) ? 0.01 * time : 1e-3;
  }
}
