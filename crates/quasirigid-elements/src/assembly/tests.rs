//! Condensation: reduced equations of a body of many points, from all its coordinates and from the few of a component.
//! The body is the same for both, so a difference at an order up to the one asked for is a vector missing from the space.
//! Equation (K8), docs/theory/12-structures.md.

use nalgebra::{Matrix3, Vector3};

use crate::contribution::Matrices;
use crate::finite::{Connectivity, Link, Mass};
use crate::math::sparse::SparseRows;
use crate::model::{
    BodyParts, Coordinate, FlexibleBody, Invariants, Marker, Pair, Rheology, Support, Wheels,
};
use crate::problems::ring_of_points;
use crate::structure::{Component, CondensationOptions, Constraint, Dofs, Load, Node, Structure};
use crate::{Assembly, Coefficient, End, SpringLaw};
use quasirigid_dynamics::reduction::reduce;

/// Structure of the points and springs of a body on its carrier.
fn structure(assembly: &Assembly) -> Structure {
    let mut structure = Structure::default();
    let material = structure.material(&Rheology::Elastic, [0.0; 2]);
    for (node, point) in assembly.points.iter().enumerate() {
        let place = Vector3::from(point.position);
        structure.nodes.push(Node { place, rotations: false });
        structure.constraints.push(Constraint::Free);
        let points = vec![(point.mass, Vector3::zeros())];
        let connectivity = Connectivity { nodes: vec![node], dofs: 3, material };
        structure.elements.push(Box::new(Mass { connectivity, points, place }));
    }
    let carrier = structure.nodes.len();
    structure.nodes.push(Node { place: Vector3::zeros(), rotations: false });
    structure.constraints.push(Constraint::On { base: None, axes: Vec::new() });
    let node = |end: End| if let End::Point(index) = end { index } else { carrier };
    for spring in &assembly.springs {
        let SpringLaw::Spatial { stiffness: Coefficient::Full(k), damping: Coefficient::Full(c) } =
            spring.law
        else {
            panic!("a full spring")
        };
        structure.elements.push(Box::new(Link::new(
            [node(spring.from), node(spring.to)],
            material,
            [-Matrix3::identity(), Matrix3::identity()],
            [Matrix3::from(k), Matrix3::from(c)],
        )));
    }
    structure
}

/// Free body of a carrier and a component.
fn body(assembly: &Assembly, component: &Component) -> FlexibleBody {
    let whole = Assembly { points: Vec::new(), springs: Vec::new(), ..assembly.clone() }.body().unwrap();
    let (mass, center) = (whole.invariants().mass, Vector3::from(whole.center_of_mass()));
    let total = mass + component.mass();
    let pole = (mass * center + component.mass() * component.center()) / total;
    let arm = center - pole;
    let shift = mass * (arm.norm_squared() * Matrix3::identity() - arm * arm.transpose());
    let shift = [(0, 0), (1, 1), (2, 2), (1, 2), (2, 0), (0, 1)].map(|entry| shift[entry]);
    let flexible = component.inertia(pole);
    let size = component.size();
    let each: Vec<_> = (0..size).map(|j| component.coordinate(j, pole)).collect();
    let pairs: Vec<(usize, usize, Pair)> = (0..size * size)
        .map(|entry| (entry / size, entry % size))
        .map(|(j, k)| (j, k, component.pair(j, k, pole)))
        .collect();
    let Matrices { stiffness, damping, viscoelastic, dissipators } =
        Matrices::sum(size, component.blocks(0).map(Ok), &[]).unwrap();
    FlexibleBody::new(BodyParts {
        support: Support::Free,
        pole: pole.into(),
        center_of_mass: pole.into(),
        invariants: Invariants {
            mass: total,
            J: std::array::from_fn(|i| whole.invariants().J[i] + shift[i] + flexible[i]),
            S: each.iter().map(|(S, _, _)| *S).collect(),
            h: each.iter().map(|(_, h, _)| *h).collect(),
            J1: each.iter().map(|(_, _, J1)| *J1).collect(),
            pairs: SparseRows::sum(size, pairs),
        },
        damping,
        stiffness,
        viscoelastic,
        dissipators,
        memories: Vec::new(),
        coordinates: (0..size).map(|j| Coordinate { name: format!("{j}"), unit: "m" }).collect(),
        cyclic: 0,
        wheels: Wheels::default(),
        markers: Vec::<Marker>::new(),
    })
    .unwrap()
}

/// Reduced equations of the few coordinates are those of the many to the order that the component is made for.
#[test]
fn few_coordinates_have_the_slow_motion_of_the_many() {
    let assembly = ring_of_points(40);
    let points = assembly.body().unwrap();
    for order in [3, 4, 5] {
        let structure = structure(&assembly);
        let dofs = Dofs::new(&structure.nodes, &structure.constraints).unwrap();
        let options = CondensationOptions {
            order,
            modes: 0,
            floating: false,
            kept_nodes: &[3, 17],
            loads: &[Load::default(); 2],
        };
        let component = structure.component(dofs, &options).unwrap();
        assert!(component.size() < points.coordinates().len(), "{} coordinates", component.size());
        let few = body(&assembly, &component);
        let (all, few) = (reduce(&points, order).unwrap(), reduce(&few, order).unwrap());
        for omega in [[0.9, 0.4, -0.3], [0.2, -1.1, 0.7]] {
            let (expected, found) = (all.torque(omega), few.torque(omega));
            let scale = expected.iter().fold(0.0_f64, |largest, entry| largest.max(entry.abs()));
            for axis in 0..3 {
                assert!((found[axis] - expected[axis]).abs() < 1e-9 * scale, "order {order}, axis {axis}");
            }
        }
    }
}
