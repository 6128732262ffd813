use crate::model::Rheology;
use crate::{Assembly, Carrier, Coefficient, End, Point, PointMotion, Spring, SpringLaw};

/// Common problem: one mass on a spring in a tumbling hub, for the comparison of programs for stiff bodies.
///
/// A hub of 100 kg with moments 10, 14, 17 kg·m², free; a point of 1 kg at (0.8, 0.3, 0.5) m from its centre on an
/// isotropic spring with a dashpot, at rest at the start. Reference trajectories: `data/published/common_problem`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CommonProblem {
    /// Stiffness (N/m).
    pub stiffness: f64,
    /// Damping (N·s/m).
    pub damping: f64,
    /// Duration (s).
    pub duration: f64,
}

impl CommonProblem {
    /// Natural frequency 100 rad/s, a tenth of critical damping.
    pub const A: Self = Self { stiffness: 1e4, damping: 20.0, duration: 200.0 };
    /// Ten times the frequency of `A`, same damping ratio.
    pub const B: Self = Self { stiffness: 1e6, damping: 200.0, duration: 200.0 };
    /// A hundred times the frequency of `A`, same damping ratio.
    pub const C: Self = Self { stiffness: 1e8, damping: 2000.0, duration: 200.0 };
    /// Frequency of `B` with ten times critical damping.
    pub const OVER: Self = Self { stiffness: 1e6, damping: 2e4, duration: 200.0 };
    /// A fifth of the frequency of `A`, same damping ratio.
    pub const SOFT: Self = Self { stiffness: 400.0, damping: 4.0, duration: 2000.0 };
    /// `A` for 4900 revolutions.
    pub const LONG: Self = Self { stiffness: 1e4, damping: 20.0, duration: 20_000.0 };

    /// Angular velocity at the start (rad/s).
    pub const SPIN: [f64; 3] = [0.3, 1.5, 0.2];

    /// Case with this name: `A`, `B`, `C`, `over`, `soft`, `long`.
    #[must_use]
    pub fn named(name: &str) -> Option<Self> {
        let cases = [
            ("A", Self::A),
            ("B", Self::B),
            ("C", Self::C),
            ("over", Self::OVER),
            ("soft", Self::SOFT),
            ("long", Self::LONG),
        ];
        cases.into_iter().find(|(known, _)| *known == name).map(|(_, case)| case)
    }

    /// Assembly of the body.
    #[must_use]
    pub fn assembly(&self) -> Assembly {
        Assembly {
            carrier: Some(Carrier {
                mass: 100.0,
                center_of_mass: [0.0; 3],
                inertia: [[10.0, 0.0, 0.0], [0.0, 14.0, 0.0], [0.0, 0.0, 17.0]],
            }),
            points: vec![Point {
                name: "mass".into(),
                mass: 1.0,
                position: [0.8, 0.3, 0.5],
                motion: PointMotion::Free,
            }],
            springs: vec![Spring {
                name: String::new(),
                from: End::Point(0),
                to: End::Carrier,
                law: SpringLaw::Spatial {
                    stiffness: Coefficient::Isotropic(self.stiffness),
                    damping: Coefficient::Isotropic(self.damping),
                },
                rheology: Rheology::Elastic,
            }],
            ..Assembly::default()
        }
    }
}
