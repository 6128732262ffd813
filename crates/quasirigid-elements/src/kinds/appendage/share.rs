//! Share of an appendage's mass and inertia that its modes carry: the rest moves with the interface, and no energy of it may be negative.
//! Equation (K18), docs/theory/12-structures.md.

use nalgebra::{DMatrix, Matrix6, Vector3, Vector6};

use crate::contribution::Piece;
use crate::error::Problem;

/// Share above one that is rounding of the participation factors: what a sheet with ten digits leaves.
const ROUNDING: f64 = 1e-9;
/// Eigenvalue of the mass matrix, as a share of the largest, below which no mass moves: an appendage on a line about that line.
const MASSLESS: f64 = 1e-12;
/// The motions of the interface, in words.
const MOTIONS: [&str; 6] = [
    "mass along x",
    "mass along y",
    "mass along z",
    "inertia about x through the interface",
    "inertia about y through the interface",
    "inertia about z through the interface",
];

/// Accepts modes that carry no more than the whole mass and inertia of the piece in any motion of its interface. (K18)
pub(super) fn within(piece: &Piece, factors: &[[Vector3<f64>; 2]]) -> Result<(), Problem> {
    let second = piece.second.trace();
    // rotations are measured by the displacement at the radius of gyration
    let length = (second / piece.mass).sqrt();
    let length = if length > 0.0 { length } else { 1.0 };
    let rigid = rigid(piece, length);
    let carried = DMatrix::from_fn(6, factors.len(), |row, mode| {
        if row < 3 { factors[mode][0][row] } else { factors[mode][1][row - 3] / length }
    });
    let floor = MASSLESS * rigid.trace();
    let along = |motion: usize| share(carried.row(motion).norm_squared(), rigid[(motion, motion)], floor);
    let most = (0..6).max_by(|a, b| along(*a).total_cmp(&along(*b))).unwrap_or(0);
    refuse(along(most), MOTIONS[most])?;
    let eigen = rigid.symmetric_eigen();
    let mut white = eigen.eigenvectors.transpose() * &carried;
    for (row, moment) in eigen.eigenvalues.iter().enumerate() {
        if *moment > floor {
            white.row_mut(row).scale_mut(moment.sqrt().recip());
        } else {
            refuse(share(white.row(row).norm_squared(), 0.0, floor), "inertia in a motion of the interface")?;
            white.row_mut(row).fill(0.0);
        }
    }
    let worst = white.singular_values().amax();
    refuse(worst * worst, "mass in a translation with a rotation")
}

/// Mass matrix of the piece in translations and rotations of its base, these at a length.
fn rigid(piece: &Piece, length: f64) -> Matrix6<f64> {
    let inertia = piece.second.trace() * nalgebra::Matrix3::identity() - piece.second;
    let coupling = piece.first.cross_matrix() / length;
    let mut rigid = Matrix6::from_diagonal(&Vector6::repeat(piece.mass));
    rigid.fixed_view_mut::<3, 3>(3, 3).copy_from(&(inertia / (length * length)));
    rigid.fixed_view_mut::<3, 3>(3, 0).copy_from(&coupling);
    rigid.fixed_view_mut::<3, 3>(0, 3).copy_from(&coupling.transpose());
    rigid
}

/// Share of a mass that is carried; of no mass none, or all and more.
fn share(carried: f64, mass: f64, floor: f64) -> f64 {
    match mass > floor {
        true => carried / mass,
        false if carried > ROUNDING * floor / MASSLESS => f64::INFINITY,
        false => 0.0,
    }
}

fn refuse(share: f64, what: &'static str) -> Result<(), Problem> {
    if share <= 1.0 + ROUNDING {
        Ok(())
    } else {
        Err(Problem::ModesTooHeavy { share, what: what.to_owned() })
    }
}
