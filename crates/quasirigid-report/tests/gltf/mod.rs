//! The glTF file of a scene, read by another library: geometry, displacements and motion are those of the scene.

use gltf::Gltf;
use gltf::animation::Property;
use quasirigid_io::record::*;
use quasirigid_report::GltfOptions;

/// A point on a line, a rod between it and the carrier, and a sheet; three frames.
fn scene() -> SceneRecord {
    let vectors = |flat: &[f64]| VectorsRecord::pack(flat.as_chunks::<3>().0);
    let piece = |name: &str, kind: &str, vertices: &[f64]| PieceRecord {
        name: name.into(),
        kind: kind.into(),
        vertices: vectors(vertices),
        triangles: None,
        lines: None,
        size: Some(0.1),
        fields: Vec::new(),
        turning: None,
    };
    let field = |flat: &[f64]| vec![FieldRecord { coordinate: 1, vectors: vectors(flat) }];
    let half = 0.5_f32.sqrt();
    SceneRecord {
        version: SCENE_VERSION,
        name: "</script> body".into(),
        radius: 2.0,
        coordinates: ["a", "b"].map(|name| CoordinateRecord { name: name.into(), unit: "m".into() }).into(),
        pieces: vec![
            PieceRecord { fields: field(&[0.0, 0.0, 1.0]), ..piece("tip", "point", &[1.0, 0.0, 0.5]) },
            PieceRecord {
                lines: Some(Packed(vec![0, 1])),
                fields: field(&[0.0, 0.0, 1.0, 0.0, 0.0, 0.0]),
                ..piece("", "spring", &[1.0, 0.0, 0.5, 0.0, 0.0, 0.0])
            },
            PieceRecord {
                triangles: Some(Packed(vec![0, 1, 2])),
                ..piece("hub", "carrier", &[0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0])
            },
            piece("nothing", "point", &[]),
        ],
        principal: PrincipalRecord {
            moments: [1.0, 2.0, 3.0],
            axes: [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]],
        },
        track: Some(TrackRecord {
            system: "full".into(),
            t: Packed(vec![0.0, 50.0, 200.0]),
            attitude: Packed(vec![1.0, 0.0, 0.0, 0.0, half, 0.0, 0.0, half, -half, 0.0, 0.0, -half]),
            omega: Packed(vec![0.0; 9]),
            momentum: Packed(vec![0.0; 9]),
            q: Some(Packed(vec![0.0, 0.0, 0.0, 0.01, 0.0, -0.02])),
            rotors: None,
            dissipated: Packed(vec![0.0; 3]),
        }),
        spin: None,
        modes: Vec::new(),
        equations: None,
    }
}

fn opened(options: &GltfOptions) -> (Gltf, Vec<u8>) {
    let file = Gltf::from_slice(&quasirigid_report::gltf(&scene(), options)).unwrap();
    let blob = file.blob.clone().unwrap();
    (file, blob)
}

#[test]
fn pieces_are_meshes_that_their_coordinates_displace() {
    let (file, blob) = opened(&GltfOptions { deformation: Some(3.0), ..GltfOptions::default() });
    let names: Vec<_> = file.nodes().map(|node| node.name().unwrap().to_owned()).collect();
    assert_eq!(names, ["</script> body", "tip", "spring", "hub"]);
    for (mesh, targets) in file.meshes().zip([1, 1, 0]) {
        let primitive = mesh.primitives().next().unwrap();
        let reader = primitive.reader(|_| Some(&blob));
        let places: Vec<[f32; 3]> = reader.read_positions().unwrap().collect();
        let indices: Vec<u32> = reader.read_indices().unwrap().into_u32().collect();
        assert!(
            indices.iter().all(|index| (*index as usize) < places.len()) && indices.len().is_multiple_of(3)
        );
        let morphs: Vec<_> = reader.read_morph_targets().collect();
        assert_eq!(morphs.len(), targets);
        for (moved, ..) in morphs {
            let moved: Vec<[f32; 3]> = moved.unwrap().collect();
            // the end on the carrier rests, the other moves by three times a metre per metre
            let expected = |place: &[f32; 3]| if place[0] > 0.5 { [0.0, 0.0, 3.0] } else { [0.0; 3] };
            let near = |a: [f32; 3], b: [f32; 3]| (0..3).all(|i| (a[i] - b[i]).abs() < 1e-4);
            assert!(places.iter().zip(&moved).all(|(place, moved)| near(*moved, expected(place))));
        }
    }
}

/// Spheres and rods have their radius about the places of the scene, and their faces look outward.
#[test]
fn points_and_lines_are_solids_of_their_size() {
    let (file, blob) = opened(&GltfOptions::default());
    let triangles = |mesh: usize| {
        let primitive = file.meshes().nth(mesh).unwrap().primitives().next().unwrap();
        let reader = primitive.reader(|_| Some(&blob));
        let places: Vec<[f32; 3]> = reader.read_positions().unwrap().collect();
        let indices: Vec<u32> = reader.read_indices().unwrap().into_u32().collect();
        let corners: Vec<[f32; 3]> = indices.iter().map(|index| places[*index as usize]).collect();
        corners.as_chunks::<3>().0.to_vec()
    };
    let sub = |a: [f32; 3], b: [f32; 3]| [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
    let dot = |a: [f32; 3], b: [f32; 3]| a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
    let cross = |a: [f32; 3], b: [f32; 3]| {
        [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
    };
    let center = [1.0, 0.0, 0.5];
    let along = [0.894_427_2, 0.0, 0.447_213_6];
    for [a, b, c] in triangles(0) {
        assert!(
            [a, b, c]
                .iter()
                .all(|place| (dot(sub(*place, center), sub(*place, center)).sqrt() - 0.1).abs() < 1e-4)
        );
        assert!(dot(cross(sub(b, a), sub(c, a)), sub(a, center)) > 0.0);
    }
    for [a, b, c] in triangles(1) {
        let out = |place: [f32; 3]| {
            let part = dot(place, along);
            [place[0] - part * along[0], place[1] - part * along[1], place[2] - part * along[2]]
        };
        assert!([a, b, c].iter().all(|place| (dot(out(*place), out(*place)).sqrt() - 0.1).abs() < 1e-4));
        assert!(dot(cross(sub(b, a), sub(c, a)), out(a)) > 0.0);
    }
}

/// The whole run takes the duration asked for; attitudes turn the short way; displacements follow the coordinates.
#[test]
fn the_animation_is_the_run() {
    let (file, blob) = opened(&GltfOptions { duration: 10.0, deformation: None });
    let animation = file.animations().next().unwrap();
    let mut weights = 0;
    for channel in animation.channels() {
        let reader = channel.reader(|_| Some(&blob));
        assert_eq!(reader.read_inputs().unwrap().collect::<Vec<_>>(), [0.0, 2.5, 10.0]);
        match channel.target().property() {
            Property::Rotation => {
                assert_eq!(channel.target().node().name(), Some("</script> body"));
                let Some(gltf::animation::util::ReadOutputs::Rotations(turned)) = reader.read_outputs()
                else {
                    panic!()
                };
                let turned: Vec<[f32; 4]> = turned.into_f32().collect();
                let half = 0.5_f32.sqrt();
                assert_eq!(turned, [[0.0, 0.0, 0.0, 1.0], [0.0, 0.0, half, half], [0.0, 0.0, half, half]]);
            }
            Property::MorphTargetWeights => {
                let Some(gltf::animation::util::ReadOutputs::MorphTargetWeights(q)) = reader.read_outputs()
                else {
                    panic!()
                };
                assert_eq!(q.into_f32().collect::<Vec<_>>(), [0.0, 0.01, -0.02]);
                weights += 1;
            }
            other => panic!("{other:?}"),
        }
    }
    assert_eq!(weights, 2);
    // the largest displacement, 0.02 m, is shown as a twentieth of the radius
    let tip = file.meshes().next().unwrap().primitives().next().unwrap();
    let (moved, ..) = tip.reader(|_| Some(&blob)).read_morph_targets().next().unwrap();
    assert!((moved.unwrap().next().unwrap()[2] - 5.0).abs() < 1e-3);
}

#[test]
fn a_large_body_is_drawn_in_a_unit_of_its_own() {
    let mut large = scene();
    large.radius = 2e4;
    large.pieces[2].vertices.unit *= 1e4;
    let file = Gltf::from_slice(&quasirigid_report::gltf(&large, &GltfOptions::default())).unwrap();
    let blob = file.blob.clone().unwrap();
    let hub = file.meshes().nth(2).unwrap().primitives().next().unwrap();
    let places: Vec<[f32; 3]> = hub.reader(|_| Some(&blob)).read_positions().unwrap().collect();
    assert!((places[1][0] - 5.0).abs() < 1e-5 && places[1][1..] == [0.0, 0.0], "{:?}", places[1]);
}
