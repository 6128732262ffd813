//! Explorer 1 with whip antennas on soft hinges: published data, and the growth rate of nutation for stiff hinges.
//! With the flown data every criterion of validity fails by orders of magnitude; stiffened hinges give a case with a closed form.
//! Equation (X3), docs/theory/06-closed-forms.md; data `[@pydy]`.

use crate::model::Rheology;
use crate::{Assembly, Carrier, HingeCoefficient, Hinged};

/// Explorer 1 with four whip antennas as thin rods on two-axis hinges `[@pydy]`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Explorer1 {
    /// Rotational stiffness of each hinge axis (N·m/rad).
    pub stiffness: f64,
    /// Rotational damping of each hinge axis (N·m·s/rad).
    pub damping: f64,
}

/// Mass of the tube (kg).
const TUBE: f64 = 13.9;
/// Length of the tube (m), inner and outer radius (m).
const TUBE_LENGTH: f64 = 2.05;
const RADII: [f64; 2] = [0.060, 0.076];
/// Mass (kg) and length (m) of a whip.
const WHIP: f64 = 0.139;
const WHIP_LENGTH: f64 = 0.56;
/// Height of the hinges above the centre of the tube (m).
const HEIGHT: f64 = 0.1;

impl Explorer1 {
    /// Spin about the axis of the tube (rad/s): 750 rpm.
    pub const SPIN: f64 = 78.539_816_339_744_83;

    /// Data of the satellite that flew.
    pub const FLOWN: Self = Self { stiffness: 0.565, damping: 1.13 };

    /// Stiffened hinges whose frequency, with the tube fixed, is `ratio` times the spin, at the damping ratio `zeta`.
    #[must_use]
    pub fn stiffened(ratio: f64, zeta: f64) -> Self {
        let inertia = WHIP * WHIP_LENGTH * WHIP_LENGTH / 3.0;
        let stiffness = inertia * (ratio * Self::SPIN).powi(2);
        Self { stiffness, damping: 2.0 * zeta * (stiffness * inertia).sqrt() }
    }

    /// Assembly of the satellite, in a frame whose origin is the centre of the tube and whose third axis is that of the tube.
    #[must_use]
    pub fn assembly(&self) -> Assembly {
        let squares = RADII[0].powi(2) + RADII[1].powi(2);
        let across = TUBE * (3.0 * squares + TUBE_LENGTH.powi(2)) / 12.0;
        let along = TUBE * squares / 2.0;
        let whips = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [-1.0, 0.0, 0.0], [0.0, -1.0, 0.0]];
        Assembly {
            carrier: Some(Carrier {
                mass: TUBE,
                center_of_mass: [0.0; 3],
                inertia: [[across, 0.0, 0.0], [0.0, across, 0.0], [0.0, 0.0, along]],
            }),
            hinged: whips.iter().enumerate().map(|(i, e)| self.whip(i, *e)).collect(),
            ..Assembly::default()
        }
    }

    fn whip(&self, index: usize, e: [f64; 3]) -> Hinged {
        let own = WHIP * WHIP_LENGTH * WHIP_LENGTH / 12.0;
        let at = |distance: f64| [distance * e[0], distance * e[1], HEIGHT];
        let inertia = std::array::from_fn(|i| {
            std::array::from_fn(|k| own * (f64::from(u8::from(i == k)) - e[i] * e[k]))
        });
        Hinged {
            name: format!("whip {}", index + 1),
            mass: WHIP,
            center_of_mass: at(RADII[1] + WHIP_LENGTH / 2.0),
            inertia,
            hinge: at(RADII[1]),
            axes: vec![[-e[1], e[0], 0.0], [0.0, 0.0, 1.0]],
            stiffness: HingeCoefficient::PerAxis(vec![self.stiffness; 2]),
            damping: HingeCoefficient::PerAxis(vec![self.damping; 2]),
            rheology: Rheology::Elastic,
            places: Vec::new(),
            angle: None,
        }
    }

    /// Growth rate of a small nutation about the spin axis (1/s) while the hinges are stiff. (X3)
    #[must_use]
    pub fn growth(&self, spin: f64) -> f64 {
        let whole = TUBE + 4.0 * WHIP;
        let z0 = HEIGHT * TUBE / whole;
        let squares = RADII[0].powi(2) + RADII[1].powi(2);
        let radial = RADII[1] + WHIP_LENGTH / 2.0;
        let own = WHIP * WHIP_LENGTH * WHIP_LENGTH / 12.0;
        let sunk = HEIGHT - z0;
        let Ia = TUBE * squares / 2.0 + 4.0 * (own + WHIP * radial * radial);
        let It = TUBE * (3.0 * squares + TUBE_LENGTH.powi(2)) / 12.0
            + TUBE * sunk * sunk
            + 2.0 * (own + WHIP * radial * radial)
            + 4.0 * WHIP * z0 * z0;
        let a1 = WHIP * (WHIP_LENGTH * RADII[1] / 2.0 + WHIP_LENGTH.powi(2) / 3.0) * (2.0 - Ia / It);
        let b1 = WHIP * WHIP_LENGTH / 2.0 * z0 * Ia / It;
        let sigma = (1.0 - Ia / It) * spin;
        let loads = a1 * a1 + b1 * b1;
        2.0 * self.damping / self.stiffness.powi(2) * loads * spin.powi(2) * sigma * sigma * Ia
            / (It * (It - Ia))
    }
}
