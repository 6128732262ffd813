//! Histories of the spin: duration, rows, tolerance, and systems of equations.

use std::f64::consts::TAU;
use std::path::Path;

use quasirigid::dynamics::{Event, Form, Method, Nutations, Options, Outcome, Run, Sample, Start};
use quasirigid::model::{Principal, ReducedBody};
use quasirigid::reduction::{Assessment, Comparison, Criterion, Validity, Verdict, frequencies};
use quasirigid_io::model::{Named, Stop, System};
use quasirigid_io::record::{Column, RowTable};
use quasirigid_math::memory;
use quasirigid_math::vec3::norm;

use crate::about_spin::{AskedManifold, OnManifold};
use crate::error::{Setting, StudyError};
use crate::history_columns::{HistoryTable, Internal};
use crate::judged::{self, Judged};
use crate::left_out::LeftOut;
use crate::motion::{LOOSE, Motion};
use crate::record::status;
use crate::study::Study;
use crate::table_sink::TableSink;
use crate::watch::Watch;
use crate::words::{Accounts, energy_note, followed};

/// Settings of a propagation by the user; absent ones are the file's, or the defaults.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Propagation {
    /// Duration (s); a hundred revolutions by default.
    pub duration: Option<f64>,
    /// Error allowed per step, relative.
    pub tolerance: Option<f64>,
    /// Number of rows.
    pub samples: Option<usize>,
    /// Variable that is integrated.
    pub form: Option<Form>,
    /// Integrator of the full system.
    pub method: Option<Method>,
}

/// Revolutions of a propagation without a duration.
const TURNS: f64 = 100.0;
/// Numbers of a row, in the history and in its table.
const ROW: usize = 40;
/// Rows that a table has.
const ROWS: std::ops::RangeInclusive<usize> = 2..=10_000_000;

impl Propagation {
    /// Duration (s) of a motion that starts with an angular velocity (rad/s).
    ///
    /// # Errors
    /// [`StudyError::NoDuration`], [`StudyError::RestWithoutDuration`].
    pub fn duration(&self, study: &Study, omega: [f64; 3]) -> Result<f64, StudyError> {
        let Some(seconds) = self.duration else {
            let usual = Some(TURNS * TAU / norm(omega)).filter(|seconds| seconds.is_finite());
            return study.model.run.duration.or(usual).ok_or(StudyError::RestWithoutDuration);
        };
        if seconds > 0.0 && seconds.is_finite() {
            Ok(seconds)
        } else {
            Err(StudyError::NoDuration { seconds })
        }
    }

    /// Number of rows, or `usual`.
    #[must_use]
    pub fn samples(&self, study: &Study, usual: usize) -> usize {
        self.samples.or(study.model.run.samples).unwrap_or(usual)
    }

    /// Options of the integrator. Nutation is counted from the `axis`.
    ///
    /// # Errors
    /// [`StudyError::Vibration`].
    pub fn options(&self, study: &Study, axis: [f64; 3]) -> Result<Options, StudyError> {
        let run = &study.model.run;
        let usual = Options::default();
        Ok(Options {
            events: events(study, axis)?,
            method: self.method.or(run.method).unwrap_or(usual.method),
            tolerance: self.tolerance.or(run.tolerance).unwrap_or(usual.tolerance),
            form: self.form.or(run.form).unwrap_or(Form::AngularMomentum),
            ..usual
        })
    }
}

/// Events that end a propagation, as the file asks.
fn events(study: &Study, axis: [f64; 3]) -> Result<Vec<Event>, StudyError> {
    let Stop { energy, nutation, validity } = study.model.run.stop;
    let mut events: Vec<Event> = energy.map(Event::Energy).into_iter().collect();
    events.extend(nutation.map(|angle| Event::Nutation { axis, angle }));
    if validity && let Some(slowest) = frequencies(&study.body)?.first() {
        let limit = Criterion { comparison: Comparison::Spin, value: 0.0 }.failure();
        events.push(Event::Validity { slowest: *slowest, limit });
    }
    Ok(events)
}

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
    let numbers = (ROW + 4 * coordinates) as f64 * samples as f64 * histories as f64;
    memory::ask(numbers * size_of::<f64>() as f64).map_err(|cause| StudyError::History { samples, cause })
}

/// Output times from zero to `duration`.
pub(crate) fn even_times(samples: usize, duration: f64) -> Result<Vec<f64>, StudyError> {
    if !ROWS.contains(&samples) {
        return Err(StudyError::Samples { samples });
    }
    let last = samples - 1;
    Ok((0..samples).map(|i| if i == last { duration } else { duration * i as f64 / last as f64 }).collect())
}

/// Contents of the table of a history.
#[derive(Clone, Debug)]
pub struct Table {
    /// System of equations.
    pub system: System,
    /// Internal coordinates and their rates, too.
    pub coordinates: bool,
    /// Displacements of points, appendages and nodes, too.
    pub displacements: bool,
    /// Output times (s), in the place of even ones.
    pub times: Option<Vec<f64>>,
    /// Settings of the reduced equations about the spin.
    pub manifold: AskedManifold,
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
    /// Reason for which the numbers are not those of the body, known before the work: the reduced equations do not hold at the start, or
    /// the effect of a liquid is not right.
    pub wrong: Option<String>,
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
    /// [`StudyError`] for a start that is none, for settings out of range, and for histories that have no room.
    pub fn simulate(
        &self,
        propagation: &Propagation,
        table: &Table,
        watch: &mut dyn Watch,
    ) -> Result<History, StudyError> {
        self.simulate_from(self.initial()?, propagation, table, watch)
    }

    /// Number of rows of a table.
    #[must_use]
    pub fn table_rows(&self, propagation: &Propagation, table: &Table) -> usize {
        table.times.as_ref().map_or_else(|| propagation.samples(self, TABLE_ROWS), Vec::len)
    }

    /// Follows one system of equations, and logs the rows in a file as they come, so that a table of any length needs little memory.
    ///
    /// # Errors
    /// As [`simulate`](Self::simulate), and [`StudyError::Write`].
    pub fn simulate_logged(
        &self,
        propagation: &Propagation,
        table: &Table,
        log: &Path,
        watch: &mut dyn Watch,
    ) -> Result<History, StudyError> {
        self.follow_table(self.initial()?, propagation, table, Some(log), watch)
    }

    /// Follows one system of equations from a rotation in the place of the model's own.
    ///
    /// # Errors
    /// As [`simulate`](Self::simulate).
    pub fn simulate_from(
        &self,
        spin: Start,
        propagation: &Propagation,
        table: &Table,
        watch: &mut dyn Watch,
    ) -> Result<History, StudyError> {
        self.follow_table(spin, propagation, table, None, watch)
    }

    fn follow_table(
        &self,
        spin: Start,
        propagation: &Propagation,
        table: &Table,
        log: Option<&Path>,
        watch: &mut dyn Watch,
    ) -> Result<History, StudyError> {
        let body = &self.body;
        let options = propagation.options(self, stop_axis(self, spin.omega)?)?;
        let times = match &table.times {
            Some(times) => times.clone(),
            None => {
                let rows = self.table_rows(propagation, table);
                even_times(rows, propagation.duration(self, spin.omega)?)?
            }
        };
        if log.is_none() {
            let kept = table.coordinates || table.displacements;
            room(times.len(), 1, if kept { body.coordinates().len() } else { 0 })?;
        }
        for (asked, setting) in
            [(table.coordinates, Setting::Coordinates), (table.displacements, Setting::Displacements)]
        {
            if asked && table.system == System::Rigid {
                return Err(StudyError::NoCoordinates { setting });
            }
        }
        let motion = Motion::new(self, spin);
        let (order, Doubts { remarks, wrong }) = Doubts::before(&motion, table.system)?;
        let motion = motion.of_order(order);
        remarks.iter().for_each(|note| watch.remark(note));
        let valued = if table.system == System::Full { body.coordinates().len() } else { body.elastic() };
        let internal = Internal {
            markers: if table.displacements { body.markers() } else { &[] },
            coordinates: table.coordinates.then(|| (body.coordinates(), valued)),
        };
        let history = HistoryTable::new(body.support(), None);
        let mut sink = TableSink::new(history, internal, &times, log, watch)?;
        let (run, manifold) = motion.follow(table.system, &table.manifold, &times, &options, &mut sink)?;
        let budget = std::mem::take(&mut sink.budget);
        let (columns, log) = sink.finish()?;
        let (forced, last) = (motion.system().acts(), run.last);
        let Sample { energy, energy_drift: drift, dissipated, .. } = last;
        let accounts = Accounts { energy, drift, dissipated, left_out: run.left_out };
        // the defect judges the equations about a spin: their energy is truncated, whatever the integrator does
        let note = match &manifold {
            Some(verdict) => verdict.note(),
            None => energy_note(table.system.name(), forced, accounts),
        };
        let notes = note.into_iter().collect();
        let left = manifold.as_ref().and_then(|verdict| verdict.status(run.outcome));
        let (status, message) = left.unwrap_or_else(|| status(body, run.outcome, last.t));
        Ok(History {
            system: table.system,
            status,
            message,
            columns,
            log,
            run,
            budget,
            notes,
            manifold,
            wrong,
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
    pub fn before(motion: &Motion, system: System) -> Result<(usize, Self), StudyError> {
        let study = motion.study();
        if system != System::Reduced || motion.start.omega == [0.0; 3] {
            let mut doubts = Self::left_out(motion, system);
            if system == System::Full && motion.starts_loose()? {
                doubts.remarks.push(LOOSE.into());
            }
            return Ok((study.order, doubts));
        }
        let poles = judged::poles_in_a_moment(motion)?;
        let Judged { order, validity, .. } = judged::for_motion(motion, &poles)?;
        let losses = LeftOut::at(study, motion.start.omega, poles.nearest);
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
    let reduced = study.reduced(study.order)?;
    let validity = Validity::assess_reduced(&study.body, &reduced, omega);
    let holds = validity.is_ok_and(|validity| validity.verdict() != Verdict::Fails);
    Ok(circled_axis(&*if holds { reduced } else { study.reduced(0)? }, omega))
}
