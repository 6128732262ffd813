//! The geometric stiffness as the second order of exact kinematics.

use nalgebra::{Matrix3, Rotation3};

use super::*;

const ENDS: [[f64; 3]; 2] = [[0.3, -1.1, 0.7], [1.6, -0.2, 1.9]];
const SIDES: [f64; 2] = [0.5, 0.3];
/// Load per length (N/m) at the root and at the tip.
const LOAD: [[f64; 3]; 2] = [[3e6, -1e6, 2e6], [-2e6, 4e6, 5e6]];

/// Moment per length (N·m/m).
const MOMENT: [f64; 3] = [0.7e6, -1.3e6, 0.9e6];

fn chain(cuts: &[f64]) -> Chain {
    let section = SectionShape::Rectangle { height: SIDES[0], width: SIDES[1] }.section(0.3).unwrap();
    Chain::cut(ENDS, [0.2, -0.9, 0.4], section, ALLOY, cuts)
}

/// The load at a fraction of the length.
fn load(part: f64) -> Vector3<f64> {
    (1.0 - part) * Vector3::from(LOAD[0]) + part * Vector3::from(LOAD[1])
}

/// The load on an element between two fractions.
fn between(cuts: &[f64], i: usize) -> Load {
    Load { force: [load(cuts[i]), load(cuts[i + 1])], moment: MOMENT.into() }
}

/// The load on the nodes that does the work of force and moment on the fields of the elements.
fn nodal(chain: &Chain, cuts: &[f64]) -> DVector<f64> {
    let mut force = DVector::zeros(chain.size());
    for (i, beam) in chain.beams.iter().enumerate() {
        let at = |t: f64| load(cuts[i] + (0.5 + t) * (cuts[i + 1] - cuts[i]));
        let mut view = force.fixed_rows_mut::<12>(6 * i);
        view += beam.integral(|fields, t| {
            fields.place.transpose() * at(t) + fields.turn.transpose() * Vector3::from(MOMENT)
        });
    }
    force
}

#[test]
fn internal_forces_balance_the_load_at_every_section() {
    let cuts = [0.0, 0.3, 1.0];
    let chain = chain(&cuts);
    let u = chain.clamped(&nodal(&chain, &cuts));
    let along = Vector3::from(ENDS[1]) - Vector3::from(ENDS[0]);
    for (i, beam) in chain.beams.iter().enumerate() {
        let forces = beam.forces(&own(&u, i), between(&cuts, i));
        for t in [-0.5, -0.2, 0.1, 0.37, 0.5] {
            let part = cuts[i] + (0.5 + t) * (cuts[i + 1] - cuts[i]);
            let rest = 1.0 - part;
            // The load beyond the section is linear: its middle two thirds and one third of the ends'.
            let [near, tip] = [load(part), load(1.0)];
            let force = 0.5 * rest * along.norm() * (near + tip);
            let moment = rest * rest * along.norm() * along.cross(&(near / 6.0 + tip / 3.0))
                + rest * along.norm() * Vector3::from(MOMENT);
            let found = forces.at(t);
            assert!((found[0] - force).amax() < 1e-11 * 3e6, "{i} {t}: {} {force}", found[0]);
            assert!((found[1] - moment).amax() < 1e-11 * 3e6, "{i} {t}: {} {moment}", found[1]);
        }
    }
}

/// Work of the internal forces on the exact strains `Rᵀ(e + u′) − e` and `RᵀR′` of nodes moved by `q`, and on the fibres that a twist
/// lengthens.
fn work(beam: &Beam, u: &Vector12, load: Load, q: &Vector12) -> f64 {
    let [axis, y, z] = beam.directions();
    let forces = beam.forces(u, load);
    beam.integral(|fields, t| {
        let [n, m] = forces.at(t);
        let (theta, bend) = (fields.turn * q, fields.bend * q);
        let R = Rotation3::new(theta);
        let step = 1e-4;
        let rate = (Rotation3::new(theta + step * bend).matrix()
            - Rotation3::new(theta - step * bend).matrix())
            / (2.0 * step);
        let curved: Matrix3<f64> = R.matrix().transpose() * rate;
        let curvature = Vector3::new(curved.m32, curved.m13, curved.m21);
        let node = 0.5 / 3.0_f64.sqrt();
        let mut longer = 0.0;
        for (a, b) in [(node, node), (node, -node), (-node, node), (-node, -node)] {
            let fibre = a * SIDES[1] * y + b * SIDES[0] * z;
            longer += 0.125 * (axis.dot(&bend) * axis).cross(&fibre).norm_squared();
        }
        n.dot(&(R.inverse() * (axis + fields.slope * q) - axis)) + m.dot(&curvature) + n.dot(&axis) * longer
    })
}

#[test]
fn it_is_the_second_derivative_of_the_work_on_exact_strains() {
    let beam = &chain(&[0.0, 1.0]).beams[0];
    let u = Vector12::from_fn(|i, _| (1.7 * i as f64).sin() * 1e-2);
    for load in [Load::default(), between(&[0.0, 1.0], 0)] {
        let geometric = beam.geometric_under(&u, load);
        for seed in 0..6 {
            let q = Vector12::from_fn(|i, _| (0.9 + 2.1 * i as f64 + 3.3 * f64::from(seed)).sin());
            let step = 1e-3;
            let exact =
                (work(beam, &u, load, &(step * q)) + work(beam, &u, load, &(-step * q))) / (step * step);
            let found = q.dot(&(geometric * q));
            // The fourth derivative over 12, times the square of the step.
            assert!((found - exact).abs() < 1e-5 * geometric.amax(), "{found} {exact}");
        }
    }
}

#[test]
fn a_twisted_beam_is_shorter_by_its_fibres() {
    // A fibre at the distance r from the axis is a helix: by ½ (r w/L)² longer per length than the axis, w the twist.
    let beam = &chain(&[0.0, 1.0]).beams[0];
    let [axis, ..] = beam.directions();
    let length = beam.length;
    let stretched = Vector12::from_fn(|i, _| if (6..9).contains(&i) { axis[i - 6] } else { 0.0 });
    let unit = length / (ALLOY.young * SIDES[0] * SIDES[1]);
    let twist = Vector12::from_fn(|i, _| if i >= 9 { axis[i - 9] } else { 0.0 });
    let shorter = 0.5 * twist.dot(&(beam.geometric(&(unit * stretched)) * twist));
    let mean = (SIDES[0].powi(2) + SIDES[1].powi(2)) / 12.0;
    assert!((shorter / (0.5 * mean / length) - 1.0).abs() < 1e-12, "{shorter}");
}

#[test]
fn a_beam_that_turns_keeps_its_length() {
    // A rotation moves each node by θ × r + ½ θ × (θ × r); the second part does the work −½ qᵀGq.
    let cuts = [0.0, 0.2, 1.0];
    let chain = chain(&cuts);
    let force = DVector::from_fn(chain.size(), |i, _| 1e6 * (2.9 * i as f64).cos());
    let u = chain.clamped(&force);
    let loads = chain.sum(Beam::stiffness) * &u;
    let geometric = chain.sum_by_place(|i, beam| beam.geometric(&own(&u, i)));
    let theta = Vector3::new(0.4, -0.7, 1.1);
    let q = rigid(&chain.nodes(), Vector3::new(0.2, 0.5, -0.1), theta);
    let second = |(i, node): (usize, &Vector3<f64>)| {
        0.5 * loads.fixed_rows::<3>(6 * i).dot(&theta.cross(&theta.cross(node)))
    };
    let expected: f64 = chain.nodes().iter().enumerate().map(second).sum();
    let found = -0.5 * q.dot(&(geometric * &q));
    assert!((found - expected).abs() < 1e-12 * expected.abs(), "{found} {expected}");
}

#[test]
fn a_beam_that_turns_under_a_load_along_it_keeps_its_length() {
    // Load between the nodes: every point of the beam moves by ½ θ × (θ × r).
    let cuts = [0.0, 0.4, 1.0];
    let chain = chain(&cuts);
    let force = nodal(&chain, &cuts);
    let u = chain.clamped(&force);
    let root = Vector3::from(ENDS[0]);
    let geometric = chain.sum_by_place(|i, beam| beam.geometric_under(&own(&u, i), between(&cuts, i)));
    let theta = Vector3::new(0.4, -0.7, 1.1);
    let q = rigid(&chain.nodes(), Vector3::zeros(), theta);
    let along = Vector3::from(ENDS[1]) - root;
    // ∫ p·½ θ × (θ × (r − root)): the root is fixed and does no work against itself.
    let second = 0.5 * theta.cross(&theta.cross(&along));
    let expected = along.norm() * (load(0.0) / 6.0 + load(1.0) / 3.0).dot(&second);
    let found = -0.5 * q.dot(&(geometric * &q));
    assert!((found - expected).abs() < 1e-11 * expected.abs(), "{found} {expected}");
}

#[test]
fn a_bent_antenna_is_foreshortened() {
    // Bent by a force at its tip, by v there, an antenna is shorter by 3v²/5L; bent evenly, by 2v²/3L.
    let chain = Chain::even(ENDS, [0.2, -0.9, 0.4], thin(0.01, 1e-4, 2e-4), ALLOY, 3);
    let (axes, size) = (chain.beams[0].axes, chain.size());
    let length = (Vector3::from(ENDS[1]) - Vector3::from(ENDS[0])).norm();
    let tip = |row: usize, direction: Vector3<f64>| {
        let mut force = DVector::zeros(size);
        force.fixed_rows_mut::<3>(size - row).copy_from(&direction);
        chain.clamped(&force)
    };
    let [along, y, z] = [0, 1, 2].map(|row| axes.row(row).transpose());
    let pulled = tip(6, along);
    let geometric = chain.sum_by_place(|i, beam| beam.geometric(&own(&pulled, i)));
    for (row, direction, across, factor) in
        [(6, y, y, 0.6), (6, z, z, 0.6), (3, z, y, 2.0 / 3.0), (3, y, z, 2.0 / 3.0)]
    {
        let bent = tip(row, direction);
        let bent = &bent / bent.fixed_rows::<3>(size - 6).dot(&across);
        let shorter = 0.5 * bent.dot(&(&geometric * &bent));
        assert!((shorter * length / factor - 1.0).abs() < 1e-9, "{shorter} {factor}");
    }
}
