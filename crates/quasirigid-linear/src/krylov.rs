//! The few largest eigenvalues of `M x = θ C x` for matrices too large for a dense solver.

use super::eigen::{Dense, NoConvergence, modes, squares};
use super::watch;

/// A pencil `M x = θ C x`, `C` symmetric positive definite, `M` symmetric positive semi-definite.
pub struct Pencil<'a> {
    /// Number of rows.
    pub size: usize,
    /// `C x`.
    pub stiffness: &'a dyn Fn(&[f64]) -> Vec<f64>,
    /// `C⁻¹ x`, in place.
    pub solve: &'a dyn Fn(&mut [f64]),
    /// `M x`.
    pub mass: &'a dyn Fn(&[f64]) -> Vec<f64>,
}

/// Vectors beyond those asked for, so that the last one converges as fast as the first.
const SPARE: usize = 4;
/// Powers of `C⁻¹M` in one Krylov space.
const DEPTH: usize = 4;
/// Restarts after which the spaces are made twice as deep.
const PATIENCE: usize = 8;
/// Most vectors of a space deeper than that, and entries in them.
const MAX_VECTORS: usize = 600;
const MAX_ENTRIES: usize = 100_000_000;
/// Krylov spaces tried.
const RESTARTS: usize = 60;
/// Residual relative to the largest eigenvalue: the error of an isolated eigenvalue is then its square, that of one in a cluster
/// the residual itself.
const CONVERGED: f64 = 1e-4;
/// Eigenvalue relative to the largest one up to which it is rounding, of a motion without mass or one that the inverse leaves out.
const NULL: f64 = 1e-13;
/// A vector that keeps less than this share of its length was in the span of the others.
const DEPENDENT: f64 = 1e-10;

/// Vectors that are orthonormal in the inner product of `C`, with their products.
#[derive(Default)]
struct Basis {
    vectors: Vec<Vec<f64>>,
    /// `C v`.
    forces: Vec<Vec<f64>>,
    /// `C⁻¹ M v`.
    images: Vec<Vec<f64>>,
}

impl Pencil<'_> {
    /// Vectors of the `count` largest eigenvalues, largest first, each with `xᵀ C x = 1`.
    ///
    /// A block Krylov method with Rayleigh–Ritz restarts: blocks find repeated eigenvalues, which bodies of regular
    /// shape have. The start is fixed, so the same pencil gives the same bits. A pencil that one Krylov space would fill is solved whole:
    /// the last vectors of such a space are rounding.
    ///
    /// # Errors
    /// [`NoConvergence`] if the residuals do not fall.
    pub fn largest(&self, count: usize) -> Result<Vec<Vec<f64>>, NoConvergence> {
        let width = (count + SPARE).min(self.size);
        if width * DEPTH >= self.size {
            return self.whole(count);
        }
        let mut basis = Basis::default();
        let mut block: Vec<Vec<f64>> = (0..width).map(|column| scattered(self.size, column)).collect();
        for restart in 0..RESTARTS {
            watch::ask();
            self.extend(&mut basis, block, self.depth(restart, width));
            let (values, ritz) = self.ritz(&basis, width)?;
            let wanted = count.min(values.len());
            let worst = (0..wanted).map(|i| self.residual(&ritz, i, values[i])).fold(0.0, f64::max);
            if worst <= CONVERGED * values.first().copied().unwrap_or(0.0) {
                return Ok(ritz.vectors.into_iter().take(wanted).collect());
            }
            block = ritz.images.clone();
            basis = ritz;
        }
        Err(NoConvergence { size: self.size })
    }

    /// The same by dense matrices: with `M = W Wᵀ` and `Wᵀ C⁻¹ W y = θ y`, `x = C⁻¹ W y / √θ` where `θ > 0`.
    fn whole(&self, count: usize) -> Result<Vec<Vec<f64>>, NoConvergence> {
        let mut mass = Dense::zero(self.size);
        for column in 0..self.size {
            let mut unit = vec![0.0; self.size];
            unit[column] = 1.0;
            (self.mass)(&unit).iter().enumerate().for_each(|(row, entry)| mass.add(row, column, *entry));
        }
        let squares = squares(&mass)?;
        let row = |form: usize| (0..self.size).map(|column| squares.at(form, column)).collect::<Vec<f64>>();
        let forms: Vec<Vec<f64>> =
            (0..self.size).map(row).filter(|form| form.iter().any(|entry| *entry != 0.0)).collect();
        let answer = |form: &Vec<f64>| {
            let mut answer = form.clone();
            (self.solve)(&mut answer);
            answer
        };
        let answers: Vec<Vec<f64>> = forms.iter().map(answer).collect();
        let (mut inner, mut unit) = (Dense::zero(forms.len()), Dense::zero(forms.len()));
        for i in 0..forms.len() {
            unit.add(i, i, 1.0);
            for j in 0..forms.len() {
                inner.add(i, j, 0.5 * (dot(&forms[i], &answers[j]) + dot(&forms[j], &answers[i])));
            }
        }
        let found = modes(&inner, &unit)?;
        let least = found.frequencies.first().map_or(0.0, |lowest| NULL * lowest.powi(-2));
        let vector = |column: usize| {
            let mut x = vec![0.0; self.size];
            for (row, answer) in answers.iter().enumerate() {
                let share = found.shapes.at(row, column);
                x.iter_mut().zip(answer).for_each(|(x, entry)| *x += share * entry);
            }
            x
        };
        let held = found.frequencies.iter().take_while(|frequency| frequency.powi(-2) > least).count();
        Ok((0..count.min(held)).map(vector).collect())
    }

    /// Powers in the space of a restart: more of them where a crowd of eigenvalues keeps the residuals from falling.
    fn depth(&self, restart: usize, width: usize) -> usize {
        let most = (MAX_ENTRIES / self.size.max(1)).min(MAX_VECTORS) / width.max(1);
        (DEPTH << (restart / PATIENCE).min(usize::BITS as usize / 4)).min(most).max(DEPTH)
    }

    /// Adds a block and its images under powers of `C⁻¹M`; a basis of Ritz vectors counts as the first power.
    fn extend(&self, basis: &mut Basis, mut block: Vec<Vec<f64>>, depth: usize) {
        let powers = if basis.vectors.is_empty() { depth } else { depth - 1 };
        for _ in 0..powers {
            let first = basis.vectors.len();
            for vector in block {
                self.append(basis, vector);
            }
            block = basis.images[first..].to_vec();
        }
    }

    /// Adds the component of a vector across the span.
    fn append(&self, basis: &mut Basis, mut x: Vec<f64>) {
        let mut force = (self.stiffness)(&x);
        let length = dot(&x, &force).max(0.0).sqrt();
        for _ in 0..2 {
            for (v, f) in basis.vectors.iter().zip(&basis.forces) {
                let share = dot(f, &x);
                x.iter_mut().zip(v).for_each(|(x, v)| *x -= share * v);
            }
        }
        force = (self.stiffness)(&x);
        let left = dot(&x, &force).max(0.0).sqrt();
        if !(left > DEPENDENT * length) {
            return;
        }
        x.iter_mut().chain(&mut force).for_each(|entry| *entry /= left);
        watch::ask();
        basis.images.push(self.image(&x));
        basis.vectors.push(x);
        basis.forces.push(force);
    }

    fn image(&self, x: &[f64]) -> Vec<f64> {
        let mut image = (self.mass)(x);
        (self.solve)(&mut image);
        image
    }

    /// The largest Ritz values of a basis, and their vectors, whose products are combined from those of the basis.
    fn ritz(&self, basis: &Basis, count: usize) -> Result<(Vec<f64>, Basis), NoConvergence> {
        let rank = basis.vectors.len();
        let (mut mass, mut unit) = (Dense::zero(rank), Dense::zero(rank));
        for i in 0..rank {
            unit.add(i, i, 1.0);
            for j in 0..rank {
                let entry =
                    0.5 * (dot(&basis.forces[i], &basis.images[j]) + dot(&basis.forces[j], &basis.images[i]));
                mass.add(i, j, entry);
            }
        }
        let small = modes(&mass, &unit)?;
        let finite = small.frequencies.iter().filter(|frequency| frequency.is_finite()).count();
        let columns = 0..count.min(finite);
        let values = columns.clone().map(|column| small.frequencies[column].powi(-2)).collect();
        let combined = |vectors: &[Vec<f64>]| {
            let combination = |column: usize| {
                let mut x = vec![0.0; self.size];
                for (row, vector) in vectors.iter().enumerate() {
                    let share = small.shapes.at(row, column) / small.frequencies[column];
                    x.iter_mut().zip(vector).for_each(|(x, v)| *x += share * v);
                }
                x
            };
            columns.clone().map(combination).collect()
        };
        let [vectors, forces, images] =
            [&basis.vectors, &basis.forces, &basis.images].map(|part| combined(part));
        Ok((values, Basis { vectors, forces, images }))
    }

    /// `|C⁻¹M x − θ x|` of a Ritz vector in the norm of `C`.
    fn residual(&self, ritz: &Basis, index: usize, theta: f64) -> f64 {
        let (x, image) = (&ritz.vectors[index], &ritz.images[index]);
        let gap: Vec<f64> = image.iter().zip(x).map(|(image, x)| image - theta * x).collect();
        dot(&gap, &(self.stiffness)(&gap)).max(0.0).sqrt()
    }
}

/// Scalar product.
#[must_use]
pub fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

/// Entries that look random and are always the same.
fn scattered(size: usize, column: usize) -> Vec<f64> {
    let mut state = 0x9e37_79b9_7f4a_7c15_u64.wrapping_mul(column as u64 + 1);
    let mut next = || {
        state ^= state << 13;
        state ^= state >> 7;
        state ^= state << 17;
        (state >> 11) as f64 / 2f64.powi(52) - 1.0
    };
    (0..size).map(|_| next()).collect()
}
