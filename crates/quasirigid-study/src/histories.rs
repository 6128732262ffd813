//! Histories of the spin by one of the systems of equations.

use std::path::Path;

use quasirigid::dynamics::{Event, Form, Nutations, Outcome, Run, Sample, Start};
use quasirigid::model::{Principal, ReducedBody};
use quasirigid::reduction::{Assessment, Validity, Verdict};
use quasirigid_io::model::{Named, PartialRun, PartialSpinManifold, System};
use quasirigid_io::record::{Column, RowTable};
use quasirigid_math::memory;

use crate::about_spin::OnManifold;
use crate::controlled;
use crate::driven;
use crate::error::StudyError;
use crate::free_rotation::FreeRotationObject;
use crate::history_columns::{HistoryTable, Internal};
use crate::judged::{self, Fastest, Judged};
use crate::left_out::LeftOut;
use crate::motion::{LOOSE, Motion};
use crate::neighbours::{Parting, parting};
use crate::record::status;
use crate::settings::{RunSettings, Setting, SpinManifoldSettings};
use crate::slugs;
use crate::study::Study;
use crate::table_sink::TableSink;
use crate::watch::Watch;
use crate::words::{Accounts, energy_note, followed, load_doubt, ringing_doubt};

/// Numbers of a row, in the history and in its table.
const NUMBERS_PER_ROW: usize = 40;
/// Axis from which nutation is counted at an angular velocity; that of greatest inertia where the angular momentum circles none. (P8)
pub(crate) fn circled_axis(body: &ReducedBody, omega: [f64; 3]) -> [f64; 3] {
    let nutation = Nutations::new(body).at(body.angular_momentum(omega));
    nutation.map_or_else(|| Principal::compute(body.J).axes[2], |nutation| nutation.axis)
}

/// Refuses histories that have no room in memory, with so many internal coordinates kept in each row.
///
/// # Errors
/// [`StudyError::History`].
pub fn room(samples: usize, histories: usize, coordinates: usize) -> Result<(), StudyError> {
    let numbers = (NUMBERS_PER_ROW + 4 * coordinates) as f64 * samples as f64 * histories as f64;
    memory::ask(numbers * size_of::<f64>() as f64).map_err(|cause| StudyError::History { samples, cause })
}

/// Output times from zero to `duration`, two or more.
pub(crate) fn even_times(samples: usize, duration: f64) -> Vec<f64> {
    let last = samples - 1;
    (0..samples).map(|i| if i == last { duration } else { duration * i as f64 / last as f64 }).collect()
}

/// Contents of the table of a history.
#[derive(Clone, Debug)]
pub struct Table {
    /// System of equations; by default the reduced, of a body with driven parts the full.
    pub system: Option<System>,
    /// Internal coordinates and their rates, too.
    pub coordinates: bool,
    /// Displacements of points, appendages and nodes, too.
    pub displacements: bool,
    /// Output times (s), in place of even ones.
    pub times: Option<Vec<f64>>,
    /// Settings of the reduced equations about the spin.
    pub manifold: PartialSpinManifold,
}

/// A history of the spin.
#[derive(Clone, Debug)]
pub struct History {
    /// The equations integrated.
    pub system: System,
    /// Status at the end, in a word.
    pub status: &'static str,
    /// Status in a sentence.
    pub message: String,
    /// The table; without values where its rows are logged.
    pub columns: Vec<Column>,
    /// Rows of a long table that was to be logged.
    pub log: Option<RowTable>,
    /// Result of the integration.
    pub run: Run,
    /// Energy (J) that each dissipator took, by name.
    pub budget: Vec<(String, f64)>,
    /// Notes to read before the numbers: the drift of the integrator may imitate dissipation.
    pub notes: Vec<String>,
    /// Verdict on the reduced equations about the spin, where these were followed.
    pub manifold: Option<OnManifold>,
    /// Reason for which the numbers are not those of the body: the reduced equations do not hold at the start or under the forces on the
    /// way, or the effect of a liquid is not right.
    pub wrong: Option<String>,
    /// Free rotation from the last state on.
    pub(crate) free_rotation: Option<FreeRotationObject>,
    /// What was followed, for a certificate.
    pub(crate) followed: Followed,
}

/// Equations of a history.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Followed {
    /// Order of the reduced equations.
    pub order: usize,
    /// Variable integrated.
    pub form: Form,
    /// Error allowed per step, relative.
    pub tolerance: f64,
    /// Whether forces or controllers act.
    pub forced: bool,
}

impl History {
    /// Whether the integration reached the last time, or an event of the file.
    #[must_use]
    pub fn ended(&self) -> bool {
        let reached = matches!(
            self.run.outcome,
            Outcome::Finished | Outcome::Event(Event::Energy(_) | Event::Nutation { .. })
        );
        reached && self.manifold.as_ref().is_none_or(OnManifold::holds)
    }

    /// Reason for which the history is not that of the body to the end asked for; none if it is.
    #[must_use]
    pub fn reason(&self) -> Option<&str> {
        let unfinished = (!self.ended()).then_some(self.message.as_str());
        self.wrong.as_deref().or(unfinished)
    }

    /// Whether the history is that of the body to the end asked for.
    #[must_use]
    pub fn holds(&self) -> bool {
        self.reason().is_none()
    }
}

/// Rows of a table without a given number.
const TABLE_ROWS: usize = 1001;

impl Study {
    /// Follows one system of equations. Doubts before the work are remarks to the watch.
    ///
    /// # Errors
    /// [`StudyError`] for an invalid start, for settings out of range, and for histories too large for memory.
    pub fn simulate(
        &self,
        asked: &PartialRun,
        table: &Table,
        watch: &mut dyn Watch,
    ) -> Result<History, StudyError> {
        self.follow_table((self.initial()?, true), asked, table, None, watch)
    }

    /// Number of rows of a table.
    #[must_use]
    pub fn table_rows(&self, asked: &PartialRun, table: &Table) -> usize {
        let rows = || asked.samples.or(self.model.run.histories.samples).unwrap_or(TABLE_ROWS);
        table.times.as_ref().map_or_else(rows, Vec::len)
    }

    /// Follows one system of equations, and logs the rows in a file as they come, so that a table of any length needs little memory.
    ///
    /// # Errors
    /// As [`simulate`](Self::simulate), and [`StudyError::Write`].
    pub fn simulate_logged(
        &self,
        asked: &PartialRun,
        table: &Table,
        log: &Path,
        watch: &mut dyn Watch,
    ) -> Result<History, StudyError> {
        self.follow_table((self.initial()?, true), asked, table, Some(log), watch)
    }

    /// Follows one system of equations from a rotation in place of the model's own, as one of many histories: neighbouring starts, which tell
    /// chaos, are not followed.
    ///
    /// # Errors
    /// As [`simulate`](Self::simulate).
    pub fn simulate_from(
        &self,
        spin: Start,
        asked: &PartialRun,
        table: &Table,
        watch: &mut dyn Watch,
    ) -> Result<History, StudyError> {
        self.follow_table((spin, false), asked, table, None, watch)
    }

    fn follow_table(
        &self,
        (spin, with_neighbours): (Start, bool),
        asked: &PartialRun,
        table: &Table,
        log: Option<&Path>,
        watch: &mut dyn Watch,
    ) -> Result<History, StudyError> {
        let body = &self.body;
        let system = table.system.unwrap_or_else(|| self.usual_system());
        controlled::carries(self, system)?;
        slugs::carries(self, system)?;
        driven::carries(self, system)?;
        let settings = RunSettings::resolve(asked, self)?;
        let about_spin = SpinManifoldSettings::resolve(table.manifold.clone(), None, self)?;
        let options = settings.options(self, stop_axis(self, spin.omega)?)?;
        let times = match &table.times {
            Some(times) => times.clone(),
            None => even_times(settings.samples.unwrap_or(TABLE_ROWS), settings.duration(spin.omega)?),
        };
        if log.is_none() {
            let kept = table.coordinates || table.displacements;
            room(times.len(), 1, if kept { body.coordinates().len() } else { 0 })?;
        }
        for (wanted, setting) in
            [(table.coordinates, Setting::Coordinates), (table.displacements, Setting::Displacements)]
        {
            if wanted && system == System::Rigid {
                return Err(StudyError::NoCoordinates { setting });
            }
        }
        let motion = Motion::new(self, spin);
        let (order, Doubts { remarks, wrong }) = Doubts::before(&motion, system, settings.form)?;
        let motion = motion.of_order(order);
        remarks.iter().for_each(|note| watch.remark(note));
        let valued = if system == System::Full { body.coordinates().len() } else { body.elastic() };
        let internal = Internal {
            markers: if table.displacements { body.markers() } else { &[] },
            coordinates: table.coordinates.then(|| (body.coordinates(), valued)),
        };
        let history = HistoryTable::new(body.support(), None).under(&self.controls);
        let mut sink = TableSink::new(history, internal, &times, log, watch)?;
        let (run, manifold) = motion.follow(system, &about_spin, &times, &options, &mut sink)?;
        let budget = std::mem::take(&mut sink.budget);
        let (columns, log) = sink.finish()?;
        let (forced, last) = (motion.is_acted_on(), run.last);
        let Sample { energy, energy_drift: drift, dissipated, .. } = last;
        let accounts = Accounts { energy, drift, dissipated, left_out: run.left_out };
        // the defect judges the equations about a spin: their energy is truncated, whatever the integrator does
        let note = match &manifold {
            Some(verdict) => verdict.note(),
            None => energy_note(system.recorded(), forced, accounts),
        };
        let verdict = judged::along_the_motion(run.load_ratio);
        let doubt = load_doubt(verdict, run.load_ratio);
        let wrong = wrong.or_else(|| doubt.clone().filter(|_| verdict == Verdict::Fails));
        let reduced = system == System::Reduced;
        let fastest = if reduced { judged::at_the_fastest(&motion, &columns)? } else { None };
        let wrong = wrong.or_else(|| fastest.as_ref().filter(|found| found.fails()).map(Fastest::doubt));
        let faster = fastest.as_ref().map(Fastest::doubt);
        let end = times.last().copied().unwrap_or_default();
        let parting = with_neighbours.then(|| parting(&motion, end, &options, watch)).flatten();
        let chaos = parting.as_ref().map(Parting::doubt);
        let ringing = run.ringing.map(ringing_doubt);
        let notes = [chaos, ringing, faster, doubt, note].into_iter().flatten().collect();
        let left = manifold.as_ref().and_then(|verdict| verdict.status(run.outcome));
        let (status, message) = left.unwrap_or_else(|| status(self, run.outcome, last.t));
        Ok(History {
            system,
            status,
            message,
            columns,
            log,
            run,
            budget,
            notes,
            manifold,
            wrong,
            free_rotation: FreeRotationObject::of(body, &last),
            followed: Followed { order, form: settings.form, tolerance: settings.tolerance, forced },
        })
    }
}

/// Doubts about a history that are known before the work.
#[derive(Clone, Debug, Default)]
pub(crate) struct Doubts {
    /// Notes to read before the numbers.
    pub remarks: Vec<String>,
    /// Reason for which the numbers are not those of the body.
    pub wrong: Option<String>,
}

impl Doubts {
    /// Order of the reduced equations, with the losses that a system of equations leaves out and the verdict on the reduced ones at the start.
    pub fn before(motion: &Motion, system: System, form: Form) -> Result<(usize, Self), StudyError> {
        let study = motion.study();
        if system != System::Reduced || motion.start.omega == [0.0; 3] {
            let mut doubts = Self::left_out(motion, system);
            if system == System::Full && motion.starts_loose()? {
                doubts.remarks.push(LOOSE.into());
            }
            return Ok((study.order, doubts));
        }
        let poles = judged::poles_in_a_moment(motion)?;
        let Judged { order, validity, .. } = judged::for_motion(motion, &poles, form)?;
        let losses = LeftOut::at(study, motion.start.omega, poles.nearest().cloned());
        let mut doubts = Self::of_validity(&losses, &validity);
        doubts.remarks.extend(judged::raised(study, order));
        Ok((order, doubts))
    }

    /// The same for the reduced equations, whose assessment is prepared, from the spin at which they start.
    pub fn judged(motion: &Motion, assessment: &Assessment, settled: [f64; 3]) -> Result<Self, StudyError> {
        let losses = LeftOut::at(motion.study(), motion.start.omega, None);
        Ok(Self::of_validity(&losses, &assessment.at(settled)?))
    }

    fn of_validity(losses: &LeftOut, validity: &Validity) -> Self {
        let mut doubts = Self::of_losses(losses);
        let worst = validity.verdict().max(validity.dissipation());
        if worst != Verdict::Holds {
            let doubt = format!("{} The check says why.", followed(validity));
            doubts.remarks.push(doubt.clone());
            if worst == Verdict::Fails {
                doubts.wrong = Some(doubt);
            }
        }
        doubts
    }

    fn left_out(motion: &Motion, system: System) -> Self {
        if system == System::Rigid {
            return Self::default();
        }
        Self::of_losses(&LeftOut::at(motion.study(), motion.start.omega, None))
    }

    fn of_losses(losses: &LeftOut) -> Self {
        Self { remarks: losses.notes(), wrong: losses.wrong().map(str::to_owned) }
    }
}

/// The axis from which the nutation that ends a history is counted. (P8)
fn stop_axis(study: &Study, omega: [f64; 3]) -> Result<[f64; 3], StudyError> {
    if study.model.run.stop.nutation.is_none() {
        return Ok(omega);
    }
    let study = study.held()?.unwrap_or(study);
    let reduced = study.reduced(study.order)?;
    let validity = Validity::assess_reduced(&study.body, &reduced, omega);
    let holds = validity.is_ok_and(|validity| validity.verdict() != Verdict::Fails);
    Ok(circled_axis(&*if holds { reduced } else { study.reduced(0)? }, omega))
}
