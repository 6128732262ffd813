use std::f64::consts::TAU;

use crate::model::Rheology;
use crate::{Assembly, Carrier, Coefficient, End, Point, PointMotion, Spring, SpringLaw};

/// Free body with sprung points scattered over a carrier, each joined to the carrier alone: of any size and without symmetry, for timing and
/// tests of bodies of many coordinates. The points share a given mass (kg) and have frequencies of 8 to 60 rad/s.
#[must_use]
pub fn hub_of_points(count: usize, mass: f64) -> Assembly {
    // irrational steps leave no two points alike
    let scattered = |i: usize, step: f64| ((i + 1) as f64 * step).fract();
    let own = mass / count as f64;
    let points = (0..count).map(|i| Point {
        name: format!("point {i}"),
        mass: own * (0.5 + scattered(i, 0.414_213_562_373)),
        position: [
            1.5 * (TAU * scattered(i, 0.618_033_988_75)).cos(),
            3.0 * scattered(i, 0.732_050_807_568) - 1.4,
            1.2 * (TAU * scattered(i, 0.236_067_977_5)).sin() + 0.1,
        ],
        motion: PointMotion::Free,
    });
    let springs = (0..count).map(|i| {
        let frequency = 8.0 + 52.0 * scattered(i, 0.302_775_637_7);
        let k = own * frequency * frequency;
        let lean = 0.3 * (scattered(i, 0.872_983_346_2) - 0.5);
        let matrix = |k: f64| [[k, lean * k, 0.0], [lean * k, 1.3 * k, 0.1 * k], [0.0, 0.1 * k, 0.8 * k]];
        Spring {
            name: String::new(),
            from: End::Point(i),
            to: End::Carrier,
            law: SpringLaw::Spatial {
                stiffness: Coefficient::Full(matrix(k)),
                damping: Coefficient::Full(matrix(0.02 * k / frequency)),
            },
            rheology: Rheology::Elastic,
        }
    });
    Assembly {
        carrier: Some(Carrier {
            mass: 400.0,
            center_of_mass: [0.1, -0.05, 0.02],
            inertia: [[900.0, 4.0, -2.0], [4.0, 1300.0, 3.0], [-2.0, 3.0, 1600.0]],
        }),
        points: points.collect(),
        springs: springs.collect(),
        ..Assembly::default()
    }
}
