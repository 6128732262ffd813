//! Nutation of bodies with liquids that spin with them, off the centre of mass and in any axes.

use nalgebra::{Complex, Matrix3, Vector3};
use quasirigid::elements::{Assembly, Cavity, CavityShape};
use quasirigid::model::Mode;
use quasirigid::modes::{
    RelativeEquilibrium, SpinMagnitude, SpinMode, SpinModes, SteadyModes, SteadyState, SteadyStateGuess,
};
use quasirigid_math::rotation::turned;

use super::bodies::tank;
use crate::support::parts;

const ALIGNED: [f64; 4] = [1.0, 0.0, 0.0, 0.0];
const SPIN: f64 = 0.8;
const DENSITY: f64 = 900.0;

fn shapes() -> [CavityShape; 3] {
    [
        CavityShape::Ellipsoid { semi_axes: [0.25; 3] },
        CavityShape::Ellipsoid { semi_axes: [0.3, 0.3, 0.2] },
        CavityShape::Cylinder { radius: 0.25, height: 0.4 },
    ]
}

/// A body of revolution about z with a tank below its centre of mass, rotated as a whole, in a unit of length.
fn stage(
    shape: &CavityShape,
    [across, along]: [f64; 2],
    viscosity: f64,
    turn: [f64; 3],
    unit: f64,
) -> Assembly {
    let attitude = turned(ALIGNED, turn);
    let R = *nalgebra::Rotation3::from_scaled_axis(Vector3::from(turn)).matrix();
    let place = |z: f64| (R * Vector3::new(0.0, 0.0, unit * z)).into();
    let J = R * Matrix3::from_diagonal(&Vector3::new(across, across, along)) * R.transpose() * unit.powi(2);
    let shape = match *shape {
        CavityShape::Ellipsoid { semi_axes } => {
            CavityShape::Ellipsoid { semi_axes: semi_axes.map(|a| unit * a) }
        }
        CavityShape::Cylinder { radius, height } => {
            CavityShape::Cylinder { radius: unit * radius, height: unit * height }
        }
        ref other => other.clone(),
    };
    let inertia = [0, 1, 2].map(|row| [0, 1, 2].map(|column| 0.5 * (J[(row, column)] + J[(column, row)])));
    // degree of the polynomials, or cells of a mesh
    let resolution = if matches!(shape, CavityShape::Cuboid { .. }) { 4 } else { 8 };
    let liquid = tank(place(-0.4), 1.0, DENSITY / unit.powi(3), viscosity * unit.powi(2));
    Assembly {
        carrier: Some(parts::carrier(260.0, place(0.1), inertia)),
        cavities: vec![Cavity { shape, attitude, resolution, ..liquid }],
        ..Assembly::default()
    }
}

fn nutation(assembly: &Assembly, mode: Mode) -> SpinMode {
    let body = assembly.body().unwrap();
    let spin = RelativeEquilibrium::extreme(&body, mode, SpinMagnitude::Rate(SPIN)).unwrap();
    SpinModes::about(&body, spin).unwrap().nutation().unwrap().clone()
}

/// Axes and units change nothing: the nutation of a prolate body at a Reynolds number of 5, or of an oblate one at 500, is the same in all.
#[test]
fn axes_and_units_change_nothing() {
    let cases = [(1e-2, [150.0, 40.0], Mode::LongAxis), (1e-4, [150.0, 240.0], Mode::ShortAxis)];
    for (shape, (viscosity, moments, mode)) in shapes().iter().zip(cases.into_iter().cycle()) {
        let plain = nutation(&stage(shape, moments, viscosity, [0.0; 3], 1.0), mode);
        let other = nutation(&stage(shape, moments, viscosity, [0.7, -1.1, 0.4], 1e-3), mode);
        let gap = (other.decay_rate / plain.decay_rate - 1.0).abs();
        assert!(gap < 1e-6, "{shape:?} {viscosity}: {gap:e}");
        assert_eq!(plain.grows(), mode == Mode::LongAxis, "{shape:?} {viscosity}");
    }
}

/// At a Reynolds number of a tenth the liquid is slow: `(s − iΩ)(A − sΠ) + iΩC = 0` with `Π = (ρ/ν)P` of (L5).
#[test]
fn slow_liquids_have_the_slow_tensor() {
    let viscosity = 0.5;
    for shape in shapes() {
        for (moments, mode) in [([150.0, 40.0], Mode::LongAxis), ([150.0, 240.0], Mode::ShortAxis)] {
            let assembly = stage(&shape, moments, viscosity, [0.0; 3], 1.0);
            let built = assembly.build().unwrap();
            let J = built.body.inertia();
            let slow = DENSITY / viscosity * built.liquids[0].tensor[0][0];
            let i = Complex::<f64>::i();
            let mut s = i * SPIN * (1.0 - J[2][2] / J[0][0]);
            for _ in 0..20 {
                s = i * SPIN - i * SPIN * J[2][2] / (J[0][0] - s * slow);
            }
            let found = nutation(&assembly, mode).decay_rate;
            assert!((found / -s.re - 1.0).abs() < 0.01, "{shape:?}: {found:e} {s}");
        }
    }
}

/// A body under no force has the nutation of the free spin, by the equations for bodies under forces as well; with a liquid at once.
#[test]
fn a_body_under_no_force_nutates_as_a_free_one() {
    for (liquid, moments) in [(true, [150.0, 240.0]), (false, [150.0, 240.0])] {
        let mut assembly = stage(&shapes()[1], moments, 1e-3, [0.7, -1.1, 0.4], 1.0);
        if !liquid {
            assembly.cavities.clear();
        }
        let body = assembly.body().unwrap();
        assert_eq!(body.memories().is_empty(), !liquid);
        let spin = RelativeEquilibrium::extreme(&body, Mode::ShortAxis, SpinMagnitude::Rate(SPIN)).unwrap();
        let expected = SpinModes::about(&body, spin.clone()).unwrap().nutation().unwrap().clone();
        let near = SteadyStateGuess {
            omega: spin.omega,
            attitude: ALIGNED,
            place: [0.0; 3],
            velocity: [0.0; 3],
            asked: true,
        };
        let state = SteadyState::near(&body, &[], near).unwrap();
        let found = SteadyModes::about(&body, &[], state).unwrap();
        assert_eq!(found.refined, liquid);
        let distance = |mode: &SpinMode| {
            (mode.frequency - expected.frequency).hypot(mode.decay_rate - expected.decay_rate) / SPIN
        };
        let nearest = found.modes.iter().map(distance).fold(f64::INFINITY, f64::min);
        assert!(nearest < 1e-8, "{nearest:e}: {expected:?} in {:?}", found.modes);
    }
}

/// Range of the responses: shapes, axes, Reynolds numbers on both sides of each limit.
#[test]
fn liquids_answer_where_they_are_known() {
    let answers = |shape: &CavityShape, viscosity: f64, spin: [f64; 3]| {
        let assembly = stage(shape, [150.0, 240.0], viscosity, [0.0; 3], 1.0);
        let slow = assembly.build().unwrap().liquids.remove(0);
        assembly.cavities[0].answers(&slow, 3, spin, 0.4)
    };
    let [ball, spheroid, cylinder] = shapes();
    let cuboid = CavityShape::Cuboid { sides: [0.4, 0.5, 0.3] };
    let radius_squared = 0.0625;
    let at = |reynolds: f64| SPIN * radius_squared / reynolds;
    let (along, tilted, across) = ([0.0, 0.0, SPIN], [0.1 * SPIN, 0.0, SPIN], [SPIN, 0.0, 0.0]);
    assert!(answers(&ball, at(1.9e6), tilted) && !answers(&ball, at(2.1e6), tilted));
    assert!(answers(&spheroid, at(3e5), along) && !answers(&spheroid, at(4e5), along));
    assert!(answers(&cylinder, at(2.9e4), along) && !answers(&cylinder, at(3.1e4), along));
    for shape in [&spheroid, &cylinder] {
        assert!(!answers(shape, at(1e3), tilted) && !answers(shape, at(1e3), across));
        assert!(answers(shape, at(0.5), across));
    }
    assert!(answers(&cuboid, at(1.0), across) && !answers(&cuboid, at(100.0), across));
}

/// Semi-axes across and along (m), Reynolds number, decay rate and frequency (1/s) of the nutation: Galerkin with fields of another
/// kind, by `spheroids.py` at degree 18.
const SPHEROIDS: [([f64; 2], f64, [f64; 2]); 20] = [
    ([0.3, 0.3], 0.1, [4.455965652e-05, 2.477868033e-02]),
    ([0.3, 0.3], 1.0, [4.449970719e-04, 2.479361079e-02]),
    ([0.3, 0.3], 10.0, [3.941998099e-03, 2.607229475e-02]),
    ([0.3, 0.3], 100.0, [7.332583829e-03, 3.741142605e-02]),
    ([0.3, 0.3], 1000.0, [3.732656767e-03, 4.575652176e-02]),
    ([0.3, 0.25], 0.1, [4.853935040e-05, 3.663328887e-02]),
    ([0.3, 0.25], 1.0, [4.845058466e-04, 3.665288892e-02]),
    ([0.3, 0.25], 10.0, [4.108731974e-03, 3.827411302e-02]),
    ([0.3, 0.25], 100.0, [5.734651535e-03, 4.860614216e-02]),
    ([0.3, 0.25], 1000.0, [2.622840079e-03, 5.457972214e-02]),
    ([0.3, 0.15], 0.1, [1.376992417e-05, 5.241328902e-02]),
    ([0.3, 0.15], 1.0, [1.375349185e-04, 5.241782886e-02]),
    ([0.3, 0.15], 10.0, [1.230563025e-03, 5.281854990e-02]),
    ([0.3, 0.15], 100.0, [1.862926022e-03, 5.625920668e-02]),
    ([0.3, 0.15], 1000.0, [8.039895429e-04, 5.813420492e-02]),
    ([0.25, 0.35], 0.1, [1.917929777e-05, 1.218415837e-02]),
    ([0.25, 0.35], 1.0, [1.916273212e-04, 1.218888947e-02]),
    ([0.25, 0.35], 10.0, [1.778450922e-03, 1.260467065e-02]),
    ([0.25, 0.35], 100.0, [4.823662953e-03, 1.875422173e-02]),
    ([0.25, 0.35], 1000.0, [2.595080202e-03, 2.445147157e-02]),
];

/// Two methods: solenoidal fields that are curls of potentials, and the poloidal and toroidal fields of the library.
#[test]
fn balls_and_spheroids_nutate_as_fields_of_another_kind_say() {
    let spin = 0.1;
    for ([a, c], reynolds, [decay, frequency]) in SPHEROIDS {
        let carrier = parts::carrier(260.0, [0.0; 3], parts::diag([4.0, 4.0, 6.0]));
        let shape = CavityShape::Ellipsoid { semi_axes: [a, a, c] };
        let liquid = tank([0.0; 3], 1.0, 1000.0, spin * a * a / reynolds);
        let cavities = vec![Cavity { shape, attitude: ALIGNED, ..liquid }];
        let body = Assembly { carrier: Some(carrier), cavities, ..Assembly::default() }.body().unwrap();
        let steady = RelativeEquilibrium::near(&body, [0.0, 0.0, 1.0], SpinMagnitude::Rate(spin)).unwrap();
        let modes = SpinModes::about(&body, steady).unwrap();
        let found = modes.nutation().unwrap();
        let converged = if reynolds > 100.0 { 4e-4 } else { 5e-6 };
        for (found, expected) in [(found.decay_rate, decay), (found.frequency, frequency)] {
            let gap = (found / expected - 1.0).abs();
            assert!(gap < converged, "{a} {c} {reynolds}: {found} for {expected}, {gap:e}");
        }
    }
}
