//! Boundary layer of a liquid at high Reynolds number that does not spin: memory of the layer as relaxations. (L12)–(L14)

use std::f64::consts::PI;

use nalgebra::{SymmetricEigen, Vector3};

use super::liquid::Relaxations;
use crate::flow::potential_flow::PotentialFlowMoments;
use crate::math::quadrature::gauss_legendre;

/// Gauss points in each panel of the rates.
const POINTS: usize = 4;
/// Ratio of a panel of `1/√rate` to the next.
const PANEL: f64 = 4.0;

/// An ideal liquid behind a boundary layer, as relaxations scaled to a value of their mass. (L14)
///
/// Along each axis in which wall and volume slip alike, rates from the one at which the liquid follows as a whole to `16^panels` times
/// as much. None if the liquid slips nowhere.
pub(super) fn relaxations(slip: &PotentialFlowMoments, panels: usize, mass: f64) -> Option<Relaxations> {
    let axes = axes(slip)?;
    let nodes = nodes(panels);
    let mut own = Relaxations { mass, ..Relaxations::default() };
    for [x, weight] in &nodes {
        let first = own.friction.len();
        for axis in &axes {
            own.friction.push(mass * 4.0 / (PI * axis.depth * x).powi(2));
            own.momentum.push((mass * axis.depth * weight).sqrt() * axis.pull);
        }
        for (j, one) in axes.iter().enumerate() {
            for (k, other) in axes.iter().enumerate().filter(|(k, _)| *k != j) {
                let across = slip.turning.map(|matrix| one.turn.dot(&(matrix * other.turn)));
                let scale = mass / (one.depth * other.depth).sqrt();
                own.turning.push((first + j, first + k, scale * Vector3::from(across)));
            }
        }
    }
    Some(own)
}

/// An axis in which wall and volume slip alike.
struct Axis {
    /// `λ`, volume over surface (m).
    depth: f64,
    /// `x`: the rotation of the body, with `x·Dx = 1` (m⁻²).
    turn: Vector3<f64>,
    /// `Dx` (m²).
    pull: Vector3<f64>,
}

/// The axes with `Δ x = λ D x`, volume `Δ` and surface `D`.
fn axes(slip: &PotentialFlowMoments) -> Option<[Axis; 3]> {
    let root = slip.surface.cholesky()?.l();
    let inverse = root.try_inverse()?;
    let alike = SymmetricEigen::new(inverse * slip.volume * inverse.transpose());
    let axis = |place: usize| {
        let direction = alike.eigenvectors.column(place).into_owned();
        Axis {
            depth: alike.eigenvalues[place],
            turn: inverse.transpose() * direction,
            pull: root * direction,
        }
    };
    let axes = [0, 1, 2].map(axis);
    axes.iter().all(|axis| axis.depth > 0.0 && axis.depth.is_finite()).then_some(axes)
}

/// `x` and weights on 0 to 1, in panels that shrink towards 0.
fn nodes(panels: usize) -> Vec<[f64; 2]> {
    let ends: Vec<f64> = (0..=panels).map(|panel| PANEL.powi(-(panel as i32))).chain([0.0]).collect();
    ends.windows(2)
        .flat_map(|ends| {
            let width = ends[0] - ends[1];
            gauss_legendre(POINTS)
                .into_iter()
                .map(move |[x, weight]| [ends[1] + 0.5 * width * (1.0 + x), 0.5 * width * weight])
        })
        .collect()
}
