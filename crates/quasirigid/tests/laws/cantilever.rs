//! Cantilever modes: sum rules, free vibrations from cantilever data alone, axes, units and the point of reference. (M18)–(M20)

use nalgebra::{Matrix3, Matrix6, Matrix6x3, Vector3, Vector6};
use proptest::prelude::*;
use quasirigid::elements::{
    Assembly, End, Frame, FrameNode, HingeCoefficient, Hinged, Part, PartKind, PartReduction, PointMotion,
    SectionShape,
};
use quasirigid::model::{FlexibleBody, Rheology, Support};
use quasirigid::modes::{CantileverError, CantileverModes};
use quasirigid::reduction::Vibrations;
use quasirigid_math::eigen::{Dense, modes};

use super::compare::list_gap;
use crate::support::transform::{rescaled, rotated};
use crate::support::{
    Massive, assemblies, cases, massive_points, parts, rotation, sprung_body, units, vector,
};

type V = Vector3<f64>;
type V6 = Vector6<f64>;

/// Rounding of two eigenproblems.
const ROUNDING: f64 = 1e-10;

fn of(assembly: &Assembly, about: [f64; 3]) -> (FlexibleBody, CantileverModes) {
    let body = assembly.body().unwrap();
    let from_pole = V::from(about) - V::from(body.pole());
    let found = CantileverModes::about(&body, from_pole.into()).unwrap();
    (body, found)
}

/// `Σ d dᵀ` in translations and rotations.
fn carried(found: &CantileverModes) -> Matrix6<f64> {
    Matrix6::from_fn(|a, b| found.carried()[a][b])
}

/// Mass matrix of the frozen body about the point.
fn rigid(found: &CantileverModes) -> Matrix6<f64> {
    let first = found.mass * V::from(found.center_of_mass).cross_matrix();
    let mut rigid = Matrix6::from_diagonal(&Vector6::repeat(found.mass));
    rigid.fixed_view_mut::<3, 3>(3, 3).copy_from(&Matrix3::from(found.inertia));
    rigid.fixed_view_mut::<3, 3>(3, 0).copy_from(&first);
    rigid.fixed_view_mut::<3, 3>(0, 3).copy_from(&first.transpose());
    rigid
}

proptest! {
    #![proptest_config(cases(32))]

    /// All modes together carry the points along their free directions, whatever the springs between them. (M19)
    #[test]
    fn effective_masses_add_to_the_mass_that_moves(Massive { assembly, .. } in massive_points(), about in vector()) {
        let (_, found) = of(&assembly, about);
        let mut expected = Matrix6::zeros();
        for point in &assembly.points {
            let unit = |n: [f64; 3]| V::from(n).normalize();
            let free = match point.motion {
                PointMotion::Free => Matrix3::identity(),
                PointMotion::Line(e) => unit(e) * unit(e).transpose(),
                PointMotion::Plane(n) => Matrix3::identity() - unit(n) * unit(n).transpose(),
            };
            let arm = (V::from(point.position) - V::from(about)).cross_matrix();
            let mut motion = Matrix6x3::zeros();
            motion.fixed_rows_mut::<3>(0).copy_from(&Matrix3::identity());
            motion.fixed_rows_mut::<3>(3).copy_from(&arm);
            expected += point.mass * motion * free * motion.transpose();
        }
        let gap = (carried(&found) - expected).amax() / expected.amax();
        prop_assert!(gap < ROUNDING, "{gap:e}");
    }

    /// The free body has the vibrations that its cantilever data alone give, and its carrier moves in them as they say. (M20)
    #[test]
    fn free_vibrations_follow_from_cantilever_data(assembly in assemblies(), about in vector()) {
        let (body, found) = of(&Assembly { support: Support::Free, ..assembly }, about);
        let M = rigid(&found);
        let factors: Vec<V6> = found.modes.iter().map(|mode| Vector6::from(mode.factors())).collect();
        let (mut A, mut C) = (Dense::zero(factors.len()), Dense::zero(factors.len()));
        let inverse = M.try_inverse().unwrap();
        for (r, d) in factors.iter().enumerate() {
            C.add(r, r, found.modes[r].frequency.powi(2));
            factors.iter().enumerate().for_each(|(s, e)| A.add(r, s, f64::from(u8::from(r == s)) - d.dot(&(inverse * e))));
        }
        let hybrid = modes(&A, &C).unwrap().frequencies;
        let own: Vec<f64> = found.free.iter().map(|mode| mode.frequency).collect();
        let known = Vibrations::compute(&body).unwrap().free_frequencies;
        prop_assert!(list_gap(&hybrid, &known) < ROUNDING, "{hybrid:?} {known:?}");
        prop_assert!(list_gap(&own, &known) < ROUNDING, "{own:?} {known:?}");
        let gains = found.free.iter().map(|mode| {
            let ([x, y, z], [a, b, c]) = (mode.displacement, mode.rotation);
            Vector6::new(x, y, z, a, b, c)
        });
        let sum: Matrix6<f64> = gains.map(|gain| gain * gain.transpose()).sum();
        let expected = (M - carried(&found)).try_inverse().unwrap() - inverse;
        let gap = (sum - expected).amax() / expected.amax();
        // the inverse of what remains loses the digits of its condition
        prop_assert!(gap < 1e-8, "{gap:e}");
    }

    /// Participation turns with the axes, and has the units of a mass to the power of one half.
    #[test]
    fn axes_and_units_change_nothing(assembly in assemblies(), R in rotation(), units in units(), about in vector()) {
        let (_, before) = of(&assembly, about);
        let carried_before = carried(&before);
        let turned = rotated(&assembly, &R);
        let (_, after) = of(&turned, (R * V::from(about)).into());
        let mut both = Matrix6::zeros();
        both.fixed_view_mut::<3, 3>(0, 0).copy_from(&R);
        both.fixed_view_mut::<3, 3>(3, 3).copy_from(&R);
        let gap = (carried(&after) - both * carried_before * both.transpose()).amax() / carried_before.amax();
        prop_assert!(gap < ROUNDING, "{gap:e}");
        let (_, scaled) = of(&rescaled(&assembly, units), about.map(|x| units.length * x));
        for (mode, old) in scaled.modes.iter().zip(&before.modes) {
            prop_assert!((mode.frequency * units.time / old.frequency - 1.0).abs() < ROUNDING);
        }
        // of equal frequencies the modes are any, and their damping together is one
        let damped = |found: &CantileverModes| found.modes.iter().map(|mode| mode.damping_ratio * mode.frequency).sum::<f64>();
        prop_assert!((damped(&scaled) * units.time / damped(&before) - 1.0).abs() < ROUNDING);
        let unit = |axis: usize| units.mass.sqrt() * if axis < 3 { 1.0 } else { units.length };
        let back = Matrix6::from_fn(|a, b| scaled.carried()[a][b] / (unit(a) * unit(b)));
        let gap = (back - carried_before).amax() / carried_before.amax();
        prop_assert!(gap < ROUNDING, "{gap:e}");
    }
}

/// A uniform beam clamped at an end: the shares of the mass across it that its modes carry, `(2σ_r/λ_r)²` with
/// `cos λ cosh λ = −1` (Blevins 1979, table 8-1: λ = 1.87510407, 4.69409113, 7.85475744; σ = 0.734095514, 1.018467319, 0.999224497).
#[test]
fn a_clamped_beam_carries_613_and_188_thousandths_of_its_mass() {
    let (length, radius) = (3.0, 1e-3);
    let area = std::f64::consts::PI * radius * radius;
    let (second, density) = (0.25 * area * radius * radius, 2700.0);
    let section = SectionShape::General {
        area,
        second_y: second,
        second_z: second,
        torsion: 2.0 * second,
        shear: None,
    };
    let along = V::new(0.3, 0.9, -0.2).normalize();
    let root = V::new(0.4, -0.2, 0.1);
    let node = |name: &str, at: V| FrameNode { name: name.into(), position: at.into() };
    let nodes = vec![node("root", root), node("tip", root + length * along)];
    let member = parts::member([0, 1], section, parts::elastic(density, 70e9, 0.3), 24);
    let part = Part {
        name: "boom".into(),
        kind: PartKind::Frame(Frame { nodes, members: vec![member] }),
        masses: Vec::new(),
        attached: vec![0],
        rayleigh: [0.0; 2],
    };
    let assembly = Assembly {
        carrier: Some(parts::carrier(5.0, [0.1, 0.0, 0.0], parts::diag([1.0, 2.0, 2.5]))),
        parts: vec![part],
        reduction: PartReduction { order: 3, modes: 12 },
        ..Assembly::default()
    };
    let (_, found) = of(&assembly, root.into());
    let mass = density * area * length;
    let roots = [(1.875_104_07, 0.734_095_514), (4.694_091_13, 1.018_467_319), (7.854_757_44, 0.999_224_497)];
    for (pair, (lambda, sigma)) in found.modes.chunks(2).zip(roots) {
        let rate = lambda * lambda * (70e9 * second / (density * area)).sqrt() / (length * length);
        let across = Matrix3::identity() - along * along.transpose();
        let share: Matrix3<f64> =
            pair.iter().map(|mode| V::from(mode.translation) * V::from(mode.translation).transpose()).sum();
        let (known, rotation) = ((2.0_f64 * sigma / lambda).powi(2), (2.0_f64 / (lambda * lambda)).powi(2));
        let gap = (share / mass - known * across).amax();
        assert!(gap < 2e-4, "{known}: {gap:e}");
        // about the root: (2/λ²)² of m L²
        let turned: Matrix3<f64> =
            pair.iter().map(|mode| V::from(mode.rotation) * V::from(mode.rotation).transpose()).sum();
        let gap = (turned / (mass * length * length) - rotation * across).amax();
        assert!(gap < 2e-4, "{rotation}: {gap:e}");
        for mode in pair {
            assert!((mode.frequency / rate - 1.0).abs() < 1e-4, "{} {rate}", mode.frequency);
            assert_eq!(mode.name, "boom");
        }
    }
}

#[test]
fn a_pendulum_without_a_spring_has_no_cantilever_modes() {
    let pendulum = Hinged {
        name: "pendulum".into(),
        mass: 1.5,
        center_of_mass: [1.2, 0.0, 0.1],
        inertia: parts::diag([0.1, 0.2, 0.2]),
        hinge: [0.8, 0.0, 0.0],
        axes: vec![[0.0, 0.0, 1.0]],
        stiffness: HingeCoefficient::PerAxis(vec![0.0]),
        damping: HingeCoefficient::PerAxis(vec![0.0]),
        rheology: Rheology::Elastic,
        places: Vec::new(),
        angle: None,
    };
    let carrier = Some(parts::carrier(20.0, [0.0; 3], parts::diag([3.0, 4.0, 5.0])));
    let body = Assembly { carrier, hinged: vec![pendulum], ..Assembly::default() }.body().unwrap();
    assert_eq!(CantileverModes::about(&body, [0.0; 3]), Err(CantileverError::Hung));
}

#[test]
fn the_first_mode_of_a_dashpot_across_two_points_says_how_far_it_couples() {
    let masses = [
        parts::sprung(1.0, [1.0, 0.0, 0.0], [9.0, 400.0, 900.0], [0.0; 3]),
        parts::sprung(1.0, [-1.0, 0.0, 0.0], [16.0, 500.0, 1000.0], [0.0; 3]),
    ];
    let mut assembly = sprung_body(parts::carrier(20.0, [0.0; 3], parts::diag([3.0, 4.0, 5.0])), &masses);
    let ends = [0, 1].map(End::Point);
    assembly.springs.push(parts::spring(ends[0], ends[1], parts::diagonal([0.0; 3], [0.7, 0.0, 0.0])));
    let (_, found) = of(&assembly, [0.0; 3]);
    // B = 0.7 [1, −1; −1, 1]: share ω₁ 0.7/(ω₂² − ω₁²)
    assert!((found.damping_coupling - 3.0 * 0.7 / 7.0).abs() < 1e-12, "{}", found.damping_coupling);
    assert!((found.modes[0].damping_ratio - 0.7 / 6.0).abs() < 1e-12);
}
