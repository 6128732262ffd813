//! Laws of the reduced equations about a spin: conservation, energy, axes, units, styles.

use nalgebra::{Rotation3, Vector3};
use quasirigid::dynamics::{Observer, Options, Sample};
use quasirigid::elements::Assembly;
use quasirigid::model::FlexibleBody;
use quasirigid::modes::{RelativeEquilibrium, SpinMagnitude, SpinModes};
use quasirigid::prelude::{CARRIER, Carrier, Point, Spring};
use quasirigid::submanifold::{SpinManifold, SpinManifoldPlan, Style, propagate_on_manifold};
use quasirigid_math::rotation::ALIGNED;
use quasirigid_math::vec3::norm;

use crate::support::transform::{Units, rescaled, rotated};

use super::{bodies, body_of, cubic, derived, plan};

fn invariants(manifold: &SpinManifold) -> [f64; 4] {
    let [re, im] = cubic(manifold);
    [manifold.masters[0].decay_rate, manifold.masters[0].frequency, re, im]
}

fn close(a: [f64; 4], b: [f64; 4], unit: f64) {
    for (a, b) in a.iter().zip(b) {
        assert!((a * unit - b).abs() < 1e-9 * b.abs(), "{a} {b}");
    }
}

/// `|K|` of the spin manifold departs with the first power that is left out, since it is a condition on every coefficient.
#[test]
fn the_angular_momentum_keeps_its_size() {
    let body = body_of(&bodies::everything(5.0));
    for degree in [2, 3, 4, 5] {
        let manifold = derived(&body, &plan(&body, 3.0, degree));
        let drift = |amplitude: f64| {
            let size = |phase: f64| {
                let z = [amplitude * phase.cos(), amplitude * phase.sin()];
                norm(manifold.full_state(&[z], ALIGNED).angular_momentum(&body))
            };
            let sizes = (0..8).map(|i| size(f64::from(i)) / norm(manifold.spin.angular_momentum) - 1.0);
            sizes.map(f64::abs).fold(0.0, f64::max)
        };
        let slope = (drift(0.06) / drift(0.03)).log2();
        assert!(slope > degree as f64 + 0.7, "degree {degree}: {slope}");
    }
}

/// What the dashpots take is what the energy loses, to the defect.
#[test]
fn the_energy_falls_by_what_is_dissipated() {
    let body = body_of(&bodies::everything(5.0));
    let manifold = derived(&body, &plan(&body, 3.0, 7));
    let start = manifold.start(&manifold.full_state(&[[0.1, 0.05]], ALIGNED));
    let mut samples: Vec<Sample> = Vec::new();
    let times: Vec<f64> = (0..=50).map(f64::from).collect();
    let run = propagate_on_manifold(&manifold, &start, &times, &Options::default(), &mut samples).unwrap();
    let taken = run.last.dissipated;
    assert!(taken > 0.0 && run.worst.0.largest() < 1e-4, "{run:?}");
    assert!(samples.windows(2).all(|pair| pair[1].dissipated > pair[0].dissipated));
}

/// Rates belong to the body, not to the axes or units of its description.
#[test]
fn axes_and_units_change_nothing() {
    let assembly = Assembly { hinged: bodies::hinged().hinged, ..bodies::two_masses() };
    let body = body_of(&assembly);
    let plan = plan(&body, 3.0, 3);
    let own = invariants(&derived(&body, &plan));
    let turn = Rotation3::from_euler_angles(0.7, -1.1, 0.4);
    let turned = body_of(&rotated(&assembly, turn.matrix()));
    let K: [f64; 3] = (turn * Vector3::from(plan.angular_momentum)).into();
    let there = SpinManifoldPlan { angular_momentum: K, ..plan.clone() };
    close(invariants(&derived(&turned, &there)), own, 1.0);
    for [mass, length, time] in [[1e-9, 1e-3, 1e2], [1e6, 1e3, 1e-3], [1.0, 1.0, 1e-12]] {
        let scaled = body_of(&rescaled(&assembly, Units { length, mass, time }));
        let unit = mass * length * length / time;
        let K = plan.angular_momentum.map(|K| unit * K);
        let there = SpinManifoldPlan { angular_momentum: K, ..plan.clone() };
        close(invariants(&derived(&scaled, &there)), own, time);
    }
}

/// Both styles describe the same motion: the mean rates at an amplitude differ by the next order.
#[test]
fn styles_agree_on_the_rates_at_an_energy() {
    let body: FlexibleBody = body_of(&bodies::two_masses());
    let rate = |style: Style| {
        let manifold = derived(&body, &SpinManifoldPlan { style, ..plan(&body, 5.0, 5) });
        let options = Options::default();
        let normal = derived(&body, &plan(&body, 5.0, 5));
        let state = normal.full_state(&[[0.12, 0.0]], ALIGNED);
        let mut samples: Vec<Sample> = Vec::new();
        let start = manifold.start(&state);
        propagate_on_manifold(&manifold, &start, &[0.0, 40.0], &options, &mut samples).unwrap();
        (samples[0].energy - samples[1].energy, samples[1].omega)
    };
    let (normal, graph) = (rate(Style::NormalForm), rate(Style::Graph));
    assert!((normal.0 / graph.0 - 1.0).abs() < 1e-4, "{normal:?} {graph:?}");
    assert!(normal.1.iter().zip(graph.1).all(|(a, b)| (a - b).abs() < 1e-4), "{normal:?} {graph:?}");
}

/// The nutation of the modes is that of the linear part of the polynomial equations, along curved paths too: decay from the balance of the
/// energy on one side, from the eigenvalue on the other.
#[test]
fn the_linear_part_has_the_nutation_of_the_modes() {
    let bodies =
        [bodies::two_masses(), bodies::hinged(), bodies::beam(), bodies::rotors(5.0), bodies::liquid()];
    for (assembly, spin) in bodies.iter().flat_map(|assembly| [(assembly, 2.0), (assembly, 30.0)]) {
        let body = body_of(assembly);
        let plan = plan(&body, spin, 1);
        let manifold = derived(&body, &plan);
        let given = SpinMagnitude::AngularMomentum(norm(plan.angular_momentum));
        let near = RelativeEquilibrium::near(&body, manifold.spin.omega, given).unwrap();
        let displaced = near.q.iter().zip(&manifold.spin.q).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
        assert!(displaced < 1e-9, "{spin}: {displaced}");
        let modes = SpinModes::about(&body, near).unwrap();
        let nutation = modes.nutation().unwrap();
        let own = &manifold.masters[0];
        let [decay, frequency] = nutation.of_motion;
        assert!((frequency / own.frequency - 1.0).abs() < 1e-10, "{spin}: {nutation:?} {own:?}");
        assert!((decay - own.decay_rate).abs() < 1e-10 * frequency, "{spin}: {nutation:?} {own:?}");
    }
}

/// The mean over a turn of the phases does not depend on where the turn begins, and with the other masters at rest it is that at the
/// amplitude.
#[test]
fn a_defect_is_that_of_the_whole_turn() {
    let body = body_of(&bodies::two_masses());
    let manifold = derived(&body, &plan(&body, 3.0, 3));
    let amplitude = 0.3_f64;
    let expected = manifold.defect(amplitude);
    assert!(expected.motion > 1e-6 && expected.power > 1e-6, "{expected:?}");
    for step in [0, 1, 7, 20] {
        let phase = std::f64::consts::TAU * f64::from(step) / 24.0;
        let found = manifold.defect_around(&[[amplitude * phase.cos(), amplitude * phase.sin()]]);
        for (found, expected) in [(found.motion, expected.motion), (found.power, expected.power)] {
            assert!((found / expected - 1.0).abs() < 1e-9, "{step}: {found:e} {expected:e}");
        }
    }
}

/// What each dissipator took, by name.
#[derive(Default)]
struct Taken(Vec<(String, f64)>);

impl Observer for Taken {
    fn sample(&mut self, _: &Sample) {}

    fn budget(&mut self, energies: &[(String, f64)]) {
        self.0 = energies.to_vec();
    }
}

/// The dissipators of a history are those of the body, and together they take what the history has dissipated; each takes what the mean
/// power of its own says.
#[test]
fn the_dissipators_share_what_a_history_takes() {
    let body = body_of(&bodies::two_masses());
    let manifold = derived(&body, &plan(&body, 3.0, 5));
    let start = manifold.start(&manifold.full_state(&[[0.02, 0.0]], ALIGNED));
    let mut taken = Taken::default();
    let run =
        propagate_on_manifold(&manifold, &start, &[0.0, 60.0], &Options::default(), &mut taken).unwrap();
    let names: Vec<&str> = taken.0.iter().map(|(name, _)| name.as_str()).collect();
    let expected: Vec<&str> = body.dissipators().iter().map(|dissipator| dissipator.name.as_str()).collect();
    assert_eq!(names, expected);
    let sum: f64 = taken.0.iter().map(|(_, energy)| energy).sum();
    assert!(run.last.dissipated > 0.0 && (sum / run.last.dissipated - 1.0).abs() < 1e-12, "{sum} {run:?}");
    let power = manifold.power_at(0.02);
    for ((name, energy), own) in taken.0.iter().zip(&power.budget) {
        let (found, expected) = (energy / sum, own / power.power);
        assert!((found - expected).abs() < 0.02 * expected, "{name}: {found} {expected}");
    }
}

/// A defect is no rounding: a stiff body has the same range with structural damping and with a hundredth of that, where the loss at small
/// amplitudes is below the rounding of the energy. (W11)
#[test]
fn the_range_does_not_depend_on_light_damping() {
    let ranges = [20.0, 1.0, 0.2].map(|damping| {
        let mut hub = Assembly::default().with(Carrier::principal(40.0, [9.0, 13.0, 16.0]));
        let tip = hub.add(Point::new("tip", 5.0, [0.4, 1.0, 0.5]));
        hub.add(Spring::isotropic(5000.0, damping).between(tip, CARRIER));
        let body = body_of(&hub);
        derived(&body, &plan(&body, 1.5, 5)).range(0.01).nutation
    });
    assert!(ranges[0] > 0.1, "{ranges:?}");
    assert!(ranges.iter().all(|range| (range / ranges[0] - 1.0).abs() < 0.02), "{ranges:?}");
}
