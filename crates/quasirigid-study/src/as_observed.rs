//! Shapes observed in rotation: the relaxed body, from which every answer is computed, and what its spin makes of it again.
//! Equations (G17) to (G19), docs/theory/11-materials.md.

use std::f64::consts::TAU;
use std::path::Path;

use quasirigid::averaging::{FreeRotation, ObservedPeriods};
use quasirigid::elements::{ElementError, ObservedShape, Relaxed};
use quasirigid::model::{FlexibleBody, Mode, Principal};
use quasirigid_io::model::{BodyKind, Model, Rotation};
use quasirigid_math::sym3::{Sym, times};
use quasirigid_math::vec3::dot;

use crate::error::StudyError;
use crate::start::NoWobble;
use crate::words::significant;

/// A body that was observed in rotation.
#[derive(Clone, Copy, Debug)]
pub struct Observed {
    /// Principal moments and axes of the body in rotation, about its centre of mass.
    pub principal: Principal,
    /// What was observed.
    shape: ObservedShape,
    /// Kind of the body.
    kind: BodyKind,
}

/// Cosine of the angle below which two axes are not the same.
const ALIKE: f64 = 0.7;

impl Observed {
    /// Moments (kg·m²) that have, with the angular momentum of a wobble, the periods of the deformable body: differences of the
    /// reciprocal ones are those of the relaxed body, the moment circled is that of the body in rotation. (G19)
    pub fn periodic_moments(&self, relaxed: [f64; 3], mode: Mode) -> [f64; 3] {
        periodic_moments([relaxed, self.principal.moments], mode)
    }

    /// By how much the reciprocal of the moment circled grows with the spin (1/(kg·m²)), from given moments. (G19)
    pub fn shift(&self, moments: [f64; 3], mode: Mode) -> f64 {
        1.0 / self.principal.moments[mode.circled()] - 1.0 / moments[mode.circled()]
    }

    /// Accepts a relaxed body whose axis of a mode is that of the body in rotation.
    pub fn circles_the_same(&self, relaxed: &Principal, mode: Mode) -> Result<(), Box<Turned>> {
        let [own, other] = [&self.principal, relaxed].map(|principal| principal.axes[mode.circled()]);
        let same = dot(own, other).abs() > ALIKE && mode.exists(relaxed.moments);
        if same {
            Ok(())
        } else {
            Err(Box::new(Turned {
                observed: self.principal.moments,
                relaxed: *relaxed,
                mode,
                kind: self.kind,
            }))
        }
    }

    /// One line on what the spin changes, and a warning where it makes the axis of greatest inertia.
    pub fn note(&self, body: &FlexibleBody) -> String {
        let relaxed = Principal::compute(body.invariants().J);
        let own = self.principal.axes.map(|axis| dot(axis, times(body.invariants().J, axis)));
        let listed = |values: [f64; 3], digits| values.map(|value| significant(value, digits)).join(", ");
        let grown = [0, 1, 2].map(|i| self.principal.moments[i] / own[i] - 1.0);
        let what = match self.shape {
            ObservedShape::Surface => "Its shape",
            ObservedShape::Moments => "Its moments of inertia",
        };
        let gap = |moments: [f64; 3]| moments[2] - 0.5 * (moments[0] + moments[1]);
        let mut text = format!(
            "{what} as observed: the relaxed body, from which all is computed, has the moments {} kg m^2; the spin at the start makes them {} kg m^2 ({})",
            listed(own, 8),
            listed(self.principal.moments, 8),
            grown.map(|share| format!("{}{:.3e}", if share < 0.0 { "" } else { "+" }, share)).join(", "),
        );
        if Mode::any_exists(self.principal.moments) {
            let bulge = 1.0 - gap(own) / gap(self.principal.moments);
            text.push_str(&format!(
                ", and its bulge is {} % of the difference between the greatest and the mean of the others",
                significant(100.0 * bulge, 4)
            ));
        }
        if self.circles_the_same(&relaxed, Mode::ShortAxis).is_err() {
            text.push_str("; WITHOUT ITS SPIN ANOTHER AXIS HAS THE GREATEST MOMENT, AND THE SPIN LEAVES ITS OWN AXIS AS ENERGY IS LOST: THE BULGE MOVES WITH IT");
        }
        text.push('.');
        text
    }
}

/// A relaxed body that circles another axis than the body in rotation, which owes its axis to the bulge.
#[derive(Debug)]
pub struct Turned {
    observed: [f64; 3],
    relaxed: Principal,
    mode: Mode,
    kind: BodyKind,
}

impl std::fmt::Display for Turned {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let which = match self.mode {
            Mode::ShortAxis => "greatest",
            Mode::LongAxis => "least",
        };
        let listed =
            |values: [f64; 3]| values.map(|value| format!("{} kg m^2", significant(value, 6))).join(", ");
        write!(
            f,
            "the bulge of the spin is larger than the difference of the moments observed ({}): without it, the body has {} and another axis of {which} inertia. The bulge follows the spin, so that there is no {} about the axis observed; give an angular_velocity to follow what happens, or a stiffer material",
            listed(self.observed),
            listed(self.relaxed.moments),
            self.kind.nutation()
        )
    }
}

/// Takes the relaxed body in place of the one observed, in the model and at both ends of its ranges; none of a model that gives the
/// relaxed shape.
pub fn relax(model: &mut Model) -> Result<Option<Observed>, StudyError> {
    let Some(shape) = model.assembly.as_observed else { return Ok(None) };
    let rotation = model.initial.rotation;
    let file = model.source.file.clone();
    let Some(rotation) = rotation else { return Err(StudyError::NoSpin { file }) };
    let (kind, given) = (model.kind, (file.as_path(), rotation));
    let products = |inertia| mean_products(given, kind, inertia).map_err(Failure::Study);
    let found = model.assembly.relaxed(products);
    let Relaxed { assembly, inertia } = found.map_err(|failure| match failure {
        Failure::Element(error) => model.diagnose(&error).into(),
        Failure::Study(error) => error,
    })?;
    for end in model.extremes.iter_mut().flat_map(|ends| ends.iter_mut()) {
        *end = end.shaped_as(&assembly);
    }
    model.assembly = assembly;
    Ok(Some(Observed { principal: Principal::compute(inertia), shape, kind }))
}

/// Failure of the search for a relaxed body.
enum Failure {
    Element(ElementError),
    Study(StudyError),
}

impl From<ElementError> for Failure {
    fn from(error: ElementError) -> Self {
        Self::Element(error)
    }
}

/// Moments (kg·m²) that have the periods of a deformable body with its angular momentum, from those of the relaxed body and of that in
/// rotation. (G19)
fn periodic_moments([relaxed, spun]: [[f64; 3]; 2], mode: Mode) -> [f64; 3] {
    let shift = 1.0 / spun[mode.circled()] - 1.0 / relaxed[mode.circled()];
    relaxed.map(|moment| 1.0 / (1.0 / moment + shift))
}

/// Mean of `ωωᵀ` (rad²/s², axes of the file) over the free rotation of the body with these inertia tensors, relaxed and in rotation. (G17)
fn mean_products(
    (file, rotation): (&Path, Rotation),
    kind: BodyKind,
    [relaxed, spun]: [Sym; 2],
) -> Result<Sym, StudyError> {
    let principal = Principal::compute(spun);
    let moments = principal.moments;
    let motion = match rotation {
        Rotation::Spin(omega) => FreeRotation::through(moments, principal.components(omega))?,
        // the bulge is not known yet: it is about that of the steady spin
        Rotation::Periods { precession, mode, .. } if relaxed == spun => {
            let mut omega = [0.0; 3];
            omega[mode.circled()] = TAU / precession;
            FreeRotation::through(moments, omega)?
        }
        Rotation::Periods { rotation, precession, mode } => ObservedPeriods { rotation, precession, mode }
            .motion(periodic_moments([Principal::compute(relaxed).moments, moments], mode))
            .map_err(|cause| StudyError::Observed { file: file.into(), cause })?,
        Rotation::Wobble { angle, rate, mode } => {
            if !mode.exists(moments) {
                let cause = NoWobble { moments, mode, kind };
                return Err(StudyError::NoWobble { file: file.into(), cause });
            }
            FreeRotation::at_nutation(moments, rate * moments[mode.circled()], mode, angle)?
        }
    };
    let spins = quasirigid_math::sym3::rows(motion.mean_products());
    let turned = |a: usize, b: usize| {
        let pair = |i: usize, k: usize| principal.axes[i][a] * spins[i][k] * principal.axes[k][b];
        (0..3).map(|i| (0..3).map(|k| pair(i, k)).sum::<f64>()).sum::<f64>()
    };
    Ok([[0, 0], [1, 1], [2, 2], [1, 2], [2, 0], [0, 1]].map(|[a, b]| turned(a, b)))
}
