//! Condensation: reduced equations of a body of many points, from all its coordinates and from the few of a part.
//! The body is the same for both, so a difference at an order up to the one asked for is a vector missing from the space.
//! Equation (K8), docs/theory/12-structures.md.

use quasirigid_body::Rheology;
use quasirigid_dynamics::reduction::reduce;
use quasirigid_elements::problems::ring_of_points;
use quasirigid_elements::{
    Assembly, Coefficient, End, Matrices, NodalMass, Part, PartKind, PartReduction, Spring, SpringLaw,
};

/// Entries of a matrix over the displacements of the points.
type Entries = Vec<(usize, usize, f64)>;

/// Entries of a spring between two points, or between a point and the carrier.
fn joined(spring: &Spring, matrix: [[f64; 3]; 3]) -> Entries {
    let point = |end: End| if let End::Point(index) = end { Some(index) } else { None };
    let ends = [(point(spring.from), -1.0), (point(spring.to), 1.0)];
    let ends: Vec<(usize, f64)> = ends.into_iter().filter_map(|(point, sign)| Some((point?, sign))).collect();
    let mut entries = Vec::new();
    for (a, b) in ends.iter().flat_map(|a| ends.iter().map(move |b| (a, b))) {
        for (i, k) in (0..9).map(|place| (place / 3, place % 3)) {
            entries.push((3 * a.0 + i, 3 * b.0 + k, a.1 * b.1 * matrix[i][k]));
        }
    }
    entries
}

/// The points and springs of a body as matrices of a part on its carrier.
fn matrices(assembly: &Assembly) -> Matrices {
    let (mut stiffness, mut damping) = (Entries::new(), Entries::new());
    for spring in &assembly.springs {
        let SpringLaw::Spatial { stiffness: Coefficient::Full(k), damping: Coefficient::Full(c) } =
            spring.law
        else {
            panic!("a full spring")
        };
        stiffness.extend(joined(spring, k));
        damping.extend(joined(spring, c));
    }
    let points = &assembly.points;
    let masses = points
        .iter()
        .enumerate()
        .flat_map(|(node, point)| (0..3).map(move |axis| (3 * node + axis, 3 * node + axis, point.mass)));
    Matrices {
        mass: NodalMass {
            nodes: points.iter().map(|point| point.position).collect(),
            node_labels: (1..=points.len() as u64).collect(),
            dofs: (0..3 * points.len()).map(|row| (row / 3, row % 3)).collect(),
            entries: masses.collect(),
        },
        stiffness,
        damping,
        rheology: Rheology::Elastic,
    }
}

/// Reduced equations of the few coordinates are those of the many to the order that the part is made for.
#[test]
fn few_coordinates_have_the_slow_motion_of_the_many() {
    let assembly = ring_of_points(40);
    let points = assembly.body().unwrap();
    let part = Part {
        name: "ring".to_owned(),
        kind: PartKind::Matrices(matrices(&assembly)),
        masses: Vec::new(),
        attached: Vec::new(),
        rayleigh: [0.0; 2],
    };
    let condensed = Assembly { points: Vec::new(), springs: Vec::new(), parts: vec![part], ..assembly };
    for order in [3, 4, 5] {
        let reduction = PartReduction { order, modes: 0 };
        let few = Assembly { reduction, ..condensed.clone() }.body().unwrap();
        let coordinates = few.coordinates().len();
        assert!(coordinates < points.coordinates().len(), "{coordinates} coordinates");
        let (all, few) = (reduce(&points, order).unwrap(), reduce(&few, order).unwrap());
        // fast, or the highest orders would be lost among the lowest
        for omega in [[27.0, 12.0, -9.0], [6.0, -33.0, 21.0]] {
            let (expected, found) = (all.torque(omega), few.torque(omega));
            let scale = expected.iter().fold(0.0_f64, |largest, entry| largest.max(entry.abs()));
            for axis in 0..3 {
                assert!((found[axis] - expected[axis]).abs() < 1e-9 * scale, "order {order}, axis {axis}");
            }
        }
    }
}
