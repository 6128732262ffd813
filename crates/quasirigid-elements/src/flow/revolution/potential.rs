use nalgebra::Vector3;

use super::grid::{Grid, Point};
use super::matrices::{Dense, Scalar};
use super::outline::Outline;
use crate::flow::potential_flow::PotentialFlowMoments;
use crate::math::factor::{Factor, Method};

/// Slip of an ideal liquid in a cavity of revolution about z, with polynomials of a degree: about the axis nothing moves the liquid, about
/// x its potential is `φ(r, z) sin θ`, about y the same a quarter of a revolution on. (L12)
///
/// None if floating point does not resolve the places of the cavity.
pub(crate) fn slip(outline: &Outline, degree: usize) -> Option<PotentialFlowMoments> {
    let grid = Grid::new(outline, degree, 1);
    let blocks = grid.patches.iter().map(Dense::new).collect::<Option<Vec<Dense>>>()?;
    let scalar = Scalar::new(&grid, &blocks, |node| !grid.axis[node]);
    let factor = Factor::new(&scalar.stiffness(1), Method::default()).ok()?;
    let mut potential = vec![0.0; scalar.nodes.len()];
    for patch in &grid.patches {
        for point in &patch.points {
            let [r, z] = point.at;
            for (node, [value, by_r, by_z]) in patch.nodes.iter().zip(&point.functions) {
                if let Some(unknown) = scalar.unknowns[*node] {
                    potential[unknown as usize] += point.share * (r * r * by_z - z * (r * by_r + value));
                }
            }
        }
    }
    factor.solve(&mut potential, 1);
    let at_node = |node: &usize| scalar.unknowns[*node].map_or(0.0, |unknown| potential[unknown as usize]);
    let mut slip = PotentialFlowMoments::default();
    for patch in &grid.patches {
        let own: Vec<f64> = patch.nodes.iter().map(at_node).collect();
        for point in &patch.points {
            round(point, &own, |share, w| slip.add_volume(share, w));
        }
    }
    for edge in &grid.edges {
        let own: Vec<f64> = edge.nodes.iter().map(at_node).collect();
        for point in &edge.points {
            round(point, &own, |share, w| slip.add_surface(share, w));
        }
    }
    Some(slip)
}

/// Places round the axis that integrate products of two flows exactly.
const ROUND: usize = 4;

/// Visits places round the axis with their shares and the flows past the body.
fn round(point: &Point, potential: &[f64], mut visit: impl FnMut(f64, &[Vector3<f64>; 3])) {
    let [r, z] = point.at;
    let mut sums = [0.0; 3];
    for (value, functions) in potential.iter().zip(&point.functions) {
        sums.iter_mut().zip(functions).for_each(|(sum, function)| *sum += value * function);
    }
    let [value, by_r, by_z] = sums;
    let (along_r, round, along_z) = (by_r + z, value / r + z, by_z - r);
    for turn in 0..ROUND {
        let angle = 2.0 * std::f64::consts::PI * turn as f64 / ROUND as f64;
        let (sin, cos) = angle.sin_cos();
        let flow = |u_r: f64, u_theta: f64, u_z: f64| {
            Vector3::new(u_r * cos - u_theta * sin, u_r * sin + u_theta * cos, u_z)
        };
        let w = [
            flow(along_r * sin, round * cos, along_z * sin),
            flow(-along_r * cos, round * sin, -along_z * cos),
            flow(0.0, -r, 0.0),
        ];
        visit(point.share * r * 2.0 * std::f64::consts::PI / ROUND as f64, &w);
    }
}
