// The panel that integrates the reduced equations for the settings of its sliders: a draft at once, a finer run when
// the sliders rest. A border and a sentence say whether the equations hold at that spin.
const DRAFT = { tolerance: 1e-7, first: 30, slice: 12 };
const FINE = { tolerance: 1e-10, first: 8, slice: 8 };
const REST = 300; // ms
const MOST_WORK = 8000; // ms

class Panel {
  /** `show` takes the frames of a run, or null for the run of the record. */
  constructor(scene, track, show) {
    Object.assign(this, { scene, track, show, job: 0, isOwn: false });
    this.node = byId("panel");
    this.node.hidden = false;
    this.start = scene.equations.start;
    this.axis = this.nearestAxis();
    byId("panel-axis").value = String(this.axis);
    byId("panel-theirs").textContent = track ? `the run of this report (${scene.track.system} equations)` : "the settings of the run";
    const fixed = !scene.equations.scalable;
    for (const name of ["stiffness", "damping"]) byId(`panel-${name}-control`).hidden = fixed;
    byId("panel-fixed").hidden = !fixed || !scene.equations.note;
    byId("panel-fixed").textContent = scene.equations.note ?? "";
    for (const name of ["spin", "wobble", "stiffness", "damping"]) this.slider(name).addEventListener("input", () => this.changed());
    byId("panel-reset").addEventListener("click", () => this.reset());
    byId("panel-axis").addEventListener("change", (event) => this.turnTo(Number(event.target.value)));
    this.reset();
  }

  slider(name) {
    return byId(`panel-${name}`);
  }

  /** The chosen principal axis, on the side of the run's K. */
  direction() {
    const axis = this.scene.principal.axes[this.axis];
    return dot(axis, this.start.K) < 0 ? times(-1, axis) : axis;
  }

  /** The axis of least or of greatest moment, whichever K circles at the start of the run. */
  nearestAxis() {
    const { moments, axes } = this.scene.principal;
    const squares = axes.map((axis) => dot(axis, this.start.K) ** 2);
    const twice = squares.reduce((sum, square, i) => sum + square / moments[i], 0);
    return twice * moments[1] <= squares[0] + squares[1] + squares[2] ? 2 : 0;
  }

  turnTo(axis) {
    const K = this.settings().K;
    this.axis = axis;
    this.slider("wobble").value = degrees(angleBetween(K, this.direction()));
    this.theirs = this.curvesOfRun();
    this.begin();
  }

  reset() {
    for (const name of ["spin", "stiffness", "damping"]) this.slider(name).value = 0;
    this.slider("wobble").value = degrees(angleBetween(this.start.K, this.direction()));
    this.isOwn = false;
    this.theirs = this.curvesOfRun();
    this.show(null);
    this.begin();
  }

  changed() {
    this.isOwn = true;
    this.begin();
  }

  curvesOfRun() {
    return this.track && curvesOf(this.track, this.direction(), this.start.duration);
  }

  /** Start of the run with the settings: K turned in its plane with the axis, and fixed in inertial axes. */
  settings() {
    const value = (name) => 10 ** Number(this.slider(name).value);
    const axis = this.direction();
    const k = unit(this.start.K);
    const sideways = plus(k, axis, -dot(k, axis));
    const side = size(sideways) > 1e-9 ? unit(sideways) : across(axis);
    const angle = (Number(this.slider("wobble").value) * Math.PI) / 180;
    const direction = this.isOwn ? plus(times(Math.cos(angle), axis), side, Math.sin(angle)) : k;
    const turn = dot(k, direction) > -0.999999 ? shortest(direction, k) : rotation(across(k), Math.PI);
    const [spin, s, d] = ["spin", "stiffness", "damping"].map(value);
    const K = times(spin * size(this.start.K), direction);
    return { spin, s, d, angle, K, attitude: product(this.start.attitude, turn), duration: this.start.duration };
  }

  begin() {
    const settings = this.settings();
    this.words(settings);
    byId("panel-reset").disabled = !this.isOwn;
    this.work = 0;
    this.pursue(settings, DRAFT, ++this.job);
  }

  /** Integrates in slices until the run is finished, the work is too much, or the sliders move. */
  pursue(settings, effort, job) {
    const equations = scaledEquations(this.scene.equations, settings.s, settings.d);
    let run = null;
    const slice = () => {
      if (job !== this.job) return;
      const from = performance.now();
      try {
        run ??= new Run(equations, settings, this.direction(), effort.tolerance);
        run.advance(this.work === 0 ? effort.first : effort.slice);
      } catch (error) {
        byId("panel-work").textContent = `The integration stopped: ${error.message}.`;
        return;
      }
      this.work += performance.now() - from;
      const spent = this.work > MOST_WORK;
      if (effort === DRAFT || run.finished) this.report(run, settings, spent);
      if (!run.finished && !spent) requestAnimationFrame(slice);
      else if (effort === DRAFT && run.finished) setTimeout(() => job === this.job && this.pursue(settings, FINE, job), REST);
    };
    requestAnimationFrame(slice);
  }

  words({ spin, s, d, angle }) {
    const factor = (value) => (Math.abs(value - 1) < 1e-9 ? "as in the run" : factorWords(value));
    byId("panel-spin-words").textContent = factor(spin);
    byId("panel-stiffness-words").textContent = factor(s);
    byId("panel-damping-words").textContent = factor(d);
    byId("panel-wobble-words").textContent = angleWords(angle);
  }

  report(run, settings, spent) {
    const { curves } = run;
    const angle = (of) => Array.from(of.least, (low, i) => [degrees(low), degrees(of.greatest[i])]);
    const energy = (of) => Array.from(of.dissipated, (value) => [value, value]);
    const both = (of) => [
      ...(this.theirs ? [{ curve: of(this.theirs), name: "viewer-theirs" }] : []),
      { curve: of(curves), name: "viewer-ours" },
    ];
    drawCurves(byId("panel-angle"), run.duration, both(angle));
    drawCurves(byId("panel-energy"), run.duration, both(energy));
    this.judge(run);
    const lost = run.motion.dissipated() / run.energy;
    const part = run.finished ? "" : ` ${spent ? "Stopped" : "So far"} at ${timeWords(run.motion.t)} of ${timeWords(run.duration)}.`;
    byId("panel-work").textContent =
      `Dissipated: ${numeral(lost)} of the kinetic energy. Numerical drift of |K|, taken out at each step: ` +
      `${numeral(run.motion.drift, 2)} in ${run.motion.solver.steps} steps.${part}`;
    if (this.isOwn) this.show(run.frames());
  }

  judge(run) {
    const { limits } = run.equations;
    const place = byId("panel-validity");
    place.hidden = !limits;
    if (!limits) return;
    const rate = Math.max(run.fastest, size(run.motion.omega));
    const [level, verdict] =
      rate <= limits[0]
        ? ["holds", "The reduced equations hold"]
        : rate <= limits[1]
          ? ["marginal", "The reduced equations hold marginally"]
          : ["fails", "The reduced equations do not hold"];
    this.node.classList.remove("holds", "marginal", "fails");
    this.node.classList.add(level);
    const limit = level === "holds" ? `up to ${numeral(limits[0])}` : `well up to ${numeral(limits[0])}, not beyond ${numeral(limits[1])}`;
    const sentence = `${verdict}: the angular velocity reaches ${numeral(rate)} rad/s, and they hold ${limit} rad/s.`;
    if (place.textContent !== sentence) place.textContent = sentence;
  }

  mark(part) {
    markTime(byId("panel-angle"), part);
    markTime(byId("panel-energy"), part);
  }
}
