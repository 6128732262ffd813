//! Solids inside surfaces outside the family of necks: rings, arcs, bowls, plates aslant; the estimated error bounds the true one there
//! too.

use std::f64::consts::{PI, TAU};

use nalgebra::{Matrix6, Rotation3, Vector3};
use quasirigid::elements::{Approximation, Problem};
use quasirigid_mesh::Mesh;
use quasirigid_mesh::surface::ClosedSurface;

use super::meshes::outer;
use super::necked::{disc, straight};
use super::necks::{apart, element, of, truth};

type Place = Vector3<f64>;

fn turned(place: Place) -> Place {
    Rotation3::from_euler_angles(0.7, -0.4, 1.9) * place
}

/// Straight tetrahedra between discs of so many steps around and layers, swept through so many places from 0 to 1, or round and closed.
fn swept(
    [around, layers]: [usize; 2],
    steps: usize,
    closed: bool,
    place: impl Fn(f64, [f64; 2]) -> Place,
) -> Mesh {
    let size = 1 + layers * around;
    let at =
        |layer: usize, step: usize| if layer == 0 { 0 } else { 1 + (layer - 1) * around + step % around };
    let place_on_disc = |node: usize| {
        let (layer, step) = if node == 0 { (0, 0) } else { ((node - 1) / around + 1, (node - 1) % around) };
        let (r, angle) = (layer as f64 / layers as f64, TAU * step as f64 / around as f64);
        [r * angle.cos(), r * angle.sin()]
    };
    let triangles = disc([around, layers], at);
    let sections = if closed { steps } else { steps + 1 };
    let nodes: Vec<Place> = (0..sections * size)
        .map(|node| place((node / size) as f64 / steps as f64, place_on_disc(node % size)))
        .collect();
    let mut cells = Vec::new();
    for section in 0..steps {
        let (here, there) = (section * size, (section + 1) % sections * size);
        for mut triangle in triangles.clone() {
            triangle.sort_unstable();
            let ([p, q, r], [u, v, w]) =
                (triangle.map(|node| here + node), triangle.map(|node| there + node));
            cells.extend([[p, q, r, w], [p, q, v, w], [p, u, v, w]]);
        }
    }
    straight(&nodes, cells)
}

/// A tube around z through an angle, by its radius at each angle.
fn arc(steps: usize, through: f64, radius: impl Fn(f64) -> f64, place: fn(Place) -> Place) -> Mesh {
    swept([10, 1], steps, through == TAU, |share, [y, z]| {
        let angle = through * share;
        let (arm, height) = (1.0 + radius(angle) * y, radius(angle) * z);
        place(Place::new(arm * angle.cos(), arm * angle.sin(), height))
    })
}

fn thin_at_one_place(angle: f64) -> f64 {
    0.3 * (1.0 - 0.7 * (-(angle - PI).powi(2) / 0.15).exp())
}

/// Approximation with its estimated and its true error, or the refusal.
fn judged(name: &str, mesh: &Mesh, surface: &ClosedSurface) -> Option<(Approximation, f64)> {
    judged_by(name, || truth(mesh, false), surface)
}

/// The same with the limits of meshes, which take long.
fn judged_by(
    name: &str,
    truth: impl FnOnce() -> [Matrix6<f64>; 2],
    surface: &ClosedSurface,
) -> Option<(Approximation, f64)> {
    let built = match element(surface, None, None).build() {
        Ok(built) => built,
        Err(refusal) => {
            println!("{name}: {refusal}");
            assert!(
                matches!(refusal.problem, Problem::Unmeshed { .. } | Problem::Unsettled { .. }),
                "{refusal}"
            );
            return None;
        }
    };
    let resolution = built.resolution.unwrap();
    let errors = truth().map(|expected| apart(&of(&built.body), &expected));
    let error = errors[0].max(errors[1]);
    println!("{name}: {:?}: told {:.4}, true {error:.4}", resolution.approximation, resolution.error);
    assert!(error <= resolution.error, "{name}");
    Some((resolution.approximation, resolution.error))
}

/// Cells as wide as the thin place tear the ring there, and its compliance grows thirtyfold: it is refused, or right.
#[test]
fn a_ring_that_is_thin_at_one_place_is_not_torn() {
    let mesh = arc(30, TAU, thin_at_one_place, |x| 1e-4 * turned(x) + Place::new(2e-4, 0.0, -1e-4));
    let surface = outer(&mesh);
    let expected = truth(&mesh, false);
    for cells in [2000, 5000] {
        match element(&surface, None, Some(cells)).body() {
            Ok(body) => assert!(apart(&of(&body), &expected[1]) < 0.5, "{cells}"),
            Err(refusal) => println!("{cells}: {refusal}"),
        }
    }
    judged_by("ring", || expected, &surface);
}

#[test]
fn the_error_told_bounds_the_true_one_on_an_arc_that_nearly_closes() {
    let mesh = arc(22, 342_f64.to_radians(), |_| 0.35, |x| 1e4 * turned(x) + Place::new(3e4, -9e3, 4e2));
    assert!(judged("arc", &mesh, &outer(&mesh)).is_some());
}

#[test]
fn the_error_told_bounds_the_true_one_on_a_bowl() {
    let mesh = swept([16, 5], 1, false, |share, [y, z]| {
        let (polar, r) = (1.3 * y.hypot(z), 0.775 + 0.45 * share);
        let angle = z.atan2(y);
        turned(r * Place::new(polar.sin() * angle.cos(), polar.sin() * angle.sin(), -polar.cos()))
    });
    judged("bowl", &mesh, &outer(&mesh));
}

/// Thin bodies that lie aslant in their file are resolved as those that lie along its axes.
#[test]
fn thin_convex_bodies_aslant_are_resolved_by_polynomials() {
    for (name, thickness, slim) in [("disc", 0.05, 1.0), ("blade", 0.03, 0.3)] {
        let mesh = swept([24, 6], 1, false, |share, [y, z]| {
            13.0 * turned(Place::new(thickness * (share - 0.5), y, slim * z)) + Place::new(2.0, 50.0, -7.0)
        });
        let (approximation, told) = judged(name, &mesh, &outer(&mesh)).unwrap();
        assert!(matches!(approximation, Approximation::Polynomials { .. }) && told < 0.01, "{name} {told}");
    }
}
