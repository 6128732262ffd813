//! Body of revolution with a sprung mass on its axis: published closed form of torque, damping rate and time.
//! The elastic and dissipative torques are single formulas here, which makes this body the first check of any change in the reduction.
//! Equations (X1) and (X2), docs/theory/06-closed-forms.md; `[@chernousko1973]`.

use crate::model::Rheology;
use crate::{Assembly, Carrier, Coefficient, End, Point, PointMotion, Spring, SpringLaw};

/// Body of revolution with one sprung mass on its axis: closed form (X1), (X2) `[@chernousko1973]`.
///
/// The frozen body has the moments `A, A, C` about its centre of mass, the mass `m` sits at the distance `rho` from that centre on the
/// third axis, on an isotropic spring `c` with a dashpot `b`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AxialMass {
    /// Mass of the carrier (kg).
    pub carrier: f64,
    /// Moment of the frozen body across its axis (kg·m²).
    pub A: f64,
    /// Moment of the frozen body about its axis (kg·m²).
    pub C: f64,
    /// Sprung mass (kg).
    pub m: f64,
    /// Distance of the mass from the centre of mass (m).
    pub rho: f64,
    /// Stiffness (N/m).
    pub c: f64,
    /// Damping (N·s/m).
    pub b: f64,
}

impl AxialMass {
    /// Assembly of the body, in a frame whose origin is its centre of mass.
    #[must_use]
    pub fn assembly(&self) -> Assembly {
        let offset = -self.m * self.rho / self.carrier;
        let across = self.A - self.m * self.rho * self.rho - self.carrier * offset * offset;
        Assembly {
            carrier: Some(Carrier {
                mass: self.carrier,
                center_of_mass: [0.0, 0.0, offset],
                inertia: [[across, 0.0, 0.0], [0.0, across, 0.0], [0.0, 0.0, self.C]],
            }),
            points: vec![Point {
                name: "mass".into(),
                mass: self.m,
                position: [0.0, 0.0, self.rho],
                motion: PointMotion::Free,
            }],
            springs: vec![Spring {
                name: String::new(),
                from: End::Point(0),
                to: End::Carrier,
                law: SpringLaw::Spatial {
                    stiffness: Coefficient::Isotropic(self.c),
                    damping: Coefficient::Isotropic(self.b),
                },
                rheology: Rheology::Elastic,
            }],
            ..Assembly::default()
        }
    }

    /// Elastic coefficient `F` of (X1).
    #[must_use]
    pub fn F(&self) -> f64 {
        self.m * self.m * self.rho.powi(2) * self.C / (self.c * self.A.powi(3))
    }

    /// Dissipative coefficient `D` of (X1).
    #[must_use]
    pub fn D(&self) -> f64 {
        let Self { A, C, m, rho, c, b, .. } = *self;
        m * m * rho * rho * b * C.powi(3) * (A - C) / (c * c * A.powi(4))
    }

    /// Torque `μ₄ + μ₅` (N·m) at an angular velocity (rad/s). (X1)
    #[must_use]
    pub fn torque(&self, [p, q, r]: [f64; 3]) -> [f64; 3] {
        let Self { A, C, .. } = *self;
        let across = p * p + q * q;
        let square = A * A * across + C * C * r * r;
        let (F, D) = (self.F(), self.D());
        [
            F * square * q * r + D * r.powi(4) * p,
            -F * square * p * r + D * r.powi(4) * q,
            -A / C * D * r.powi(3) * across,
        ]
    }

    /// Rate `κ` of the law in time (1/s) at the angular momentum `G` (N·m·s). (X2)
    #[must_use]
    pub fn kappa(&self, G: f64) -> f64 {
        let Self { A, C, m, rho, c, b, .. } = *self;
        2.0 * m * m * rho * rho * b * (C - A) * G.powi(4) / (c * c * A.powi(5) * C)
    }

    /// Time (s) in which `u = cos²θ` goes from one value to another. (X2)
    #[must_use]
    pub fn time(&self, G: f64, from: f64, to: f64) -> f64 {
        let primitive = |u: f64| (u / (1.0 - u)).ln() - 1.0 / u;
        (primitive(to) - primitive(from)) / self.kappa(G)
    }
}
