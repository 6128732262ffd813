// Sums of homogeneous polynomials in three variables, from the terms of the scene.
// The monomials of degree n + 1 are x times all of degree n, y times those without x, z times the last.
class Polynomial {
  /** Terms scaled for stiffnesses times s and dampings times d; equal degrees are added. */
  constructor(terms, s = 1, d = 1) {
    const byDegree = new Map();
    for (const { degree, stiffness, damping, values } of terms) {
      const factor = s ** stiffness * d ** damping;
      const sum = byDegree.get(degree) ?? values.map((row) => new Float64Array(row.length));
      values.forEach((row, r) => row.forEach((value, i) => (sum[r][i] += factor * value)));
      byDegree.set(degree, sum);
    }
    this.rows = terms.length ? terms[0].values.length : 0;
    this.highest = Math.max(0, ...byDegree.keys());
    this.byDegree = Array.from({ length: this.highest + 1 }, (_, degree) => byDegree.get(degree) ?? null);
    this.monomials = new Float64Array(((this.highest + 1) * (this.highest + 2)) / 2);
  }

  /** Writes the values at (x, y, z). */
  at(x, y, z, out) {
    const { monomials, byDegree, rows } = this;
    out.fill(0, 0, rows);
    monomials[0] = 1;
    for (let degree = 0; ; degree++) {
      const term = byDegree[degree];
      if (term) {
        for (let r = 0; r < rows; r++) {
          const row = term[r];
          let sum = 0;
          for (let i = 0; i < row.length; i++) sum += row[i] * monomials[i];
          out[r] += sum;
        }
      }
      if (degree === this.highest) return;
      const count = ((degree + 1) * (degree + 2)) / 2;
      const last = monomials[count - 1];
      for (let i = 0; i <= degree; i++) monomials[count + i] = y * monomials[count - degree - 1 + i];
      monomials[count + degree + 1] = z * last;
      for (let i = 0; i < count; i++) monomials[i] *= x;
    }
  }
}

/** Spins up to which the equations hold, and from which they fail; null where there is no limit. */
const scaledLimits = (limits, s, d) => {
  const least = (name) => Math.min(...limits.map((limit) => (limit[name] ?? Infinity) * s ** limit.stiffness * d ** limit.damping));
  return limits.length ? [least("holds"), least("fails")] : null;
};

/** Energy form of the reduced equations: from the gradient of the energy, the vector c and the tensor T over the angular momentum. */
class EnergyForm {
  constructor(gradient, c, T) {
    Object.assign(this, { gradient, c, T });
    [this.g, this.v, this.t] = [new Float64Array(3), new Float64Array(3), new Float64Array(6)];
  }

  /** Writes angular velocity, rate of the angular momentum and power: K' = (a v + K x T v)/(a^2 + K.adj(T)K) with v = K x g, a = 1 + K.c. */
  at(K1, K2, K3, out) {
    const { g, v, t } = this;
    this.gradient.at(K1, K2, K3, g);
    this.c.at(K1, K2, K3, v);
    this.T.at(K1, K2, K3, t);
    const [c1, c2, c3] = v;
    const [xx, yy, zz, yz, zx, xy] = t;
    const [v1, v2, v3] = [K2 * g[2] - K3 * g[1], K3 * g[0] - K1 * g[2], K1 * g[1] - K2 * g[0]];
    const [b1, b2, b3] = [xx * v1 + xy * v2 + zx * v3, xy * v1 + yy * v2 + yz * v3, zx * v1 + yz * v2 + zz * v3];
    const a = 1 + K1 * c1 + K2 * c2 + K3 * c3;
    const adjugate =
      K1 * K1 * (yy * zz - yz * yz) + K2 * K2 * (zz * xx - zx * zx) + K3 * K3 * (xx * yy - xy * xy)
      + 2 * (K2 * K3 * (zx * xy - yz * xx) + K3 * K1 * (xy * yz - zx * yy) + K1 * K2 * (yz * zx - xy * zz));
    const d = 1 / (a * a + adjugate);
    const r1 = d * (a * v1 + K2 * b3 - K3 * b2);
    const r2 = d * (a * v2 + K3 * b1 - K1 * b3);
    const r3 = d * (a * v3 + K1 * b2 - K2 * b1);
    const [p1, p2, p3] = [xx * r1 + xy * r2 + zx * r3, xy * r1 + yy * r2 + yz * r3, zx * r1 + yz * r2 + zz * r3];
    out[0] = g[0] + c2 * r3 - c3 * r2 + p1;
    out[1] = g[1] + c3 * r1 - c1 * r3 + p2;
    out[2] = g[2] + c1 * r2 - c2 * r1 + p3;
    [out[3], out[4], out[5]] = [r1, r2, r3];
    out[6] = r1 * p1 + r2 * p2 + r3 * p3;
  }
}

/** The reduced equations with stiffnesses times s and dampings times d. */
const scaledEquations = (equations, s = 1, d = 1) => {
  const of = (terms) => new Polynomial(terms ?? [], s, d);
  return {
    form: new EnergyForm(of(equations.energy_gradient), of(equations.c), of(equations.T)),
    displacements: equations.displacements?.length ? of(equations.displacements) : null,
    limits: scaledLimits(equations.limits ?? [], s, d),
  };
};

/** Equations of the rigid body, for bodies whose own are not known. */
const rigidEquations = ({ moments, axes }) => {
  const row = (r) => [0, 1, 2].map((c) => axes.reduce((sum, axis, i) => sum + (axis[r] * axis[c]) / moments[i], 0));
  return scaledEquations({ energy_gradient: [{ degree: 1, stiffness: 0, damping: 0, values: [row(0), row(1), row(2)] }] });
};
