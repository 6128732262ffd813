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

/** The reduced equations with stiffnesses times s and dampings times d. */
const scaledEquations = (equations, s = 1, d = 1) => {
  const of = (terms) => new Polynomial(terms ?? [], s, d);
  return {
    spin: of(equations.spin_of_momentum),
    power: of(equations.power),
    displacements: equations.displacements?.length ? of(equations.displacements) : null,
    limits: scaledLimits(equations.limits ?? [], s, d),
  };
};

/** Equations of the rigid body, for bodies whose own are not known. */
const rigidEquations = ({ moments, axes }) => {
  const row = (r) => [0, 1, 2].map((c) => axes.reduce((sum, axis, i) => sum + (axis[r] * axis[c]) / moments[i], 0));
  return scaledEquations({
    spin_of_momentum: [{ degree: 1, stiffness: 0, damping: 0, values: [row(0), row(1), row(2)] }],
    power: [{ degree: 0, stiffness: 0, damping: 0, values: [[0]] }],
  });
};
