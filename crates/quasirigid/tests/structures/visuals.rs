//! Visual geometry: closed surfaces with the volume and the inertia of what they stand for, moved as the body's own markers are.

use std::f64::consts::PI;

use nalgebra::Matrix3;
use quasirigid::elements::{
    Assembly, Carrier, Cavity, CavityShape, Ellipsoid, End, Frame, FrameNode, HingeCoefficient, Hinged, Part,
    PartKind, PlaceRef, Regime, Rotor, RotorKind, SectionShape, Spring, Visual,
};
use quasirigid::model::Rheology;
use quasirigid_mesh::surface::ClosedSurface;

use crate::support::parts;

const CENTER: [f64; 3] = [0.3, -0.2, 0.1];

fn carrier() -> Carrier {
    let inertia = [[9.0, 0.4, -0.3], [0.4, 12.0, 0.2], [-0.3, 0.2, 15.0]];
    parts::carrier(40.0, CENTER, inertia)
}

fn visuals(assembly: &Assembly) -> Vec<Visual> {
    assembly.build_with_visuals().unwrap().visuals
}

fn of<'a>(visuals: &'a [Visual], name: &str) -> &'a Visual {
    visuals.iter().find(|visual| visual.name == name).unwrap()
}

fn closed(visual: &Visual) -> ClosedSurface {
    ClosedSurface::new(visual.vertices.clone(), visual.triangles.clone()).unwrap()
}

#[test]
fn the_box_of_a_carrier_has_its_inertia() {
    let assembly = Assembly { carrier: Some(carrier()), ..Assembly::default() };
    let built = assembly.build_with_visuals().unwrap();
    let surface = closed(&built.visuals[0]);
    let moments = surface.moments(2, [0.0; 3], [1.0; 3]);
    let density = carrier().mass / surface.volume();
    let second = Matrix3::from_fn(|a, b| {
        let mut exponents = [0; 3];
        exponents[a] += 1;
        exponents[b] += 1;
        density * moments.of(exponents)
    });
    let inertia = second.trace() * Matrix3::identity() - second;
    let expected = Matrix3::from_fn(|a, b| carrier().inertia[a][b]);
    assert!((inertia - expected).amax() < 1e-12 * expected.amax(), "{inertia}");
}

#[test]
fn walls_of_cavities_enclose_their_liquid() {
    let ball = |radius: f64| 4.0 / 3.0 * PI * radius.powi(3);
    let shapes = [
        (CavityShape::Ellipsoid { semi_axes: [0.1, 0.2, 0.15] }, ball(1.0) * 0.1 * 0.2 * 0.15),
        (CavityShape::Cylinder { radius: 0.1, height: 0.3 }, PI * 0.01 * 0.3),
        (CavityShape::Annulus { radii: [0.05, 0.1], height: 0.3 }, PI * 0.0075 * 0.3),
        (CavityShape::Ring { radius: 0.2, tube_radius: 0.02 }, 2.0 * PI * PI * 0.2 * 0.0004),
        (CavityShape::Cuboid { sides: [0.1, 0.2, 0.3] }, 0.006),
    ];
    for (shape, volume) in shapes {
        let cavity = Cavity {
            name: "tank".into(),
            shape: shape.clone(),
            center: [0.1, 0.2, -0.1],
            attitude: [0.5, -0.5, 0.5, 0.5],
            density: 900.0,
            viscosity: 1e-2,
            resolution: 5,
            regime: Regime::Viscous,
            modes: 0,
        };
        let assembly = Assembly { carrier: Some(carrier()), cavities: vec![cavity], ..Assembly::default() };
        let found = closed(of(&visuals(&assembly), "tank")).volume();
        assert!(found < 1.0000001 * volume && found > 0.93 * volume, "{shape:?}: {found} of {volume}");
    }
}

/// Vertices of an ellipsoid at the ends of its axes move as its markers do; a shear of the whole keeps its volume.
#[test]
fn the_surface_of_an_ellipsoid_moves_as_its_markers() {
    let material = parts::elastic(2000.0, 1e9, 0.25);
    let ellipsoid =
        Ellipsoid { name: "rock".into(), semi_axes: [230.0, 120.0, 95.0], center: CENTER, material };
    let assembly = Assembly { ellipsoids: vec![ellipsoid], ..Assembly::default() };
    let built = assembly.build_with_visuals().unwrap();
    let rock = of(&built.visuals, "rock");
    assert!(closed(rock).volume() > 0.0);
    for marker in built.body.markers() {
        let near = |vertex: &[f64; 3]| (0..3).all(|i| (vertex[i] - marker.position[i]).abs() < 1e-9 * 230.0);
        let vertex = rock.vertices.iter().position(near).unwrap();
        for (coordinate, shape) in &marker.shapes {
            let drawn = rock.shapes.iter().find(|(other, _)| other == coordinate).unwrap().1[vertex];
            assert!((0..3).all(|i| (drawn[i] - shape[i]).abs() < 1e-12), "{coordinate}: {drawn:?} {shape:?}");
        }
    }
}

/// An appendage turns as a rigid piece, and a rotor about its axis with its own coordinate.
#[test]
fn appendages_and_rotors_turn() {
    let hinge = [1.0, 0.2, -0.3];
    let boom = Hinged {
        name: "boom".into(),
        mass: 2.0,
        center_of_mass: [2.0, 0.2, -0.3],
        inertia: parts::diag([0.01, 0.6, 0.6]),
        hinge,
        axes: vec![[0.0, 1.0, 0.0], [0.0, 0.0, 3.0]],
        stiffness: HingeCoefficient::PerAxis(vec![50.0, 60.0]),
        damping: HingeCoefficient::PerAxis(vec![1.0, 1.0]),
        rheology: Rheology::Elastic,
        places: vec![("tip".into(), [3.0, 0.2, -0.3])],
        angle: None,
    };
    let kind = RotorKind::Flywheel { axis: [0.0, 3.0, 4.0] };
    let rotor = Rotor { name: "flywheel".into(), kind, inertia: 0.2, friction: 0.05, speed: None };
    let assembly =
        Assembly { carrier: Some(carrier()), hinged: vec![boom], rotors: vec![rotor], ..Assembly::default() };
    let built = assembly.build_with_visuals().unwrap();
    let pole = built.body.pole();
    let boom = of(&built.visuals, "boom");
    for (axis, (coordinate, shape)) in [[0.0, 1.0, 0.0], [0.0, 0.0, 1.0]].into_iter().zip(&boom.shapes) {
        for (vertex, moved) in boom.vertices.iter().zip(shape) {
            let arm: [f64; 3] = std::array::from_fn(|i| vertex[i] + pole[i] - hinge[i]);
            let turned = quasirigid_math::vec3::cross(axis, arm);
            assert!(
                (0..3).all(|i| (moved[i] - turned[i]).abs() < 1e-12),
                "{coordinate}: {moved:?} {turned:?}"
            );
        }
    }
    let turning = of(&built.visuals, "flywheel").turning.unwrap();
    assert_eq!((turning.axis, turning.coordinate), ([0.0, 0.6, 0.8], 2));
}

/// A spring runs between its ends: one on the carrier is at its anchor, else at the centre of the carrier; one on a point moves with it.
#[test]
fn springs_run_between_their_ends() {
    let point = parts::free_point("mass", 2.0, [1.0, 0.5, -0.5]);
    let spring = |name: &str, law| Spring {
        name: name.into(),
        from: End::Carrier,
        to: End::Point(0),
        law,
        rheology: Rheology::Elastic,
    };
    let all = parts::isotropic(40.0, 1.0);
    let anchor = [0.5, 0.5, 0.5];
    let line = parts::axial(5.0, 0.0, Some(anchor));
    let springs = vec![spring("all", all), spring("line", line)];
    let assembly = Assembly { carrier: Some(carrier()), points: vec![point], springs, ..Assembly::default() };
    let built = assembly.build_with_visuals().unwrap();
    let from_pole =
        |place: [f64; 3]| -> [f64; 3] { std::array::from_fn(|i| place[i] - built.body.pole()[i]) };
    for (name, start) in [("all", CENTER), ("line", anchor)] {
        let spring = of(&built.visuals, name);
        assert_eq!(spring.vertices, [from_pole(start), from_pole([1.0, 0.5, -0.5])]);
        let moved: Vec<_> =
            spring.shapes.iter().map(|(coordinate, shape)| (*coordinate, shape[0], shape[1])).collect();
        assert_eq!(moved[2], (2, [0.0; 3], [0.0, 0.0, 1.0]));
    }
}

/// A spring on a place of an appendage ends there, and moves as that place does.
#[test]
fn springs_end_at_places_of_appendages() {
    let places = [("near", [1.5, 0.2, -0.3]), ("far", [3.0, 0.4, -0.3])];
    let boom = Hinged {
        name: "boom".into(),
        mass: 2.0,
        center_of_mass: [2.0, 0.2, -0.3],
        inertia: parts::diag([0.01, 0.6, 0.6]),
        hinge: [1.0, 0.2, -0.3],
        axes: vec![[0.0, 0.0, 1.0]],
        stiffness: HingeCoefficient::PerAxis(vec![50.0]),
        damping: HingeCoefficient::PerAxis(vec![1.0]),
        rheology: Rheology::Elastic,
        places: places.map(|(name, place)| (name.into(), place)).into(),
        angle: None,
    };
    let law = parts::axial(5.0, 0.0, Some([0.5, 0.5, 0.5]));
    let spring = |(place, (name, _)): (usize, (&str, [f64; 3]))| Spring {
        name: name.into(),
        from: End::Carrier,
        to: End::Hinged(PlaceRef { hinged: 0, place }),
        law,
        rheology: Rheology::Elastic,
    };
    let springs = places.into_iter().enumerate().map(spring).collect();
    let assembly = Assembly { carrier: Some(carrier()), hinged: vec![boom], springs, ..Assembly::default() };
    let built = assembly.build_with_visuals().unwrap();
    for (name, place) in places {
        let spring = of(&built.visuals, name);
        let end: [f64; 3] = std::array::from_fn(|i| spring.vertices[1][i] + built.body.pole()[i]);
        assert!((0..3).all(|i| (end[i] - place[i]).abs() < 1e-12), "{name}: {end:?}");
        let [(0, shape)] = spring.shapes.as_slice() else { panic!("{:?}", spring.shapes) };
        let turned = [-(place[1] - 0.2), place[0] - 1.0, 0.0];
        assert!((0..3).all(|i| (shape[1][i] - turned[i]).abs() < 1e-12), "{name}: {shape:?}");
    }
}

/// The end of a beam is drawn where its marker is, and moves as it does; the lines join its nodes in order.
#[test]
fn beams_move_as_their_markers() {
    let ends = [[0.5, 0.0, 0.0], [3.5, 0.4, 0.0]];
    let node = |(name, position): (&str, [f64; 3])| FrameNode { name: name.into(), position };
    let material = parts::elastic(2700.0, 7e10, 0.3);
    let member = parts::member([0, 1], SectionShape::Tube { radius: 0.02, thickness: 0.002 }, material, 4);
    let frame =
        Frame { nodes: ["root", "tip"].into_iter().zip(ends).map(node).collect(), members: vec![member] };
    let part = Part {
        name: "boom".into(),
        kind: PartKind::Frame(frame),
        masses: Vec::new(),
        attached: vec![0],
        rayleigh: [0.0; 2],
    };
    let assembly = Assembly { carrier: Some(carrier()), parts: vec![part], ..Assembly::default() };
    let built = assembly.build_with_visuals().unwrap();
    let boom = of(&built.visuals, "boom");
    assert_eq!(boom.lines, [[0, 2], [2, 3], [3, 4], [4, 1]]);
    let marker = built.body.markers().iter().find(|marker| marker.name.contains("tip")).unwrap();
    assert_eq!(boom.vertices[1], marker.position);
    for (coordinate, shape) in &marker.shapes {
        let (_, drawn) = boom.shapes.iter().find(|(other, _)| other == coordinate).unwrap();
        assert_eq!(drawn[1], *shape);
        assert_eq!(drawn[0], [0.0; 3], "the root is clamped");
    }
    let radius = (PI * (0.02_f64.powi(2) - 0.018_f64.powi(2)) / PI).sqrt();
    assert!((boom.radius.unwrap() - radius).abs() < 1e-12);
}
