//! Sunlight on facets: the sum in plain vectors, closed forms of spheres, ellipsoids and shadows, harmonics, and the load on a body. (F27)–(F29)

use std::f64::consts::PI;
use std::sync::Arc;

use nalgebra::{Matrix3, Rotation3, Vector3};
use proptest::prelude::*;
use quasirigid::elements::SunlitShape;
use quasirigid::model::force::{Force, ForceLaw, SunPath};
use quasirigid_math::quadrature::gauss_legendre;
use quasirigid_mesh::surface::ClosedSurface;

use super::forced::{State, forced, orbit, states};
use crate::support::{assemblies, cases};

type V = Vector3<f64>;

/// Corners of a tetrahedron that no symmetry has, off the origin.
const CORNERS: [[f64; 3]; 4] = [[1.3, 0.2, -0.1], [-0.4, 1.1, 0.3], [-0.7, -0.9, 0.1], [0.2, 0.3, 1.7]];
const FACES: [[usize; 3]; 4] = [[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]];

pub fn tetrahedron(moved: impl Fn(V) -> V) -> ClosedSurface {
    let vertices = CORNERS.iter().map(|corner| moved(V::from(*corner)).into()).collect();
    ClosedSurface::new(vertices, FACES.to_vec()).unwrap()
}

/// Force and torque about the mean of the corners per pressure, face by face: light pushes along its way, and Lambert's recoil along the
/// normal.
fn plain(surface: &ClosedSurface, sun: V) -> [V; 2] {
    let corner = |k: usize| V::from(surface.vertices()[k]);
    let center = (0..4).map(corner).sum::<V>() / 4.0;
    surface.triangles().iter().fold([V::zeros(); 2], |[force, torque], [a, b, c]| {
        let (a, b, c) = (corner(*a), corner(*b), corner(*c));
        let area = (b - a).cross(&(c - a)) / 2.0;
        let lit = area.dot(&sun).max(0.0);
        let push = -lit * (sun + 2.0 / 3.0 * area.normalize());
        [force + push, torque + ((a + b + c) / 3.0 - center).cross(&push)]
    })
}

fn suns() -> impl Iterator<Item = V> {
    (0..40)
        .map(|k| {
            V::new((1.3 * f64::from(k)).sin(), (2.1 * f64::from(k) + 1.0).sin(), (0.7 * f64::from(k)).cos())
        })
        .map(|sun| sun.normalize())
}

/// In any unit of length and any axes: forces scale with its square, torques with its cube; the harmonics are off by what they say.
#[test]
fn loads_are_the_sum_over_the_faces_in_any_unit_and_axes() {
    let turn = Rotation3::from_axis_angle(&nalgebra::Unit::new_normalize(V::new(1.0, -2.0, 0.5)), 0.9);
    let unturned = SunlitShape::of_surface(&tetrahedron(|r| r), true).harmonics(0.003).1;
    for unit in [1e-4, 1.0, 1e4] {
        let surface = tetrahedron(|r| unit * (turn * r + V::new(3.0, -1.0, 2.0)));
        let shape = SunlitShape::of_surface(&surface, true);
        assert!(!shape.has_shadows() && shape.count() == 4);
        let (harmonics, accuracy) = shape.harmonics(0.003);
        assert!((accuracy.torque / (unit.powi(3) * unturned.torque) - 1.0).abs() < 0.01);
        let (mut squares, mut worst) = (0.0, 0.0_f64);
        for sun in suns() {
            let [force, torque] = plain(&surface, sun);
            let [exact_force, exact_torque] = shape.loads(sun.into()).map(V::from);
            assert!((exact_force - force).norm() <= 1e-13 * force.norm());
            assert!((exact_torque - torque).norm() <= 1e-11 * unit.powi(3), "{exact_torque} {torque}");
            let error = (V::from(harmonics.at(sun.into())[1]) - torque).norm() / accuracy.torque;
            (squares, worst) = (squares + error * error / 40.0, worst.max(error));
        }
        assert!(
            squares.sqrt() < 2.0 * accuracy.error && worst < 2.0 * accuracy.greatest,
            "{squares} {worst} {accuracy:?}"
        );
        // Each degree of the harmonics is exact, and four faces have many.
        assert!(
            harmonics.degree() == 48 && accuracy.error < 0.01 && accuracy.force_error < 2e-3,
            "{accuracy:?}"
        );
    }
}

/// `πR²(1 + 4/9)`: half the surface sends back two thirds of two thirds.
#[test]
fn a_sphere_is_pushed_and_not_turned() {
    let sphere = SunlitShape::of_ellipsoid([250.0; 3], [0.0; 3]);
    let (harmonics, accuracy) = sphere.harmonics(0.01);
    assert!(accuracy.torque < 1e-12 * 250f64.powi(3), "{accuracy:?}");
    for sun in suns() {
        for [force, torque] in
            [sphere.loads(sun.into()), harmonics.at(sun.into())].map(|loads| loads.map(V::from))
        {
            let known = -PI * 250f64.powi(2) * 13.0 / 9.0 * sun;
            assert!((force - known).norm() < 2e-3 * known.norm(), "{force} {known}");
            assert!(torque.norm() < 1e-12 * 250f64.powi(3), "{torque}");
        }
    }
}

/// Torque of an ellipsoid by an integral over the normals about the Sun, which is smooth on the lit half: `dA = (abc)²/h⁴ dΩ` with the
/// distance `h` of the tangent plane.
fn of_ellipsoid(semi_axes: [f64; 3], sun: V) -> V {
    let D = Matrix3::from_diagonal(&V::from(semi_axes));
    let across = sun.cross(&V::new(0.6, -0.3, 0.8)).normalize();
    let third = sun.cross(&across);
    let steps = 120;
    let mut torque = V::zeros();
    for [node, weight] in gauss_legendre(60) {
        let cos = 0.5 * (1.0 + node);
        let sin = (1.0 - cos * cos).sqrt();
        for step in 0..steps {
            let (s, c) = (2.0 * PI * f64::from(step) / f64::from(steps)).sin_cos();
            let n = cos * sun + sin * (c * across + s * third);
            let h = (D * n).norm();
            let area = D.determinant().powi(2) / h.powi(4) * 0.5 * weight * 2.0 * PI / f64::from(steps);
            torque -= (D * D * n / h).cross(&(sun + 2.0 / 3.0 * n)) * cos * area;
        }
    }
    torque
}

/// An ellipsoid is turned, but not about an axis of symmetry; about the axis of its spin the turns of half a revolution cancel.
#[test]
fn an_ellipsoid_is_turned_by_the_recoil_alone_and_not_in_the_mean() {
    let semi_axes = [2.0, 1.4, 0.9];
    let shape = SunlitShape::of_ellipsoid(semi_axes, [5.0, -3.0, 1.0]);
    for sun in suns().take(6) {
        let (found, known) = (V::from(shape.loads(sun.into())[1]), of_ellipsoid(semi_axes, sun));
        assert!((found - known).norm() < 3e-3 * known.norm(), "{found} {known}");
        assert!(known.dot(&sun).abs() < 1e-9, "no torque about the way of the light: {known}");
        let quarter = (0..4).map(|k| V::from(shape.loads(<[f64; 3]>::from(sun).turned(k))[1]).z).sum::<f64>();
        assert!(quarter.abs() < 1e-12, "{quarter}");
    }
    for axis in 0..3 {
        let mut along = [0.0; 3];
        along[axis] = 1.0;
        assert!(V::from(shape.loads(along)[1]).norm() < 1e-12);
    }
    let spheroid = SunlitShape::of_ellipsoid([1.5, 1.5, 0.7], [0.0; 3]);
    assert!(suns().all(|sun| spheroid.loads(sun.into())[1][2].abs() < 2e-3));
}

/// Mirror images of a direction in the planes through z.
trait Turned {
    fn turned(self, k: u32) -> [f64; 3];
}

impl Turned for [f64; 3] {
    fn turned(self, k: u32) -> [f64; 3] {
        let sign = |bit: u32| if k & bit == 0 { 1.0 } else { -1.0 };
        [sign(1) * self[0], sign(2) * self[1], self[2]]
    }
}

/// An L of three cubes.
pub fn elbow() -> ClosedSurface {
    let outline = [[0.0, 0.0], [2.0, 0.0], [2.0, 1.0], [1.0, 1.0], [1.0, 2.0], [0.0, 2.0]];
    let vertices: Vec<[f64; 3]> =
        [0.0, 1.0].into_iter().flat_map(|z| outline.map(|[x, y]| [x, y, z])).collect();
    let caps = [[0, 1, 2], [0, 2, 3], [0, 3, 4], [0, 4, 5]]
        .into_iter()
        .flat_map(|[a, b, c]| [[a, c, b], [a + 6, b + 6, c + 6]]);
    let sides = (0..6).flat_map(|k| {
        let n = (k + 1) % 6;
        [[k, n, n + 6], [k, n + 6, k + 6]]
    });
    ClosedSurface::new(vertices, caps.chain(sides).collect()).unwrap()
}

/// An L of three cubes in light along a diagonal: of two walls that face the Sun the one in the corner is in the shadow of the other arm.
#[test]
fn shadows_take_what_they_hide() {
    let surface = elbow();
    let [lit, unshaded] = [true, false].map(|shadows| SunlitShape::of_surface(&surface, shadows));
    assert!(lit.has_shadows() && !unshaded.has_shadows());
    let sun = V::new(-1.0, 1.0, 0.0).normalize();
    let cos = 0.5f64.sqrt();
    // areas, normals and middles of the left wall, the upper end and the inner wall
    let walls = [
        (2.0, -V::x(), V::new(0.0, 1.0, 0.5)),
        (1.0, V::y(), V::new(0.5, 2.0, 0.5)),
        (1.0, V::y(), V::new(1.5, 1.0, 0.5)),
    ];
    let center = V::new(5.0 / 6.0, 5.0 / 6.0, 0.5);
    for (shape, number) in [(&lit, 2), (&unshaded, 3)] {
        let known =
            walls[..number].iter().fold([V::zeros(); 2], |[force, torque], (area, normal, middle)| {
                let push = -cos * *area * (sun + 2.0 / 3.0 * normal);
                [force + push, torque + (middle - center).cross(&push)]
            });
        for (found, known) in shape.loads(sun.into()).map(V::from).into_iter().zip(known) {
            assert!((found - known).norm() < 1e-12, "{found} {known}");
        }
    }
    // The mirror of the L through its corner has none of its torque; the harmonics keep that of the shadows.
    let (harmonics, accuracy) = lit.harmonics(0.02);
    assert!(accuracy.error < 0.05, "{accuracy:?}");
    let mirrored = |sun: V| V::new(sun.y, sun.x, sun.z);
    for sun in suns().take(12) {
        let [one, other] = [sun, mirrored(sun)].map(|sun| V::from(lit.loads(sun.into())[1]));
        assert!((one + mirrored(other)).norm() < 0.03, "{one} {other}");
        let off = (V::from(harmonics.at(sun.into())[1]) - one).norm();
        assert!(off < 2.0 * accuracy.greatest * accuracy.torque, "{off} {accuracy:?}");
    }
}

proptest! {
    #![proptest_config(cases(32))]

    /// On an orbit and any attitude, about a pole of its own: pressure by the inverse square, force and moment in plain vectors.
    #[test]
    fn loads_on_a_body_are_those_of_its_facets(assembly in assemblies(), loose in states(), orbit in orbit()) {
        let surface = tetrahedron(|r| r);
        let shape = SunlitShape::of_surface(&surface, true);
        let (loads, _) = shape.harmonics(0.1);
        let law = |sun| ForceLaw::Sunlight { loads: Arc::new(loads.clone()), sun };
        // An orbit about the Sun at a few of its radii, in the phase of the one drawn.
        let mu = 1.327_124_400_41e20;
        let orbit = quasirigid::model::force::Orbit { mu, semi_major_axis: 2e11 * (1.0 + orbit.eccentricity), ..orbit };
        let assembly = forced(&assembly, vec![Force { name: "light".into(), law: law(SunPath::Orbit(orbit.into())) }]);
        let (body, forces) = (assembly.body().unwrap(), assembly.forces().unwrap());
        let state = State::of(&body, &loose, 0.5);
        let found = body.loads(&forces, &state.kinematics());
        let place = V::from(orbit.at(state.t).place);
        let sun = state.turn().transpose() * -place.normalize();
        let pressure = 1361.0 / 299_792_458.0 * (149_597_870_700.0 / place.norm()).powi(2);
        let [force, torque] = loads.at(sun.into()).map(V::from);
        let center = V::from(CORNERS[0]) + V::from(CORNERS[1]) + V::from(CORNERS[2]) + V::from(CORNERS[3]);
        let moment = torque + (center / 4.0 - V::from(body.pole())).cross(&force);
        prop_assert!((V::from(found.force) - pressure * force).norm() <= 1e-12 * pressure * force.norm());
        prop_assert!((V::from(found.moment) - pressure * moment).norm() <= 1e-11 * pressure * (moment.norm() + force.norm()));
        prop_assert!(found.generalized.iter().all(|load| *load == 0.0));
        // The same Sun that stands still, in a vector of another length.
        let fixed = law(SunPath::Fixed { direction: (-1e-7 * place).into(), distance: place.norm() });
        let assembly = forced(&assembly, vec![Force { name: "light".into(), law: fixed }]);
        let still = body.loads(&assembly.forces().unwrap(), &state.kinematics());
        prop_assert!((V::from(still.moment) - V::from(found.moment)).norm() <= 1e-12 * (V::from(found.moment).norm() + pressure * force.norm()));
    }
}

/// Lambert's law sends out what comes in, with two thirds of its momentum along the normal: the albedo does not matter.
#[test]
fn the_recoil_of_lambert_is_two_thirds() {
    let over_half = |power: i32| -> f64 {
        gauss_legendre(8).into_iter().map(|[node, weight]| weight * (0.5 * (1.0 + node)).powi(power)).sum()
    };
    // radiance cos θ/π over 2π sin θ dθ: energy with cos θ, momentum with cos² θ
    let (energy, momentum) = (over_half(1), over_half(2));
    assert!((energy - 1.0).abs() < 1e-14 && (momentum - 2.0 / 3.0).abs() < 1e-14);
}
