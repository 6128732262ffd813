//! Order of the reduced equations: the one asked for, or the lowest one at which they hold.

use std::sync::Arc;

use quasirigid::dynamics::{Form, SlowEquations};
use quasirigid::model::ReducedBody;
use quasirigid::modes::SpinModes;
use quasirigid::reduction::{Comparison, Criterion, Validity, Verdict};
use quasirigid::verification::wobble_difference;

use crate::error::StudyError;
use crate::incomplete::beyond;
use crate::motion::Motion;
use crate::steady::{self, Poles};
use crate::study::Study;

/// Reduced equations of one order with their validity.
#[derive(Debug)]
pub(crate) struct Judged {
    pub order: usize,
    pub reduced: Arc<ReducedBody>,
    /// Angular velocity that is judged (rad/s).
    pub omega: [f64; 3],
    pub validity: Validity,
}

/// Highest order that is tried where nobody asked for one.
const HIGHEST_ORDER: usize = 7;
/// Coordinates of a body whose modes are found before every history.
const QUICK_COORDINATES: usize = 100;

/// The order of the study; where nobody asked for it, the motion holds and its dissipation or rates do not, the lowest order at which all
/// hold and nothing of the body is left out, if there is one.
pub(crate) fn at_an_order_that_holds(motion: &Motion, poles: &Poles) -> Result<Judged, StudyError> {
    from_an_order(motion, poles, motion.study().order)
}

/// The order for a motion that is followed in a form. Under forces the order of the torque-free part is the one that is raised, where the
/// form has one: the cost of the series along the flow grows steeply with its order. (E6)
pub(crate) fn for_motion(motion: &Motion, poles: &Poles, form: Form) -> Result<Judged, StudyError> {
    let (study, system) = (motion.study(), motion.system());
    if !system.acts() {
        return at_an_order_that_holds(motion, poles);
    }
    let Some(above) = SlowEquations::torque_free_order(system, form, study.order) else {
        return judged(study, motion, &[], study.order);
    };
    let quick = study.body.coordinates().len() <= QUICK_COORDINATES;
    let free = if quick { steady::without_forces(motion, study)? } else { Poles::default() };
    let found = from_an_order(motion, &free, above)?;
    if found.order > above {
        return Ok(found);
    }
    Ok(Judged { order: study.order, reduced: study.reduced(study.order)?, ..found })
}

fn from_an_order(motion: &Motion, poles: &Poles, lowest: usize) -> Result<Judged, StudyError> {
    let study = motion.study();
    let modes: Vec<_> = poles.modes.iter().take(2).flatten().collect();
    let own = judged(study, motion, &modes, lowest)?;
    if study.order_given || own.validity.verdict() == Verdict::Fails || own.holds() {
        return Ok(own);
    }
    let complete = |order: &usize| beyond(&study.model.assembly, *order).is_none();
    for order in (lowest + 1..=HIGHEST_ORDER).take_while(complete) {
        let next = judged(study, motion, &modes, order)?;
        if next.validity.verdict() <= own.validity.verdict() && next.holds() {
            return Ok(next);
        }
    }
    Ok(own)
}

/// The steady spins next to a start, of a body whose modes take a moment.
pub(crate) fn poles_in_a_moment(motion: &Motion) -> Result<Poles, StudyError> {
    let study = motion.study();
    let few = study.body.coordinates().len() <= QUICK_COORDINATES;
    if few { steady::at_start(motion, study) } else { Ok(Poles::default()) }
}

/// The order of the study, judged at an angular velocity (rad/s).
pub(crate) fn at(study: &Study, omega: [f64; 3]) -> Result<Judged, StudyError> {
    let reduced = study.reduced(study.order)?;
    let validity = Validity::assess_reduced(&study.body, &reduced, omega)?;
    Ok(Judged { order: study.order, reduced, omega, validity })
}

/// The note on an order above that of the study, which nobody asked for.
pub(crate) fn raised(study: &Study, order: usize) -> Option<String> {
    let default = study.order;
    let equations = if study.forces.is_empty() {
        "The reduced equations are"
    } else {
        "The torque-free part of the reduced equations is"
    };
    (order > default).then(|| {
        format!(
            "{equations} of order {order}: at order {default}, the default, dissipation or rates do not hold."
        )
    })
}

impl Judged {
    fn holds(&self) -> bool {
        self.validity.dissipation() == Verdict::Holds
    }
}

fn judged(study: &Study, motion: &Motion, modes: &[&SpinModes], order: usize) -> Result<Judged, StudyError> {
    let reduced = study.reduced(order)?;
    let omega = motion.judged_spin(&reduced)?;
    let mut validity = Validity::assess_reduced(&study.body, &reduced, omega)?;
    // losses of materials are left out of the reduced equations, and are told of elsewhere
    let complete = study.body.viscoelastic().is_empty();
    let compared = modes.iter().filter(|_| complete);
    let differences = compared.filter_map(|modes| wobble_difference(&reduced, modes));
    if let Some(value) = differences.reduce(f64::max) {
        let comparison = Comparison::Wobbles;
        let place = validity.criteria.iter().position(|criterion| criterion.comparison == Comparison::Levels);
        let place = place.unwrap_or(validity.criteria.len());
        validity.criteria.insert(place, Criterion { comparison, value });
    }
    Ok(Judged { order, reduced, omega, validity })
}
