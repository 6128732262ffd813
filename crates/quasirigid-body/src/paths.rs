//! Curved paths of mass elements: fields whose amplitudes follow the coordinates, with the derivatives of the amplitudes.
//! A body on curved paths is one of more coordinates on straight paths; a change in how fields follow is made here alone.
//! Equations (K12), docs/theory/12-structures.md; (I12), docs/theory/02-invariants.md.

use std::ops::Range;

use nalgebra::DMatrix;

use super::gimbal::{Gimbal, Rotated, Rows, cross_matrix};
use super::{Invariants, Pair};
use crate::math::scalar::Smooth;
use crate::math::sparse::SparseRows;

/// Curved paths, for the full equations: `r = H_j q_j + Ψ_e y_e(q)`. (K12), (I12)
///
/// Represented as a body of more coordinates on straight paths, the last of which follow the others.
#[derive(Clone, Debug, PartialEq)]
pub struct CurvedPaths {
    /// Invariants of the body on straight paths: coordinates of the body, then the fields `Ψ_e`.
    pub straight: Invariants,
    /// Laws by which the fields follow the coordinates, in the order of the fields.
    pub followers: Vec<Follower>,
}

/// Fields that follow some of the coordinates.
#[derive(Clone, Debug, PartialEq)]
pub enum Follower {
    /// `y_e = ½ qᵀΓ^e q`: paths of second order. (K12)
    Quadratic {
        /// Coordinates that the fields follow.
        coordinates: Range<usize>,
        /// `Γ^e` over those coordinates, symmetric, row by row.
        forms: Vec<Vec<f64>>,
    },
    /// `y_e = W^e : (R(q) − 1 − q_j [a_j])`: an appendage on a hinge, exact at any angles. (I12)
    Rotation {
        /// Axes of the hinge; their coordinates are contiguous.
        gimbal: Gimbal,
        /// `W^e`, a matrix for each field.
        duals: Vec<[[f64; 3]; 3]>,
    },
}

/// Amplitudes of all fields at a displacement, with their derivatives.
#[derive(Clone, Debug)]
pub(super) struct Amplitudes {
    /// `y_e`.
    pub y: Vec<f64>,
    /// `∂y_e/∂q_j`, a row for each field over all coordinates.
    pub slopes: DMatrix<f64>,
    /// Coordinates that each field follows, and `∂²y_e/∂q_j∂q_k` over them, row by row.
    pub curved: Vec<(Range<usize>, Vec<f64>)>,
}

impl Follower {
    /// Number of fields.
    #[must_use]
    pub fn fields(&self) -> usize {
        match self {
            Self::Quadratic { forms, .. } => forms.len(),
            Self::Rotation { duals, .. } => duals.len(),
        }
    }

    /// Coordinates that the fields follow.
    #[must_use]
    pub fn coordinates(&self) -> Range<usize> {
        match self {
            Self::Quadratic { coordinates, .. } => coordinates.clone(),
            Self::Rotation { gimbal, .. } => {
                let start = gimbal.axes.first().map_or(0, |(at, _)| *at);
                start..start + gimbal.axes.len()
            }
        }
    }

    /// Amplitudes of the fields at displacements of all coordinates, and their slopes over the coordinates that the fields follow.
    pub(super) fn amplitudes<T: Smooth>(&self, q: &[T]) -> Vec<(T, Vec<T>)> {
        match self {
            Self::Quadratic { coordinates, forms } => {
                let curving = &q[coordinates.clone()];
                let zero = T::from(0.0);
                let amplitude = |form: &Vec<f64>| {
                    let mut slopes = vec![zero; curving.len()];
                    for (row, q) in form.chunks_exact(curving.len().max(1)).zip(curving) {
                        let terms = slopes.iter_mut().zip(row);
                        terms.for_each(|(slope, form)| *slope = *slope + T::from(*form) * *q);
                    }
                    let twice = slopes.iter().zip(curving).fold(zero, |sum, (slope, q)| sum + *slope * *q);
                    (T::from(0.5) * twice, slopes)
                };
                forms.iter().map(amplitude).collect()
            }
            Self::Rotation { gimbal, duals } => {
                let Rotated { turn, first } = gimbal.rotated(q);
                let amplitude = |W: &Rows<f64>| {
                    let mut value = contracted(W, &turn) - T::from(W[0][0] + W[1][1] + W[2][2]);
                    let slope = |((at, axis), first): (&(usize, [f64; 3]), &Rows<T>)| {
                        let straight = T::from(contracted(W, &cross_matrix(*axis)));
                        value = value - q[*at] * straight;
                        contracted(W, first) - straight
                    };
                    let slopes: Vec<T> = gimbal.axes.iter().zip(&first).map(slope).collect();
                    (value, slopes)
                };
                duals.iter().map(amplitude).collect()
            }
        }
    }

    /// Second derivatives of the amplitudes over the coordinates that the fields follow, row by row.
    fn curved(&self, q: &[f64]) -> Vec<Vec<f64>> {
        match self {
            Self::Quadratic { forms, .. } => forms.clone(),
            Self::Rotation { gimbal, duals } => {
                let second = gimbal.curved(q);
                let field = |W: &Rows<f64>| second.iter().map(|rows| contracted(W, rows)).collect();
                duals.iter().map(field).collect()
            }
        }
    }

    /// Follower of renumbered coordinates; none if one of its coordinates is locked.
    fn locked(&self, kept: &Range<usize>) -> Option<Self> {
        let Range { start, end } = self.coordinates();
        if !(kept.start <= start && end <= kept.end) {
            return None;
        }
        Some(match self {
            Self::Quadratic { forms, .. } => {
                Self::Quadratic { coordinates: start - kept.start..end - kept.start, forms: forms.clone() }
            }
            Self::Rotation { gimbal, duals } => {
                let gimbal = gimbal.renumbered(&|j| Some(j - kept.start))?;
                Self::Rotation { gimbal, duals: duals.clone() }
            }
        })
    }
}

/// `W : M`.
fn contracted<T: Smooth>(W: &Rows<f64>, M: &Rows<T>) -> T {
    let entries = W.as_flattened().iter().zip(M.as_flattened());
    entries.fold(T::from(0.0), |sum, (W, M)| sum + T::from(*W) * *M)
}

impl CurvedPaths {
    /// Number of fields.
    #[must_use]
    pub fn fields(&self) -> usize {
        self.followers.iter().map(Follower::fields).sum()
    }

    /// Followers, each with its first field.
    pub(super) fn placed(&self) -> impl Iterator<Item = (usize, &Follower)> {
        self.followers.iter().scan(0, |next, follower| {
            let first = *next;
            *next += follower.fields();
            Some((first, follower))
        })
    }

    /// Amplitudes of the fields and their derivatives at displacements of all coordinates. (K12), (I12)
    pub(super) fn amplitudes(&self, q: &[f64]) -> Amplitudes {
        let curved = |follower: &Follower| {
            let size = follower.coordinates().len();
            let form = |e: usize| match follower {
                Follower::Quadratic { forms, .. } => forms[e].clone(),
                Follower::Rotation { .. } => vec![0.0; size * size],
            };
            (0..follower.fields()).map(|e| (follower.coordinates(), form(e))).collect::<Vec<_>>()
        };
        let mut at = Amplitudes {
            y: vec![0.0; self.fields()],
            slopes: DMatrix::zeros(self.fields(), q.len()),
            curved: self.followers.iter().flat_map(curved).collect(),
        };
        self.follow(q, &mut at);
        at
    }

    /// Sets the amplitudes of the fields and their derivatives at displacements of all coordinates. (K12), (I12)
    pub(super) fn follow(&self, q: &[f64], at: &mut Amplitudes) {
        for (first, follower) in self.placed() {
            let start = follower.coordinates().start;
            for (e, (value, slopes)) in follower.amplitudes(q).into_iter().enumerate() {
                at.y[first + e] = value;
                slopes.iter().enumerate().for_each(|(j, slope)| at.slopes[(first + e, start + j)] = *slope);
            }
            if matches!(follower, Follower::Rotation { .. }) {
                for (e, second) in follower.curved(q).into_iter().enumerate() {
                    at.curved[first + e].1 = second;
                }
            }
        }
    }

    /// Values of all coordinates of the body on straight paths at displacements `q`, and for each field the first coordinate that it follows
    /// and its slopes.
    pub(super) fn spread<T: Smooth>(&self, q: &[T]) -> (Vec<T>, Vec<(usize, Vec<T>)>) {
        let (mut z, mut slopes) = (q.to_vec(), Vec::new());
        for follower in &self.followers {
            for (value, slope) in follower.amplitudes(q) {
                z.push(value);
                slopes.push((follower.coordinates().start, slope));
            }
        }
        (z, slopes)
    }

    /// Paths in a body with these of `all` coordinates kept and the others locked; none if no curved path is left.
    pub(super) fn locked(&self, all: usize, kept: &Range<usize>) -> Option<Self> {
        let (mut places, mut followers): (Vec<usize>, Vec<Follower>) = (kept.clone().collect(), Vec::new());
        for (first, follower) in self.placed() {
            if let Some(locked) = follower.locked(kept) {
                places.extend((first..first + follower.fields()).map(|field| all + field));
                followers.push(locked);
            }
        }
        if followers.is_empty() {
            return None;
        }
        let place = |j: usize| places.iter().position(|place| *place == j);
        let Invariants { mass, J, S, h, J1, pairs } = &self.straight;
        let pairs: Vec<(usize, usize, Pair)> =
            pairs.iter().filter_map(|(j, k, pair)| Some((place(j)?, place(k)?, *pair))).collect();
        let straight = Invariants {
            mass: *mass,
            J: *J,
            S: places.iter().map(|j| S[*j]).collect(),
            h: places.iter().map(|j| h[*j]).collect(),
            J1: places.iter().map(|j| J1[*j]).collect(),
            pairs: SparseRows::sum(places.len(), pairs),
        };
        Some(Self { straight, followers })
    }
}
