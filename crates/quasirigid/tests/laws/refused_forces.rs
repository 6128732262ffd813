//! Impossible forces are refused, with the place and the value; possible ones act at their places. Thresholds on both sides.

use nalgebra::Vector3;
use quasirigid::elements::{
    ApplicationPoint, Assembly, ElementError, ElementId, ElementKind, End, Field, Problem,
};
use quasirigid::model::Support;
use quasirigid::model::force::{Axes, EarthField, Force, ForceLaw, MagneticField, Orbit, Wave};
use quasirigid_math::expression::Expression;

use super::wobbler;

const NAN: f64 = f64::NAN;
const GOOD: [f64; 3] = [0.1, -0.2, 0.3];
const BAD: [f64; 3] = [0.1, f64::INFINITY, 0.3];
const STEADY: Wave = Wave { frequency: 0.0, phase: 0.0 };
const CARRIER: ApplicationPoint = ApplicationPoint { on: End::Carrier, at: Some(GOOD) };
const POINT: ApplicationPoint = ApplicationPoint { on: End::Point(0), at: None };
const ORBIT: Orbit = Orbit {
    mu: 3.986e14,
    semi_major_axis: 7e6,
    eccentricity: 0.1,
    inclination: 1.0,
    raan: -2.0,
    argument_of_periapsis: 9.0,
    mean_anomaly: 0.5,
    node_rate: 0.0,
    periapsis_rate: 0.0,
};

fn body(law: ForceLaw<ApplicationPoint>) -> Assembly {
    let force = |law| Force { name: "wind".into(), law };
    // The second force is the one tried.
    Assembly {
        forces: vec![force(ForceLaw::SpinDrag { coefficient: 1.0 }), force(law)],
        ..wobbler::assembly()
    }
}

/// Error of a force; [`Assembly::check`] finds the same one and no other, and the body without the force is accepted.
fn error(law: ForceLaw<ApplicationPoint>) -> Option<ElementError> {
    let assembly = body(law);
    assert!(assembly.body().is_ok());
    let error = assembly.forces().err();
    let texts = |errors: &[ElementError]| errors.iter().map(ToString::to_string).collect::<Vec<_>>();
    assert_eq!(texts(&assembly.check()), texts(error.as_slice()));
    error
}

macro_rules! refused {
    ($law:expr, $field:expr, $problem:pat) => {{
        let error = error($law).unwrap();
        assert_eq!((error.element, error.field), (ElementKind::Force.at(1), $field), "{error}");
        assert!(matches!(error.problem, $problem), "{error}");
        assert!(error.to_string().starts_with("force 2: "), "{error}");
    }};
}

#[test]
fn amplitudes_that_are_not_finite_are_refused() {
    use Problem::NotFinite;
    let torque = |torque, wave| ForceLaw::Torque { torque, axes: Axes::Body, wave };
    let thrust = |force, wave| ForceLaw::Thrust { at: POINT, force, axes: Axes::Inertial, wave };
    let magnet = |moment, field| ForceLaw::MagneticDipole { moment, field };
    refused!(ForceLaw::UniformGravity { acceleration: BAD }, Field::ACCELERATION, NotFinite { .. });
    refused!(torque(BAD, STEADY), Field::TORQUE, NotFinite { .. });
    refused!(thrust(BAD, STEADY), Field::FORCE, NotFinite { .. });
    refused!(thrust(GOOD, Wave { frequency: NAN, phase: 0.0 }), Field::FREQUENCY, NotFinite { .. });
    refused!(torque(GOOD, Wave { frequency: 1.0, phase: NAN }), Field::PHASE, NotFinite { .. });
    refused!(magnet(BAD, MagneticField::Uniform(GOOD)), Field::MOMENT, NotFinite { .. });
    refused!(magnet(GOOD, MagneticField::Uniform(BAD)), Field::MAGNETIC_FIELD, NotFinite { .. });
    let dipole = |strength, orbit| magnet(GOOD, MagneticField::Dipole { strength, rate: 0.0, orbit });
    refused!(dipole(BAD, ORBIT), Field::DIPOLE, NotFinite { .. });
    let low = Orbit { semi_major_axis: 0.0, ..ORBIT };
    refused!(dipole(GOOD, low), Field::SEMI_MAJOR_AXIS, Problem::NotPositive { .. });
    for law in [
        ForceLaw::UniformGravity { acceleration: [0.0; 3] },
        torque(GOOD, Wave { frequency: -1.0, phase: -9.0 }),
        thrust(GOOD, STEADY),
        dipole(GOOD, ORBIT),
    ] {
        assert_eq!(error(law), None);
    }
}

#[test]
fn a_drag_must_not_drive() {
    for value in [-1e-300, -1.0] {
        let drag = ForceLaw::Drag { at: CARRIER, coefficient: value };
        refused!(drag, Field::COEFFICIENT, Problem::Driving { .. });
        refused!(ForceLaw::SpinDrag { coefficient: value }, Field::COEFFICIENT, Problem::Driving { .. });
    }
    refused!(ForceLaw::Drag { at: POINT, coefficient: NAN }, Field::COEFFICIENT, Problem::NotFinite { .. });
    assert_eq!(error(ForceLaw::Drag { at: CARRIER, coefficient: 0.0 }), None);
}

#[test]
fn an_orbit_is_an_ellipse_about_something() {
    let on = |orbit: Orbit| ForceLaw::CentralGravity { orbit: orbit.into() };
    for value in [0.0, -1.0] {
        let centre = Orbit { mu: value, ..ORBIT };
        refused!(on(centre), Field::GRAVITATIONAL_PARAMETER, Problem::NotPositive { .. });
        let size = Orbit { semi_major_axis: value, ..ORBIT };
        refused!(on(size), Field::SEMI_MAJOR_AXIS, Problem::NotPositive { .. });
    }
    for eccentricity in [-1e-9, 1.0, 1.5] {
        refused!(on(Orbit { eccentricity, ..ORBIT }), Field::ECCENTRICITY, Problem::NotElliptic { .. });
    }
    for eccentricity in [0.0, 1.0 - f64::EPSILON] {
        assert_eq!(error(on(Orbit { eccentricity, ..ORBIT })), None);
    }
    let not_finite = [
        (Orbit { mu: NAN, ..ORBIT }, Field::GRAVITATIONAL_PARAMETER),
        (Orbit { semi_major_axis: f64::INFINITY, ..ORBIT }, Field::SEMI_MAJOR_AXIS),
        (Orbit { eccentricity: NAN, ..ORBIT }, Field::ECCENTRICITY),
        (Orbit { inclination: NAN, ..ORBIT }, Field::INCLINATION),
        (Orbit { raan: NAN, ..ORBIT }, Field::NODE),
        (Orbit { argument_of_periapsis: NAN, ..ORBIT }, Field::PERIAPSIS),
        (Orbit { mean_anomaly: NAN, ..ORBIT }, Field::MEAN_ANOMALY),
        (Orbit { node_rate: NAN, ..ORBIT }, Field::PRECESSION),
        (Orbit { periapsis_rate: f64::INFINITY, ..ORBIT }, Field::PRECESSION),
    ];
    for (orbit, field) in not_finite {
        refused!(on(orbit), field, Problem::NotFinite { .. });
    }
}

/// The main field of the Earth is that along an orbit about the Earth, above it, in the years and the degrees of its table.
#[test]
fn the_main_field_is_known_above_the_earth() {
    let within = |field, orbit| ForceLaw::MagneticDipole {
        moment: GOOD,
        field: MagneticField::Earth { field, orbit },
    };
    let earth = EarthField { year: 2024.0, degree: 13, sidereal: 0.3 };
    let nearest = |radius: f64| Orbit { semi_major_axis: radius / 0.9, ..ORBIT };
    let high = nearest(7e6);
    let [first, last] = EarthField::YEARS;
    for year in [first, last] {
        assert_eq!(error(within(EarthField { year, ..earth }, high)), None);
    }
    for year in [first - 1e-9, last + 1e-9] {
        refused!(within(EarthField { year, ..earth }, high), Field::IGRF, Problem::NoMainField { .. });
    }
    for degree in [0, 14] {
        refused!(within(EarthField { degree, ..earth }, high), Field::IGRF, Problem::NoMainField { .. });
    }
    for mu in [0.98, 1.02].map(|share| share * ORBIT.mu) {
        refused!(within(earth, Orbit { mu, ..high }), Field::IGRF, Problem::NotTheEarth { .. });
    }
    refused!(within(earth, nearest(6.35e6)), Field::IGRF, Problem::Underground { .. });
    assert_eq!(error(within(earth, nearest(6.36e6))), None);
}

#[test]
fn a_force_acts_somewhere() {
    let drag = |on, at| ForceLaw::Drag { at: ApplicationPoint { on, at }, coefficient: 1.0 };
    refused!(drag(End::Carrier, None), Field::AT, Problem::NoApplicationPoint);
    refused!(drag(End::Carrier, Some(BAD)), Field::AT, Problem::NotFinite { .. });
    refused!(drag(End::Point(0), Some(GOOD)), Field::AT, Problem::ApplicationPointOnPoint);
    let points = wobbler::assembly().points.len();
    refused!(drag(End::Point(points), None), Field::ON, Problem::NoSuchPoint { .. });
    assert_eq!(error(drag(End::Point(points - 1), None)), None);
}

#[test]
fn the_start_of_a_driven_pole_is_finite() {
    let driven = |velocity, position| {
        let mut assembly = wobbler::assembly();
        let acceleration = ["1", "sin(t)", "0"].map(|text| Expression::parse(text, &["t"]).unwrap());
        assembly.support = Support::Prescribed { point: GOOD, acceleration, velocity, position };
        let error = assembly.body().err();
        assert_eq!(assembly.check().first(), error.as_ref());
        error.map(|error| (error.element, error.field))
    };
    assert_eq!(driven(BAD, GOOD), Some((ElementId::SUPPORT, Field::VELOCITY)));
    assert_eq!(driven(GOOD, BAD), Some((ElementId::SUPPORT, Field::POSITION)));
    assert_eq!(driven(GOOD, GOOD), None);
}

/// Places are from the pole, wherever the body is fixed, and those on a point move with it.
#[test]
fn forces_act_at_their_stations() {
    let drag = |at| ForceLaw::Drag { at, coefficient: 1.0 };
    for support in [Support::Free, Support::FixedPoint { point: [0.7, -0.4, 0.2] }] {
        let mut assembly = body(drag(CARRIER));
        assembly.forces.push(Force { name: "tip".into(), law: drag(POINT) });
        assembly.support = support;
        let (whole, forces) = (assembly.body().unwrap(), assembly.forces().unwrap());
        assert_eq!(forces[0].law.place(), None);
        let on_carrier = forces[1].law.place().unwrap();
        let from_pole = Vector3::from(GOOD) - Vector3::from(whole.pole());
        assert_eq!((&on_carrier.name[..], on_carrier.position), ("wind", from_pole.into()));
        assert!(on_carrier.shapes.is_empty());
        assert_eq!(forces[2].law.place(), whole.markers().first());
    }
}
