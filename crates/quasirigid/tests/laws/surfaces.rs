//! Closed surfaces: moments against closed forms, invariance under how the triangles are written, and every refusal.

use std::collections::BTreeMap;
use std::f64::consts::PI;

use proptest::array::uniform3;
use proptest::collection::vec;
use proptest::prelude::*;
use quasirigid::math::polynomial::monomial::exponents;
use quasirigid::math::surface::{ClosedSurface, Moments, SurfaceError};

use crate::support::cases;

type Mesh = (Vec<[f64; 3]>, Vec<[usize; 3]>);

fn closed((vertices, triangles): &Mesh) -> ClosedSurface {
    ClosedSurface::new(vertices.clone(), triangles.clone()).unwrap()
}

fn refusal((vertices, triangles): &Mesh) -> SurfaceError {
    ClosedSurface::new(vertices.clone(), triangles.clone()).unwrap_err()
}

/// Vertex `4i + 2j + k` is at `[x_i, y_j, z_k]`.
fn block([low, high]: [[f64; 3]; 2]) -> Mesh {
    let corner =
        |n: usize| [[low[0], high[0]][n / 4], [low[1], high[1]][n / 2 % 2], [low[2], high[2]][n % 2]];
    let sides = [[0, 1, 3, 2], [4, 6, 7, 5], [0, 4, 5, 1], [2, 3, 7, 6], [0, 2, 6, 4], [1, 5, 7, 3]];
    let triangles = sides.iter().flat_map(|[a, b, c, d]| [[*a, *b, *c], [*a, *c, *d]]).collect();
    ((0..8).map(corner).collect(), triangles)
}

const UNIT_CUBE: [[f64; 3]; 2] = [[-1.0; 3], [1.0; 3]];

fn tetrahedron(corners: [[f64; 3]; 4]) -> Mesh {
    (corners.to_vec(), vec![[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]])
}

/// A sphere about the origin: the icosahedron, every triangle split in four `splits` times.
fn icosphere(splits: usize) -> Mesh {
    let g = 0.5 * (1.0 + 5f64.sqrt());
    let mut vertices = Vec::new();
    for [a, b] in [[1.0, g], [-1.0, g], [1.0, -g], [-1.0, -g]] {
        vertices.extend([[a, b, 0.0], [0.0, a, b], [b, 0.0, a]]);
    }
    let near = |a: [f64; 3], b: [f64; 3]| (0..3).map(|i| (a[i] - b[i]).powi(2)).sum::<f64>() < 4.1;
    let mut triangles = Vec::new();
    for a in 0..12 {
        for b in a + 1..12 {
            for c in b + 1..12 {
                let [p, q, r] = [a, b, c].map(|n: usize| vertices[n]);
                if near(p, q) && near(q, r) && near(r, p) {
                    triangles.push(if det(p, q, r) > 0.0 { [a, b, c] } else { [a, c, b] });
                }
            }
        }
    }
    let mut mesh = (vertices, triangles);
    for _ in 0..splits {
        mesh = split_in_four(&mesh);
    }
    for vertex in &mut mesh.0 {
        let length = vertex.iter().map(|x| x * x).sum::<f64>().sqrt();
        *vertex = vertex.map(|x| x / length);
    }
    mesh
}

fn split_in_four((vertices, triangles): &Mesh) -> Mesh {
    let (mut vertices, mut halves) = (vertices.clone(), BTreeMap::new());
    let mut half = |a: usize, b: usize| {
        *halves.entry([a.min(b), a.max(b)]).or_insert_with(|| {
            vertices.push(std::array::from_fn(|i| 0.5 * (vertices[a][i] + vertices[b][i])));
            vertices.len() - 1
        })
    };
    let split = |[a, b, c]: &[usize; 3]| {
        let [p, q, r] = [half(*a, *b), half(*b, *c), half(*c, *a)];
        [[*a, p, r], [p, *b, q], [r, q, *c], [p, q, r]]
    };
    let triangles = triangles.iter().flat_map(split).collect();
    (vertices, triangles)
}

fn det(a: [f64; 3], b: [f64; 3], c: [f64; 3]) -> f64 {
    a[0] * (b[1] * c[2] - b[2] * c[1])
        + a[1] * (b[2] * c[0] - b[0] * c[2])
        + a[2] * (b[0] * c[1] - b[1] * c[0])
}

/// Two meshes as one.
fn both((mut vertices, mut triangles): Mesh, (others, more): Mesh) -> Mesh {
    let first = vertices.len();
    vertices.extend(others);
    triangles.extend(more.into_iter().map(|corners| corners.map(|corner| corner + first)));
    (vertices, triangles)
}

fn inside_out((vertices, triangles): Mesh) -> Mesh {
    (vertices, triangles.into_iter().map(|[a, b, c]| [a, c, b]).collect())
}

/// Vertices moved.
fn mapped((vertices, triangles): &Mesh, map: impl Fn([f64; 3]) -> [f64; 3]) -> Mesh {
    (vertices.iter().copied().map(map).collect(), triangles.clone())
}

fn all(degree: usize) -> impl Iterator<Item = [usize; 3]> {
    (0..=degree).flat_map(exponents)
}

/// Largest difference of two sets of moments, beside those of `sizes`: even ones, which are integrals of `|x^i y^j z^k|`.
fn difference(a: &Moments, b: &Moments, degree: usize) -> f64 {
    // ∫|x^a y^b z^c| is at least of the order of the geometric mean of its even neighbours.
    let size = |m: [usize; 3]| {
        let low = m.map(|n| n / 2 * 2);
        let high = m.map(|n| n.div_ceil(2) * 2);
        if high.iter().sum::<usize>() > degree { a.of(low) } else { (a.of(low) * a.of(high)).sqrt() }
    };
    all(degree).map(|m| (a.of(m) - b.of(m)).abs() / size(m)).fold(0.0, f64::max)
}

fn binomial(n: usize, k: usize) -> f64 {
    (0..k).map(|i| (n - i) as f64 / (i + 1) as f64).product()
}

fn factorial(n: usize) -> f64 {
    (1..=n).map(|k| k as f64).product()
}

/// A body about the origin whose every ray from there leaves it once, with bumps of up to 40 %.
fn star(splits: usize) -> impl Strategy<Value = Mesh> {
    let size = icosphere(splits).0.len();
    let waves = vec((uniform3(-3.0..3.0), 0.0..6.3), 4);
    let bumps = vec(0.9..1.0, size);
    (waves, bumps).prop_map(move |(waves, bumps)| {
        let (mut vertices, triangles) = icosphere(splits);
        for (vertex, bump) in vertices.iter_mut().zip(bumps) {
            let phase = |(k, start): &([f64; 3], f64)| (0..3).map(|i| k[i] * vertex[i]).sum::<f64>() + start;
            let radius = bump * (1.0 + 0.08 * waves.iter().map(|wave| phase(wave).sin()).sum::<f64>());
            *vertex = vertex.map(|x| x * radius);
        }
        (vertices, triangles)
    })
}

/// `∫ ξ^i` over an interval is `(b^{i+1} − a^{i+1})/(i+1)`; of its absolute value, the same from the origin both ways.
#[test]
fn moments_of_a_box_are_those_of_its_sides() {
    let sides = [[-0.3, 0.2, -4.0], [0.9, 1.1, 7.0]];
    let (origin, scale) = ([0.1, -0.2, 0.5], [0.5, 0.9, 6.0]);
    let moments = closed(&block(sides)).moments(8, origin, scale);
    for m in all(8) {
        let side = |axis: usize| {
            let end = |side: usize| (sides[side][axis] - origin[axis]) / scale[axis];
            let power = |x: f64| x.powi(m[axis] as i32 + 1) / (m[axis] + 1) as f64;
            let size = |x: f64| power(x.abs()) * x.signum();
            [power(end(1)) - power(end(0)), size(end(1)) - size(end(0))]
        };
        let [exact, size] = [0, 1].map(|n| (0..3).map(|axis| side(axis)[n]).product::<f64>());
        assert!((moments.of(m) - exact).abs() <= 1e-14 * size, "{m:?}: {:e} {exact:e}", moments.of(m));
    }
}

/// In barycentric coordinates `∫ λ^α dV = 6V α!/(|α|+3)!`; a monomial is a product of sums `Σ λ_n x_n`.
#[test]
fn moments_of_a_tetrahedron_are_those_in_barycentric_coordinates() {
    let corners = [[0.1, 0.2, -0.3], [1.3, -0.2, 0.1], [0.3, 1.7, 0.4], [-0.4, 0.2, 2.1]];
    let (origin, scale) = ([0.2, 0.1, 0.4], [0.8, 1.1, 1.4]);
    let moments = closed(&tetrahedron(corners)).moments(8, origin, scale);
    let [a, b, c, d] = corners.map(|corner| std::array::from_fn(|i| (corner[i] - origin[i]) / scale[i]));
    let minus = |p: [f64; 3]| std::array::from_fn(|i| p[i] - a[i]);
    let six_volumes = det(minus(b), minus(c), minus(d));
    let integral = |m: [usize; 3], of: fn(f64) -> f64| -> f64 {
        let mut polynomial = BTreeMap::from([([0usize; 4], 1.0)]);
        for axis in [0, 1, 2].into_iter().flat_map(|axis| std::iter::repeat_n(axis, m[axis])) {
            let mut product = BTreeMap::new();
            for (alpha, factor) in polynomial {
                for (n, corner) in [a, b, c, d].into_iter().enumerate() {
                    let mut alpha: [usize; 4] = alpha;
                    alpha[n] += 1;
                    *product.entry(alpha).or_insert(0.0) += factor * of(corner[axis]);
                }
            }
            polynomial = product;
        }
        let term = |(alpha, factor): ([usize; 4], f64)| {
            let (all, each) =
                (alpha.iter().sum::<usize>(), alpha.into_iter().map(factorial).product::<f64>());
            factor * each / factorial(all + 3)
        };
        six_volumes * polynomial.into_iter().map(term).sum::<f64>()
    };
    for m in all(8) {
        let (exact, size) = (integral(m, |x| x), integral(m, f64::abs));
        assert!((moments.of(m) - exact).abs() <= 1e-14 * size, "{m:?}: {:e} {exact:e}", moments.of(m));
    }
}

/// Inscribed spheres lack a layer of thickness h²; moments of the ball are
/// `4π (i−1)!!(j−1)!!(k−1)!! / ((d+1)!! (d+3))`, and zero where an exponent is odd.
#[test]
fn a_refined_sphere_becomes_a_ball_with_order_two() {
    let spheres = [2, 3, 4].map(|splits| closed(&icosphere(splits)).moments(12, [0.0; 3], [1.0; 3]));
    let double = |n: usize| (1..n).step_by(2).map(|k| k as f64).product::<f64>(); // (n−1)!!, n even
    for m in all(12) {
        let found = spheres.each_ref().map(|moments| moments.of(m));
        if m.iter().any(|n| n % 2 == 1) {
            assert!(found.iter().all(|x| x.abs() < 1e-15), "{m:?}: {found:?}");
            continue;
        }
        let degree: usize = m.iter().sum();
        let exact =
            4.0 * PI * m.map(double).iter().product::<f64>() / (double(degree + 2) * (degree + 3) as f64);
        let errors = found.map(|x| exact - x);
        for [coarse, fine] in [[errors[0], errors[1]], [errors[1], errors[2]]] {
            assert!((3.4..4.1).contains(&(coarse / fine)), "{m:?}: {errors:?} of {exact}");
        }
        assert!(errors[2] / exact < 0.03, "{m:?}: {errors:?} of {exact}");
    }
}

proptest! {
    #![proptest_config(cases(24))]

    /// Moments about one origin follow from those about another by the binomial theorem.
    #[test]
    fn moments_about_another_origin_follow_by_shifting(mesh in star(1), from in uniform3(-0.4..0.4), to in uniform3(-0.4..0.4)) {
        let surface = closed(&mesh);
        let [a, b] = [from, to].map(|origin| surface.moments(10, origin, [1.0; 3]));
        let shift: [f64; 3] = std::array::from_fn(|i| from[i] - to[i]);
        for [i, j, k] in all(10) {
            let (mut sum, mut size) = (0.0, 0.0);
            for [p, q, r] in all(i + j + k).filter(|[p, q, r]| *p <= i && *q <= j && *r <= k) {
                let power = |axis: usize, n: usize| shift[axis].powi(n as i32);
                let chosen = binomial(i, p) * binomial(j, q) * binomial(k, r);
                let term = chosen * a.of([p, q, r]) * power(0, i - p) * power(1, j - q) * power(2, k - r);
                sum += term;
                size += term.abs();
            }
            let scale = size.max(b.of([0, 0, 0]) * 0.5f64.powi((i + j + k) as i32));
            prop_assert!((b.of([i, j, k]) - sum).abs() <= 1e-13 * scale, "{:?}", [i, j, k]);
        }
    }

    /// Which corner comes first, which triangle comes first and which vertices are of no triangle does not matter;
    /// nor do triangles split in four.
    #[test]
    fn the_body_matters_and_not_its_triangles(mesh in star(1), turns in vec(0..3usize, 80), start in 0..80usize) {
        let (vertices, triangles) = mesh.clone();
        let mut turned: Vec<[usize; 3]> = triangles
            .iter()
            .zip(&turns)
            .map(|(corners, turn)| std::array::from_fn(|i| vertices.len() - corners[(i + turn) % 3]))
            .collect();
        turned.rotate_left(start);
        let mut renumbered = vec![[7.0, 8.0, 9.0]];
        renumbered.extend(vertices.iter().rev());
        let frame = ([0.1, -0.1, 0.05], [0.9, 1.0, 1.1]);
        let surface = closed(&mesh);
        let expected = surface.moments(12, frame.0, frame.1);
        let other = closed(&(renumbered, turned));
        prop_assert_eq!(surface.bounds(), other.bounds());
        prop_assert_eq!((surface.edges().count(), other.edges().count()), (120, 120));
        for other in [other, closed(&split_in_four(&mesh)), closed(&split_in_four(&split_in_four(&mesh)))] {
            let found = other.moments(12, frame.0, frame.1);
            prop_assert!(difference(&expected, &found, 12) < 1e-13, "{}", difference(&expected, &found, 12));
        }
    }

    /// A cavity takes its moments away, bodies side by side add theirs.
    #[test]
    fn shells_add(outer in star(1), inner in star(0), place in uniform3(-0.05..0.05)) {
        let inner = mapped(&inner, |x| std::array::from_fn(|i| 0.2 * x[i] + place[i]));
        let beside = mapped(&inner, |[x, y, z]| [x, y, z + 2.0]);
        let of = |mesh: &Mesh| closed(mesh).moments(6, [0.1, 0.0, 0.2], [1.0; 3]);
        let hollow = of(&both(both(outer.clone(), beside.clone()), inside_out(inner.clone())));
        let parts = [outer, beside, inner].map(|mesh| of(&mesh));
        for m in all(6) {
            let [outer, beside, inner] = parts.each_ref().map(|moments| moments.of(m));
            let size = 2f64.powi(m.iter().sum::<usize>() as i32);
            prop_assert!((hollow.of(m) - (outer + beside - inner)).abs() < 1e-14 * size, "{m:?}");
        }
    }

    /// Nothing knows the unit of length, nor where the axes of the file start.
    #[test]
    fn moments_do_not_know_units(mesh in star(1), unit in -9..=9i32, shift in uniform3(-3.0..3.0)) {
        let unit = 10f64.powi(unit);
        let place = |x: [f64; 3]| -> [f64; 3] { std::array::from_fn(|i| unit * (x[i] + shift[i])) };
        let other = closed(&mapped(&mesh, place));
        let here = closed(&mesh);
        let expected = here.moments(16, here.centroid(), [0.8; 3]);
        let found = other.moments(16, other.centroid(), [0.8 * unit; 3]);
        prop_assert!(difference(&expected, &found, 16) < 1e-13, "{}", difference(&expected, &found, 16));
        prop_assert!((other.volume() / unit.powi(3) / here.volume() - 1.0).abs() < 1e-13);
        for (found, expected) in other.centroid().into_iter().zip(place(here.centroid())) {
            prop_assert!((found - expected).abs() < 1e-14 * unit);
        }
    }
}

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

/// Lines that are nearly straight: the last bit decides, and it is the same bit for a grain and for a moon.
#[test]
fn a_sliver_is_a_triangle_until_rounding() {
    for unit in [1e-9, 1.0, 1e9] {
        // A cube whose first side has a vertex close to its diagonal.
        let with = |height: f64| {
            let (mut vertices, mut triangles) = mapped(&block(UNIT_CUBE), |x| x.map(|x| x * unit));
            let on = [-1.0, 0.5 * height, -0.5 * height].map(|x| x * unit); // diagonal from [-1, -1] to [1, 1]
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
