//! Nutation of bodies with liquids that spin with them, off the centre of mass and in any axes.

use nalgebra::{Complex, Matrix3, Vector3};
use quasirigid::elements::{Assembly, Carrier, Cavity, CavityShape};
use quasirigid::math::rotation::turned;
use quasirigid::model::Mode;
use quasirigid::modes::{Given, RelativeEquilibrium, SpinMode, SpinModes};

use crate::bodies::tank;

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

/// A body of revolution about z with a tank below its centre of mass, turned as a whole, in a unit of length.
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
    let liquid = tank(place(-0.4), 1.0, DENSITY / unit.powi(3), viscosity * unit.powi(2));
    Assembly {
        carrier: Some(Carrier { mass: 260.0, center_of_mass: place(0.1), inertia }),
        cavities: vec![Cavity { shape, attitude, resolution: 12, ..liquid }],
        ..Assembly::default()
    }
}

fn nutation(assembly: &Assembly, mode: Mode) -> SpinMode {
    let body = assembly.body().unwrap();
    let spin = RelativeEquilibrium::extreme(&body, mode, Given::Rate(SPIN)).unwrap();
    SpinModes::about(&body, spin).unwrap().nutation().unwrap().clone()
}

/// Axes and units are ours: the nutation of prolate and oblate bodies is the same in all, at Reynolds numbers of 5 and 5000.
#[test]
fn axes_and_units_change_nothing() {
    for shape in shapes() {
        for viscosity in [1e-2, 1e-5] {
            for (moments, mode) in [([150.0, 40.0], Mode::LongAxis), ([150.0, 240.0], Mode::ShortAxis)] {
                let plain = nutation(&stage(&shape, moments, viscosity, [0.0; 3], 1.0), mode);
                let other = nutation(&stage(&shape, moments, viscosity, [0.7, -1.1, 0.4], 1e-3), mode);
                let gap = (other.decay_rate / plain.decay_rate - 1.0).abs();
                assert!(gap < 1e-6, "{shape:?} {viscosity}: {gap:e}");
                assert_eq!(plain.grows(), mode == Mode::LongAxis, "{shape:?} {viscosity}");
            }
        }
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

/// What is known, and what is not: shapes, axes, Reynolds numbers on both sides of each line.
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
