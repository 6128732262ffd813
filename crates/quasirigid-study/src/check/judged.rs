//! Order of the reduced equations that `check` judges.

use std::sync::Arc;

use quasirigid::model::ReducedBody;
use quasirigid::modes::SpinModes;
use quasirigid::reduction::{Comparison, Criterion, Validity, Verdict};
use quasirigid::verification::wobble_difference;

use crate::error::StudyError;
use crate::motion::Motion;
use crate::study::Study;

/// Reduced equations of one order with their validity.
#[derive(Debug)]
pub(super) struct Judged {
    pub order: usize,
    pub reduced: Arc<ReducedBody>,
    /// Angular velocity that is judged (rad/s).
    pub omega: [f64; 3],
    pub validity: Validity,
}

/// Highest order that is tried where nobody asked for one.
const HIGHEST: usize = 7;

/// The order of the study; where nobody asked for it, the motion holds and its dissipation or rates do not, the lowest order at which all
/// hold, if there is one.
pub(super) fn at_an_order_that_holds(
    study: &Study,
    motion: &Motion,
    modes: &[&SpinModes],
) -> Result<Judged, StudyError> {
    let own = judged(study, motion, modes, study.order)?;
    if study.order_given || own.validity.verdict() == Verdict::Fails || own.holds() {
        return Ok(own);
    }
    for order in study.order + 1..=HIGHEST {
        let next = judged(study, motion, modes, order)?;
        if next.validity.verdict() <= own.validity.verdict() && next.holds() {
            return Ok(next);
        }
    }
    Ok(own)
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
