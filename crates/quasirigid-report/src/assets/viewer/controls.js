// Controls of the viewer: buttons, sliders, keys and pointers, and what is written beside the picture.
const byId = (id) => document.getElementById(id);
const LARGEST_SHARE = 0.05; // of the radius: what the largest displacement is magnified to
const TURN = 0.06; // rad a key press
const ZOOM = 1.12;
const STEP = 0.005; // of the run a key press
const BESIDE = 13; // pixels from a tip to its letter

class Controls {
  constructor(viewer) {
    Object.assign(this, { viewer, canvas: viewer.canvas, pointers: new Map() });
    this.chooseMagnification();
    this.chooseSpeed(this.speedOfTurn());
    this.transport();
    this.options();
    this.motions();
    this.legend();
    this.pointing();
    this.canvas.addEventListener("keydown", (event) => this.key(event));
    const dark = matchMedia("(prefers-color-scheme: dark)");
    dark.addEventListener("change", () => viewer.recolor());
    viewer.onDraw = () => this.told();
    this.hideUnserved();
    this.playInView(viewer.frames && !matchMedia("(prefers-reduced-motion: reduce)").matches);
  }

  /** Plays as soon as the picture is on the screen, and rests while it is not. */
  playInView(plays) {
    let first = plays;
    new IntersectionObserver(([entry]) => {
      this.viewer.awake = entry.isIntersecting;
      if (!entry.isIntersecting) return;
      this.play(first || this.viewer.clock.playing);
      first = false;
    }).observe(this.canvas);
  }

  hideUnserved() {
    const { scene, frames } = this.viewer;
    const absent = {
      "viewer-side": !this.viewer.polhode,
      "viewer-magnified-control": !scene.coordinates?.length,
      "viewer-motion-control": !this.viewer.modes.length,
      "viewer-speed-control": !frames,
      "viewer-play": !frames,
      "viewer-scrub": !frames,
    };
    for (const [id, hidden] of Object.entries(absent)) byId(id).hidden = hidden;
  }

  transport() {
    byId("viewer-play").addEventListener("click", () => this.play(!this.viewer.clock.playing));
    byId("viewer-scrub").addEventListener("input", (event) => this.scrub(Number(event.target.value)));
    byId("viewer-speed").addEventListener("input", (event) => this.chooseSpeed(10 ** Number(event.target.value)));
    window.addEventListener("quasirigid:seek", ({ detail }) => this.seek(detail?.t));
    byId("viewer-speed-real").addEventListener("click", () => this.chooseSpeed(1));
    byId("viewer-speed-turn").addEventListener("click", () => this.chooseSpeed(this.speedOfTurn()));
    byId("viewer-speed-whole").addEventListener("click", () => this.chooseSpeed((this.viewer.frames.end - this.viewer.frames.start) / 30));
  }

  play(playing) {
    this.viewer.clock.play(playing);
    this.viewer.redraw();
  }

  scrub(part) {
    this.viewer.clock.part = part;
    this.viewer.redraw();
  }

  /** Rate of the rotation at the start (rad/s). */
  rate() {
    const { frames } = this.viewer;
    return frames ? size(frames.spinAt(0)) : 0;
  }

  speedOfTurn() {
    const rate = this.rate();
    return rate > 0 ? (2 * Math.PI) / rate / PERIOD_SHOWN : 1;
  }

  chooseSpeed(speed) {
    const { viewer } = this;
    const slider = byId("viewer-speed");
    viewer.runSpeed = speed;
    if (!viewer.mode && viewer.clock) viewer.clock.speed = speed;
    slider.value = Math.log10(speed);
    viewer.redraw();
  }

  chooseMagnification() {
    const { viewer } = this;
    const largest = viewer.largestDisplacement();
    const usual = largest > 0 ? Math.max(1, rounded((LARGEST_SHARE * viewer.radius) / largest)) : 1;
    const slider = byId("viewer-magnified");
    const choose = (factor) => {
      viewer.magnified = factor;
      slider.value = Math.log10(factor);
      byId("viewer-magnified-words").textContent = factor === 1 ? "true to scale" : factorWords(factor);
      viewer.redraw();
    };
    slider.max = Math.max(3, Math.ceil(Math.log10(usual)) + 2);
    slider.addEventListener("input", () => choose(10 ** Number(slider.value)));
    choose(usual);
    this.magnify = choose;
    this.usual = usual;
  }

  options() {
    const { viewer } = this;
    for (const radio of document.getElementsByName("viewer-view")) {
      radio.addEventListener("change", () => this.see(radio.value));
    }
    for (const name of ["spin", "momentum", "axes"]) {
      byId(`viewer-show-${name}`).addEventListener("change", (event) => {
        viewer.show[name] = event.target.checked;
        viewer.redraw();
      });
    }
    byId("viewer-reset").addEventListener("click", () => this.reset());
  }

  see(view) {
    this.viewer.view = view;
    for (const radio of document.getElementsByName("viewer-view")) radio.checked = radio.value === view;
    this.viewer.redraw();
  }

  reset() {
    this.viewer.camera.reset();
    this.viewer.redraw();
  }

  /** The run, and the vibration modes one by one. */
  motions() {
    const { viewer } = this;
    const select = byId("viewer-motion");
    const amplitude = byId("viewer-amplitude");
    const names = [viewer.frames ? "the run" : "at rest", ...viewer.modes.map((mode, i) => `mode ${i + 1}: ${mode.source.name}`)];
    for (const [i, name] of names.entries()) select.add(new Option(name, String(i)));
    const choose = () => {
      const mode = viewer.modes[Number(select.value) - 1] ?? null;
      viewer.choose(mode);
      byId("viewer-amplitude-control").hidden = !mode;
      byId("viewer-motion-words").textContent = mode ? mode.words() : "";
      for (const id of ["viewer-speed-control", "viewer-side"]) byId(id).hidden = Boolean(mode) || !viewer.frames;
      this.magnify(mode ? mode.magnified : this.usual);
      if (mode && !matchMedia("(prefers-reduced-motion: reduce)").matches) this.play(true);
    };
    const size = () => {
      viewer.amplitude = Number(amplitude.value);
      byId("viewer-amplitude-words").textContent = numeral(viewer.amplitude, 2);
      viewer.redraw();
    };
    select.addEventListener("change", choose);
    amplitude.addEventListener("input", size);
    size();
  }

  /** A button for each part: pressed parts are shown, and the part under the pointer or with the focus stands out. */
  legend() {
    const { viewer } = this;
    const place = byId("viewer-legend");
    const light = (pieces) => {
      viewer.lit = pieces;
      viewer.redraw();
    };
    for (const entry of viewer.legend) {
      const button = document.createElement("button");
      const swatch = document.createElement("span");
      button.type = "button";
      button.setAttribute("aria-pressed", "true");
      swatch.className = "viewer-swatch";
      swatch.style.background = `var(${entry.color})`;
      button.append(swatch, titleOf(entry));
      button.addEventListener("click", () => {
        const shown = button.getAttribute("aria-pressed") !== "true";
        button.setAttribute("aria-pressed", String(shown));
        for (const piece of entry.pieces) piece.hidden = !shown;
        viewer.redraw();
      });
      for (const type of ["pointerenter", "focus"]) button.addEventListener(type, () => light(entry.pieces));
      for (const type of ["pointerleave", "blur"]) button.addEventListener(type, () => light(null));
      place.append(button);
    }
  }

  pointing() {
    const { canvas } = this;
    canvas.addEventListener("pointerdown", (event) => {
      canvas.setPointerCapture(event.pointerId);
      this.pointers.set(event.pointerId, [event.clientX, event.clientY]);
    });
    for (const type of ["pointerup", "pointercancel"]) canvas.addEventListener(type, (event) => this.pointers.delete(event.pointerId));
    canvas.addEventListener("pointermove", (event) => this.moved(event));
    canvas.addEventListener("pointerleave", () => (byId("viewer-tip").hidden = true));
    canvas.addEventListener(
      "wheel",
      (event) => {
        if (document.activeElement !== canvas) return;
        event.preventDefault();
        this.zoom(Math.exp(-0.0015 * event.deltaY));
      },
      { passive: false },
    );
  }

  moved(event) {
    const before = this.pointers.get(event.pointerId);
    if (!before) return this.hover(event);
    const now = [event.clientX, event.clientY];
    const others = [...this.pointers].filter(([id]) => id !== event.pointerId).map(([, place]) => place);
    this.pointers.set(event.pointerId, now);
    if (others.length === 1) {
      const apart = ([x, y]) => Math.hypot(x - others[0][0], y - others[0][1]);
      if (apart(before) > 0) this.zoom(apart(now) / apart(before));
    } else if (others.length === 0) {
      const scale = Math.PI / this.canvas.clientHeight;
      this.turn(scale * (now[0] - before[0]), scale * (now[1] - before[1]));
    }
  }

  turn(azimuth, elevation) {
    this.viewer.camera.turn(azimuth, elevation);
    this.viewer.redraw();
  }

  zoom(factor) {
    this.viewer.camera.closer(factor);
    this.viewer.redraw();
  }

  hover(event) {
    if (event.pointerType === "touch") return;
    const box = this.canvas.getBoundingClientRect();
    const [x, y] = [event.clientX - box.left, event.clientY - box.top];
    const found = this.viewer.under(x / box.width, y / box.height);
    const tip = byId("viewer-tip");
    tip.hidden = !found;
    if (!found) return;
    const { name, kind } = found.piece;
    const moved = found.displacement > 0 ? `: displaced by ${lengthWords(found.displacement)}` : "";
    tip.textContent = `${name || kind}${moved}`;
    tip.style.left = `${Math.min(x + 12, box.width - 160)}px`;
    tip.style.top = `${y + 14}px`;
  }

  key(event) {
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    const step = (sign) => this.scrub(this.viewer.clock.part + sign * STEP);
    const arrows = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] };
    const actions = {
      " ": () => this.play(!this.viewer.clock.playing),
      ",": () => step(-1),
      ".": () => step(1),
      "+": () => this.zoom(ZOOM),
      "=": () => this.zoom(ZOOM),
      "-": () => this.zoom(1 / ZOOM),
      1: () => this.see("body"),
      2: () => this.see("inertial"),
      r: () => this.reset(),
    };
    const arrow = arrows[event.key];
    const sideways = event.shiftKey && arrow && arrow[0];
    const action = sideways ? () => step(arrow[0]) : arrow ? () => this.turn(TURN * arrow[0], TURN * arrow[1]) : actions[event.key.toLowerCase()];
    if (!action) return;
    event.preventDefault();
    action();
  }

  /** Writes what the picture shows. */
  told() {
    const { viewer } = this;
    const { clock, now } = viewer;
    byId("viewer-play").textContent = clock.playing ? "Pause" : "Play";
    if (viewer.frames) {
      byId("viewer-scrub").value = clock.part;
      byId("viewer-time").textContent = `${timeIn(clock.time, timeUnit(clock.time), 4)} of ${timeWords(clock.end)}`;
      byId("viewer-scrub").setAttribute("aria-valuetext", byId("viewer-time").textContent);
      byId("viewer-state").textContent = this.stateWords(now);
    }
    const strobe = clock.playing && now.omega && size(now.omega) * Math.abs(clock.step) > Math.PI;
    byId("viewer-strobe").hidden = !strobe;
    byId("viewer-speed-words").textContent = speedWords(viewer.runSpeed, this.rate());
    this.tags();
    if (viewer.mode) return;
    this.panel?.mark(clock.time - clock.start);
    if (viewer.frames && clock.time !== this.toldTime) this.tell(clock.time);
  }

  /** Tells the charts of the page which time is shown. */
  tell(t) {
    this.toldTime = t;
    window.dispatchEvent(new CustomEvent("quasirigid:time", { detail: { t } }));
  }

  /** Goes to a time of the run, as a click on a chart asks. */
  seek(t) {
    const { viewer } = this;
    const clock = viewer.mode ? viewer.runClock : viewer.clock;
    if (!viewer.frames || !Number.isFinite(t)) return;
    clock.time = clamp(t, clock.start, clock.end);
    viewer.redraw();
  }

  stateWords({ omega, momentum, dissipated }) {
    const words = [];
    if (omega) words.push(`|ω| ${numeral(size(omega), 4)} rad/s`);
    if (omega && momentum) words.push(`angle of ω from K ${angleWords(angleBetween(omega, momentum))}`);
    if (momentum && this.viewer.scene.principal) words.push(nutationWords(momentum, this.viewer.scene.principal));
    if (dissipated !== undefined) words.push(`dissipated ${numeral(dissipated)} J`);
    return words.join(", ");
  }

  tags() {
    const { clientWidth: width, clientHeight: height } = this.canvas;
    const places = new Map(this.viewer.tags.map(([name, [x, y]]) => [name, [x * width, y * height]]));
    const [spin, momentum] = [places.get("spin"), places.get("momentum")];
    if (spin && momentum) spin[0] += spin[0] < momentum[0] ? -BESIDE : BESIDE;
    const covered = ([x, y]) => [spin, momentum].some((other) => other && Math.hypot(x - other[0], y - other[1]) < 1.5 * BESIDE);
    for (const name of ["momentum", "spin", "1", "2", "3"]) {
      const tag = byId(`viewer-tag-${name}`);
      const place = places.get(name);
      const isAxis = name.length === 1;
      tag.hidden = !place || place[0] < 6 || place[0] > width - 6 || place[1] < 8 || place[1] > height - 8 || (isAxis && covered(place));
      if (place) [tag.style.left, tag.style.top] = place.map((x) => `${x}px`);
    }
  }
}

const titleOf = ({ name, kind, pieces }) => (pieces.length > 1 ? name : name && name !== kind ? `${name} (${kind})` : kind);

/** Angle of K from the principal axis that it circles. */
const nutationWords = (momentum, { moments, axes }) => {
  const squares = axes.map((axis) => dot(axis, momentum) ** 2);
  const excess = squares.reduce((sum, square, i) => sum + square * (1 / moments[i] - 1 / moments[1]), 0);
  const [circled, name] = excess > 0 ? [axes[0], "least"] : [axes[2], "greatest"];
  const angle = angleBetween(momentum, circled);
  return `K ${angleWords(Math.min(angle, Math.PI - angle))} from the axis of ${name} moment`;
};
