//! One damped body with a point and an appendage, off its axes, for runs that need no other.

use quasirigid::elements::{Assembly, Coefficient, End, HingeCoefficient, Hinged, SpringLaw};
use quasirigid::model::{ReducedBody, Rheology};
use quasirigid::reduction::reduce;

use crate::support::parts;

/// The body; its lowest frequency is about 13 rad/s, its damping ratios are about 0.2.
pub fn assembly() -> Assembly {
    Assembly {
        carrier: Some(parts::carrier(
            4.0,
            [0.1, -0.2, 0.05],
            [[1.1, 0.1, -0.05], [0.1, 1.7, 0.2], [-0.05, 0.2, 2.3]],
        )),
        points: vec![parts::free_point("mass", 0.3, [0.7, 0.4, -0.5])],
        springs: vec![parts::spring(
            End::Point(0),
            End::Carrier,
            SpringLaw::Spatial {
                stiffness: Coefficient::Diagonal([60.0, 90.0, 75.0]),
                damping: Coefficient::Isotropic(1.5),
            },
        )],
        hinged: vec![Hinged {
            name: "boom".into(),
            mass: 0.2,
            center_of_mass: [-0.9, 0.3, 0.2],
            inertia: [[0.004, 0.001, 0.0], [0.001, 0.012, 0.0], [0.0, 0.0, 0.013]],
            hinge: [-0.4, 0.1, 0.1],
            axes: vec![[0.1, 0.2, 1.0], [0.3, 1.0, -0.1]],
            stiffness: HingeCoefficient::PerAxis(vec![14.0, 18.0]),
            damping: HingeCoefficient::PerAxis(vec![0.4, 0.3]),
            rheology: Rheology::Elastic,
            places: Vec::new(),
            angle: None,
        }],
        ..Assembly::default()
    }
}

/// Reduced equations of the body.
pub fn reduced(order: usize) -> ReducedBody {
    reduce(&assembly().body().unwrap(), order).unwrap()
}

/// An attitude that is none of the simple ones.
pub fn attitude() -> [f64; 4] {
    [0.5, -0.1, 0.7, 0.5]
}

/// Inertial components of a vector, `σ ∘ (0, v) ∘ σ̄` written out. (P3)
pub fn inertial([s, x, y, z]: [f64; 4], v: [f64; 3]) -> [f64; 3] {
    let rows = [
        [s * s + x * x - y * y - z * z, 2.0 * (x * y - s * z), 2.0 * (x * z + s * y)],
        [2.0 * (x * y + s * z), s * s - x * x + y * y - z * z, 2.0 * (y * z - s * x)],
        [2.0 * (x * z - s * y), 2.0 * (y * z + s * x), s * s - x * x - y * y + z * z],
    ];
    rows.map(|row| row[0] * v[0] + row[1] * v[1] + row[2] * v[2])
}

/// Equal steps in time up to an end.
pub fn times_to(end: f64, count: u32) -> Vec<f64> {
    (1..=count).map(|i| end * f64::from(i) / f64::from(count)).collect()
}
