use quasirigid::averaging::{FreeRotation, PolynomialPower, PowerSource, Response};
use quasirigid::dynamics::Start;
use quasirigid::model::{FlexibleBody, Principal, ReducedBody};
use quasirigid::secular::choice::AveragePowers;
use quasirigid_io::model::{BodyKind, Power};
use quasirigid_math::rotation::to_inertial;
use quasirigid_math::vec3::{norm, scale};

use crate::as_observed::Observed;
use crate::error::StudyError;

/// Inputs of an evolution: what is known of a body and its start before a method is chosen.
pub struct Inputs {
    /// Mean powers of the averages along the frozen polhode.
    pub powers: AveragePowers,
    /// Rotation of the frozen body with the angular momentum at the start.
    pub initial: FreeRotation,
    /// Principal axes and moments of the frozen body.
    pub principal: Principal,
    /// Direction of the angular momentum at the start, a unit vector in inertial axes.
    pub direction: [f64; 3],
    /// What the spin makes of a body that was observed in rotation.
    pub observed: Option<Observed>,
    /// Kind of the body, for the words.
    pub kind: BodyKind,
    /// Order of the reduced equations.
    pub order: usize,
    /// Whether a material loses energy by a law that the polynomial leaves out.
    pub viscoelastic: bool,
    /// Frequencies (rad/s) between which materials were measured.
    pub measured: Vec<[f64; 2]>,
}

impl Inputs {
    /// Inputs from the reduced equations, and from those of the order to which the state follows its spin.
    pub fn new(
        body: &FlexibleBody,
        [reduced, slaved]: [&ReducedBody; 2],
        start: Start,
        power: Option<Power>,
    ) -> Result<Self, StudyError> {
        let principal = Principal::compute(reduced.J);
        let measured = body.viscoelastic().iter().filter_map(|part| part.rheology.measured_between());
        let (response, polynomial) = (Response::compute(body)?, PolynomialPower::from_reduced(reduced));
        let K = slaved.angular_momentum(start.omega);
        let omega = frozen(&principal, K);
        if !omega.iter().all(|rate| rate.is_finite()) {
            return Err(StudyError::BoundlessSpin);
        }
        let initial = FreeRotation::through(principal.moments, omega)?;
        let asked = power.map(|power| match power {
            Power::Polynomial => PowerSource::Polynomial,
            Power::Harmonics => PowerSource::Harmonics,
        });
        Ok(Self {
            powers: AveragePowers::new(body, response, polynomial, asked, initial.angular_momentum()),
            initial,
            principal,
            direction: scale(1.0 / norm(K), to_inertial(start.attitude, K)),
            observed: None,
            kind: BodyKind::default(),
            order: reduced.order,
            viscoelastic: !body.viscoelastic().is_empty(),
            measured: measured.collect(),
        })
    }

    /// Rotation of the frozen body with the angular momentum (N·m·s, body axes) of the deformed body at its start, which a series of the slow
    /// manifold does not know of a soft body.
    pub fn turning_with(&self, K: [f64; 3]) -> Result<FreeRotation, StudyError> {
        Ok(FreeRotation::through(self.principal.moments, frozen(&self.principal, K))?)
    }
}

/// Angular velocity (rad/s) of the frozen body with an angular momentum (N·m·s, body axes), in principal axes.
fn frozen(principal: &Principal, K: [f64; 3]) -> [f64; 3] {
    let K = principal.components(K);
    [0, 1, 2].map(|i| K[i] / principal.moments[i])
}
