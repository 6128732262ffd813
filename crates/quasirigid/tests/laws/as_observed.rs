//! Bodies whose shape or moments were observed in rotation: the relaxed body, its bulge, its free wobble. (G17)–(G19)

use quasirigid::averaging::FreeRotation;
use quasirigid::elements::{
    Assembly, ElementError, Ellipsoid, Field, Material, ObservedShape, Problem, Relaxed, Surface,
};
use quasirigid::model::{FlexibleBody, Mode, Rheology};
use quasirigid::modes::{RelativeEquilibrium, SpinMagnitude, SpinModes};
use quasirigid_mesh::surface::ClosedSurface;

/// A steady spin (rad/s) as its products.
fn steady([x, y, z]: [f64; 3]) -> [f64; 6] {
    [x * x, y * y, z * z, y * z, z * x, x * y]
}

fn relaxed(given: &Assembly, products: impl Fn([f64; 6]) -> [f64; 6]) -> Result<Relaxed, ElementError> {
    given.relaxed(|[_, J]| Ok(products(J)))
}

fn observed(ellipsoid: Ellipsoid, shape: ObservedShape) -> Assembly {
    Assembly { ellipsoids: vec![ellipsoid], as_observed: Some(shape), ..Assembly::default() }
}

/// Semi-axes of a homogeneous ellipsoid with these moments of unit mass.
fn semi_axes([A, B, C]: [f64; 3]) -> [f64; 3] {
    [B + C - A, A + C - B, A + B - C].map(|sum| (2.5 * sum).sqrt())
}

/// Bulge `δ(C − A)` (kg·m²) of a homogeneous elastic ball at a slow spin. The displacement by the potential `W` of degree two is
/// `(αR² + βr²)∇W + γWr`: Navier's equation and a free surface give three linear equations. (G20)
fn bulge_of_ball(radius: f64, Material { density, young, poisson, .. }: &Material, spin: f64) -> f64 {
    let mu = young / (2.0 * (1.0 + poisson));
    let lambda = young * poisson / ((1.0 + poisson) * (1.0 - 2.0 * poisson));
    // (λ+μ)(4β+5γ) + μ(10β+2γ) = −ρ,  λ(4β+5γ) + 4μ(β+γ) = 0,  2α + 4β + γ = 0
    let (a, b) = (4.0 * (lambda + mu) + 10.0 * mu, 5.0 * (lambda + mu) + 2.0 * mu);
    let (c, d) = (4.0 * lambda + 4.0 * mu, 5.0 * lambda + 4.0 * mu);
    let beta = -density * d / (a * d - b * c);
    let gamma = density * c / (a * d - b * c);
    let alpha = -0.5 * (4.0 * beta + gamma);
    let form = (alpha / 5.0 + beta / 7.0) / 3.0 + gamma / 105.0;
    8.0 * std::f64::consts::PI * density * spin * spin * radius.powi(7) * form
}

/// The free wobble of a ball whose difference of moments contains its bulge `b` is slower than Euler's by `1 − b/(C − A)`.
#[test]
fn the_wobble_of_a_ball_as_observed_is_slower_by_the_share_of_its_bulge() {
    for (radius, density, young, poisson) in
        [(6.4e6_f64, 5514.0, 4.5e11_f64, 0.29), (0.3, 2e-3, 7e5, 0.05), (2e-4, 8e3, 3.0, 0.45)]
    {
        let material = Material::new(density, young, poisson);
        let spin = 1e-4 * (young / density).sqrt() / radius; // the bulge is 1e-9 of the moments
        let moment = 0.4 * density * 4.0 / 3.0 * std::f64::consts::PI * radius.powi(5);
        let bulge = bulge_of_ball(radius, &material, spin);
        let gap = 3.0 * bulge / moment;
        let ratios = semi_axes([1.0, 1.0, 1.0 + gap]);
        let mean = ratios.iter().product::<f64>().cbrt();
        let given = Ellipsoid::new("ball", ratios.map(|axis| radius * axis / mean), material);
        let given = observed(given, ObservedShape::Moments);
        let found = relaxed(&given, |_| steady([0.0, 0.0, spin])).unwrap();
        let body = found.assembly.body().unwrap();
        let [A, B, C, ..] = body.invariants().J;
        assert!((A / B - 1.0).abs() < 1e-14);
        let left = (C - A) / (found.inertia[2] - found.inertia[0]);
        assert!((left / (2.0 / 3.0) - 1.0).abs() < 1e-6, "{left}");

        let about = RelativeEquilibrium::near(&body, [0.0, 0.0, 1.0], SpinMagnitude::Rate(spin)).unwrap();
        let modes = SpinModes::about(&body, about).unwrap();
        let nutation = modes.modes.iter().find(|mode| mode.nutation).unwrap().frequency;
        let euler = spin * (found.inertia[2] - found.inertia[0]) / found.inertia[0];
        assert!((nutation / euler / (2.0 / 3.0) - 1.0).abs() < 1e-6, "{nutation} {euler}");
    }
}

const AXES: [f64; 3] = [170.0, 141.0, 120.0];

/// Rubber that a spin of this rate (rad/s) changes by two per cent.
const SPIN: f64 = 0.05;

fn rubber() -> Material {
    Material::new(1900.0, 1e6, 0.3)
}

/// The body as its steady spin deforms it, by the modes' own equilibrium.
fn spun(body: &FlexibleBody, axis: [f64; 3], rate: f64) -> ([f64; 3], [f64; 6]) {
    let steady = RelativeEquilibrium::near(body, axis, SpinMagnitude::Rate(rate)).unwrap();
    let tips = [0, 1, 2].map(|i| {
        let tip = &body.markers()[i];
        tip.position[i] + tip.displacement(&steady.q)[i]
    });
    (tips, body.full_inertia_at(&steady.q))
}

/// The relaxed body, set in rotation again, has the shape or the moments that were observed, and the mass of the density given.
#[test]
fn a_relaxed_body_set_in_rotation_is_the_body_observed() {
    let given = Ellipsoid { center: [3.0, -2.0, 1.0], ..Ellipsoid::new("rock", AXES, rubber()) };
    let still = Assembly::default().with(given.clone()).body().unwrap();
    for axis in [[0.0, 0.0, 1.0], [1.0, 0.0, 0.0]] {
        let products = |_: [f64; 6]| steady(axis.map(|entry| SPIN * entry));
        let of = |shape| relaxed(&observed(given.clone(), shape), products).unwrap();

        let found = of(ObservedShape::Surface);
        let body = found.assembly.body().unwrap();
        let (tips, inertia) = spun(&body, axis, SPIN);
        (0..3).for_each(|i| assert!((tips[i] / AXES[i] - 1.0).abs() < 1e-13, "{tips:?}"));
        (0..3).for_each(|i| assert!((inertia[i] / found.inertia[i] - 1.0).abs() < 1e-13));
        assert!((body.invariants().mass / still.invariants().mass - 1.0).abs() < 1e-14);
        let strain = found.assembly.ellipsoids[0].semi_axes[2] / AXES[2] - 1.0;
        assert!(strain.abs() > 2e-3, "{strain}");

        let found = of(ObservedShape::Moments);
        let (_, inertia) = spun(&found.assembly.body().unwrap(), axis, SPIN);
        let wanted = still.invariants().J;
        (0..3).for_each(|i| assert!((inertia[i] / wanted[i] - 1.0).abs() < 1e-13, "{inertia:?} {wanted:?}"));
        assert_eq!(found.assembly.ellipsoids[0].center, given.center);
    }
}

/// Of a tumbling body the mean over the motion is the shape observed: the displacement is linear in the products of the spin but for the
/// softening, which falls with the square of the spin.
#[test]
fn the_mean_load_of_a_wobble_gives_the_mean_displacement() {
    let body = Assembly::default().with(Ellipsoid::new("rock", AXES, rubber())).body().unwrap();
    let [A, B, C, ..] = body.invariants().J;
    let error = |spin: f64| {
        let motion = FreeRotation::at_nutation([A, B, C], spin * A, Mode::LongAxis, 1.1).unwrap();
        let mean = |i: usize, k: usize| motion.mean(2, |omega| omega[i] * omega[k]);
        let products = [mean(0, 0), mean(1, 1), mean(2, 2), 0.0, 0.0, 0.0];
        let found = body.displaced_by(products).unwrap();
        let along = |q: &[f64]| body.full_inertia_at(q)[2] / C - 1.0;
        let sampled = motion.mean(8, |omega| along(&body.displaced_by(steady(omega)).unwrap()));
        along(&found) / sampled - 1.0
    };
    let [slow, fast] = [error(0.005), error(0.01)];
    assert!(fast.abs() < 0.01 && (fast / slow / 4.0 - 1.0).abs() < 0.05, "{slow} {fast}");
}

/// An octahedron whose triangles are cut so many times, its vertices on the ellipsoid about a place.
fn faceted(cuts: usize) -> ClosedSurface {
    let mut vertices: Vec<[f64; 3]> = vec![
        [1.0, 0.0, 0.0],
        [-1.0, 0.0, 0.0],
        [0.0, 1.0, 0.0],
        [0.0, -1.0, 0.0],
        [0.0, 0.0, 1.0],
        [0.0, 0.0, -1.0],
    ];
    let mut triangles =
        vec![[0, 2, 4], [2, 1, 4], [1, 3, 4], [3, 0, 4], [2, 0, 5], [1, 2, 5], [3, 1, 5], [0, 3, 5]];
    for _ in 0..cuts {
        let mut finer = Vec::new();
        for [a, b, c] in triangles {
            let mut middle = |i: usize, k: usize| {
                let sum: [f64; 3] = std::array::from_fn(|axis| vertices[i][axis] + vertices[k][axis]);
                let size = sum.iter().map(|entry| entry * entry).sum::<f64>().sqrt();
                let place = sum.map(|entry| entry / size);
                vertices.iter().position(|other| *other == place).unwrap_or_else(|| {
                    vertices.push(place);
                    vertices.len() - 1
                })
            };
            let (ab, bc, ca) = (middle(a, b), middle(b, c), middle(c, a));
            finer.extend([[a, ab, ca], [ab, b, bc], [ca, bc, c], [ab, bc, ca]]);
        }
        triangles = finer;
    }
    let placed =
        |place: [f64; 3]| std::array::from_fn(|axis| AXES[axis] * place[axis] + [40.0, -9.0, 3.0][axis]);
    ClosedSurface::new(vertices.into_iter().map(placed).collect(), triangles).unwrap()
}

/// A surface as observed is that of the ellipsoid, to the square of the strain: by polynomials and by cells. Its facets lie inside the ellipsoid;
/// the displacement goes with the cube of the size, that is with the volume.
#[test]
fn a_surface_observed_relaxes_as_the_ellipsoid_does() {
    let products = |_: [f64; 6]| steady([0.0, 0.0, 0.2 * SPIN]);
    let ellipsoid = Ellipsoid::new("rock", AXES, rubber());
    let exact = relaxed(&observed(ellipsoid, ObservedShape::Surface), products).unwrap();
    let exact = exact.assembly.ellipsoids[0].semi_axes;
    let surface = faceted(3);
    let smaller = surface.volume() / (4.0 / 3.0 * std::f64::consts::PI * AXES.iter().product::<f64>());
    for (degree, cells, tolerance) in [(Some(4), None, 0.01), (None, Some(1500), 0.03)] {
        let material = rubber();
        let surface = Surface { name: "rock".into(), surface: surface.clone(), material, degree, cells };
        let given = Assembly {
            surfaces: vec![surface],
            as_observed: Some(ObservedShape::Surface),
            ..Assembly::default()
        };
        let found = relaxed(&given, products).unwrap();
        let [low, high] = found.assembly.surfaces[0].surface.bounds();
        for i in 0..3 {
            let [own, other] = [0.5 * (high[i] - low[i]), exact[i]].map(|axis| axis - AXES[i]);
            println!("{degree:?} {i}: {} of the ellipsoid of equal volume", own / (smaller * other));
            assert!((own / (smaller * other) - 1.0).abs() < tolerance, "{degree:?} {i}: {own} {other}");
        }
        let mass = |assembly: &Assembly| assembly.body().unwrap().invariants().mass;
        let plain = Assembly { as_observed: None, ..given.clone() };
        assert!((mass(&found.assembly) / mass(&plain) - 1.0).abs() < 1e-9);
    }
}

/// What has no relaxed body is refused in words, and an observed one is not built as if it were relaxed.
#[test]
fn bodies_without_a_relaxed_shape_are_refused() {
    let problem = |material: Material, spin: [f64; 3], axes| {
        let given = observed(Ellipsoid::new("rock", axes, material), ObservedShape::Moments);
        relaxed(&given, |_| steady(spin)).map(drop).map_err(|error| (error.field, error.problem))
    };
    let soft = problem(rubber(), [0.0, 0.0, 8.0 * SPIN], AXES).unwrap_err();
    assert!(soft.0 == Field::SHAPE && matches!(soft.1, Problem::TooSoft { .. }), "{soft:?}");
    let turned = problem(rubber(), [0.02, 0.0, 0.04], [150.0; 3]).unwrap_err();
    assert!(matches!(turned.1, Problem::Aslant), "{turned:?}");
    problem(rubber(), [0.0, 0.04, 0.0], [150.0; 3]).unwrap();
    let flowing = Material { rheology: Rheology::Maxwell { time: 1e6 }, ..rubber() };
    assert!(matches!(problem(flowing, [0.0, 0.0, SPIN], AXES).unwrap_err().1, Problem::FlowsSteadily));

    let given = observed(Ellipsoid::new("rock", AXES, rubber()), ObservedShape::Surface);
    assert_eq!(given.body().unwrap_err().problem, Problem::AsObserved);
    let carrier = Assembly { as_observed: Some(ObservedShape::Surface), ..Assembly::default() };
    assert!(relaxed(&carrier, |_| steady([0.0; 3])).is_err());
}
