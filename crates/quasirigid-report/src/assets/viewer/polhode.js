// Two small pictures of the rotation: K on its sphere in body axes, and the tip of omega on the invariable plane.
const SHADES = ["--t0", "--t1", "--t2", "--t3", "--t4", "--t5"];
const POLHODES = 48;
const VIEWPOINT = [0.62, 0.6, 0.5];

/** The polhode of a rigid body through a direction k, in principal components; an intersection of sphere and ellipsoid. */
const rigidPolhode = (moments, k, points = 90) => {
  const inverses = moments.map((moment) => 1 / moment);
  const twice = k.reduce((sum, x, i) => sum + x * x * inverses[i], 0);
  const circled = twice < inverses[1] ? 2 : 0;
  const [a, b] = [1, circled === 2 ? 0 : 2];
  const gap = (i) => Math.sqrt(Math.max(0, (twice - inverses[circled]) / (inverses[i] - inverses[circled] || 1)));
  return Array.from({ length: points + 1 }, (_, i) => {
    const angle = (2 * Math.PI * i) / points;
    const point = [0, 0, 0];
    point[a] = Math.min(1, gap(a)) * Math.cos(angle);
    point[b] = Math.min(1, gap(b)) * Math.sin(angle);
    point[circled] = Math.sign(k[circled] || 1) * Math.sqrt(Math.max(0, 1 - point[a] ** 2 - point[b] ** 2));
    return unit(point);
  });
};

class SmallCanvas {
  constructor(canvas) {
    this.canvas = canvas;
    this.context = canvas.getContext("2d");
  }

  /** Fits the pixels to the place; the drawing is in units of half the smaller side, y upwards. */
  clear() {
    const { canvas, context } = this;
    const scale = Math.min(window.devicePixelRatio || 1, 2);
    const [width, height] = [canvas.clientWidth * scale, canvas.clientHeight * scale].map(Math.round);
    if (canvas.width !== width || canvas.height !== height) Object.assign(canvas, { width, height });
    context.setTransform(1, 0, 0, 1, 0, 0);
    context.clearRect(0, 0, width, height);
    const half = Math.min(width, height) / 2;
    context.setTransform(half, 0, 0, -half, width / 2, height / 2);
    this.dot = scale / half;
  }

  stroke(points, color, width, opacity = 1) {
    if (points.length < 2) return;
    const { context } = this;
    context.globalAlpha = opacity;
    context.strokeStyle = color;
    context.lineWidth = width * this.dot;
    context.lineJoin = context.lineCap = "round";
    context.beginPath();
    points.forEach(([x, y], i) => (i ? context.lineTo(x, y) : context.moveTo(x, y)));
    context.stroke();
    context.globalAlpha = 1;
  }

  disc([x, y], radius, color, opacity = 1) {
    const { context } = this;
    context.globalAlpha = opacity;
    context.fillStyle = color;
    context.beginPath();
    context.arc(x, y, radius * this.dot, 0, 7);
    context.fill();
    context.globalAlpha = 1;
  }

  text(words, [x, y], color, align = "center") {
    const { context } = this;
    context.save();
    context.translate(x, y);
    context.scale(this.dot, -this.dot);
    context.font = "12px system-ui, sans-serif";
    context.textAlign = align;
    context.textBaseline = "middle";
    context.fillStyle = color;
    context.fillText(words, 0, 0);
    context.restore();
  }
}

class PolhodeView extends SmallCanvas {
  constructor(canvas, principal) {
    super(canvas);
    this.moments = principal.moments;
    this.axes = principal.axes;
  }

  /** Takes the path of a list of frames, coloured by the share of the energy that has been dissipated. */
  follow(frames) {
    const mean = [0, 0, 0];
    const step = Math.max(1, Math.floor(frames.count / 400));
    for (let i = 0; i < frames.count; i += step) {
      const k = unit(vectorAt(frames.momentum, i));
      this.axes.forEach((axis, a) => (mean[a] += dot(axis, k)));
    }
    this.signs = mean.map((x) => (x < 0 ? -1 : 1));
    const towards = unit(VIEWPOINT.map((x, i) => x * this.signs[i]));
    const right = unit(cross([0, 0, this.signs[2]], towards));
    this.basis = [right, cross(towards, right), towards];
    this.paths = this.coloured(frames);
  }

  coloured(frames) {
    const whole = frames.dissipated[frames.count - 1] - frames.dissipated[0];
    const shade = (i) => (whole > 0 ? clamp(Math.floor((6 * (frames.dissipated[i] - frames.dissipated[0])) / whole), 0, 5) : 0);
    const direction = (i) => this.principal(unit(vectorAt(frames.momentum, i)));
    const turn = Array.from({ length: frames.count - 1 }, (_, i) => size(frames.spinAt(i)) * (frames.t[i + 1] - frames.t[i])).sort((x, y) => x - y);
    const joined = turn[Math.floor(0.9 * turn.length)] < SMOOTH;
    if (joined) {
      const paths = [];
      for (let i = 0; i < frames.count; i++) {
        const last = paths[paths.length - 1];
        last?.points.push(direction(i));
        if (last?.shade !== shade(i)) paths.push({ points: [direction(i)], shade: shade(i) });
      }
      return paths;
    }
    const level = (part) => (whole > 0 ? lastNotAbove(frames.dissipated, frames.dissipated[0] + part * whole) : Math.round(part * (frames.count - 1)));
    const chosen = Array.from({ length: POLHODES }, (_, j) => level(j / (POLHODES - 1)));
    return chosen.map((i) => ({ points: rigidPolhode(this.moments, direction(i)), shade: shade(i) }));
  }

  principal(k) {
    return this.axes.map((axis) => dot(axis, k));
  }

  spot(k) {
    const [x, y, depth] = this.basis.map((axis) => 0.78 * dot(axis, k));
    return [x, y, depth];
  }

  /** Strokes the near or the far part of a curve. */
  part(points, far, color, width, opacity) {
    let run = [];
    for (const spot of points.map((k) => this.spot(k))) {
      if (spot[2] < 0 === far) run.push(spot);
      else {
        if (run.length) this.stroke([...run, spot], color, width, opacity);
        run = [];
      }
    }
    this.stroke(run, color, width, opacity);
  }

  draw(theme, state, recent) {
    this.clear();
    this.background(theme);
    const ink = theme.text("--ink");
    const points = (recent ?? []).map(({ momentum }) => this.principal(unit(momentum)));
    for (const far of [true, false]) this.part(points, far, ink, 1.6, far ? 0.3 : 0.9);
    const spot = this.spot(this.principal(unit(state.momentum)));
    this.disc(spot, 5.5, theme.text("--paper"), spot[2] < 0 ? 0.4 : 1);
    this.disc(spot, 4, theme.text("--s2"), spot[2] < 0 ? 0.45 : 1);
  }

  /** What does not change from picture to picture is drawn once. */
  background(theme) {
    const { canvas, context } = this;
    const { width, height } = canvas;
    const key = [theme, this.paths, width, height];
    if (!this.key || key.some((part, i) => part !== this.key[i])) {
      this.key = key;
      this.still = document.createElement("canvas");
      Object.assign(this.still, { width, height });
      this.context = this.still.getContext("2d");
      this.context.setTransform(context.getTransform());
      this.scene(theme);
      this.context = context;
    }
    context.save();
    context.setTransform(1, 0, 0, 1, 0, 0);
    context.drawImage(this.still, 0, 0);
    context.restore();
  }

  scene(theme) {
    const [muted, rule] = ["--muted", "--rule"].map(theme.text);
    const shades = SHADES.map(theme.text);
    const faint = [0.2, 0.4, 0.6, 0.8].flatMap((part) => this.scaffold(part));
    this.disc([0, 0], 0.78 / this.dot, theme.text("--paper"));
    for (const far of [true, false]) {
      for (const curve of faint) this.part(curve, far, muted, 0.8, far ? 0.15 : 0.4);
      for (const { points, shade } of this.paths) this.part(points, far, shades[shade], 1.3, far ? 0.2 : 0.8);
    }
    const rim = Array.from({ length: 73 }, (_, i) => [0.78 * Math.cos((i * Math.PI) / 36), 0.78 * Math.sin((i * Math.PI) / 36)]);
    this.stroke(rim, rule, 1.2);
    this.signs.forEach((sign, i) => {
      const axis = [0, 0, 0];
      axis[i] = sign;
      const [x, y] = this.spot(axis);
      this.stroke([[x, y], [1.12 * x, 1.12 * y]], muted, 1.4);
      this.text(`${sign < 0 ? "−" : ""}${i + 1}`, [1.2 * x, 1.2 * y], muted);
    });
  }

  /** Polhodes of the rigid body on either side of the middle axis. */
  scaffold(part) {
    const angle = (part * Math.PI) / 2;
    const [least, middle, greatest] = this.moments;
    if (greatest - least < 1e-9 * greatest) return [];
    const twice = (axis) => (1 / axis) * Math.cos(angle) ** 2 + (1 / middle) * Math.sin(angle) ** 2;
    const through = (axis, moment) => {
      const share = (twice(moment) - 1 / middle) / (1 / moment - 1 / middle || 1);
      const k = [0, Math.sqrt(Math.max(0, 1 - share)), 0];
      k[axis] = Math.sqrt(Math.max(0, share));
      return [k, times(-1, k)].map((point) => rigidPolhode(this.moments, point));
    };
    return [...(greatest > middle ? through(2, greatest) : []), ...(middle > least ? through(0, least) : [])];
  }
}

class HerpolhodeView extends SmallCanvas {
  /** Takes the size of the picture from the whole run. */
  follow(frames) {
    this.reach = 0;
    for (let i = 0; i < frames.count; i++) {
      const k = unit(vectorAt(frames.momentum, i));
      this.reach = Math.max(this.reach, size(cross(k, frames.spinAt(i))));
    }
    const K = turned(quaternionAt(frames.attitude, 0), unit(vectorAt(frames.momentum, 0)));
    this.basis = [across(K), cross(K, across(K))];
  }

  spot({ omega, attitude }) {
    const inertial = turned(attitude, omega);
    return this.basis.map((axis) => (0.82 * dot(axis, inertial)) / (this.reach || 1));
  }

  draw(theme, state, recent) {
    this.clear();
    const [muted, rule] = ["--muted", "--rule"].map(theme.text);
    for (const part of [0.5, 1]) {
      const radius = 0.82 * part;
      this.stroke(Array.from({ length: 73 }, (_, i) => [radius * Math.cos((i * Math.PI) / 36), radius * Math.sin((i * Math.PI) / 36)]), rule, 1);
    }
    this.text(`${numeral(this.reach, 2)} rad/s`, [0, -0.92], muted);
    this.disc([0, 0], 2, muted);
    const points = (recent ?? []).map((past) => this.spot(past));
    const pieces = 6;
    for (let p = pieces - 1; p >= 0; p--) {
      const [from, to] = [p, p + 1].map((i) => Math.floor((i * points.length) / pieces));
      this.stroke(points.slice(from, to + 1), theme.text("--s1"), 1.4, 0.95 - 0.13 * p);
    }
    const now = this.spot(state);
    this.disc(now, 5.5, theme.text("--paper"));
    this.disc(now, 4, theme.text("--s1"));
  }
}
