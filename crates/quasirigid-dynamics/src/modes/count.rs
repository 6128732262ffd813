//! Number of small motions slower than a rate, by the argument principle.
//! The determinant of the condensed matrix has the eigenvalues of the body as zeros and those of the blocks as poles; the blocks are small, so
//! that theirs are known.
//! Equation (M24), docs/theory/15-modes.md.

use std::f64::consts::{FRAC_PI_8, PI};

use nalgebra::{Complex, DMatrix};

use super::blocks::BlockPencil;
use crate::math::eigen::{Dense, eigenvalues};
use crate::math::watch;

type C = Complex<f64>;

/// Count of the motions of a body in the equations of motion.
pub(super) struct Count<'a> {
    pencil: &'a BlockPencil<'a>,
    /// Eigenvalues of the blocks.
    poles: Vec<C>,
}

/// Size of a block up to which its eigenvalues are found.
const MAX_BLOCK: usize = 48;
/// Change of the argument over a piece of the contour, and its difference between a piece and its halves, up to which it is followed.
const FOLLOWED: f64 = 0.7;
const AGREED: f64 = 1e-6;
/// Limits of the evaluations on a contour and of the halvings of a piece, and the least change of direction of a step.
const MAX_EVALUATIONS: usize = 3000;
const MAX_HALVINGS: usize = 48;
/// Distance of a count from a whole number from which it is none.
const UNCERTAIN: f64 = 0.1;

impl<'a> Count<'a> {
    /// Count by the blocks of a body; none where one is too large or has a coordinate without mass.
    pub fn new(pencil: &'a BlockPencil<'a>) -> Option<Self> {
        let lists = pencil.blocks().lists();
        if lists.iter().any(|list| list.len() > MAX_BLOCK) {
            return None;
        }
        let zero = |list: &Vec<usize>| [0, 1, 2].map(|_| DMatrix::<f64>::zeros(list.len(), list.len()));
        let mut parts: Vec<[DMatrix<f64>; 3]> = lists.iter().map(zero).collect();
        for (row, column, powers) in pencil.block_entries() {
            let ([block, i], [_, j]) = (pencil.blocks().place(row), pencil.blocks().place(column));
            (0..3).for_each(|power| parts[block][power][(i, j)] += powers[power]);
        }
        let mut poles = Vec::new();
        for [mass, rate, stiffness] in parts {
            poles.extend(of_block(&mass, &rate, &stiffness)?);
        }
        Some(Self { pencil, poles })
    }

    /// Sizes of the eigenvalues of the blocks (1/s).
    pub fn sizes(&self) -> impl Iterator<Item = f64> {
        self.poles.iter().map(|pole| pole.norm())
    }

    /// Number of eigenvalues `|λ|` below a rate (1/s), each of a pair by itself and with their multiplicity; none where the argument cannot be
    /// followed.
    pub fn below(&self, rate: f64) -> Option<usize> {
        let near: Vec<C> =
            self.poles.iter().copied().filter(|pole| (pole.norm() / rate).ln().abs() < 1.0).collect();
        let mut contour = Contour { count: self, rate, near, evaluations: 0 };
        let (from, to) = (contour.value(0.0)?, contour.value(PI)?);
        let turned = contour.followed((0.0, from), (PI, to), 0)?;
        let excess = turned / PI;
        if (excess - excess.round()).abs() > UNCERTAIN {
            return None;
        }
        let poles = self.poles.iter().filter(|pole| pole.norm() < rate).count();
        (poles as f64 + excess.round() >= 0.0).then(|| (poles as f64 + excess.round()) as usize)
    }
}

/// Upper half of the circle `|λ| = rate`.
struct Contour<'a> {
    count: &'a Count<'a>,
    rate: f64,
    /// Poles of a size like that of the rate.
    near: Vec<C>,
    evaluations: usize,
}

impl Contour<'_> {
    fn place(&self, angle: f64) -> C {
        C::from_polar(self.rate, angle)
    }

    /// Direction of the determinant.
    fn value(&mut self, angle: f64) -> Option<C> {
        watch::ask();
        self.evaluations += 1;
        let mut condensed = self.count.pencil.factor(self.place(angle))?.condensed;
        for mut row in condensed.row_iter_mut() {
            let largest = row.iter().fold(0.0_f64, |largest, entry| largest.max(entry.norm()));
            row /= C::from(largest);
        }
        let value = condensed.determinant();
        (value.is_finite() && value.norm() > 0.0).then(|| value / value.norm())
    }

    /// Change of the argument between two places; none where it cannot be followed. No pole is nearer to a piece than the piece is long.
    fn followed(&mut self, from: (f64, C), to: (f64, C), halvings: usize) -> Option<f64> {
        if halvings > MAX_HALVINGS || self.evaluations > MAX_EVALUATIONS {
            return None;
        }
        let angle = 0.5 * (from.0 + to.0);
        let middle = (angle, self.value(angle)?);
        let change = |a: C, b: C| (b * a.conj()).arg();
        let (first, second) = (change(from.1, middle.1), change(middle.1, to.1));
        let length = to.0 - from.0;
        let place = self.place(angle);
        let distance = self.near.iter().map(|pole| (pole - place).norm()).fold(f64::INFINITY, f64::min);
        let smooth = first.abs() < FOLLOWED && second.abs() < FOLLOWED;
        let agrees = (first + second - change(from.1, to.1)).abs() < AGREED;
        if smooth && agrees && length < FRAC_PI_8 && self.rate * length < distance {
            return Some(first + second);
        }
        let before = self.followed(from, middle, halvings + 1)?;
        Some(before + self.followed(middle, to, halvings + 1)?)
    }
}

/// Eigenvalues of `λ²A + λB + C` of a block; none where its mass matrix is singular.
fn of_block(mass: &DMatrix<f64>, rate: &DMatrix<f64>, stiffness: &DMatrix<f64>) -> Option<Vec<C>> {
    let size = mass.nrows();
    let factor = mass.clone().cholesky()?;
    let (rate, stiffness) = (factor.solve(rate), factor.solve(stiffness));
    let unit = units(&stiffness);
    let mut first_order = Dense::zero(2 * size);
    for row in 0..size {
        first_order.add(row, size + row, unit);
        for column in 0..size {
            first_order.add(size + row, column, -stiffness[(row, column)] / unit);
            first_order.add(size + row, size + column, -rate[(row, column)]);
        }
    }
    let values = eigenvalues(&first_order).ok()?;
    Some(values.iter().map(|[re, im]| C::new(*re, *im)).collect())
}

/// A rate of the size of those of a block (1/s), by which its displacements are measured.
fn units(stiffness: &DMatrix<f64>) -> f64 {
    let size = stiffness.diagonal().amax().sqrt();
    if size > 0.0 { size } else { 1.0 }
}
