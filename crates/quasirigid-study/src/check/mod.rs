//! Validity of the reduced equations at the start of a study.

mod json;
mod text;

use std::collections::BTreeMap;
use std::sync::Arc;

use quasirigid::model::ReducedBody;
use quasirigid::modes::acts;
use quasirigid::reduction::{Validity, Verdict};
use quasirigid_io::record::SteadySpinRecord;
use quasirigid_math::vec3::norm;
use serde_json::Value;

use crate::about_spin::MAX_TRIED_COORDINATES;
use crate::error::StudyError;
use crate::judged::{self, Judged};
use crate::left_out::LeftOut;
use crate::motion::Motion;
use crate::study::Study;
use crate::words::{shares, significant, verdict};
use crate::{slugs, steady, steady_state, tanks};

/// Validity of the reduced equations of a study at its spin.
#[derive(Debug)]
pub struct CheckReport<'a> {
    study: &'a Study,
    /// Order that is judged: that of the study, or a higher one that holds where nobody asked for one.
    pub order: usize,
    /// The reduced equations.
    pub reduced: Arc<ReducedBody>,
    /// Angular velocity that is judged (rad/s): that of the start, or the one on which the internal coordinates settle.
    pub omega: [f64; 3],
    /// Angular velocity of the start (rad/s), where another one is judged.
    pub start: Option<[f64; 3]>,
    /// The criteria.
    pub validity: Validity,
    /// Share of the power that each dissipator takes, where it is known.
    pub budget: BTreeMap<String, f64>,
    /// Steady spins with the modes about them, the one next to the start first.
    pub spins: Vec<SteadySpinRecord>,
    /// Losses that the equations of motion leave out.
    pub left_out: LeftOut,
    /// Steady state under the forces, in words, where moments act.
    pub under_forces: Option<String>,
    /// Whether the model, of tanks that a thrust settles, has no spin and is judged at a slow one.
    pub unspun: bool,
    /// Words on liquids that slide along rings, and are held here.
    pub sliding: Option<String>,
    /// Reduced equations about the spin, tried where those about rest fail.
    pub about_spin: Option<InsteadOfRest>,
}

/// Verdict on the reduced equations about the spin, where those about rest fail.
#[derive(Clone, Debug)]
pub struct InsteadOfRest {
    /// Whether they hold at the start.
    pub holds: bool,
    /// The verdict in words.
    pub sentence: String,
    /// For machines: range, masters and resonances; none where there are no such equations.
    pub json: Value,
}

/// Coordinates of a body whose modes under forces take a moment.
const QUICK_COORDINATES: usize = 60;

impl Study {
    /// Judges the reduced equations at the spin of the start.
    ///
    /// # Errors
    /// [`StudyError`] for an invalid start, and where the reduction fails.
    pub fn check(&self) -> Result<CheckReport<'_>, StudyError> {
        let report = self.held()?.unwrap_or(self).checked()?;
        Ok(CheckReport { sliding: slugs::unjudged(self), ..report })
    }

    /// The check of a study in which nothing slides.
    fn checked(&self) -> Result<CheckReport<'_>, StudyError> {
        let Study { body, .. } = self;
        let (start, unspun) = tanks::spun_slowly(self)?;
        let motion = Motion::new(self, start);
        let poles = steady::at_start(&motion, self)?;
        let Judged { order, reduced, omega, validity } = judged::at_an_order_that_holds(&motion, &poles)?;
        let nearest = poles.nearest().cloned();
        let known = validity.verdict() != Verdict::Fails && body.viscoelastic().is_empty();
        let budget = if known { shares(&reduced.power_budget(omega)) } else { BTreeMap::new() };
        let mut report = CheckReport {
            study: self,
            order,
            reduced,
            omega,
            start: motion.starts_displaced().then_some(start.omega),
            validity,
            budget,
            spins: poles.records,
            left_out: LeftOut::at(self, omega, nearest),
            under_forces: under_forces(self)?,
            unspun,
            sliding: None,
            about_spin: None,
        };
        if !report.holds() {
            report.about_spin = Some(about_spin(self, &report.left_out));
        }
        Ok(report)
    }
}

/// Tries the reduced equations about the spin.
fn about_spin(study: &Study, left_out: &LeftOut) -> InsteadOfRest {
    let none = |sentence: String| InsteadOfRest { holds: false, sentence, json: Value::Null };
    if left_out.wrong().is_some() {
        let what = if left_out.flow.is_some() { "materials" } else { "liquids" };
        return none(format!("Reduced equations about the spin have the same {what}, and were not tried."));
    }
    let coordinates = study.body.coordinates().len();
    if coordinates > MAX_TRIED_COORDINATES {
        return none(format!(
            "Reduced equations about the spin were not tried for a body of {coordinates} coordinates; `derive --about spin` does."
        ));
    }
    match study.about_spin_that_holds() {
        Ok(found) => {
            InsteadOfRest { holds: found.holds(), sentence: found.sentence(), json: found.short_json() }
        }
        Err(error) => none(format!("There are no reduced equations about the spin: {error}.")),
    }
}

/// Steady state under the forces, in words; none of a body that no moment acts on.
fn under_forces(study: &Study) -> Result<Option<String>, StudyError> {
    let Study { body, forces, .. } = study;
    if !acts(body, forces) {
        return Ok(None);
    }
    Ok(Some(if body.coordinates().len() > QUICK_COORDINATES {
        "The modes of its steady state are left out here; the command modes finds them.".to_owned()
    } else {
        steady_state::told(study, forces, steady_state::near(study, None)?).record.sentence
    }))
}

impl CheckReport<'_> {
    /// Whether no criterion fails, neither of the motion nor of the dissipation, and the equations get the liquids right.
    #[must_use]
    pub fn holds(&self) -> bool {
        let fails = [self.validity.verdict(), self.validity.dissipation()].contains(&Verdict::Fails);
        !fails && self.left_out.wrong().is_none() && self.sliding.is_none()
    }

    /// The reduction that holds: `rest`, `spin`, or `none`.
    #[must_use]
    pub fn reduction(&self) -> &'static str {
        match &self.about_spin {
            _ if self.holds() => "rest",
            Some(about) if about.holds && self.sliding.is_none() => "spin",
            _ => "none",
        }
    }

    /// The verdict in a sentence or two.
    #[must_use]
    pub fn sentence(&self) -> String {
        let slow = self.unspun.then(|| {
            let rate = significant(norm(self.omega), 3);
            format!("The model has no spin; the reduced equations are judged at a slow one, {rate} rad/s.")
        });
        let verdict = [self.sliding.clone(), slow, self.left_out.flow.clone(), Some(verdict(&self.validity))];
        let verdict = verdict.into_iter().flatten().collect::<Vec<_>>().join(" ");
        if self.order == self.study.order {
            return verdict;
        }
        let Self { order, study: Study { order: default, .. }, .. } = self;
        format!(
            "{verdict} This is judged at order {order}: at order {default}, the default, dissipation or rates do not hold; ask for order {order}."
        )
    }

    /// For a terminal of 80 columns.
    #[must_use]
    pub fn text(&self) -> String {
        text::text(self)
    }
}
