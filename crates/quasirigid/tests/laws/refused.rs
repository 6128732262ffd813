//! Impossible bodies are refused, with the place and the value; nothing is repaired. Thresholds on both sides.

use quasirigid::elements::{
    Assembly, Carrier, Coefficient, ElementError, ElementId, ElementKind, End, Field, HingeCoefficient,
    Point, PointMotion, Problem, SpringLaw,
};
use quasirigid::model::{InertiaError, Support};
use quasirigid::reduction::{MAX_ORDER, ReductionError, Validity, ValidityError, reduce};

use super::wobbler;
use crate::support::parts;

/// Error of the body with one change; [`Assembly::check`] finds the same one.
fn error(change: impl Fn(&mut Assembly)) -> Option<ElementError> {
    let mut assembly = wobbler::assembly();
    change(&mut assembly);
    let error = assembly.body().err();
    if let Some(error) = &error {
        let whole = matches!(error.problem, Problem::Mechanism { .. } | Problem::NoInertia { .. });
        let found = assembly.check().iter().map(ToString::to_string).any(|text| text == error.to_string());
        assert!(whole || found, "{error} is not among {:?}", assembly.check());
    } else {
        assert!(assembly.check().is_empty(), "{:?}", assembly.check());
    }
    error
}

fn place_of(change: impl Fn(&mut Assembly)) -> (ElementId, Field) {
    let error = error(change).unwrap();
    (error.element, error.field)
}

macro_rules! refused {
    ($change:expr, $place:expr, $field:expr, $problem:pat) => {{
        let error = error($change).unwrap();
        assert_eq!((error.element, error.field), ($place, $field), "{error}");
        assert!(matches!(error.problem, $problem), "{error}");
        assert!(error.to_string().starts_with(&error.element.to_string()));
    }};
}

fn carrier(assembly: &mut Assembly) -> &mut Carrier {
    assembly.carrier.as_mut().unwrap()
}

fn spatial(assembly: &mut Assembly, coefficient: Coefficient) {
    assembly.springs[0].law =
        SpringLaw::Spatial { stiffness: coefficient, damping: Coefficient::Isotropic(0.0) };
}

fn axial(anchor: Option<[f64; 3]>) -> SpringLaw {
    parts::axial(1.0, 0.0, anchor)
}

/// A second spring beside the good one.
fn second(assembly: &mut Assembly, from: End, to: End, law: SpringLaw) {
    assembly.springs.push(parts::spring(from, to, law));
}

#[test]
fn the_body_without_a_change_is_accepted() {
    assert_eq!(error(|_| {}), None);
}

#[test]
fn numbers_that_are_not_finite_are_refused_wherever_they_stand() {
    const NAN: f64 = f64::NAN;
    const INFINITE: f64 = f64::INFINITY;
    use Problem::{Inertia, NotFinite};
    refused!(|a| carrier(a).mass = NAN, ElementId::CARRIER, Field::MASS, NotFinite { .. });
    refused!(
        |a| carrier(a).center_of_mass[1] = INFINITE,
        ElementId::CARRIER,
        Field::CENTER_OF_MASS,
        NotFinite { .. }
    );
    refused!(
        |a| carrier(a).inertia[1][2] = NAN,
        ElementId::CARRIER,
        Field::INERTIA,
        Inertia(InertiaError::NotFinite { .. })
    );
    refused!(|a| a.points[0].mass = INFINITE, ElementKind::Point.at(0), Field::MASS, NotFinite { .. });
    refused!(|a| a.points[0].position[2] = NAN, ElementKind::Point.at(0), Field::POSITION, NotFinite { .. });
    let line = |a: &mut Assembly| a.points[0].motion = PointMotion::Line([0.0, NAN, 1.0]);
    refused!(line, ElementKind::Point.at(0), Field::MOTION, NotFinite { .. });
    let stiffness = |a: &mut Assembly| spatial(a, Coefficient::Diagonal([1.0, NAN, 1.0]));
    refused!(stiffness, ElementKind::Spring.at(0), Field::STIFFNESS, NotFinite { .. });
    let anchor = |a: &mut Assembly| second(a, End::Point(0), End::Carrier, axial(Some([NAN, 0.0, 0.0])));
    assert!(matches!(error(anchor).unwrap().problem, NotFinite { .. }));
    refused!(|a| a.hinged[0].mass = NAN, ElementKind::Hinged.at(0), Field::MASS, NotFinite { .. });
    refused!(
        |a| a.hinged[0].center_of_mass[0] = NAN,
        ElementKind::Hinged.at(0),
        Field::CENTER_OF_MASS,
        NotFinite { .. }
    );
    refused!(|a| a.hinged[0].hinge[0] = INFINITE, ElementKind::Hinged.at(0), Field::HINGE, NotFinite { .. });
    refused!(|a| a.hinged[0].axes[1][0] = NAN, ElementKind::Hinged.at(0), Field::AXES, NotFinite { .. });
    let damping = |a: &mut Assembly| a.hinged[0].damping = HingeCoefficient::PerAxis(vec![NAN, 1.0]);
    refused!(damping, ElementKind::Hinged.at(0), Field::DAMPING, NotFinite { .. });
    let support = |a: &mut Assembly| a.support = Support::FixedPoint { point: [0.0, NAN, 0.0] };
    refused!(support, ElementId::SUPPORT, Field::FIXED_POINT, NotFinite { .. });
}

#[test]
fn masses_must_be_positive() {
    for mass in [0.0, -1.0, -0.0] {
        refused!(|a| carrier(a).mass = mass, ElementId::CARRIER, Field::MASS, Problem::NotAMass { .. });
        refused!(
            |a| a.points[0].mass = mass,
            ElementKind::Point.at(0),
            Field::MASS,
            Problem::NotAMass { .. }
        );
        refused!(
            |a| a.hinged[0].mass = mass,
            ElementKind::Hinged.at(0),
            Field::MASS,
            Problem::NotAMass { .. }
        );
    }
    assert_eq!(error(|a| a.points[0].mass = 1e-300), None);
}

/// Thresholds are in units of the largest moment, and hold in any unit. (I1)
#[test]
fn inertia_tensors_are_judged_on_both_sides_of_the_line() {
    for unit in [1e-12, 1.0, 1e12] {
        let diagonal = |moments: [f64; 3], shear: f64| {
            move |a: &mut Assembly| {
                let [x, y, z] = moments.map(|moment| unit * moment);
                carrier(a).inertia = [[x, unit * shear, 0.0], [0.0, y, 0.0], [0.0, 0.0, z]];
            }
        };
        let problem = |moments, shear| error(diagonal(moments, shear)).map(|error| error.problem);
        use InertiaError::{Impossible, NotSymmetric};
        use Problem::Inertia;
        // Sum of two moments against the third: the tolerance is 1e-12 of the largest.
        assert_eq!(problem([1.0, 1.0, 2.0 + 1e-12], 0.0), None);
        assert!(matches!(problem([1.0, 1.0, 2.0 + 3e-12], 0.0), Some(Inertia(Impossible { .. }))));
        assert!(matches!(problem([-0.1, 1.0, 1.0], 0.0), Some(Inertia(Impossible { .. }))));
        assert!(matches!(problem([-3e-12, 1.0, 1.0], 0.0), Some(Inertia(Impossible { .. }))));
        assert!(matches!(problem([1.0, 1.0, 1.0], 3e-12), Some(Inertia(NotSymmetric { .. }))));
        assert_eq!(problem([1.0, 1.0, 1.0], 0.9e-12), None);
    }
    refused!(
        |a| a.hinged[0].inertia[0][0] = 1.0,
        ElementKind::Hinged.at(0),
        Field::INERTIA,
        Problem::Inertia(InertiaError::Impossible { .. })
    );
}

#[test]
fn directions_need_a_length() {
    let motion = |motion: PointMotion| move |a: &mut Assembly| a.points[0].motion = motion;
    refused!(
        motion(PointMotion::Line([0.0; 3])),
        ElementKind::Point.at(0),
        Field::MOTION,
        Problem::ZeroDirection
    );
    refused!(
        motion(PointMotion::Plane([0.0; 3])),
        ElementKind::Point.at(0),
        Field::MOTION,
        Problem::ZeroDirection
    );
    refused!(
        |a| a.hinged[0].axes[0] = [0.0; 3],
        ElementKind::Hinged.at(0),
        Field::AXES,
        Problem::ZeroDirection
    );
    assert_eq!(error(motion(PointMotion::Line([0.0, 1e-300, 0.0]))), None);
    assert_eq!(error(motion(PointMotion::Plane([1e300, 1e300, 0.0]))), None);
}

#[test]
fn coefficients_must_be_symmetric_and_take_energy() {
    let full = |entry: f64, mirror: f64| {
        move |a: &mut Assembly| {
            spatial(a, Coefficient::Full([[9.0, entry, 0.0], [mirror, 9.0, 0.0], [0.0, 0.0, 9.0]]));
        }
    };
    refused!(full(1.0, 2.0), ElementKind::Spring.at(0), Field::STIFFNESS, Problem::NotSymmetric { .. });
    refused!(
        full(1.0, 1.0 + 2e-11),
        ElementKind::Spring.at(0),
        Field::STIFFNESS,
        Problem::NotSymmetric { .. }
    );
    assert_eq!(error(full(1.0, 1.0 + 5e-12)), None);
    refused!(full(9.1, 9.1), ElementKind::Spring.at(0), Field::STIFFNESS, Problem::Indefinite { .. });
    refused!(
        |a| a.springs[0].law = axial(Some([0.0; 3])).with_stiffness(-1.0),
        ElementKind::Spring.at(0),
        Field::STIFFNESS,
        Problem::Indefinite { .. }
    );
    let damping = |value: f64| {
        move |a: &mut Assembly| {
            a.hinged[0].damping = HingeCoefficient::Full(vec![vec![1.0, value], vec![value, 1.0]]);
        }
    };
    // Smallest eigenvalue 1 − value against 1e-12 of the largest entry.
    assert_eq!(error(damping(1.0 + 0.5e-12)), None);
    refused!(damping(1.0 + 3e-12), ElementKind::Hinged.at(0), Field::DAMPING, Problem::Indefinite { .. });
}

trait WithStiffness {
    fn with_stiffness(self, value: f64) -> Self;
}

impl WithStiffness for SpringLaw {
    fn with_stiffness(self, value: f64) -> Self {
        let SpringLaw::Axial { damping, anchor, .. } = self else { return self };
        parts::axial(value, damping, anchor)
    }
}

#[test]
fn springs_need_two_ends_and_axial_ones_a_line() {
    let (point, carrier) = (End::Point(0), End::Carrier);
    let place = wobbler::assembly().points[0].position;
    let with = |from: End, to: End, law: SpringLaw| move |a: &mut Assembly| second(a, from, to, law);
    refused!(with(point, point, axial(None)), ElementKind::Spring.at(1), Field::TO, Problem::SameEnds);
    refused!(with(carrier, carrier, axial(None)), ElementKind::Spring.at(1), Field::TO, Problem::SameEnds);
    let isotropic = parts::isotropic(1.0, 0.0);
    refused!(
        with(carrier, End::Point(7), isotropic),
        ElementKind::Spring.at(1),
        Field::TO,
        Problem::NoSuchPoint { index: 7 }
    );
    refused!(
        with(End::Point(1), carrier, axial(None)),
        ElementKind::Spring.at(1),
        Field::FROM,
        Problem::NoSuchPoint { .. }
    );
    refused!(with(point, carrier, axial(None)), ElementKind::Spring.at(1), Field::TO, Problem::NoAnchor);
    refused!(with(carrier, point, axial(None)), ElementKind::Spring.at(1), Field::FROM, Problem::NoAnchor);
    refused!(with(point, carrier, axial(Some(place))), ElementKind::Spring.at(1), Field::TO, Problem::NoLine);
    assert_eq!(error(with(point, carrier, axial(Some([0.0; 3])))), None);
}

/// Appendage that is a thin rod along x from its hinge: it has no inertia about its own line.
fn rod(assembly: &mut Assembly, axes: Vec<[f64; 3]>) {
    let rod = &mut assembly.hinged[0];
    rod.hinge = [0.0; 3];
    rod.center_of_mass = [0.5, 0.0, 0.0];
    rod.inertia = [[0.0; 3], [0.0, 0.01, 0.0], [0.0, 0.0, 0.01]];
    rod.stiffness = HingeCoefficient::PerAxis(vec![2.0; axes.len()]);
    rod.damping = HingeCoefficient::PerAxis(vec![0.1; axes.len()]);
    rod.axes = axes;
}

#[test]
fn hinges_have_one_to_three_independent_axes_that_move_mass() {
    let with = |axes: Vec<[f64; 3]>| move |a: &mut Assembly| rod(a, axes.clone());
    let (y, z) = ([0.0, 1.0, 0.0], [0.0, 0.0, 1.0]);
    for count in [0, 4] {
        let mut assembly = wobbler::assembly();
        rod(&mut assembly, vec![y; count]);
        assert_eq!(assembly.body().unwrap_err().problem, Problem::AxisCount { count });
    }
    refused!(with(vec![y, [0.0, -2.0, 0.0]]), ElementKind::Hinged.at(0), Field::AXES, Problem::DependentAxes);
    refused!(
        with(vec![y, z, [0.0, 1.0, 1.0]]),
        ElementKind::Hinged.at(0),
        Field::AXES,
        Problem::DependentAxes
    );
    // Independent if the sine of the angle is above 1e-6.
    refused!(
        with(vec![y, [0.0, 1.0, 0.9e-6]]),
        ElementKind::Hinged.at(0),
        Field::AXES,
        Problem::DependentAxes
    );
    let assembly = |axes: Vec<[f64; 3]>| {
        let mut assembly = wobbler::assembly();
        rod(&mut assembly, axes);
        assembly.check()
    };
    assert_eq!(assembly(vec![y, [0.0, 1.0, 1.1e-6]]), []);
    // A rod has no inertia about its own line; an axis moves mass above 1e-12 of the largest moment, so for a sine above 1e-6.
    refused!(
        with(vec![[1.0, 0.0, 0.0]]),
        ElementKind::Hinged.at(0),
        Field::AXES,
        Problem::MasslessAxis { axis: 1 }
    );
    refused!(
        with(vec![y, [1.0, 0.0, 0.9e-6]]),
        ElementKind::Hinged.at(0),
        Field::AXES,
        Problem::MasslessAxis { axis: 2 }
    );
    assert_eq!(assembly(vec![y, [1.0, 0.0, 1.1e-6]]), []);
    let values = |a: &mut Assembly| a.hinged[0].stiffness = HingeCoefficient::PerAxis(vec![1.0]);
    refused!(
        values,
        ElementKind::Hinged.at(0),
        Field::STIFFNESS,
        Problem::ValuePerAxis { axes: 2, values: 1 }
    );
    let ragged =
        |a: &mut Assembly| a.hinged[0].damping = HingeCoefficient::Full(vec![vec![1.0, 0.0], vec![0.0]]);
    refused!(ragged, ElementKind::Hinged.at(0), Field::DAMPING, Problem::ValuePerAxis { axes: 2, values: 1 });
}

#[test]
fn names_are_unique_among_points_and_appendages() {
    let name = |a: &mut Assembly| a.hinged[0].name = "mass".into();
    assert_eq!(place_of(name), (ElementKind::Hinged.at(0), Field::NAME));
    assert!(matches!(error(name).unwrap().problem, Problem::DuplicateName { name } if name == "mass"));
}

/// A dumb-bell rotates about its own line without inertia. The limit between the two is √ε of the largest moment.
#[test]
fn a_body_without_inertia_about_some_axis_is_refused() {
    let needle = |across: f64| {
        move |a: &mut Assembly| {
            a.points.clear();
            a.springs.clear();
            a.hinged.clear();
            carrier(a).center_of_mass = [0.0; 3];
            carrier(a).inertia = [[across, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
        }
    };
    refused!(needle(0.0), ElementId::CARRIER, Field::INERTIA, Problem::NoInertia { .. });
    refused!(needle(1.4e-8), ElementId::CARRIER, Field::INERTIA, Problem::NoInertia { .. });
    assert_eq!(error(needle(1.6e-8)), None);
    let speck = |a: &mut Assembly| {
        needle(0.0)(a);
        carrier(a).inertia = [[0.0; 3]; 3];
    };
    refused!(speck, ElementId::CARRIER, Field::INERTIA, Problem::NoInertia { .. });
}

/// Three points in a line on a body without a carrier; the slightest bend gives it inertia.
#[test]
fn a_floating_line_of_points_is_refused() {
    let floating = |bend: f64| {
        let point = |x: f64, y: f64| Point {
            name: format!("at {x}"),
            mass: 2.0,
            position: [0.3 + x, 0.1 + y, -0.7],
            motion: PointMotion::Free,
        };
        let law = parts::isotropic(50.0, 0.0);
        let spring = |from: usize, to: usize| parts::spring(End::Point(from), End::Point(to), law);
        let points = vec![point(0.0, 0.0), point(1.0, bend), point(2.5, 0.0)];
        let springs = vec![spring(0, 1), spring(1, 2), spring(0, 2)];
        Assembly { points, springs, ..Assembly::default() }.body()
    };
    let error = floating(0.0).unwrap_err();
    assert_eq!((error.element, error.field), (ElementKind::Point.at(0), Field::INERTIA));
    assert!(matches!(error.problem, Problem::NoInertia { .. }), "{error}");
    assert!(floating(0.1).is_ok());
}

#[test]
fn orders_above_the_highest_are_refused() {
    let body = wobbler::assembly().body().unwrap();
    let order = MAX_ORDER + 1;
    assert_eq!(reduce(&body, order).unwrap_err(), ReductionError::Order { order });
    let error = Validity::assess(&body, order, [0.0, 0.0, 1.0]).unwrap_err();
    assert_eq!(error, ValidityError::Reduction(ReductionError::Order { order }));
    assert!(reduce(&body, 0).is_ok() && reduce(&body, MAX_ORDER).is_ok());
    for omega in [[0.0; 3], [f64::NAN; 3], [f64::INFINITY, 0.0, 0.0]] {
        assert!(matches!(Validity::assess(&body, 3, omega), Err(ValidityError::NoSpin { .. })));
    }
}
