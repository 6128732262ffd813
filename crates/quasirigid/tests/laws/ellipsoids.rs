//! A body that is elastic throughout: its frame, its laws, and the elements that may stand beside it.

use proptest::prelude::*;
use quasirigid::averaging::{FreeRotation, MeanPower, Response};
use quasirigid::elements::{Assembly, ElementId, ElementKind, Ellipsoid, Field, Material, Problem};
use quasirigid::model::{FlexibleBody, Mode, Rheology, Support};
use quasirigid::reduction::{Validity, Verdict, reduce};

use crate::support::cases;
use crate::support::parts;

fn rock() -> Ellipsoid {
    Ellipsoid {
        name: "rock".into(),
        semi_axes: [1.4, 1.0, 0.7],
        center: [2.0, -1.0, 0.5],
        material: Material {
            density: 3.0,
            young: 7e3,
            poisson: 0.2,
            rheology: Rheology::KelvinVoigt { time: 0.01 },
        },
    }
}

fn alone(ellipsoid: Ellipsoid) -> Assembly {
    Assembly { ellipsoids: vec![ellipsoid], ..Assembly::default() }
}

fn body(ellipsoid: Ellipsoid) -> FlexibleBody {
    alone(ellipsoid).body().unwrap()
}

/// In the Tisserand frame no coordinate has linear or angular momentum; mass and inertia are those of the solid.
#[test]
fn displacements_carry_no_momentum() {
    let body = body(rock());
    let invariants = body.invariants();
    let [a, b, c] = [1.4_f64, 1.0, 0.7];
    let mass = 3.0 * 4.0 / 3.0 * std::f64::consts::PI * a * b * c;
    let J = [b * b + c * c, c * c + a * a, a * a + b * b].map(|sum| mass / 5.0 * sum);
    assert!((invariants.mass / mass - 1.0).abs() < 1e-14);
    assert!((0..3).all(|i| (invariants.J[i] / J[i] - 1.0).abs() < 1e-14));
    assert_eq!(body.coordinates().len(), 36);
    assert_eq!(body.pole(), [2.0, -1.0, 0.5]);
    assert!(invariants.S.iter().all(|S| *S == [0.0; 3]) && invariants.h.iter().all(|h| *h == [0.0; 3]));
    // h_k(q) = ∫ H_j × H_k is antisymmetric, and its rate of change is the Coriolis coupling.
    for (j, k, pair) in invariants.pairs.iter() {
        let back = invariants.pairs.row(k).find(|(column, _)| *column == j).unwrap().1;
        assert!((0..3).all(|i| pair.Z[i] == -back.Z[i]) && pair.A == back.A, "{j} {k}");
    }
}

/// The shapes are really without angular momentum: `∫ρ × H dm` over a grid of the solid, by their displacements at points.
#[test]
fn markers_move_as_the_shapes_say() {
    let body = body(rock());
    for (axis, marker) in body.markers().iter().enumerate() {
        assert!((marker.position[axis] - [1.4, 1.0, 0.7][axis]).abs() < 1e-15);
        let stretch = marker.shapes.iter().find(|(j, _)| *j == axis).unwrap().1;
        assert_eq!(stretch[axis], 1.0);
    }
}

/// A slow rotation about an axis: the full equations, put to the reduced ones, leave the order that theory says.
#[test]
fn slow_rotation_is_in_the_range_of_the_theory() {
    let body = body(rock());
    let validity = Validity::assess(&body, 3, [0.3, 0.2, 0.4]).unwrap();
    assert!(validity.verdict() != Verdict::Fails, "{:?}", validity.criteria);
    let reduced = reduce(&body, 3).unwrap();
    assert!(reduced.power.scalar([0.3, 0.2, 0.4]) > 0.0 && reduced.power.scalar([0.0, 0.0, 0.4]) < 1e-30);
}

proptest! {
    #![proptest_config(cases(12))]

    /// Order of the axes and units do not matter: power goes as ρ²a⁷Ω⁶τ/E in any units.
    #[test]
    fn power_does_not_know_axes_or_units(turn in 0..3usize, length in -9.0..9.0, mass in -9.0..9.0, time in -9.0..9.0, xi in -2.0..4.0) {
        let power = |ellipsoid: Ellipsoid, time: f64| {
            let response = Response::compute(&body(ellipsoid)).unwrap();
            let motion =
                FreeRotation::at_logit(response.moments(), 0.4 * response.moments()[2] / time, Mode::ShortAxis, xi);
            response.mean_power(&motion)
        };
        let one = power(rock(), 1.0);
        let [l, m, t] = [length, mass, time].map(|exponent: f64| 10f64.powf(exponent));
        let [a, b, c] = rock().semi_axes;
        let axes = [[a, b, c], [b, c, a], [c, a, b]][turn];
        let other = Ellipsoid {
            semi_axes: axes.map(|axis| axis * l),
            material: Material {
                density: rock().material.density * m / l.powi(3),
                young: rock().material.young * m / (l * t * t),
                rheology: Rheology::KelvinVoigt { time: 0.01 * t },
                ..rock().material
            },
            ..rock()
        };
        let found = power(other, t) / (m * l * l / t.powi(3));
        prop_assert!((found / one - 1.0).abs() < 1e-10, "{found} {one}");
    }
}

#[test]
fn what_no_ellipsoid_has_is_refused() {
    let error = |change: fn(&mut Ellipsoid)| {
        let mut ellipsoid = rock();
        change(&mut ellipsoid);
        let assembly = alone(ellipsoid);
        let error = assembly.body().unwrap_err();
        // as text, in which NaN is itself
        assert!(assembly.check().iter().any(|found| found.to_string() == error.to_string()), "{error}");
        assert_eq!(error.element, ElementKind::Ellipsoid.at(0));
        (error.field, error.problem)
    };
    assert!(matches!(error(|e| e.semi_axes[1] = 0.0), (Field::SEMI_AXES, Problem::NotPositive { .. })));
    assert!(matches!(error(|e| e.semi_axes[2] = f64::NAN), (Field::SEMI_AXES, Problem::NotFinite { .. })));
    assert!(matches!(error(|e| e.center[0] = f64::INFINITY), (Field::CENTER, Problem::NotFinite { .. })));
    assert!(matches!(error(|e| e.material.density = -1.0), (Field::DENSITY, Problem::NotPositive { .. })));
    assert!(matches!(error(|e| e.material.young = 0.0), (Field::YOUNG, Problem::NotPositive { .. })));
    for poisson in [0.5, -1.0, 0.7, f64::NAN] {
        let mut ellipsoid = rock();
        ellipsoid.material.poisson = poisson;
        let error = alone(ellipsoid).body().unwrap_err();
        assert!(matches!(error.problem, Problem::Poisson { .. }), "{error}");
    }
    let nearly_incompressible = Material { poisson: 0.4999, ..rock().material };
    assert_eq!(body(Ellipsoid { material: nearly_incompressible, ..rock() }).coordinates().len(), 36);
    let flow = |e: &mut Ellipsoid| e.material.rheology = Rheology::Maxwell { time: -3.0 };
    assert!(matches!(error(flow), (Field::RHEOLOGY, Problem::Rheology(_))));
}

#[test]
fn an_ellipsoid_is_a_whole_body() {
    let carrier = parts::carrier(1.0, [0.0; 3], parts::diag([1.0, 1.0, 1.0]));
    let both = Assembly { carrier: Some(carrier), ..alone(rock()) };
    let two = Assembly {
        ellipsoids: vec![rock(), Ellipsoid { name: "other".into(), ..rock() }],
        ..Assembly::default()
    };
    for (assembly, place) in [(both, ElementId::CARRIER), (two, ElementKind::Ellipsoid.at(1))] {
        let error = assembly.body().unwrap_err();
        assert_eq!((error.element, &error.problem), (place, &Problem::BesideWhole));
        assert!(assembly.check().contains(&error));
    }
    let held = Assembly { support: Support::FixedPoint { point: [0.0; 3] }, ..alone(rock()) };
    assert_eq!(held.body().unwrap_err().problem, Problem::HeldWhole);
    assert_eq!(Assembly::default().body().unwrap_err().problem, Problem::NoBody);
}
