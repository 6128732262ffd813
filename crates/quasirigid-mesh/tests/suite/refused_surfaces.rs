//! Triangles that bound no body are refused by name, and bodies of any shape and size are not.

use proptest::array::uniform3;
use proptest::prelude::*;
use quasirigid_mesh::surface::{ClosedSurface, SurfaceError};

use super::cases;
use super::shapes::{
    Mesh, UNIT_CUBE, block, both, closed, icosphere, inside_out, mapped, refusal, split_in_four, star,
    tetrahedron,
};

#[test]
fn what_encloses_no_body_is_refused() {
    use SurfaceError::*;
    let cube = block(UNIT_CUBE);
    let changed = |change: fn(&mut Mesh)| {
        let mut mesh = cube.clone();
        change(&mut mesh);
        refusal(&mesh)
    };
    assert_eq!(changed(|mesh| mesh.1.truncate(3)), TooFew { triangles: 3 });
    let missing = NoSuchVertex { triangle: 7, index: 8, vertices: 8, count: 2 };
    assert_eq!(changed(|mesh| [mesh.1[7][1], mesh.1[9][0]] = [8, 9]), missing);
    assert_eq!(changed(|mesh| mesh.0[5][2] = f64::NAN), NotFinite { vertex: 5, count: 1 });
    assert_eq!(changed(|mesh| mesh.0.push([f64::INFINITY; 3])), NotFinite { vertex: 8, count: 1 });
    assert_eq!(changed(|mesh| mesh.1[4][1] = mesh.1[4][0]), Degenerate { triangle: 4, count: 1 });
    assert_eq!(changed(|mesh| mesh.0.fill([1.0; 3])), Degenerate { triangle: 0, count: 12 });
    assert_eq!(
        changed(|mesh| mesh.1.retain(|corners| *corners != [4, 7, 5])),
        Open { edge: [7, 4], triangle: 2, count: 3 }
    );
    let crowded = NonManifold { edge: [4, 7], triangles: vec![2, 3, 12], count: 3 };
    assert_eq!(changed(|mesh| mesh.1.push(mesh.1[3])), crowded);
    let turned = TwiceOriented { edge: [7, 4], triangles: [2, 3], count: 3 };
    assert_eq!(changed(|mesh| mesh.1[3].swap(0, 1)), turned);
    assert_eq!(refusal(&inside_out(cube.clone())), Inward);
    let small = block([[-0.5; 3], [0.5; 3]]);
    let beside = block([[1.5; 3], [2.0; 3]]);
    assert_eq!(refusal(&both(cube.clone(), small.clone())), Buried { triangle: 12, count: 1 });
    assert_eq!(refusal(&both(small.clone(), cube.clone())), Buried { triangle: 0, count: 1 });
    assert_eq!(
        refusal(&both(cube.clone(), inside_out(beside.clone()))),
        LooseCavity { triangle: 12, count: 1 }
    );
    let hollow = both(cube, inside_out(small));
    let core = block([[-0.1; 3], [0.1; 3]]);
    assert!((closed(&both(both(hollow.clone(), core.clone()), beside)).volume() - 7.133).abs() < 1e-14);
    assert_eq!(refusal(&both(hollow, inside_out(core))), LooseCavity { triangle: 24, count: 1 });
}

#[test]
fn refusals_count_from_one_and_say_what_to_do() {
    let says = |mesh: Mesh, expected: &str| assert_eq!(refusal(&mesh).to_string(), expected);
    let (vertices, mut triangles) = block(UNIT_CUBE);
    triangles.remove(3);
    says(
        (vertices.clone(), triangles.clone()),
        "the edge between vertices 8 and 5 of triangle 3 is open, the first of 3 such edges; \
         fill the hole, and let triangles that meet share their vertices",
    );
    triangles.push([4, 5, 7]);
    says(
        (vertices.clone(), triangles.clone()),
        "triangles 3 and 12 both run from vertex 8 to vertex 5, the first of 3 such edges; turn one of them around",
    );
    triangles.push([4, 7, 5]);
    says(
        (vertices.clone(), triangles),
        "the edge between vertices 5 and 8 belongs to 3 triangles, 3, 12, 13, the first of 3 such edges; two is right: \
         take out walls inside the body, and give bodies that touch vertices of their own",
    );
    says((vertices, vec![[0, 1, 2]; 3]), "3 triangles enclose nothing; a closed surface has at least 4");
}

/// Lines that are nearly straight: the last bit decides, and it is the same bit for a speck of dust and for a moon.
#[test]
fn a_sliver_is_a_triangle_until_rounding() {
    for unit in [1e-9, 1.0, 1e9] {
        // A cube whose first side has a vertex close to its diagonal.
        let with = |height: f64| {
            let (mut vertices, mut triangles) = mapped(&block(UNIT_CUBE), |x| x.map(|x| x * unit));
            let on = [-1.0, -0.5 * height, 0.5 * height].map(|x| x * unit); // diagonal from [-1, -1] to [1, 1]
            vertices.push(on);
            let [a, b, c] = triangles[0];
            triangles[0] = [a, b, 8];
            triangles.extend([[b, c, 8], [8, c, a]]);
            ClosedSurface::new(vertices, triangles)
        };
        assert!(with(1e-12).is_ok(), "{unit:e}");
        assert_eq!(with(1e-15).unwrap_err(), SurfaceError::Degenerate { triangle: 13, count: 1 });
    }
}

/// Mesh rotated as a whole, so that flat sides are flat to rounding only.
fn turned(mesh: &Mesh, axis: [f64; 3], unit: f64) -> Mesh {
    let [x, y, z] = axis;
    let square = 1.0 + x * x + y * y + z * z;
    // Cayley's form of the rotation.
    let rows = [
        [1.0 + x * x - y * y - z * z, 2.0 * (x * y - z), 2.0 * (x * z + y)],
        [2.0 * (x * y + z), 1.0 - x * x + y * y - z * z, 2.0 * (y * z - x)],
        [2.0 * (x * z - y), 2.0 * (y * z + x), 1.0 - x * x - y * y + z * z],
    ];
    mapped(mesh, |r| rows.map(|row| unit * (row[0] * r[0] + row[1] * r[1] + row[2] * r[2]) / square))
}

proptest! {
    #![proptest_config(cases(48))]

    /// Flat sides of many triangles meet nowhere but in their edges, in any position and unit.
    #[test]
    fn fine_meshes_of_flat_sides_are_accepted(axis in uniform3(-2.0..2.0), unit in -9..=9i32, corners in uniform3(uniform3(-0.3..0.3))) {
        let [p, q, r] = corners;
        let plus = |a: [f64; 3], b: [f64; 3]| std::array::from_fn(|i| a[i] + b[i]);
        let tetrahedron = tetrahedron([p, plus(q, [1.0, 0.0, 0.0]), plus(r, [0.0, 1.0, 0.0]), [0.0, 0.0, 1.0]]);
        let cube = mapped(&block(UNIT_CUBE), |[x, y, z]| [x + 3.0, y, z]);
        for mesh in [cube, tetrahedron] {
            let mesh = split_in_four(&split_in_four(&split_in_four(&mesh)));
            let mesh = turned(&mesh, axis, 10f64.powi(unit));
            prop_assert!(ClosedSurface::new(mesh.0, mesh.1).is_ok());
        }
    }

    /// A vertex pushed through the far side takes its triangles with it. One of them is named.
    #[test]
    fn a_vertex_through_the_far_side_is_refused(mesh in star(2), vertex in 0..162usize, far in 1.6..9.0f64, unit in -9..=9i32) {
        let mut mesh = mapped(&mesh, |x| x.map(|x| x * 10f64.powi(unit)));
        closed(&mesh);
        mesh.0[vertex] = mesh.0[vertex].map(|x| -far * x);
        let SurfaceError::SelfIntersecting { triangles, count } = refusal(&mesh) else {
            return Err(TestCaseError::fail(refusal(&mesh).to_string()));
        };
        prop_assert!(triangles.iter().any(|triangle| mesh.1[*triangle].contains(&vertex)), "{triangles:?}");
        prop_assert!(count > 3);
    }

    /// Two bodies may be side by side or one in the other, but not across one another.
    #[test]
    fn bodies_across_one_another_are_refused(a in star(1), b in star(1), direction in uniform3(-1.0..1.0f64)) {
        let length = direction.iter().map(|x| x * x).sum::<f64>().sqrt();
        let at = |distance: f64| {
            let shift = direction.map(|x| distance * x / length);
            both(a.clone(), mapped(&b, |x| std::array::from_fn(|i| x[i] + shift[i])))
        };
        closed(&at(3.0));
        let crosses = matches!(refusal(&at(0.7)), SurfaceError::SelfIntersecting { .. });
        prop_assert!(crosses);
    }
}

#[test]
fn surfaces_that_touch_themselves_are_refused() {
    let cube = block(UNIT_CUBE);
    let beside = |gap: f64| both(cube.clone(), mapped(&cube, |[x, y, z]| [x + 2.0 + gap, y + 0.3, z - 0.1]));
    assert!(matches!(refusal(&beside(0.0)), SurfaceError::SelfIntersecting { .. }), "side to side");
    assert!(
        matches!(refusal(&beside(-1e-12)), SurfaceError::SelfIntersecting { .. }),
        "a little into one another"
    );
    closed(&beside(1e-12));
    let on_corner = |gap: f64| both(cube.clone(), mapped(&cube, |x| x.map(|x| x + 2.0 + gap)));
    // Six triangles on either side.
    assert_eq!(
        refusal(&on_corner(0.0)).to_string(),
        "triangles 3 and 13 cross or touch, the first of 36 such pairs; \
        a surface must not meet itself: pull them apart, or join the parts into one body"
    );
    closed(&on_corner(1e-12));
    // A common corner of both cubes makes a body that is connected there.
    let (vertices, mut triangles) = on_corner(0.0);
    triangles[12..].iter_mut().flatten().for_each(|corner| *corner = if *corner == 8 { 7 } else { *corner });
    assert!((closed(&(vertices, triangles)).volume() - 16.0).abs() < 1e-13);
}

/// A fold: the last row of triangles is pulled back over the one before, without an edge that could show it.
#[test]
fn a_side_folded_back_is_refused() {
    let mut mesh = split_in_four(&split_in_four(&block(UNIT_CUBE)));
    let inner = mesh.0.iter().position(|vertex| *vertex == [1.0, 0.5, 0.5]).unwrap();
    mesh.0[inner] = [1.0, -0.7, 0.6];
    assert!(matches!(refusal(&mesh), SurfaceError::SelfIntersecting { .. }));
    mesh.0[inner] = [1.0, 0.6, 0.55];
    closed(&mesh);
}

#[test]
fn a_sphere_of_many_triangles_is_accepted() {
    assert_eq!(closed(&icosphere(5)).triangles().len(), 20 * 1024);
}
