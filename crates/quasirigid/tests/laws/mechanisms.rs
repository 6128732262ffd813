//! Bodies with a motion that no spring resists are refused, and the motion is named. (I9)

use proptest::prelude::*;
use quasirigid::elements::{
    Assembly, ElementError, ElementId, ElementKind, End, HingeCoefficient, Point, PointMotion, Problem,
    Spring,
};

use super::wobbler;
use crate::support::parts;
use crate::support::{bodies, cases};

fn point(name: &str, position: [f64; 3], motion: PointMotion) -> Point {
    Point { name: name.into(), mass: 0.2, position, motion }
}

fn isotropic(from: End, to: End, stiffness: f64) -> Spring {
    let law = parts::isotropic(stiffness, 0.01 * stiffness);
    parts::spring(from, to, law)
}

fn axial(from: End, to: End, anchor: Option<[f64; 3]>) -> Spring {
    parts::spring(from, to, parts::axial(5.0, 0.1, anchor))
}

fn body(points: Vec<Point>, springs: Vec<Spring>) -> Assembly {
    let inertia = [[1.0, 0.1, 0.0], [0.1, 1.4, 0.0], [0.0, 0.0, 1.2]];
    let carrier = parts::carrier(2.0, [0.1, 0.0, -0.1], inertia);
    Assembly { carrier: Some(carrier), points, springs, ..Assembly::default() }
}

/// Element blamed and coordinates named.
fn named(assembly: &Assembly) -> (ElementId, String) {
    let ElementError { element, problem, .. } = assembly.body().unwrap_err();
    let Problem::Mechanism { coordinates } = problem else { panic!("{problem}") };
    (element, coordinates)
}

#[test]
fn a_point_without_a_spring_is_a_mechanism() {
    let points = vec![
        point("held", [0.5, 0.0, 0.2], PointMotion::Free),
        point("loose", [0.0, 0.7, 0.1], PointMotion::Free),
    ];
    let mut assembly = body(points, vec![isotropic(End::Point(0), End::Carrier, 9.0)]);
    let (place, coordinates) = named(&assembly);
    assert_eq!(place, ElementKind::Point.at(1));
    assert!(coordinates.starts_with("\"loose\"") && !coordinates.contains("held"), "{coordinates}");
    assembly.springs.push(isotropic(End::Carrier, End::Point(1), 1e-9));
    assert!(assembly.body().is_ok(), "a weak spring is a spring");
}

#[test]
fn a_point_on_an_axial_spring_alone_moves_across_it() {
    let place = [0.5, 0.3, 0.2];
    let free = body(
        vec![point("tip", place, PointMotion::Free)],
        vec![axial(End::Point(0), End::Carrier, Some([0.1, 0.3, 0.2]))],
    );
    let (blamed, coordinates) = named(&free);
    assert_eq!(blamed, ElementKind::Point.at(0));
    assert!(coordinates.contains("\"tip\" y") || coordinates.contains("\"tip\" z"), "{coordinates}");
    assert!(!coordinates.contains("\"tip\" x"), "the spring lies along x: {coordinates}");
    let skew = body(
        vec![point("tip", place, PointMotion::Free)],
        vec![axial(End::Point(0), End::Carrier, Some([-0.3, 0.1, 0.9]))],
    );
    assert_eq!(named(&skew).0, ElementKind::Point.at(0));
    let line = PointMotion::Line([1.0, 0.2, 0.0]);
    let held = body(vec![point("tip", place, line)], free.springs.clone());
    assert!(held.body().is_ok(), "a line along the spring is held");
    let across = body(vec![point("tip", place, PointMotion::Line([0.0, 1.0, 0.0]))], free.springs);
    assert_eq!(named(&across).1, "\"tip\" along its line");
}

#[test]
fn two_points_joined_only_to_each_other_are_a_mechanism() {
    let points = vec![
        point("one", [0.5, 0.0, 0.2], PointMotion::Free),
        point("two", [0.0, 0.7, 0.1], PointMotion::Free),
        point("held", [0.2, 0.2, 0.9], PointMotion::Free),
    ];
    let springs =
        vec![isotropic(End::Point(0), End::Point(1), 9.0), isotropic(End::Point(2), End::Carrier, 9.0)];
    let mut assembly = body(points, springs);
    let (place, coordinates) = named(&assembly);
    assert!([0, 1].map(|index| ElementKind::Point.at(index)).contains(&place), "{place}");
    assert!(coordinates.contains("one") && coordinates.contains("two"), "{coordinates}");
    assert!(!coordinates.contains("held"), "{coordinates}");
    assembly.springs.push(isotropic(End::Point(1), End::Carrier, 9.0));
    assert!(assembly.body().is_ok());
}

#[test]
fn a_hinge_without_stiffness_about_a_skew_axis_is_a_mechanism() {
    let mut assembly = wobbler::assembly();
    assembly.hinged[0].stiffness = HingeCoefficient::PerAxis(vec![14.0, 0.0]);
    let hung = assembly.body().unwrap();
    assert_eq!(hung.hung().unwrap().names(), "\"boom\" about axis 2", "a spin may restore it");
    assembly.hinged[0].stiffness = HingeCoefficient::Full(vec![vec![4.0, 2.0], vec![2.0, 1.0]]);
    let (place, coordinates) = named(&assembly);
    assert_eq!(place, ElementKind::Hinged.at(0));
    assert!(coordinates.contains("axis 1") && coordinates.contains("axis 2"), "{coordinates}");
    assembly.hinged[0].stiffness = HingeCoefficient::Full(vec![vec![4.0, 2.0], vec![2.0, 1.0 + 1e-9]]);
    assert!(assembly.body().is_ok(), "soft in one combination of angles, but held");
}

/// Dashpots resist no displacement.
#[test]
fn a_dashpot_alone_is_a_mechanism() {
    let law = parts::isotropic(0.0, 3.0);
    let spring = parts::spring(End::Point(0), End::Carrier, law);
    let assembly =
        body(vec![point("slow", [0.5, 0.0, 0.2], PointMotion::Plane([0.0, 0.3, 1.0]))], vec![spring]);
    let (_, coordinates) = named(&assembly);
    assert!(coordinates.starts_with("\"slow\" in its plane"), "{coordinates}");
}

#[test]
fn many_loose_coordinates_are_counted_rather_than_named() {
    let names = ["a", "b", "c", "d"];
    let points: Vec<_> = (0..4u8)
        .map(|i| {
            point(names[usize::from(i)], [0.3 * f64::from(i), 0.2, -0.4], PointMotion::Line([1.0, 1.0, 1.0]))
        })
        .collect();
    let springs = (1..4).map(|i| isotropic(End::Point(i - 1), End::Point(i), 1.0)).collect();
    let (_, coordinates) = named(&body(points, springs));
    assert_eq!(coordinates.matches("along its line").count(), 4, "{coordinates}");
    let points: Vec<_> = (0..4u8)
        .flat_map(|i| {
            let place = [0.3 * f64::from(i), 0.2, -0.4];
            [0, 1].map(|k| point(&format!("{i}{k}"), place, PointMotion::Line([1.0, 1.0, 1.0])))
        })
        .collect();
    let springs = (1..8).map(|i| isotropic(End::Point(i - 1), End::Point(i), 1.0)).collect();
    let (_, coordinates) = named(&body(points, springs));
    assert!(coordinates.ends_with("and 2 more"), "{coordinates}");
}

proptest! {
    #![proptest_config(cases(48))]

    /// A loose point is found in any units, and whatever else the body has.
    #[test]
    fn a_loose_point_is_found_in_every_body(assembly in bodies()) {
        let mut loose = assembly;
        let position = loose.points[0].position;
        let mass = loose.points[0].mass;
        loose.points.push(parts::free_point("loose", mass, position));
        let (place, coordinates) = named(&loose);
        prop_assert_eq!(place, ElementKind::Point.at(loose.points.len() - 1));
        prop_assert!(coordinates.starts_with("\"loose\""), "{coordinates}");
    }

    /// All springs of a point removed, those of the others left.
    #[test]
    fn taking_the_springs_of_a_point_away_makes_a_mechanism(assembly in bodies()) {
        let mut loose = assembly;
        loose.springs.retain(|spring| spring.from != End::Point(0) && spring.to != End::Point(0));
        prop_assert_eq!(named(&loose).0, ElementKind::Point.at(0));
    }
}
