// The panel that integrates the reduced equations for the settings of its sliders: a draft at once, a finer run when
// the sliders rest. A border and a sentence say whether the equations hold at that spin.
const DRAFT = { tolerance: 1e-7, first: 30, slice: 12 };
const FINE = { tolerance: 1e-10, first: 8, slice: 8 };
const REST = 300; // ms
const MOST_WORK = 8000; // ms

class Panel {
  /** `show` takes the frames of a run, or null for the run of the record. */
  constructor(scene, track, show) {
    Object.assign(this, { scene, track, show, job: 0, time: 0, isOwn: false });
    this.node = byId("panel");
    this.node.hidden = false;
    this.start = scene.equations.start;
    this.axis = this.nearestAxis();
    byId("panel-axis").value = String(this.axis);
    // A run of other equations is drawn from its frames; one of these, from the page's own integration of it.
    const { system } = scene.track ?? {};
    this.other = track && system !== "reduced" ? curvesOf(track, scene.principal.axes.map((_, i) => this.direction(i)), this.start.duration) : null;
    byId("panel-theirs").textContent = this.other ? `the run of this report (${system} equations)` : "the run";
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
  direction(i = this.axis) {
    const axis = this.scene.principal.axes[i];
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
    this.begin();
  }

  reset() {
    for (const name of ["spin", "stiffness", "damping"]) this.slider(name).value = 0;
    this.slider("wobble").value = degrees(angleBetween(this.start.K, this.direction()));
    this.isOwn = false;
    this.show(null);
    this.begin();
  }

  changed() {
    this.isOwn = true;
    this.begin();
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
      const first = run === null;
      run ??= new Run(equations, settings, this.scene.principal.axes.map((_, i) => this.direction(i)), effort.tolerance);
      const stopped = !this.advanced(run, first ? effort.first : effort.slice);
      this.work += performance.now() - from;
      const last = stopped || run.finished || this.work > MOST_WORK;
      if (effort === DRAFT || run.finished) this.report(run, last, stopped);
      if (this.isOwn && effort === DRAFT ? first || last : this.isOwn && run.finished) this.show(run.frames());
      if (!last) requestAnimationFrame(slice);
      else if (effort === DRAFT && run.finished) setTimeout(() => job === this.job && this.pursue(settings, FINE, job), REST);
    };
    requestAnimationFrame(slice);
  }

  /** Whether a run went on; equations far outside their range may have no solution. */
  advanced(run, milliseconds) {
    try {
      run.advance(milliseconds);
      return true;
    } catch {
      return false;
    }
  }

  words({ spin, s, d, angle }) {
    const factor = (value) => (Math.abs(value - 1) < 1e-9 ? "as in the run" : factorWords(value));
    byId("panel-spin-words").textContent = factor(spin);
    byId("panel-stiffness-words").textContent = factor(s);
    byId("panel-damping-words").textContent = factor(d);
    byId("panel-wobble-words").textContent = angleWords(angle);
  }

  report(run, last, stopped) {
    const { curves } = run;
    if (!this.isOwn && !this.other) this.usual = curves;
    const theirs = this.other ?? (this.isOwn ? this.usual : null);
    const draw = (id, of) => {
      const both = [...(theirs ? [{ curve: of(theirs), name: "viewer-theirs" }] : []), { curve: of(curves), name: "viewer-ours" }];
      // The settings of the run leave its scale: reduced equations that do not hold may say anything.
      return drawCurves(byId(id), run.duration, both, this.isOwn ? both : both.slice(0, 1));
    };
    draw("panel-angle", (of) => of.angle(this.axis));
    const power = draw("panel-energy", (of) => of.energy());
    byId("panel-energy-title").textContent = `Dissipated energy, ${power ? `${powerOfTen(power)} J` : "J"}`;
    byId("panel-ours").textContent = this.isOwn ? "these settings" : this.other ? "reduced equations, settings of the run" : "the run";
    byId("panel-theirs-key").hidden = !theirs;
    this.mark();
    this.judge(run);
    const lost = run.motion.dissipated() / run.energy;
    const share = lost <= 1 ? `${numeral(lost)} of the kinetic energy` : "more than the kinetic energy, which no body can lose";
    const reached = `${timeWords(run.motion.t)} of ${timeWords(run.duration)}`;
    const broken = `Broken off after ${reached}: equations so far outside their range need not have a solution.`;
    const part = run.finished ? "" : ` ${last ? "Stopped after" : "So far"} ${reached}.`;
    byId("panel-work").textContent = stopped
      ? broken
      : `Dissipated: ${share}. Numerical drift of |K|, taken out at each step: ` +
        `${numeral(run.motion.drift, 2)} in ${run.motion.solver.steps} steps.${part}`;
  }

  judge(run) {
    const { limits } = run.equations;
    const place = byId("panel-validity");
    place.hidden = !limits;
    if (!limits) return;
    const rate = run.fastest;
    const [level, verdict] =
      rate <= limits[0]
        ? ["holds", "The reduced equations hold"]
        : rate <= limits[1]
          ? ["marginal", "The reduced equations hold marginally"]
          : ["fails", "The reduced equations do not hold"];
    this.node.classList.remove("holds", "marginal", "fails");
    this.node.classList.add(level);
    const beyond = level !== "holds" && Number.isFinite(limits[1]) ? `, not beyond ${numeral(limits[1])}` : "";
    const limit = `${level === "holds" ? "to" : "well to"} ${numeral(limits[0])}${beyond}`;
    const sentence = `${verdict}: |ω| reaches ${numeral(rate)} rad/s; they hold ${limit} rad/s.`;
    if (place.textContent !== sentence) place.textContent = sentence;
  }

  /** Marks a time since the start of the run. */
  mark(time = this.time) {
    this.time = time;
    const part = time / this.start.duration;
    markTime(byId("panel-angle"), part);
    markTime(byId("panel-energy"), part);
  }
}
