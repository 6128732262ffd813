// Vectors, unit quaternions (w, x, y, z) and column-major 4 x 4 matrices.
// The attitude Q turns body components into inertial ones: v_I = Q v_B Q*.
const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
const plus = (a, b, factor = 1) => [a[0] + factor * b[0], a[1] + factor * b[1], a[2] + factor * b[2]];
const times = (factor, a) => [factor * a[0], factor * a[1], factor * a[2]];
const size = (a) => Math.hypot(a[0], a[1], a[2]);
const unit = (a) => times(1 / (size(a) || 1), a);
const angleBetween = (a, b) => Math.atan2(size(cross(a, b)), dot(a, b));
const vectorAt = (list, i) => [list[3 * i], list[3 * i + 1], list[3 * i + 2]];

/** A unit vector across a given one. */
const across = (a) => unit(cross(a, Math.abs(a[0]) < 0.6 * size(a) ? [1, 0, 0] : [0, 1, 0]));

const product = (p, q) => [
  p[0] * q[0] - p[1] * q[1] - p[2] * q[2] - p[3] * q[3],
  p[0] * q[1] + p[1] * q[0] + p[2] * q[3] - p[3] * q[2],
  p[0] * q[2] - p[1] * q[3] + p[2] * q[0] + p[3] * q[1],
  p[0] * q[3] + p[1] * q[2] - p[2] * q[1] + p[3] * q[0],
];
const inverse = (q) => [q[0], -q[1], -q[2], -q[3]];
const normalized = (q) => {
  const factor = 1 / Math.hypot(...q);
  return q.map((x) => factor * x);
};
const quaternionAt = (list, i) => normalized([list[4 * i], list[4 * i + 1], list[4 * i + 2], list[4 * i + 3]]);
const turned = (q, v) => {
  const u = [q[1], q[2], q[3]];
  const twice = times(2, cross(u, v));
  return plus(plus(v, twice, q[0]), cross(u, twice));
};
/** Rotation about a unit axis. */
const rotation = (axis, angle) => [Math.cos(angle / 2), ...times(Math.sin(angle / 2), axis)];
const exponential = (v) => rotation(unit(v), size(v));
/** Rotation vector of a quaternion, of at most half a turn. */
const logarithm = (q) => {
  const [w, ...u] = q[0] < 0 ? q.map((x) => -x) : q;
  const s = size(u);
  return s < 1e-300 ? [0, 0, 0] : times((2 * Math.atan2(s, w)) / s, u);
};
/** Smallest rotation that turns one unit vector into another, which must not be opposite. */
const shortest = (from, to) => normalized([1 + dot(from, to), ...cross(from, to)]);
const slerp = (p, q, part) => product(p, exponential(times(part, logarithm(product(inverse(p), q)))));

const matrixOf = (q, origin = [0, 0, 0]) => {
  const [x, y, z] = [[1, 0, 0], [0, 1, 0], [0, 0, 1]].map((axis) => turned(q, axis));
  return new Float32Array([...x, 0, ...y, 0, ...z, 0, ...origin, 1]);
};
const matrixProduct = (a, b) => {
  const c = new Float32Array(16);
  for (let column = 0; column < 4; column++) {
    for (let row = 0; row < 4; row++) {
      let sum = 0;
      for (let k = 0; k < 4; k++) sum += a[4 * k + row] * b[4 * column + k];
      c[4 * column + row] = sum;
    }
  }
  return c;
};
const perspective = (fieldOfView, aspect, near, far) => {
  const f = 1 / Math.tan(fieldOfView / 2);
  const depth = 1 / (near - far);
  return new Float32Array([f / aspect, 0, 0, 0, 0, f, 0, 0, 0, 0, (far + near) * depth, -1, 0, 0, 2 * far * near * depth, 0]);
};
