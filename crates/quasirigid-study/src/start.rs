//! Initial rotation of a model, from any of the forms of the file.

use std::fmt::{self, Display, Formatter};

use quasirigid::averaging::{FreeRotation, ObservedPeriods};
use quasirigid::dynamics::Start;
use quasirigid::model::{FlexibleBody, Mode, Principal, ReducedBody};
use quasirigid::reduction::{Comparison, Criterion, Relaxation, Verdict, manifold_has_meaning, residual};
use quasirigid::secular::spun_state;
use quasirigid_io::model::{BodyKind, Displacements, Rotation};
use quasirigid_math::sym3::{inverse, times};
use quasirigid_math::vec3::norm;

use crate::error::StudyError;
use crate::spun_wobble::SpunWobble;
use crate::study::Study;
use crate::words::significant;

/// The state the file starts from.
pub fn initial(study: &Study) -> Result<Start, StudyError> {
    let Study { model, body, .. } = study;
    let file = &model.source.file;
    let rotation = model.initial.rotation.ok_or_else(|| StudyError::NoSpin { file: file.into() })?;
    let settled = matches!(model.initial.displacements, Displacements::SlowManifold);
    if let Some(held) = study.held()?
        && (settled || !body.drives().is_empty())
        && !matches!(rotation, Rotation::Spin(_))
    {
        return initial(held);
    }
    let principal = Principal::compute(body.invariants().J);
    let attitude = model.initial.attitude;
    let observed = study.observed.as_ref();
    if let (Some(observed), Rotation::Periods { mode, .. } | Rotation::Wobble { mode, .. }) =
        (observed, rotation)
    {
        let same = observed.circles_the_same(&principal, mode);
        same.map_err(|cause| StudyError::Turned { file: file.into(), cause })?;
    }
    let (K, rigid) = match rotation {
        Rotation::Spin(omega) => return Ok(Start::new(omega, attitude)),
        Rotation::Periods { rotation, precession, mode } => {
            let periods = ObservedPeriods { rotation, precession, mode };
            let moments = observed.map_or(principal.moments, |observed| {
                observed.periodic_moments(principal.moments, mode) // (G19)
            });
            let motion = periods.motion(moments);
            angular_momentum(
                &Principal { moments, ..principal },
                &motion.map_err(|cause| StudyError::Observed { file: file.into(), cause })?,
            )
        }
        Rotation::Wobble { angle, rate, mode } => {
            if !mode.exists(principal.moments) {
                let cause = NoWobble { moments: principal.moments, mode, kind: model.kind };
                return Err(StudyError::NoWobble { file: file.into(), cause });
            }
            let circled = observed.map_or(&principal, |observed| &observed.principal);
            let size = rate * circled.moments[mode.circled()];
            let motion = FreeRotation::at_nutation(principal.moments, size, mode, angle);
            let frozen = angular_momentum(&principal, &motion?);
            let spun =
                observed.is_none() && matches!(model.initial.displacements, Displacements::SlowManifold);
            let found = spun.then(|| SpunWobble::of(body, frozen, (angle, rate, mode))).flatten();
            if let Some(wobble) = found {
                return wobble
                    .start(study, |K| started(study, (K, times(inverse(body.invariants().J), K)), attitude));
            }
            frozen
        }
    };
    started(study, (K, rigid), attitude)
}

/// Start with an angular momentum (N·m·s, body axes) and the angular velocity (rad/s) that the frozen body has with it.
fn started(study: &Study, (K, rigid): ([f64; 3], [f64; 3]), attitude: [f64; 4]) -> Result<Start, StudyError> {
    let Study { model, body, order, .. } = study;
    if let Displacements::Given { q, .. } = &model.initial.displacements {
        let mut q = q.clone();
        q.resize(body.coordinates().len(), 0.0);
        let omega = times(inverse(body.full_inertia_at(&q)), K);
        return Ok(Start::new(omega, attitude));
    }
    if body.hung().is_none() {
        let reduced = study.reduced(slaved_order(study, *order, rigid)?)?;
        let omega = reduced.angular_velocity(K);
        if follows_its_spin(body, &reduced, omega) && norm(omega) < MAX_SPIN_RATIO * norm(rigid) {
            return Ok(Start::new(omega, attitude));
        }
    }
    let (omega, _) = spun_state(body, K).map_err(StudyError::NoStart)?;
    Ok(Start::new(omega, attitude))
}

/// An angular velocity this many times that of the frozen body is no solution for its angular momentum.
const MAX_SPIN_RATIO: f64 = 3.0;

/// Angular momentum (N·m·s) and angular velocity (rad/s) of a motion of the frozen body, body axes.
fn angular_momentum(principal: &Principal, motion: &FreeRotation) -> ([f64; 3], [f64; 3]) {
    let spin = motion.omega(0.0);
    let K = [0, 1, 2].map(|i| principal.moments[i] * spin[i]);
    (principal.vector(K), principal.vector(spin))
}

/// Share of the load left unbalanced from which the balance with the spin starts with less vibration than the series: measured between 0.15 and 0.3.
const UNBALANCED: f64 = 0.2;

/// Whether the displacements of a body are those of the series of its slow manifold at this angular velocity (rad/s). (Q8)
pub fn follows_its_spin(body: &FlexibleBody, reduced: &ReducedBody, spin: [f64; 3]) -> bool {
    reduced.order < 2
        || (residual(body, reduced, spin).elastic <= UNBALANCED && manifold_has_meaning(body, reduced, spin))
}

/// A nutation about an axis that the body does not have.
#[derive(Debug)]
pub struct NoWobble {
    /// Principal moments (kg·m²), ascending.
    pub(crate) moments: [f64; 3],
    pub(crate) mode: Mode,
    /// Kind of the body.
    pub(crate) kind: BodyKind,
}

impl Display for NoWobble {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let nutation = self.kind.nutation();
        let [I1, I2, I3] = self.moments;
        let (which, those, a, b) = match self.mode {
            Mode::ShortAxis => ("greatest", "greatest", I2, I3),
            Mode::LongAxis => ("least", "smallest", I1, I2),
        };
        let [a, b] = [a, b].map(|moment| significant(moment, 6));
        write!(
            f,
            "this body has no axis of {which} inertia for a {nutation}: its two {those} moments are equal ({a} and {b} kg m^2)"
        )?;
        match self.mode.other() {
            other if !other.exists(self.moments) => {
                write!(f, ", and so is the third: such a body has no {nutation}")
            }
            Mode::LongAxis => {
                f.write_str("; measure the angle from the axis of least inertia, mode = \"long-axis\"")
            }
            Mode::ShortAxis => {
                f.write_str("; measure the angle from the axis of greatest inertia, mode = \"short-axis\"")
            }
        }
    }
}

/// Whether friction is strong enough against a spin (rad/s) to slave internal rotors and liquids. (C7)
pub fn slaves(body: &FlexibleBody, spin: [f64; 3]) -> Result<bool, StudyError> {
    let value = Relaxation::compute(body)?.longest() * norm(spin);
    let criterion = Criterion { comparison: Comparison::Relaxation, value };
    Ok(criterion.verdict() != Verdict::Fails)
}

/// The order to which the state of the body follows its spin (rad/s): that asked for, or 0 where internal rotors or liquids are so free
/// that the slow series does not hold. They then turn with the body at the start. (C7), (Q8)
pub fn slaved_order(study: &Study, order: usize, spin: [f64; 3]) -> Result<usize, StudyError> {
    let body = &study.body;
    let follows = order == 0
        || body.cyclic().is_empty()
        || slaves(body, spin)? && manifold_has_meaning(body, &*study.reduced(order)?, spin);
    Ok(if follows { order } else { 0 })
}
