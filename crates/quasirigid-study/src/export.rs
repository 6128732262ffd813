//! The energy form of the reduced equations of a free body, for other programs: what may be exported, its range and its notes.

use quasirigid::dynamics::{Form, steady_spins};
use quasirigid::model::{Principal, ReducedBody, Support};
use quasirigid::reduction::{Assessment, Comparison, Criterion};
use quasirigid_io::export::{Exported, FreeBody, Target, momentum_of};
use quasirigid_io::model::System;
use quasirigid_math::sym3::times;
use quasirigid_math::vec3::{add, dot, norm, scale};
use serde_json::{Value, json};

use crate::error::StudyError;
use crate::histories::Doubts;
use crate::motion::Motion;
use crate::study::Study;
use crate::words::significant;

/// Exported equations.
#[derive(Clone, Debug)]
pub struct Export {
    /// Source, or a functional mock-up unit.
    pub exported: Exported,
    /// Order of the equations.
    pub order: usize,
    /// Spins (rad/s) below which they hold, and from which they fail, in the direction of the start.
    pub range: [f64; 2],
    /// Notes to read before the numbers; the files have them too.
    pub notes: Vec<String>,
    /// Reason for which the equations are not those of the body at its start.
    pub wrong: Option<String>,
}

impl Export {
    /// The range in words.
    #[must_use]
    pub fn sentence(&self) -> String {
        let Self { order, range: [holds, fails], .. } = self;
        if fails.is_infinite() {
            return format!("Order {order}; nothing bounds the spin.");
        }
        let [holds, fails] = [holds, fails].map(|spin| significant(*spin, 3));
        format!("Order {order}; the equations hold below {holds} rad/s and fail from {fails} rad/s on.")
    }

    /// For machines.
    #[must_use]
    pub fn json(&self) -> Value {
        let Self { order, range, notes, wrong, .. } = self;
        let bound = range.map(|spin| spin.is_finite().then_some(spin));
        json!({
            "order": order, "spin_holds": bound[0], "spin_fails": bound[1],
            "holds": wrong.is_none(), "notes": notes,
        })
    }
}

impl Study {
    /// Exports the reduced equations in the energy form, under a name for source.
    ///
    /// # Errors
    /// [`StudyError::NotExported`] for a body whose equations have more than a torque in them, [`StudyError`] for an invalid start, and
    /// where the reduction fails.
    pub fn export(&self, target: Target, name: &str) -> Result<Export, StudyError> {
        self.left_alone("export")?;
        self.without_slugs("export")?;
        refuse(self)?;
        let motion = Motion::new(self, self.start_or_rest()?);
        let (order, doubts) = Doubts::before(&motion, System::Reduced, Form::AngularMomentum)?;
        let reduced = self.reduced(order)?;
        let start = motion.of_order(order).reduced_start(&reduced)?;
        let mut remarks = doubts.remarks;
        let momentum = momentum_of(&reduced, start.omega).unwrap_or_else(|| {
            remarks.push(
                "No angular momentum has the spin of the start: the start is that of the rigid body.".into(),
            );
            add(times(reduced.J, start.omega), reduced.wheels())
        });
        let notes: Vec<_> = remarks.iter().chain(&self.model.notes).cloned().collect();
        let range = range(self, &reduced, start.omega)?;
        let exported = FreeBody {
            title: &self.model.name,
            name,
            reduced: &reduced,
            start: (momentum, start.attitude),
            place: [start.place, start.velocity],
            axis: circled(&reduced, start.omega, momentum),
            range,
            notes: &notes,
            origin: &[origin(self)],
        }
        .exported(target);
        if matches!(&exported, Exported::Unit(unit) if !unit.compiled) {
            remarks.push(SOURCE_ALONE.into());
        }
        Ok(Export { exported, order, range, notes: remarks, wrong: doubts.wrong })
    }
}

const SOURCE_ALONE: &str = "No C compiler `cc` made a library of the source: the unit holds the source alone, for a tool that compiles it.";

/// Refuses what the equations of a free body under a torque leave out.
pub(crate) fn refuse(study: &Study) -> Result<(), StudyError> {
    let refused = |what: String| Err(StudyError::NotExported { what });
    if !study.forces.is_empty() {
        let names: Vec<_> = study.forces.iter().map(|force| force.name.as_str()).collect();
        return refused(format!(
            "exported equations have no external forces ({}), but take a torque: leave the forces out of the model, and give their torque to the equations in your program",
            names.join(", ")
        ));
    }
    if !matches!(study.body.support(), Support::Free) {
        return refused("exported equations are those of a free body, and this one has a support: leave the support out of the model, or follow it with `simulate`".into());
    }
    if !study.body.wheels().driven.is_empty() {
        return refused("exported equations have wheels of constant speed alone: give each [[wheel]] a number for its speed, or follow the body with `simulate`".into());
    }
    Ok(())
}

/// Axis of the steady spin that the angular momentum circles, body axes.
fn circled(reduced: &ReducedBody, omega: [f64; 3], momentum: [f64; 3]) -> [f64; 3] {
    let principal = Principal::compute(reduced.J);
    let [mode, _] = principal.nearest(omega);
    let own = principal.axes[mode.circled()];
    let size = norm(momentum);
    let spin = if size > 0.0 { steady_spins(reduced, size)[mode.circled()] } else { None };
    let axis = spin.map_or(own, |spin| scale(norm(spin.omega).recip(), spin.omega));
    if dot(axis, momentum) < 0.0 { scale(-1.0, axis) } else { axis }
}

/// Program and files.
fn origin(study: &Study) -> String {
    let inputs = study.inputs();
    let files: Vec<_> =
        inputs.files.iter().map(|file| format!("{} (SHA-256 {})", file.name, file.sha256)).collect();
    format!("Written by quasirigid {} from {}.", inputs.version, files.join(", "))
}

/// Doublings or halvings of the spin to the range, and halvings of the interval found.
const DOUBLINGS: usize = 60;
const HALVINGS: usize = 14;

/// Greatest spins (rad/s) along a direction at which every criterion of the motion and of the dissipation that grows with the spin holds, or
/// does not fail.
pub(crate) fn range(study: &Study, reduced: &ReducedBody, omega: [f64; 3]) -> Result<[f64; 2], StudyError> {
    let assessment = Assessment::new(&study.body, reduced)?;
    let spin = norm(omega);
    let (direction, first) = if spin > 0.0 {
        (scale(spin.recip(), omega), spin)
    } else {
        (Principal::compute(reduced.J).axes[2], 1.0)
    };
    let bound = |limit: fn(&Criterion) -> f64| {
        greatest(first, |spin| {
            let Ok(validity) = assessment.at(scale(spin, direction)) else { return false };
            validity
                .criteria
                .iter()
                .filter(|criterion| grows(criterion.comparison))
                .all(|each| each.value < limit(each))
        })
    };
    Ok([bound(Criterion::limit), bound(Criterion::failure)])
}

/// Whether a criterion grows with the spin, and concerns motion or dissipation.
fn grows(comparison: Comparison) -> bool {
    match comparison {
        Comparison::Spin
        | Comparison::Damping
        | Comparison::Relaxation
        | Comparison::Series
        | Comparison::Linearity
        | Comparison::Residual
        | Comparison::Power => true,
        Comparison::Resonance
        | Comparison::Loads
        | Comparison::Wobbles
        | Comparison::Levels
        | Comparison::Forgetting => false,
    }
}

/// Greatest number up to which a condition holds; infinite where it holds as far as is tried.
fn greatest(first: f64, holds: impl Fn(f64) -> bool) -> f64 {
    let [mut low, mut high] = [first; 2];
    let rising = holds(first);
    for _ in 0..DOUBLINGS {
        let next = if rising { 2.0 * high } else { 0.5 * low };
        if holds(next) != rising {
            if rising {
                high = next
            } else {
                low = next
            }
            break;
        }
        [low, high] = [next; 2];
    }
    if low == high {
        return if rising { f64::INFINITY } else { 0.0 };
    }
    for _ in 0..HALVINGS {
        let middle = (low * high).sqrt();
        if holds(middle) { low = middle } else { high = middle }
    }
    low
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ranges_end_where_the_condition_does() {
        for first in [1e-3, 0.7, 1e4] {
            let found = greatest(first, |x| x < 0.3);
            assert!(found < 0.3 && found > 0.2999, "{found}");
        }
        assert_eq!(greatest(1.0, |_| true), f64::INFINITY);
        assert_eq!(greatest(1.0, |_| false), 0.0);
    }
}
