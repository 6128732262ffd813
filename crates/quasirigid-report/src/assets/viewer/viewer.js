// The picture: what is shown at a time, and one drawing loop that sleeps when nothing changes.
const REVOLUTIONS = 12;
const PER_REVOLUTION = 24;
const EDGE = 0.55; // of the colour of a piece
const MOMENTUM = 1.36; // length of the arrow of K, in radii of the body
const SLENDER = 0.1; // distance from an arrow, in radii of the body, within which a part is hidden by it

/** Equations that turn the body from frame to frame: the reduced ones where they hold, else those of the rigid body. */
const equationsBetween = ({ equations, principal, track }) => {
  const fastest = track ? Math.max(...chunks(floats(track.omega), 3).map(size)) : 0;
  const reduced = equations && scaledEquations(equations);
  const holds = reduced && fastest <= (reduced.limits?.[1] ?? Infinity);
  return holds ? reduced : principal && rigidEquations(principal);
};

class Viewer {
  constructor(scene, gl) {
    Object.assign(this, { scene, gl, canvas: gl.canvas, view: "inertial", magnified: 1, lit: null, mode: null, amplitude: 0.12, awake: true });
    this.show = { spin: true, momentum: true, axes: true };
    this.radius = scene.radius;
    this.camera = new Camera(scene.radius);
    this.stage = new Stage(gl);
    this.pieces = scene.pieces.filter(({ vertices }) => vertices.values.byteLength).map((source) => new Piece(source, scene.radius));
    this.legend = legendOf(this.pieces);
    this.drawn = new Map(this.pieces.map((piece) => [piece, this.stage.upload(piece)]));
    for (const piece of this.pieces) {
      const hull = ["carrier", "ellipsoid", "surface", "solid"].includes(piece.kind) && piece.faces;
      const inside = hull && this.pieces.some((other) => other !== piece && piece.holds(other.middle()));
      piece.seenThrough = piece.kind === "liquid" || Boolean(inside);
      piece.hidden = false;
    }
    this.between = equationsBetween(scene);
    this.track = scene.track && this.between ? this.stored(scene.track) : null;
    this.modes = (scene.modes ?? []).map((mode) => new Mode(mode, scene.spin, this.pieces, scene.radius));
    this.polhode = scene.principal && this.track ? new PolhodeView(byId("viewer-polhode"), scene.principal) : null;
    this.herpolhode = this.polhode && new HerpolhodeView(byId("viewer-herpolhode"));
    this.recolor();
    this.follow(this.track);
    this.tick = (now) => this.loop(now);
    new ResizeObserver(() => this.redraw()).observe(this.canvas);
  }

  stored(track) {
    const arrays = { t: doubles(track.t), dissipated: doubles(track.dissipated) };
    for (const name of ["attitude", "omega", "momentum", "q", "rotors"]) arrays[name] = floats(track[name]);
    return new Frames(arrays, this.between);
  }

  /** Shows a list of frames, at the same time as before. */
  follow(frames) {
    this.frames = frames;
    const clock = new Clock(frames?.start ?? 0, frames?.end ?? 1);
    const before = this.mode ? this.runClock : this.clock;
    if (before && frames) clock.replace(before);
    if (this.mode) this.runClock = clock;
    else this.clock = clock;
    if (frames) {
      this.fullSpin = size(frames.spinAt(0));
      this.polhode?.follow(frames);
      this.herpolhode?.follow(frames);
      this.upright = this.upright ?? this.uprightAxes(frames.frame(0));
      this.arrowsFrom = this.arrowsFrom ?? this.slenderReach(unit(frames.frame(0).momentum));
    }
    this.redraw();
  }

  /** What is up: in body axes the principal axis next to K, in inertial axes K. */
  uprightAxes({ momentum, attitude }) {
    const axes = this.scene.principal?.axes ?? [[1, 0, 0], [0, 1, 0], [0, 0, 1]];
    const nearest = axes.reduce((a, b) => (Math.abs(dot(b, momentum)) > Math.abs(dot(a, momentum)) ? b : a));
    return { body: times(Math.sign(dot(nearest, momentum)) || 1, nearest), inertial: turned(attitude, unit(momentum)) };
  }

  /** How far slender parts reach along a direction: arrows begin there, or they would hide the parts. */
  slenderReach(direction) {
    let reach = 0;
    for (const { rest } of this.pieces) {
      for (let i = 0; i < rest.length / 3; i++) {
        const place = vectorAt(rest, i);
        const along = dot(place, direction);
        if (size(plus(place, direction, -along)) < SLENDER * this.radius) reach = Math.max(reach, along);
      }
    }
    return reach > this.radius / 2 ? reach : 0;
  }

  choose(mode) {
    if (!this.mode) this.runClock = this.clock;
    this.mode = mode;
    this.clock = this.runClock;
    if (mode) {
      this.clock = new Clock(0, mode.period, true);
      this.clock.speed = mode.period / PERIOD_SHOWN;
      this.clock.play(this.runClock.playing);
    }
    this.redraw();
  }

  state() {
    if (this.mode) return this.mode.at(this.clock.time, this.amplitude);
    return this.frames?.at(this.clock.time, this.clock.step) ?? { attitude: [1, 0, 0, 0], omega: null, momentum: null, q: null, rotors: null };
  }

  recolor() {
    this.theme = currentTheme();
    this.redraw();
  }

  redraw() {
    if (!this.waiting) this.waiting = requestAnimationFrame((now) => this.tick(now));
  }

  loop(now) {
    this.waiting = 0;
    this.clock.tick(now);
    this.draw();
    if (this.clock.playing && this.awake) this.redraw();
    this.onDraw?.();
  }

  draw() {
    const { stage, canvas, theme } = this;
    if (!canvas.clientWidth) return; // on paper
    const scale = Math.min(window.devicePixelRatio || 1, 2);
    const [width, height] = [canvas.clientWidth * scale, canvas.clientHeight * scale].map((x) => Math.max(1, Math.round(x)));
    if (canvas.width !== width || canvas.height !== height) Object.assign(canvas, { width, height });
    const state = (this.now = this.state());
    const inertial = this.view === "inertial";
    const up = this.upright?.[this.view] ?? [0, 0, 1];
    const seen = this.camera.matrices(inertial ? state.attitude : state.small ?? [1, 0, 0, 0], up, width / height);
    this.seen = seen;
    const pixel = (2 * Math.tan(FIELD_OF_VIEW / 2)) / height * scale;
    stage.begin(theme.rgb("--panel"), seen.view, seen.projection, pixel);
    const visible = this.pieces.filter((piece) => !piece.hidden);
    for (const piece of visible) {
      piece.move(state.q, state.rotors, this.magnified);
      stage.refresh(this.drawn.get(piece));
    }
    this.drawPieces(visible.filter((piece) => !piece.seenThrough));
    this.drawVectors(state);
    this.drawPieces(visible.filter((piece) => piece.seenThrough));
    if (this.polhode && !this.mode) {
      const recent = this.frames.recent(state, REVOLUTIONS, PER_REVOLUTION);
      this.polhode.draw(theme, state, recent);
      this.herpolhode.draw(theme, state, recent);
    }
  }

  drawPieces(pieces) {
    const paper = this.theme.rgb("--panel");
    for (const piece of pieces) {
      const rgb = this.theme.rgb(piece.color);
      const dimmed = this.lit && !this.lit.includes(piece);
      const color = dimmed ? rgb.map((x, i) => 0.45 * x + 0.55 * paper[i]) : rgb;
      const edge = times(EDGE, color);
      const glow = this.lit && !dimmed ? 1 : 0;
      const alpha = piece.seenThrough ? (piece.kind === "liquid" ? 0.5 : 0.32) : 1;
      this.stage.draw(this.drawn.get(piece), { color, edge, alpha, glow });
    }
  }

  drawVectors({ omega, momentum }) {
    const { stage, theme, radius } = this;
    const tags = [];
    if (this.show.axes && this.scene.principal) {
      this.scene.principal.axes.forEach((axis, i) => {
        const end = times(1.16 * radius, axis);
        stage.stroke([times(-1.08 * radius, axis), end], theme.rgb("--muted"), 0.75);
        tags.push([`${i + 1}`, times(1.22 * radius, axis)]);
      });
    }
    if (this.show.momentum && momentum) {
      const tip = this.drawArrow(momentum, MOMENTUM, theme.rgb("--s2"));
      tags.push(["momentum", times(1.06, tip)]);
    }
    if (this.show.spin && omega && size(omega) > 0) {
      this.fullSpin ??= size(omega);
      const tip = this.drawArrow(omega, 1.18 * clamp(size(omega) / this.fullSpin, 0.2, 1.25), theme.rgb("--s1"));
      tags.push(["spin", times(1.07, tip)]);
    }
    this.tags = tags.map(([name, place]) => [name, Camera.spot(this.seen.both, place)]);
  }

  /** Draws an arrow along a vector, its length in radii of the body, and shorter by what slender parts take; returns its tip. */
  drawArrow(vector, length, color) {
    const { radius, arrowsFrom = 0 } = this;
    const along = (radii) => times(arrowsFrom + radii * (radius - arrowsFrom / MOMENTUM), unit(vector));
    const tip = along(length);
    this.stage.arrow(along(0), tip, 0.014 * radius, color);
    return tip;
  }

  /** Largest displacement of any vertex over the frames. */
  largestDisplacement() {
    if (!this.frames) return 0;
    const step = Math.max(1, Math.floor(this.frames.count / 60));
    let largest = 0;
    for (let i = 0; i < this.frames.count; i += step) {
      const { q } = this.frames.frame(i);
      if (q) for (const piece of this.pieces) largest = Math.max(largest, piece.largest(q));
    }
    return largest;
  }

  /** Piece and displacement under a place in the picture. */
  under(x, y) {
    if (!this.seen) return null;
    const aspect = this.canvas.clientWidth / this.canvas.clientHeight;
    const ray = this.camera.ray(x, y, aspect);
    const slack = (8 * Math.tan(FIELD_OF_VIEW / 2)) / this.canvas.clientHeight;
    const found = picked(this.pieces.filter((piece) => !piece.hidden), ray, slack);
    return found && { ...found, displacement: found.piece.displacement(found.vertex) / this.magnified };
  }
}
