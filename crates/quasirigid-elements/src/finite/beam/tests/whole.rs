//! Mass of beam elements: rigid motions give mass, centre and inertia of the prism, and slender beams the classical matrix.
//! The lumped masses are checked against the prism too: all invariants of a body are sums over them.
//! Equation (K3), docs/theory/12-structures.md.

use nalgebra::Matrix3;

use super::*;
use crate::finite::LumpedMass;

const ENDS: [[f64; 3]; 2] = [[0.4, -0.9, 1.3], [2.1, 0.5, 0.2]];
const SIDES: [f64; 2] = [0.7, 0.4];

fn chain() -> Chain {
    let section = SectionShape::Rectangle { height: SIDES[0], width: SIDES[1] }.section(0.3).unwrap();
    Chain::cut(ENDS, [0.1, 0.3, -0.8], section, ALLOY, &[0.0, 0.37, 1.0])
}

/// `∫ r rᵀ dm` of the prism, from the origin, by the points of a rule that is exact for quadratic functions.
fn second_moment(beam: &Beam) -> Matrix3<f64> {
    let [from, to] = ENDS.map(Vector3::from);
    let (middle, [_, y, z]) = (0.5 * (from + to), beam.directions());
    let mass = ALLOY.density * (to - from).norm() * SIDES[0] * SIDES[1];
    let node = 0.5 / 3.0_f64.sqrt();
    let mut sum = Matrix3::zeros();
    for a in [-node, node] {
        for b in [-node, node] {
            for c in [-node, node] {
                let r = middle + a * (to - from) + b * SIDES[1] * y + c * SIDES[0] * z;
                sum += mass / 8.0 * r * r.transpose();
            }
        }
    }
    sum
}

#[test]
fn rigid_motions_find_mass_centre_and_inertia_of_the_prism() {
    let chain = chain();
    let (mass, nodes) = (chain.sum(Beam::mass), chain.nodes());
    let [from, to] = ENDS.map(Vector3::from);
    let whole = ALLOY.density * (to - from).norm() * SIDES[0] * SIDES[1];
    let centre = 0.5 * (from + to);
    let W = second_moment(&chain.beams[0]);
    let inertia = W.trace() * Matrix3::identity() - W;
    let unit = |axis: usize| Vector3::ith(axis, 1.0);
    let shift = |axis| rigid(&nodes, unit(axis), Vector3::zeros());
    let turn = |axis| rigid(&nodes, Vector3::zeros(), unit(axis));
    for i in 0..3 {
        for j in 0..3 {
            let delta = if i == j { whole } else { 0.0 };
            assert!((shift(i).dot(&(&mass * shift(j))) - delta).abs() < 1e-13 * whole);
            let first = whole * unit(i).dot(&unit(j).cross(&centre));
            assert!((shift(i).dot(&(&mass * turn(j))) - first).abs() < 1e-13 * whole * centre.norm());
            let (found, wanted) = (turn(i).dot(&(&mass * turn(j))), inertia[(i, j)]);
            assert!((found - wanted).abs() < 1e-13 * inertia.trace(), "{i} {j}: {found} {wanted}");
        }
    }
}

#[test]
fn a_slender_beam_has_the_classical_mass_matrix() {
    // Archer 1963: ρAL/420 of 156, 22L, 54, −13L, 4L², −3L² for the cubic functions; ⅓ and ⅙ for the linear ones.
    let (length, area) = (1.7, 0.01);
    let material = BeamMaterial { density: 420.0 / (area * length), ..ALLOY };
    let beam = Beam::new([[0.0; 3], [length, 0.0, 0.0]], None, thin(area, 1e-9, 1e-9), material).unwrap();
    let (M, L) = (beam.mass(), length);
    let cubic = [
        [156.0, 22.0 * L, 54.0, -13.0 * L],
        [22.0 * L, 4.0 * L * L, 13.0 * L, -3.0 * L * L],
        [54.0, 13.0 * L, 156.0, -22.0 * L],
        [-13.0 * L, -3.0 * L * L, -22.0 * L, 4.0 * L * L],
    ];
    for i in 0..4 {
        for j in 0..4 {
            let sign = if (i + j) % 2 == 0 { 1.0 } else { -1.0 };
            for (found, wanted) in [
                (M[([1, 5, 7, 11][i], [1, 5, 7, 11][j])], cubic[i][j]),
                (M[([2, 4, 8, 10][i], [2, 4, 8, 10][j])], sign * cubic[i][j]),
            ] {
                assert!((found - wanted).abs() < 1e-11, "{i} {j}: {found} {wanted}");
            }
        }
    }
    assert!((M[(0, 0)] - 140.0).abs() < 1e-11 && (M[(0, 6)] - 70.0).abs() < 1e-11);
}

#[test]
fn lumped_masses_add_up_to_the_prism() {
    let chain = chain();
    let nodes = chain.nodes();
    let W = second_moment(&chain.beams[0]);
    let spin = Vector3::new(0.3, -0.8, 0.5).cross_matrix();
    let other = Vector3::new(-1.1, 0.2, 0.6);
    let fields = [spin, other.cross_matrix()]
        .map(|turn| rigid(&nodes, Vector3::zeros(), Vector3::new(turn.m32, turn.m13, turn.m21)));
    let (mut place, mut pair, mut sum) = (Matrix3::zeros(), Matrix3::zeros(), Vector3::zeros());
    for (i, beam) in chain.beams.iter().enumerate() {
        let [u, v] = [own(&fields[0], i), own(&fields[1], i)];
        let mut mass = Matrix12::zeros();
        for lumped_mass in beam.lumped_masses() {
            let (r, LumpedMass { mass: m, shapes, .. }) =
                (lumped_mass.place_from(Vector3::zeros()), lumped_mass);
            let (moved, other) = (&shapes * u, &shapes * v);
            sum += m * moved;
            place += m * r * moved.transpose();
            pair += m * moved * other.transpose();
            let own = shapes.tr_mul(&shapes);
            mass += m * Matrix12::from_column_slice(own.as_slice());
        }
        assert!((mass - beam.mass()).amax() < 1e-14 * mass.amax());
    }
    let [from, to] = ENDS.map(Vector3::from);
    let whole = ALLOY.density * (to - from).norm() * SIDES[0] * SIDES[1];
    let first = 0.5 * whole * spin * (from + to);
    assert!((sum - first).amax() < 1e-13 * first.amax());
    let place_wanted = W * spin.transpose();
    assert!((place - place_wanted).amax() < 1e-13 * W.amax(), "{place} {place_wanted}");
    let pair_wanted = spin * W * other.cross_matrix().transpose();
    assert!((pair - pair_wanted).amax() < 1e-13 * W.amax(), "{pair} {pair_wanted}");
}
