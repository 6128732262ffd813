//! Verification of the reduced equations against the full system: plan, run and text.

use std::fmt::{self, Write};

use quasirigid::secular::MeasureError;
use quasirigid::verification::{
    self, AverageError, AverageRow, Verification, VerificationError, VerificationPlan, verify_average,
};
use quasirigid_io::record::{AverageRecord, OrderRecord, VerificationRecord};
use quasirigid_io::visible::one_line;

use crate::error::StudyError;
use crate::layout::paragraph;
use crate::motion::Motion;
use crate::record;
use crate::study::Study;
use crate::watch::Watch;
use crate::words::{significant, time};

impl Study {
    /// Verifies the reduced equations of a study; none if the watch ended it.
    ///
    /// # Errors
    /// [`StudyError`] for an invalid start, and for an invalid plan.
    pub fn verify(
        &self,
        plan: &VerificationPlan,
        watch: &mut dyn Watch,
    ) -> Result<Option<VerificationRecord>, StudyError> {
        self.left_alone("verify")?;
        self.without_slugs("verify")?;
        let motion = Motion::new(self, self.initial()?);
        Ok(follow(&motion, plan, watch)?.map(|found| record::verification(plan, &found)))
    }
}

/// Results for the reduced equations and for the average.
pub(crate) struct Proof {
    pub verification: Verification,
    pub average: Result<AverageRow, AverageError>,
}

/// Halvings at most at which the average is compared with the full system, and the steps of these runs, in those of the verification.
const MAX_HALVINGS: usize = 3;
const STEPS_RATIO: u64 = 40;

const STAGE: &str = "verifying";

/// Runs the verification; none if the watch ended it.
pub(crate) fn follow(
    motion: &Motion,
    plan: &VerificationPlan,
    watch: &mut dyn Watch,
) -> Result<Option<Proof>, StudyError> {
    let (system, start) = (motion.system(), &motion.start);
    let verification = match verification::verify(system, start, plan, &mut |share| watch.at(STAGE, share)) {
        Err(VerificationError::Interrupted) => return Ok(None),
        other => other?,
    };
    let highest = plan.orders.iter().copied().max().unwrap_or_default();
    let (halvings, steps) = (plan.halvings.min(MAX_HALVINGS), STEPS_RATIO * verification.steps);
    let average = verify_average(system, start, highest, halvings, steps, &mut || watch.at(STAGE, 1.0));
    match average {
        Err(AverageError::Measure(MeasureError::Interrupted)) => Ok(None),
        average => Ok(Some(Proof { verification, average })),
    }
}

/// The differences and their orders, for a terminal of 80 columns.
pub fn text(name: &str, verification: &VerificationRecord) -> String {
    let mut text = String::new();
    write(&mut text, &one_line(name), verification).expect("a string takes any text");
    text
}

fn write(out: &mut String, name: &str, verification: &VerificationRecord) -> fmt::Result {
    let VerificationRecord { reached, rotations, duration, orders, average, .. } = verification;
    let title = format!(
        "{name}: the full system against the reduced equations over {} revolutions ({}), from the slow manifold, with \
         stiffness C/e^2 and damping B/e.",
        significant(*rotations, 4),
        time(*duration)
    );
    writeln!(out, "{}", paragraph(&title, "", "  "))?;
    writeln!(out, "\n  Largest difference in spin, relative to the spin")?;
    write!(out, "   p")?;
    for epsilon in orders.iter().flat_map(|row| &row.epsilons).take(columns(verification)) {
        write!(out, " {:>9}", format!("e = 1/{}", 1.0 / epsilon))?;
    }
    writeln!(out, "   order (expected)")?;
    let paper = |row: &OrderRecord| row.form == "paper";
    for (i, row) in orders.iter().enumerate() {
        if paper(row) && !i.checked_sub(1).is_some_and(|before| paper(&orders[before])) {
            writeln!(out, "  in the paper's form")?;
        }
        write!(out, "  {:>2}", row.p)?;
        for error in row.errors.iter().take(COLUMNS) {
            write!(out, " {error:>9.2e}")?;
        }
        let order = row.order.map_or("below rounding".into(), |order| format!("{order:.3}"));
        writeln!(out, "   {order} ({}){}", row.expected, if row.reached { "" } else { " NOT REACHED" })?;
    }
    writeln!(out, "\n  At the model's own stiffness, at most")?;
    writeln!(out, "   p      spin   attitude    energy dissipated")?;
    for row in orders.iter().filter(|row| !paper(row)) {
        let own = [&row.errors, &row.attitude, &row.dissipated, &row.dissipation].map(|list| list.first());
        let [Some(spin), Some(attitude), Some(off), Some(taken)] = own else { continue };
        let attitude = format!("{:.2e} deg", attitude.to_degrees());
        writeln!(out, "  {:>2} {spin:>9.2e}   {attitude}   {off:.2e} J of {taken:.4e} J", row.p)?;
    }
    averages(out, verification, average.as_ref())?;
    let verdict = if *reached { "Every order is reached." } else { "NOT EVERY ORDER IS REACHED." };
    writeln!(out, "\n{verdict}")
}

/// The mean power of the average beside that of the full system.
fn averages(
    out: &mut String,
    verification: &VerificationRecord,
    average: Option<&AverageRecord>,
) -> fmt::Result {
    let Some(AverageRecord { errors, order, expected, reached, .. }) = average else {
        let why = verification.average_left_out.as_deref().unwrap_or_default();
        return if why.is_empty() { Ok(()) } else { writeln!(out, "\n{}", paragraph(why, "  ", "    ")) };
    };
    write!(out, "\n  Mean power by the average, relative difference from a run of the full system\n    ")?;
    for error in errors.iter().take(COLUMNS) {
        write!(out, " {error:>9.2e}")?;
    }
    let order = order.map_or("below what it resolves".into(), |order| format!("{order:.3}"));
    writeln!(out, "   {order} ({expected}){}", if *reached { "" } else { " NOT REACHED" })
}

/// Columns that fit a terminal.
const COLUMNS: usize = 5;

fn columns(verification: &VerificationRecord) -> usize {
    verification.orders.first().map_or(0, |row| row.epsilons.len().min(COLUMNS))
}
