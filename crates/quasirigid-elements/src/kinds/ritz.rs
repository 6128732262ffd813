//! Ritz method for a homogeneous solid: displacements that are polynomials of the place, from the moments of its volume.
//! The coordinates are responses to the loads of a rotation, in a space that is solved once with rigid motions fixed by springs.
//! Equations (G2), (G4), (G5), (G9) and (G10), docs/theory/11-materials.md.

use std::ops::AddAssign;

use nalgebra::{DMatrix, DVector, Matrix3, Matrix3xX, Vector3};

use crate::error::Problem;
use crate::kinds::compliance;
use crate::material::Material;
use crate::math::polynomial::monomial;
use crate::math::sparse::SparseRows;
use crate::math::sym3::Sym;
use crate::model::moment;
use crate::model::{Invariants, Pair, Rheology};
use crate::structure::Block;

/// A homogeneous elastic solid, for displacements that are polynomials of the place. (G9)
///
/// Places are from the centre of mass, `ξ` over a `scale` along each of the solid's own axes; displacements are in the file's frame.
pub(crate) struct Solid<'a> {
    pub material: &'a Material,
    /// Axes of the solid, as columns.
    pub axes: Matrix3<f64>,
    /// Lengths (m) of about half the solid along each of them.
    pub scale: [f64; 3],
    /// `∫ ξ^i η^k ζ^l dV` (m³).
    pub moment: &'a dyn Fn([usize; 3]) -> f64,
}

/// Responses of a solid to the loads of a rotation, as coordinates of their own: each is scaled to the rms displacement.
pub(crate) struct Ritz {
    pub invariants: Invariants,
    pub stiffness: Vec<Vec<f64>>,
    /// Largest relative growth of the compliance by the last two degrees of the polynomials.
    pub growth: f64,
    polynomials: Polynomials,
    /// Displacement of each coordinate: a row per axis, a column per polynomial.
    fields: Vec<Matrix3xX<f64>>,
    axes: Matrix3<f64>,
    scale: [f64; 3],
}

/// Scalar polynomials that are orthonormal in mass, by ascending degree.
struct Polynomials {
    /// Exponents of the monomials.
    monomials: Vec<[usize; 3]>,
    /// A row per polynomial.
    coefficients: DMatrix<f64>,
}

/// Powers of `C⁻¹A` on the static responses in the space: the response is then right to the same power of the square of the frequency.
const POWERS: usize = 2;
/// Share of its energy below which the rest of a displacement is linearly dependent on the others.
const DEPENDENT: f64 = 1e-10;

impl Solid<'_> {
    /// Responses among polynomials up to a degree. (G10)
    pub fn ritz(&self, degree: usize) -> Result<Ritz, Problem> {
        let polynomials = self.polynomials(degree)?;
        let position = self.position(&polynomials);
        let J: Sym = moment::inertia(&outer(&position, &position)).map(|entry| 0.5 * entry);
        let stiffness = self.stiffness(&polynomials);
        let held = held(&stiffness, &position);
        let factor = held.cholesky().ok_or(Problem::Unresolved { degree })?;
        let loads = loads(J, &position);
        let forward =
            factor.l_dirty().solve_lower_triangular(&loads).ok_or(Problem::Unresolved { degree })?;
        let mut answers = vec![factor.solve(&loads)];
        for _ in 0..POWERS {
            let next = factor.solve(answers.last().unwrap_or(&loads));
            answers.push(next);
        }
        let mass = self.material.density * (self.moment)([0; 3]);
        let vectors = independent(&answers, &stiffness, mass);
        let fields: Vec<Matrix3xX<f64>> = vectors.iter().map(field).collect();
        let energy = |a: &DVector<f64>| {
            let force = &stiffness * a;
            vectors.iter().map(|b| b.dot(&force)).collect()
        };
        Ok(Ritz {
            invariants: invariants(mass, J, &position, &fields),
            stiffness: vectors.iter().map(energy).collect(),
            growth: growth(&forward, degree),
            polynomials,
            fields,
            axes: self.axes,
            scale: self.scale,
        })
    }

    /// Products of Legendre polynomials, made orthonormal in mass.
    fn polynomials(&self, degree: usize) -> Result<Polynomials, Problem> {
        let monomials: Vec<[usize; 3]> = (0..=degree).flat_map(monomial::exponents).collect();
        let legendre = legendre(degree);
        let size = monomials.len();
        let mut products = DMatrix::zeros(size, size);
        for (row, [i, j, k]) in monomials.iter().enumerate() {
            for (a, x) in legendre[*i].iter().enumerate() {
                for (b, y) in legendre[*j].iter().enumerate() {
                    for (c, z) in legendre[*k].iter().enumerate() {
                        products[(row, monomial::place([a, b, c]))] += x * y * z;
                    }
                }
            }
        }
        let moment = |row: usize, column: usize| {
            let exponents = [0, 1, 2].map(|axis| monomials[row][axis] + monomials[column][axis]);
            self.material.density * (self.moment)(exponents)
        };
        let gram = DMatrix::from_fn(size, size, moment);
        let gram: DMatrix<f64> = &products * gram * products.transpose();
        let factor = gram.cholesky().ok_or(Problem::Unresolved { degree })?;
        let coefficients =
            factor.l_dirty().solve_lower_triangular(&products).ok_or(Problem::Unresolved { degree })?;
        Ok(Polynomials { monomials, coefficients })
    }

    /// The place as a field: `x_k = Σ P_ka φ_a`, of first degree.
    fn position(&self, polynomials: &Polynomials) -> Matrix3xX<f64> {
        let mut position = Matrix3xX::zeros(polynomials.monomials.len());
        // With four polynomials of degree one or less the place is a triangular system.
        let low = polynomials.coefficients.view((0, 0), (4, 4)).transpose().lu();
        for axis in 0..3 {
            let mut place = DVector::zeros(4);
            let exponents = [0, 1, 2].map(|i| usize::from(i == axis));
            place[monomial::place(exponents)] = self.scale[axis];
            if let Some(shares) = low.solve(&place) {
                (0..4).for_each(|a| position[(axis, a)] = shares[a]);
            }
        }
        self.axes * position
    }

    /// `C` over the displacements `φ_a e_i`, numbered `3a + i`. (G4)
    fn stiffness(&self, polynomials: &Polynomials) -> DMatrix<f64> {
        let (shear, lame) = (self.material.shear(), self.material.lame());
        let slopes = self.slopes(polynomials);
        let size = polynomials.monomials.len();
        let mut stiffness = DMatrix::zeros(3 * size, 3 * size);
        let products = |l: usize, m: usize| &slopes[l] * slopes[m].transpose() / self.material.density;
        let all = (0..3).map(|l| products(l, l)).fold(DMatrix::zeros(size, size), |sum, part| sum + part);
        for i in 0..3 {
            for j in 0..3 {
                let straight = products(i, j);
                for a in 0..size {
                    for b in 0..size {
                        let same = if i == j { all[(a, b)] } else { 0.0 };
                        // K^{ji}_{ab} = K^{ij}_{ba}
                        stiffness[(3 * a + i, 3 * b + j)] =
                            lame * straight[(a, b)] + shear * (same + straight[(b, a)]);
                    }
                }
            }
        }
        stiffness
    }

    /// Derivatives along each axis of the file's frame, as combinations of the polynomials.
    fn slopes(&self, polynomials: &Polynomials) -> [DMatrix<f64>; 3] {
        let factor = polynomials.coefficients.transpose().lu();
        let own = [0, 1, 2].map(|axis| {
            let derived = polynomials.derived(axis) / self.scale[axis];
            // derived = slope · coefficients
            factor.solve(&derived.transpose()).unwrap_or(derived).transpose()
        });
        [0, 1, 2].map(|axis| {
            let share = |own_axis: usize| self.axes[(axis, own_axis)] * &own[own_axis];
            share(0) + share(1) + share(2)
        })
    }
}

impl Polynomials {
    /// Coefficients of the derivatives along an axis.
    fn derived(&self, axis: usize) -> DMatrix<f64> {
        let size = self.monomials.len();
        let mut derived = DMatrix::zeros(size, size);
        for (column, exponents) in self.monomials.iter().enumerate() {
            let mut lower = *exponents;
            if let Some(power) = exponents[axis].checked_sub(1) {
                lower[axis] = power;
                let slope = exponents[axis] as f64 * self.coefficients.column(column);
                derived.column_mut(monomial::place(lower)).add_assign(&slope);
            }
        }
        derived
    }
}

impl Ritz {
    /// Stiffness as a block of coordinates numbered from zero.
    pub fn block(&self, name: &str, rheology: &Rheology) -> Block {
        Block {
            name: name.to_owned(),
            columns: (0..self.stiffness.len()).collect(),
            stiffness: self.stiffness.clone(),
            damping: Vec::new(),
            rheology: rheology.clone(),
        }
    }

    /// Displacement of a place (m from the centre of mass) per unit of each coordinate.
    pub fn shapes(&self, place: [f64; 3]) -> Vec<(usize, [f64; 3])> {
        let place = self.axes.tr_mul(&Vector3::from(place));
        let power = |exponents: &[usize; 3]| -> f64 {
            (0..3).map(|axis| (place[axis] / self.scale[axis]).powi(exponents[axis] as i32)).product()
        };
        let powers = DVector::from_iterator(
            self.polynomials.monomials.len(),
            self.polynomials.monomials.iter().map(power),
        );
        let values = &self.polynomials.coefficients * powers;
        let moved = |field: &Matrix3xX<f64>| -> [f64; 3] { (field * &values).into() };
        self.fields.iter().map(moved).enumerate().collect()
    }
}

/// Coefficients of the Legendre polynomials up to a degree, from the constant term.
fn legendre(degree: usize) -> Vec<Vec<f64>> {
    let mut all = vec![vec![1.0], vec![0.0, 1.0]];
    for n in 1..degree {
        let mut next = vec![0.0; n + 2];
        let weight = (n + 1) as f64;
        all[n].iter().enumerate().for_each(|(i, c)| next[i + 1] += (2 * n + 1) as f64 / weight * c);
        all[n - 1].iter().enumerate().for_each(|(i, c)| next[i] -= n as f64 / weight * c);
        all.push(next);
    }
    all
}

/// `∫ u vᵀ dm` of two fields.
fn outer(u: &Matrix3xX<f64>, v: &Matrix3xX<f64>) -> Matrix3<f64> {
    u * v.transpose()
}

/// Stiffness with springs on the six rigid motions, which a load in balance does not excite. (G2)
fn held(stiffness: &DMatrix<f64>, position: &Matrix3xX<f64>) -> DMatrix<f64> {
    let mut held = stiffness.clone();
    let firm = stiffness.trace() / stiffness.nrows() as f64;
    (0..3).for_each(|axis| held[(axis, axis)] += firm);
    for axis in 0..3 {
        let turn = vector(&(Vector3::ith(axis, 1.0).cross_matrix() * position));
        let unit = turn.normalize();
        held += firm * &unit * unit.transpose();
    }
    held
}

/// Loads by the products xx, yy, zz, yz, zx, xy of the spin, Euler's angular acceleration with them. (G5)
fn loads(J: Sym, position: &Matrix3xX<f64>) -> DMatrix<f64> {
    let inertia = Matrix3::from(crate::math::sym3::rows(J));
    let inverse = inertia.try_inverse().unwrap_or_else(Matrix3::zeros);
    let force = |omega: Vector3<f64>| {
        let rate = -inverse * omega.cross(&(inertia * omega));
        let turning = omega.cross_matrix();
        -(turning * turning + rate.cross_matrix())
    };
    let alone = [0, 1, 2].map(|axis| force(Vector3::ith(axis, 1.0)));
    let pair = |a: usize, b: usize| force(Vector3::ith(a, 1.0) + Vector3::ith(b, 1.0)) - alone[a] - alone[b];
    let all = [alone[0], alone[1], alone[2], pair(1, 2), pair(2, 0), pair(0, 1)];
    DMatrix::from_columns(&all.map(|matrix| vector(&(matrix * position))))
}

/// A field as a vector numbered `3a + i`.
fn vector(field: &Matrix3xX<f64>) -> DVector<f64> {
    DVector::from_column_slice(field.as_slice())
}

fn field(vector: &DVector<f64>) -> Matrix3xX<f64> {
    Matrix3xX::from_column_slice(vector.as_slice())
}

/// Growth of the compliance by the last two degrees: forward substitution uses leading blocks alone, so one factor gives all degrees.
fn growth(forward: &DMatrix<f64>, degree: usize) -> f64 {
    let lower = 3 * (0..degree.saturating_sub(1)).map(|d| (d + 1) * (d + 2) / 2).sum::<usize>();
    let form = |rows: usize| {
        let rows = forward.rows(0, rows);
        (rows.transpose() * rows).fixed_view::<6, 6>(0, 0).into_owned()
    };
    compliance::gap(&form(forward.nrows()), &form(lower))
}

/// Responses that are linearly independent, each scaled to an rms displacement of one.
fn independent(answers: &[DMatrix<f64>], stiffness: &DMatrix<f64>, mass: f64) -> Vec<DVector<f64>> {
    let mut kept: Vec<DVector<f64>> = Vec::new();
    for answer in answers {
        for column in answer.column_iter() {
            let mut x: DVector<f64> = column.into_owned();
            let whole = x.dot(&(stiffness * &x));
            for _ in 0..2 {
                let force = stiffness * &x;
                let parts: Vec<f64> = kept.iter().map(|y| y.dot(&force)).collect();
                kept.iter().zip(parts).for_each(|(y, part)| x -= y * part);
            }
            let rest = x.dot(&(stiffness * &x));
            if rest > DEPENDENT * whole {
                kept.push(x / rest.sqrt());
            }
        }
    }
    kept.into_iter().map(|x| &x * (mass.sqrt() / x.norm())).collect()
}

/// Inertia invariants in the Tisserand frame, which every field keeps. (G2)
fn invariants(mass: f64, J: Sym, position: &Matrix3xX<f64>, fields: &[Matrix3xX<f64>]) -> Invariants {
    let mut pairs: Vec<(usize, usize, Pair)> = Vec::new();
    for (j, a) in fields.iter().enumerate() {
        for (k, b) in fields.iter().enumerate() {
            pairs.push((j, k, moment::straight_pair(&outer(a, b))));
        }
    }
    Invariants {
        mass,
        J,
        S: vec![[0.0; 3]; fields.len()],
        h: vec![[0.0; 3]; fields.len()],
        J1: fields.iter().map(|field| moment::inertia(&outer(position, field))).collect(),
        pairs: SparseRows::sum(fields.len(), pairs),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::contribution::BuildOptions;
    use crate::element::Element;
    use crate::error::ElementKind;
    use crate::{Ellipsoid, PartReduction};

    const AXES: [f64; 3] = [1.7, 1.1, 0.8];

    fn rock() -> Material {
        Material { density: 2.5, young: 30.0, poisson: 0.3, rheology: Rheology::Elastic }
    }

    /// Volume integrals of an ellipsoid, in coordinates over lengths that are not its semi-axes.
    fn moment(scale: [f64; 3], exponents: [usize; 3]) -> f64 {
        if exponents.iter().any(|power| power % 2 == 1) {
            return 0.0;
        }
        let odd = |n: usize| (1..=n).step_by(2).map(|k| k as f64).product::<f64>();
        let powers: f64 = (0..3).map(|i| (AXES[i] / scale[i]).powi(exponents[i] as i32)).product();
        let all: f64 = exponents.iter().map(|power| odd(power.saturating_sub(1))).product();
        4.0 * std::f64::consts::PI * AXES.iter().product::<f64>() * powers * all
            / odd(exponents.iter().sum::<usize>() + 3)
    }

    /// `JᵀC⁻¹J` for the derivatives `J` of one entry of the inertia: as large as the compliance to that product.
    fn energy(J1: &[Sym], stiffness: &[Vec<f64>], product: usize) -> f64 {
        let size = J1.len();
        let matrix = DMatrix::from_fn(size, size, |i, j| stiffness[i][j]);
        let load = DVector::from_fn(size, |k, _| J1[k][product]);
        load.dot(&matrix.cholesky().unwrap().solve(&load))
    }

    #[test]
    fn an_ellipsoid_by_its_moments_is_the_ellipsoid() {
        let ellipsoid =
            Ellipsoid { name: "rock".into(), semi_axes: AXES, center: [0.0; 3], material: rock() };
        let (id, reduction) = (ElementKind::Ellipsoid.at(0), PartReduction::default());
        // not by an assembly, with which every kind of element would be compiled once more
        let body = ellipsoid.whole(id, reduction, BuildOptions::default()).unwrap().unwrap().body;
        let dense: Vec<Vec<f64>> = (0..36)
            .map(|i| {
                let mut row = vec![0.0; 36];
                body.stiffness().row(i).for_each(|(j, entry)| row[j] = *entry);
                row
            })
            .collect();
        for degree in [3, 4, 5, 7] {
            let scale = [1.5, 1.3, 0.9];
            let material = rock();
            let solid = Solid {
                material: &material,
                axes: Matrix3::identity(),
                scale,
                moment: &|exponents| moment(scale, exponents),
            };
            let ritz = solid.ritz(degree).unwrap();
            let close = |found: f64, expected: f64| {
                assert!((found / expected - 1.0).abs() < 1e-9, "{found} {expected}")
            };
            close(ritz.invariants.mass, body.invariants().mass);
            (0..3).for_each(|i| close(ritz.invariants.J[i], body.invariants().J[i]));
            for product in 0..6 {
                close(
                    energy(&ritz.invariants.J1, &ritz.stiffness, product),
                    energy(&body.invariants().J1, &dense, product),
                );
            }
            let nothing = degree < 5 || ritz.growth < 1e-12;
            assert!(nothing, "degrees above the third add nothing: {}", ritz.growth);
            assert!(ritz.invariants.J1.len() >= 12, "{}", ritz.invariants.J1.len());
        }
    }
}
