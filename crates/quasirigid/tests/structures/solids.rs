//! Solids of cells against other methods for the same body: polynomials inside a surface, a beam, all coordinates.

use nalgebra::{DVector, Matrix3, Rotation3, Vector3};
use quasirigid::elements::{
    Assembly, Carrier, ElementKind, Field, Frame, FrameNode, Material, Member, Part, PartKind, PartReduction,
    Problem, SectionShape, Surface, TipMass,
};
use quasirigid::model::{FlexibleBody, Marker, ReducedBody, Rheology};
use quasirigid::reduction::reduce;
use quasirigid_mesh::{Mesh, Shape};

use super::common::{compliance, error, turned_axes, vector_error};
use super::meshes::{Hexahedra, outer, refined, solid, throughout, with_middles};
use crate::support::parts;

fn rock(rheology: Rheology) -> Material {
    Material { density: 2600.0, young: 4e6, poisson: 0.27, rheology }
}

fn floating(mesh: Mesh) -> FlexibleBody {
    let regions = throughout(&mesh, &rock(Rheology::Elastic));
    Assembly { parts: vec![solid(mesh, &regions, Vec::new())], ..Assembly::default() }.body().unwrap()
}

/// A lump of 48 facets, far from the origin: cells inside it, and polynomials of degree ten on its surface.
#[test]
fn cells_inside_a_surface_are_the_surface_element() {
    let lump = |x: Vector3<f64>| {
        let bump = 1.0 + 0.15 * (2.0 * x.x + 1.0).sin() + 0.1 * x.y * x.z;
        turned_axes() * (bump * Vector3::new(140.0 * x.x, 110.0 * x.y, 85.0 * x.z))
            + Vector3::new(300.0, -90.0, 55.0)
    };
    let coarse = Hexahedra::ball(1).mesh(Shape::Tet4, lump);
    let closed = outer(&coarse);
    let by_degree = |degree| {
        let element = Surface {
            name: "lump".to_owned(),
            surface: closed.clone(),
            material: rock(Rheology::Elastic),
            degree: Some(degree),
            cells: None,
        };
        Assembly { surfaces: vec![element], ..Assembly::default() }.body().unwrap()
    };
    let [low, high] = [8, 10].map(by_degree);
    let axes = Rotation3::identity();
    let expected = compliance(&high, axes);
    let left = error(&compliance(&low, axes), &expected);
    let fine = refined(&coarse);
    let meshes = [coarse.clone(), fine.clone(), with_middles(&coarse), with_middles(&fine)];
    let bodies = meshes.clone().map(floating);
    let gaps = bodies.each_ref().map(|body| error(&compliance(body, axes), &expected));
    println!("compliance of polynomials of degree 8 beside 10: {left:.2e}");
    for ((mesh, body), gap) in meshes.iter().zip(&bodies).zip(gaps) {
        let [cells, nodes] = [mesh.cells.len(), mesh.nodes.len()];
        println!("{cells:>5} {}, {nodes} nodes: {gap:.2e} beside polynomials", mesh.cells[0].shape);
        assert_eq!(body.coordinates().len(), 12);
    }
    let mass = bodies[3].invariants().mass / high.invariants().mass - 1.0;
    let J = Matrix3::from(bodies[3].inertia()) - Matrix3::from(high.inertia());
    let turn = J.amax() / Matrix3::from(high.inertia()).amax();
    println!("mass {mass:.1e}, inertia {turn:.1e}");
    // Facets are equal, so the bodies are equal but for the rounding of polynomials of degree ten.
    assert!(mass.abs() < 1e-9 && turn < 1e-9, "{mass} {turn}");
    assert!(gaps[3] < 5e-3 && gaps[3] < 0.3 * gaps[2] && gaps[1] < 0.6 * gaps[0], "{gaps:?}");
}

const LENGTH: f64 = 2.4;
const HEIGHT: f64 = 0.16;
const WIDTH: f64 = 0.1;
const ROOT: [f64; 3] = [0.5, -0.3, 0.2];
const OMEGA: [f64; 3] = [0.7, -0.5, 0.9];

fn carrier() -> Carrier {
    parts::carrier(300.0, [0.1, -0.05, 0.02], [[90.0, 4.0, -2.0], [4.0, 130.0, 3.0], [-2.0, 3.0, 160.0]])
}

fn on_carrier(part: Part, reduction: PartReduction) -> FlexibleBody {
    Assembly { carrier: Some(carrier()), parts: vec![part], reduction, ..Assembly::default() }.body().unwrap()
}

/// Bar of cells along the first of the rotated axes, with its clamped nodes.
fn bar(shape: Shape, counts: [usize; 3]) -> (Mesh, Vec<usize>) {
    let mut block = Hexahedra::default();
    block.add(counts, |[x, y, z]| Vector3::new(LENGTH * x, WIDTH * (y - 0.5), HEIGHT * (z - 0.5)));
    let even = block.mesh(shape, |place| place);
    let clamped = (0..even.nodes.len()).filter(|node| even.nodes[*node][0] < 1e-9 * LENGTH).collect();
    (block.mesh(shape, |place| turned_axes() * place + Vector3::from(ROOT)), clamped)
}

/// The bar as a beam.
fn beam(material: &Material) -> Part {
    let axes = turned_axes();
    let tip = axes * Vector3::new(LENGTH, 0.0, 0.0) + Vector3::from(ROOT);
    let node = |name: &str, position| FrameNode { name: name.to_owned(), position };
    let member = Member {
        name: String::new(),
        ends: [0, 1],
        section: SectionShape::Rectangle { height: HEIGHT, width: WIDTH },
        up: Some((axes * Vector3::y()).into()),
        material: material.clone(),
        elements: 8,
    };
    let kind = PartKind::Frame(Frame {
        nodes: vec![node("root", ROOT), node("tip", tip.into())],
        members: vec![member],
    });
    Part { name: "bar".to_owned(), kind, masses: Vec::new(), attached: vec![0], rayleigh: [0.0; 2] }
}

/// One degree of the torque.
fn torque(body: &ReducedBody, degree: usize) -> [f64; 3] {
    let mut value = [0.0; 3];
    body.mu(degree).add_value(OMEGA, &mut value);
    value
}

/// Beam theory leaves out that the clamp keeps the section flat, an effect of about the width over the length.
#[test]
fn a_bar_of_cells_is_a_beam() {
    let material = rock(Rheology::KelvinVoigt { time: 0.02 });
    let expected = reduce(&on_carrier(beam(&material), PartReduction::default()), 3).unwrap();
    let gaps = [[2, 1, 1], [4, 1, 1], [8, 2, 2]].map(|counts| {
        let (mesh, clamped) = bar(Shape::Hex20, counts);
        let regions = throughout(&mesh, &material);
        let found = on_carrier(solid(mesh, &regions, clamped), PartReduction::default());
        let found = reduce(&found, 3).unwrap();
        let gaps = [4, 5].map(|degree| vector_error(torque(&found, degree), torque(&expected, degree)));
        println!("{counts:?} cells beside a beam: torque of degree 4 {:.2e}, 5 {:.2e}", gaps[0], gaps[1]);
        gaps
    });
    for degree in 0..2 {
        assert!(gaps[2][degree] < 0.02 && gaps[2][degree] < 0.6 * gaps[0][degree], "{gaps:?}");
    }
}

/// Displacements of the farthest nodes on the slow manifold, of one degree in the spin.
fn displaced((reduced, body): &(ReducedBody, FlexibleBody), degree: usize) -> DVector<f64> {
    let mut q = vec![0.0; body.coordinates().len()];
    reduced.q.part(degree).add_value(OMEGA, &mut q);
    let place = |marker: &Marker| -> Vector3<f64> {
        marker.shapes.iter().map(|(j, shape)| q[*j] * Vector3::from(*shape)).sum()
    };
    let all: Vec<f64> = body.markers().iter().flat_map(|marker| <[f64; 3]>::from(place(marker))).collect();
    DVector::from(all)
}

/// Halves with different losses: on few coordinates the reduced equations are those of all coordinates, which so many
/// modes of vibration span.
#[test]
fn losses_of_two_materials_are_those_of_all_coordinates() {
    let materials = [0.03, 0.2].map(|time| rock(Rheology::KelvinVoigt { time }));
    // Thirty nodes, less the six that are clamped, or less six rigid motions.
    for (floating, unknowns) in [(false, 72), (true, 84)] {
        let (mesh, clamped) = bar(Shape::Hex8, [4, 2, 1]);
        let half = |side: usize| (0..8).filter(|cell| cell % 4 / 2 == side).collect();
        let regions = [0, 1].map(|side| (half(side), materials[side].clone()));
        let part = solid(mesh, &regions, if floating { Vec::new() } else { clamped });
        let [few, all] = [0, unknowns].map(|modes| {
            let carrier = (!floating).then(carrier);
            let reduction = PartReduction { order: 3, modes };
            let parts = vec![part.clone()];
            Assembly { carrier, parts, reduction, ..Assembly::default() }.body().unwrap()
        });
        let counts = [&few, &all].map(|body| body.coordinates().len());
        let [few, all] = [few, all].map(|body| (reduce(&body, 3).unwrap(), body));
        let places = [2, 3].map(|degree| {
            (displaced(&few, degree) - displaced(&all, degree)).amax() / displaced(&all, degree).amax()
        });
        let [(few, _), (all, _)] = [few, all];
        let torque = vector_error(torque(&few, 5), torque(&all, 5));
        let power = few.dissipated_power(OMEGA) / all.dissipated_power(OMEGA) - 1.0;
        let [second, third] = places;
        println!("{counts:?} coordinates: torque of degree 5 {torque:.1e}, power {power:.1e}");
        println!("displacements of degree 2 {second:.1e}, 3 {third:.1e}");
        // Torque and power need no more than the responses to the loads; the lag of the shape needs the responses to their losses.
        assert!(second < 1e-8 && third < 1e-8, "{second} {third}");
        assert!(counts[0] < counts[1] && counts[1] == unknowns, "{counts:?}");
        assert!(torque < 1e-8 && power.abs() < 1e-8, "{torque} {power}");
    }
}

/// The losses of two materials add up.
#[test]
fn power_of_losses_grows_with_their_times() {
    let power = |times: [f64; 2]| {
        let (mesh, clamped) = bar(Shape::Hex8, [2, 1, 1]);
        let regions = [0, 1].map(|cell| (vec![cell], rock(Rheology::KelvinVoigt { time: times[cell] })));
        let body = on_carrier(solid(mesh, &regions, clamped), PartReduction::default());
        reduce(&body, 3).unwrap().dissipated_power(OMEGA)
    };
    let [both, first, second, double] = [[0.03, 0.2], [0.03, 1e-9], [1e-9, 0.2], [0.06, 0.4]].map(power);
    println!("power {both:.3e} W, of the first material {first:.3e}, of the second {second:.3e}");
    // Linear in the times at the lowest degree; the smallest times add their share, 1e-7 of the whole.
    assert!(((first + second) / both - 1.0).abs() < 1e-6, "{first} {second} {both}");
    assert!((double / both - 2.0).abs() < 1e-12, "{double} {both}");
    assert!(first > 0.05 * both && second > 0.05 * both, "{first} {second} {both}");
}

#[test]
fn a_region_of_cells_that_are_not_there_is_refused() {
    let (mesh, clamped) = bar(Shape::Hex8, [2, 1, 1]);
    let regions = [(vec![0, 1, 2], rock(Rheology::Elastic))];
    let part = solid(mesh, &regions, clamped);
    let assembly = Assembly { carrier: Some(carrier()), parts: vec![part], ..Assembly::default() };
    let error = assembly.body().unwrap_err();
    assert_eq!((error.element, error.field), (ElementKind::Part.at(0), Field::MATERIAL));
    assert_eq!(error.problem, Problem::NoSuchCell { index: 2, count: 2 });
}

/// Nodes of solids carry mass, and no inertia.
#[test]
fn a_mass_at_a_node_of_a_solid_has_no_inertia() {
    let (mesh, clamped) = bar(Shape::Hex8, [2, 1, 1]);
    let last = mesh.nodes.len() - 1;
    let part = solid(mesh, &[(vec![0, 1], rock(Rheology::Elastic))], clamped);
    let with = |inertia: f64| {
        let inertia = std::array::from_fn(|i| std::array::from_fn(|j| if i == j { inertia } else { 0.0 }));
        let masses = vec![TipMass { node: last, mass: 2.5, inertia }];
        let parts = vec![Part { masses, ..part.clone() }];
        Assembly { carrier: Some(carrier()), parts, ..Assembly::default() }.body()
    };
    let bare = Assembly { carrier: Some(carrier()), parts: vec![part.clone()], ..Assembly::default() };
    let gained = with(0.0).unwrap().invariants().mass - bare.body().unwrap().invariants().mass;
    assert!((gained - 2.5).abs() < 1e-12, "{gained}");
    let error = with(0.1).unwrap_err();
    assert_eq!((error.element, error.field), (ElementKind::Part.at(0), Field::MASSES));
    assert!(matches!(error.problem, Problem::NoTurnForInertia { .. }), "{error}");
}
