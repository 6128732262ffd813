//! Springs that act across the line between their ends resist a rotation of the whole body, which floats in its Tisserand frame all the
//! same. (K15)

use nalgebra::{DMatrix, Matrix3, SymmetricEigen, Vector3};
use quasirigid::elements::{
    Anchor, Assembly, Coefficient, Connection, End, Frame, FrameNode, Member, NodeRef, Part, PartKind,
    PartReduction, Point, PointMotion, SectionShape, SpringLaw,
};
use quasirigid::model::{FlexibleBody, Rheology};
use quasirigid::reduction::reduce;
use quasirigid_math::eigen::{Dense, modes};

use super::common::{Numbers, turned_axes};
use crate::support::parts;

const POINTS: usize = 12;
/// Number of coordinates of a floating body of these points.
const COORDINATES: usize = 3 * POINTS - 6;

/// Places (m) and masses (kg) of the points.
fn points() -> Vec<(Vector3<f64>, f64)> {
    let mut numbers = Numbers(1973);
    let mut place = || Vector3::from_fn(|_, _| numbers.next()) + Vector3::new(3.7, -0.4, 1.6);
    let places: Vec<Vector3<f64>> = (0..POINTS).map(|_| place()).collect();
    places.into_iter().map(|place| (place, 1.3 + 0.8 * numbers.next())).collect()
}

/// A full law that is no multiple of the unit matrix, and one that acts along the line alone.
fn laws(pair: usize) -> Option<Matrix3<f64>> {
    let turned = turned_axes().matrix() * Matrix3::from_diagonal(&Vector3::new(40.0, 75.0, 130.0));
    let law = turned * turned_axes().inverse();
    (pair % 3 != 2).then(|| (0.5 + 0.02 * pair as f64) * 0.5 * (law + law.transpose()))
}

fn pairs() -> impl Iterator<Item = (usize, usize, usize)> {
    (0..POINTS).flat_map(|i| (0..i).map(move |j| (i, j))).enumerate().map(|(pair, (i, j))| (pair, i, j))
}

const ALONG: f64 = 55.0;
/// Kelvin–Voigt time of every spring (s).
const TIME: f64 = 0.02;

fn network(unit: f64, order: usize, kept: usize) -> FlexibleBody {
    let points = points().into_iter().enumerate().map(|(i, (place, mass))| Point {
        name: format!("{i}"),
        mass,
        position: (unit * place).into(),
        motion: PointMotion::Free,
    });
    let rows = |matrix: Matrix3<f64>| std::array::from_fn(|i| std::array::from_fn(|j| matrix[(i, j)]));
    let springs = pairs().map(|(pair, i, j)| {
        parts::spring(
            End::Point(i),
            End::Point(j),
            match laws(pair) {
                Some(law) => SpringLaw::Spatial {
                    stiffness: Coefficient::Full(rows(law)),
                    damping: Coefficient::Full(rows(TIME * law)),
                },
                None => parts::axial(ALONG, TIME * ALONG, None),
            },
        )
    });
    let reduction = PartReduction { order, modes: kept };
    Assembly { points: points.collect(), springs: springs.collect(), reduction, ..Assembly::default() }
        .body()
        .unwrap()
}

fn stiffness(points: &[(Vector3<f64>, f64)]) -> DMatrix<f64> {
    let mut K = DMatrix::zeros(3 * POINTS, 3 * POINTS);
    for (pair, i, j) in pairs() {
        let line = (points[i].0 - points[j].0).normalize();
        let law = laws(pair).unwrap_or(ALONG * line * line.transpose());
        for (a, b, sign) in [(i, i, 1.0), (j, j, 1.0), (i, j, -1.0), (j, i, -1.0)] {
            let mut block = K.fixed_view_mut::<3, 3>(3 * a, 3 * b);
            block += sign * law;
        }
    }
    K
}

/// Frequencies of all displacements without linear or angular momentum: an orthonormal basis of them in the inner product of the masses.
fn frequencies_by_definition() -> Vec<f64> {
    let points = points();
    let total: f64 = points.iter().map(|(_, mass)| mass).sum();
    let center = points.iter().map(|(place, mass)| *mass * place).sum::<Vector3<f64>>() / total;
    let mut rigid = DMatrix::zeros(3 * POINTS, 6);
    for (i, (place, mass)) in points.iter().enumerate() {
        let mut block = rigid.fixed_view_mut::<3, 6>(3 * i, 0);
        block.fixed_columns_mut::<3>(0).copy_from(&(mass.sqrt() * Matrix3::identity()));
        block.fixed_columns_mut::<3>(3).copy_from(&(-mass.sqrt() * (place - center).cross_matrix()));
    }
    let gram = rigid.transpose() * &rigid;
    let free =
        DMatrix::identity(3 * POINTS, 3 * POINTS) - &rigid * gram.try_inverse().unwrap() * rigid.transpose();
    let scaled = stiffness(&points)
        .map_with_location(|a, b, entry| entry / (points[a / 3].1 * points[b / 3].1).sqrt());
    let mut squares: Vec<f64> =
        SymmetricEigen::new(&free * scaled * &free).eigenvalues.iter().copied().collect();
    squares.sort_by(f64::total_cmp);
    squares[6..].iter().map(|square| square.sqrt()).collect()
}

/// Frequencies with the axes fixed, the lowest first.
fn held(body: &FlexibleBody) -> Vec<f64> {
    modes(&body.mass_matrix(), &Dense::of(body.stiffness())).unwrap().frequencies
}

/// All modes that the points have without their rigid motions, in any unit of length.
#[test]
fn a_network_of_skew_springs_has_the_frequencies_of_its_definition() {
    let expected = frequencies_by_definition();
    for unit in [1.0, 1e-6, 1e7] {
        let found = held(&network(unit, 3, COORDINATES));
        assert_eq!(found.len(), COORDINATES, "unit {unit}");
        for (mode, (found, expected)) in found.iter().zip(&expected).enumerate() {
            assert!((found / expected - 1.0).abs() < 1e-10, "unit {unit}, mode {mode}: {found} {expected}");
        }
    }
}

/// Three equal masses in a triangle, an isotropic spring along each side: all displacements without linear or angular momentum have `Ω² =
/// 3k/m`.
#[test]
fn a_triangle_of_isotropic_springs_has_one_frequency_thrice() {
    let places = [[0.3, 0.0, 0.1], [1.7, 0.2, -0.4], [0.9, 1.6, 0.5]];
    let points = places.map(|place| Point {
        name: format!("{}", place[0]),
        mass: 2.0,
        position: (turned_axes() * Vector3::from(place)).into(),
        motion: PointMotion::Free,
    });
    let springs = [(0, 1), (1, 2), (2, 0)]
        .map(|(i, j)| parts::spring(End::Point(i), End::Point(j), parts::isotropic(45.0, 0.0)));
    let reduction = PartReduction { order: 3, modes: 3 };
    let body =
        Assembly { points: points.to_vec(), springs: springs.to_vec(), reduction, ..Assembly::default() }
            .body()
            .unwrap();
    let found = held(&body);
    assert!(found.iter().all(|found| (found / 67.5_f64.sqrt() - 1.0).abs() < 1e-12), "{found:?}");
}

/// The few coordinates of an order have the reduced equations of all.
#[test]
fn few_coordinates_of_skew_springs_have_the_slow_motion_of_all() {
    for order in [3, 4, 5] {
        let (few, all) = (network(1.0, order, 0), network(1.0, 5, COORDINATES));
        let (found, expected) = (reduce(&few, order).unwrap(), reduce(&all, order).unwrap());
        for omega in [[0.9, 0.4, -0.3], [0.2, -1.1, 0.7]] {
            let (found, expected) = (found.torque(omega), expected.torque(omega));
            let scale = expected.iter().fold(0.0_f64, |largest, entry| largest.max(entry.abs()));
            for axis in 0..3 {
                assert!((found[axis] - expected[axis]).abs() < 1e-9 * scale, "order {order}, axis {axis}");
            }
        }
    }
    assert!(network(1.0, 3, 0).coordinates().len() < COORDINATES);
}

/// Beams of the model that was refused: a whip with a bend and a beam on a hinge, a spring between their tips.
fn beams(kept: usize) -> FlexibleBody {
    let node = |name: &str, position| FrameNode { name: name.to_owned(), position };
    let frame = |name: &str, nodes, ends: &[[usize; 2]], section: SectionShape| {
        let member = |ends: &[usize; 2]| Member {
            name: String::new(),
            ends: *ends,
            section,
            up: Some([0.0, 0.0, 1.0]),
            material: parts::elastic(2700.0, 70e9, 0.33),
            elements: 3,
        };
        let kind = PartKind::Frame(Frame { nodes, members: ends.iter().map(member).collect() });
        Part { name: name.to_owned(), kind, masses: Vec::new(), attached: Vec::new(), rayleigh: [0.01, 3e-4] }
    };
    let whip =
        vec![node("root", [0.0, 0.4, 0.0]), node("tip", [0.0, 1.4, 0.0]), node("side", [0.5, 1.4, 0.2])];
    let other = vec![node("root", [0.0, 0.4, 0.0]), node("tip", [1.0, 0.4, 0.3])];
    let thin = SectionShape::Rectangle { height: 0.02, width: 0.01 };
    let thick = SectionShape::Rectangle { height: 0.03, width: 0.02 };
    let parts = vec![frame("whip", whip, &[[0, 1], [1, 2]], thin), frame("b2", other, &[[0, 1]], thick)];
    let at = |part, node| NodeRef { part, node };
    let hinge = Connection {
        from: Anchor::Nodes { part: 0, nodes: vec![0] },
        to: Anchor::Nodes { part: 1, nodes: vec![0] },
        axes: vec![[0.0, 0.0, 1.0]],
        stiffness: vec![40.0],
        damping: vec![1.0],
        rheology: Rheology::Elastic,
    };
    let spring = parts::spring(End::Node(at(0, 1)), End::Node(at(1, 1)), parts::isotropic(15.0, 0.0));
    let reduction = PartReduction { order: 3, modes: kept };
    Assembly { parts, connections: vec![hinge], springs: vec![spring], reduction, ..Assembly::default() }
        .body()
        .unwrap()
}

/// Two requested modes are the lowest two of all. The iteration finds an eigenvalue to the square of 1e-4.
#[test]
fn modes_of_beams_with_a_skew_spring_are_found() {
    let (two, forty) = (held(&beams(2)), held(&beams(40)));
    for mode in 0..2 {
        assert!((two[mode] / forty[mode] - 1.0).abs() < 1e-6, "{} {}", two[mode], forty[mode]);
    }
}
