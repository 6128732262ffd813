//! The main job: check, reduce, propagate, follow over many revolutions, prove; and the record of it all.

use std::fs;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use quasirigid::dynamics::{Options, Outcome, Ringing, Scan, Start, spin_from_rest};
use quasirigid::model::ReducedBody;
use quasirigid::reduction::Verdict;
use quasirigid_io::model::{Named, PartialEvolve, PartialRun, PartialSpinManifold, PartialVerify, System};
use quasirigid_io::record::{
    AboutSpinRecord, EvolutionRecord, HistoryRecord, RECORD_FORMAT, RingingRecord, RunRecord, TableFormat,
    VerificationRecord,
};
use quasirigid_math::vec3::norm;

use crate::about_spin::{self, OnManifold};
use crate::campbell::campbell;
use crate::derive;
use crate::error::StudyError;
use crate::evolution::Evolved;
use crate::histories::{circled_axis, even_times, room};
use crate::history_columns::HistoryTable;
use crate::history_sink::{FrameList, HistorySink};
use crate::judged::{self, Fastest, Judged};
use crate::kept_run::{HistoryLog, Keeping, KeptRun};
use crate::left_out::LeftOut;
use crate::liquids::{Liquid, liquids};
use crate::motion::{DISPLACED, LOOSE, Motion};
use crate::neighbours::{Parting, parting};
use crate::scene::{self, Frames};
use crate::settings::{EvolveSettings, RunSettings, SpinManifoldSettings};
use crate::study::Study;
use crate::watch::Watch;
use crate::words::{Accounts, energy_note, load_doubt, ringing_doubt, significant};
use crate::{evolution, record, steady, verification};

/// Rows of a history without a given number: enough for smooth curves, within limits.
const ROWS_PER_TURN: f64 = 24.0;
const ROW_RANGE: [f64; 2] = [2_001.0, 50_001.0];

/// Note on a spin outside the range of the series.
const NO_SERIES: &str = "The truncated series has no angular momentum for this angular velocity, so the full system was followed in \
                         place of the reduced equations.";
/// Note on a start from rest.
const FROM_REST: &str = "The body starts from rest. The reduced equations are judged at {spin} rad/s, which the loads can give \
                         it, or a radian in the whole time.";
/// Note on a run that was told to end.
const INTERRUPTED: &str = "The run was interrupted, so the history of the {system} body was left out.";
const UNEXPANDED: &str = "The run was interrupted, so the reduced equations about the spin were left out.";
/// Stage of the expansion about the spin.
const STAGE: &str = "expanding about the spin";
const UNPROVED: &str = "The run was interrupted, so the verification against the full system was left out.";
/// Note on the histories of a start off the slow manifold.
const SETTLES: &str = "the full system moves until friction has damped it, and the reduced body starts from \
                       the state to which it settles";

/// Result of a run.
#[derive(Debug)]
pub struct RunOutcome {
    /// The record.
    pub record: RunRecord,
    /// The reduced equations, as JSON.
    pub reduced: String,
    /// Whether everything asked for is done and holds.
    pub holds: bool,
    /// Folder of the run in work.
    kept: Option<KeptRun>,
}

impl RunOutcome {
    /// Removes the folder of the run in work, once the record is written; that of a run that was interrupted stays, so that it can go on.
    /// Returns the folder that stays.
    pub fn settle(mut self) -> Option<PathBuf> {
        self.release()
    }

    /// As [`settle`](Self::settle); of long histories, whose rows were in that folder, the record has the extremes from then on.
    pub fn release(&mut self) -> Option<PathBuf> {
        let kept = self.kept.take()?;
        self.record.histories.iter_mut().for_each(|history| history.log = None);
        if kept.is_there() && self.record.histories.iter().any(|history| history.status == "interrupted") {
            return Some(kept.folder().to_owned());
        }
        kept.remove();
        None
    }

    /// Writes the record, the reduced equations, the report and its picture into a folder that is there.
    ///
    /// # Errors
    /// [`StudyError::Record`] and [`StudyError::Write`].
    pub fn write(&self, folder: &Path) -> Result<(), StudyError> {
        self.write_tables(folder, self.record.usual_formats())
    }

    /// The same with tables in these formats.
    ///
    /// # Errors
    /// Those of [`write`](Self::write).
    pub fn write_tables(&self, folder: &Path, formats: &[TableFormat]) -> Result<(), StudyError> {
        self.record.write(folder, formats)?;
        self.files().into_iter().try_for_each(|(name, text)| {
            let path = folder.join(name);
            fs::write(&path, text).map_err(|cause| StudyError::Write { path, cause })
        })
    }

    /// Names and texts of the files beside the record: the reduced equations, the report and its picture.
    #[must_use]
    pub fn files(&self) -> Vec<(&'static str, String)> {
        let mut files = vec![
            ("reduced.json", self.reduced.clone()),
            ("report.html", quasirigid_report::page(&self.record)),
        ];
        files.extend(quasirigid_report::sphere_picture(&self.record).map(|picture| ("sphere.svg", picture)));
        files
    }
}

impl Study {
    /// Does everything that the model asks for in `[run]`.
    ///
    /// # Errors
    /// [`StudyError`] for an invalid start, and for settings out of range; what is interrupted is left out with a note.
    pub fn run(&self, asked: &PartialRun, watch: &mut dyn Watch) -> Result<RunOutcome, StudyError> {
        self.run_kept(asked, None, watch)
    }

    /// Does everything that the model asks for in `[run]`, and keeps the histories in work in a folder, from which a run that was cut off
    /// goes on with the same bits. A long history is then written to the disk as it goes. The folder is that of the outcome, until
    /// [`RunOutcome::settle`] removes it.
    ///
    /// # Errors
    /// Those of [`run`](Self::run), and [`StudyError::KeptRun`].
    pub fn run_kept(
        &self,
        asked: &PartialRun,
        keeping: Option<&Keeping>,
        watch: &mut dyn Watch,
    ) -> Result<RunOutcome, StudyError> {
        self.left_alone("run")?;
        self.without_slugs("run")?;
        let mut kept = keeping.map(|keeping| KeptRun::open(keeping, self, asked)).transpose()?;
        let settings = RunSettings::resolve(asked, self)?;
        let Study { model, body, .. } = self;
        let start = self.initial()?;
        let motion = Motion::new(self, start);
        let from_rest = if start.omega == [0.0; 3] {
            let duration = settings.duration(start.omega)?;
            Some(spin_from_rest(motion.system(), motion.start, duration))
        } else {
            None
        };
        let poles = steady::at_start(&motion, self)?;
        let judged = from_rest.map_or_else(
            || judged::for_motion(&motion, &poles, settings.form),
            |spin| judged::at(&motion, spin),
        );
        let Judged { order, reduced, validity, .. } = match judged {
            Err(error) if error.is_of_the_series() => judged::at(&motion, start.omega)?,
            found => found?,
        };
        let motion = motion.of_order(order);
        let rigid = self.reduced(0)?;
        let moves = validity.verdict() != Verdict::Fails;
        let holds = moves && validity.dissipation() != Verdict::Fails;
        let nutating = Nutating { rigid: &rigid, nearly_rigid: if moves { &reduced } else { &rigid } };
        let mut notes = model.notes.clone();
        notes.extend(from_rest.map(|spin| FROM_REST.replace("{spin}", &significant(norm(spin), 3))));
        if motion.starts_loose()? {
            notes.push(LOOSE.into());
        }
        notes.extend(judged::raised(self, order));
        let scene_modes = poles.nearest().cloned();
        let left_out = LeftOut::at(self, start.omega, poles.nearest().cloned());
        notes.extend(left_out.notes());
        let plan = Plan::new(self, &settings, &motion, nutating, kept.is_some())?;
        let evolution = plan.evolution(start, &mut notes, watch)?;
        let mut record = RunRecord {
            format: RECORD_FORMAT,
            version: env!("CARGO_PKG_VERSION").into(),
            model: record::model(model),
            inputs: Some(self.inputs()),
            notes,
            body: record::body(self),
            liquids: liquids(self, norm(start.omega)).iter().map(Liquid::record).collect(),
            validity: record::validity(&validity),
            steady_spins: poles.records,
            campbell: scene_modes.as_ref().and_then(|modes| campbell(self, modes)),
            about_spin: None,
            reduction: record::reduction(body, &reduced, &validity, from_rest.unwrap_or(start.omega)),
            histories: Vec::new(),
            verification: None,
            evolution,
            scene: None,
        };
        let mut frames = None;
        plan.histories(&mut record, &mut frames, &mut kept, watch)?;
        let enough = holds || left_out.wrong().is_some(); // the equations about the spin have the same liquids and materials
        record.about_spin = plan.about_spin(enough, &mut record.notes, watch)?;
        record.verification = plan.verification(&mut record.notes, watch)?;
        let equations = frames.as_ref().filter(|_| !motion.system().acts()).and_then(|frames| {
            let [first, .., last] = frames.samples.as_slice() else { return None };
            scene::equations(self, order, (first, last.t - first.t), &validity).ok()
        });
        let scene = scene::scene(self, self.visuals()?, frames.as_ref(), scene_modes.as_ref(), equations);
        record.scene = Some(scene);
        let done = plan.is_done(&record);
        // a model that asks for the equations about the spin has its answer where these hold
        let instead = plan.asks_about_spin() && record.about_spin.as_ref().is_some_and(|about| about.holds);
        let equations =
            derive::of_reduced(self, Arc::clone(&reduced), &validity.vibrations.frequencies, Some(start));
        Ok(RunOutcome {
            record,
            reduced: equations.json(),
            holds: done && (holds || instead) && left_out.wrong().is_none(),
            kept,
        })
    }
}

/// Settings that the histories of a run share.
struct Plan<'a> {
    study: &'a Study,
    motion: &'a Motion<'a>,
    systems: Vec<System>,
    times: Vec<f64>,
    options: Options,
    nutating: Nutating<'a>,
}

/// The bodies by which nutation is counted. (P8)
struct Nutating<'a> {
    rigid: &'a ReducedBody,
    /// The reduced body where its equations hold, else the rigid one.
    nearly_rigid: &'a ReducedBody,
}

impl Nutating<'_> {
    fn of(&self, system: System) -> &ReducedBody {
        if system == System::Rigid { self.rigid } else { self.nearly_rigid }
    }
}

impl<'a> Plan<'a> {
    fn new(
        study: &'a Study,
        settings: &RunSettings,
        motion: &'a Motion<'a>,
        nutating: Nutating<'a>,
        kept: bool,
    ) -> Result<Self, StudyError> {
        let omega = motion.start.omega;
        let duration = settings.duration(omega)?;
        let revolutions = duration * norm(omega) / std::f64::consts::TAU;
        let rows = (ROWS_PER_TURN * revolutions).ceil().clamp(ROW_RANGE[0], ROW_RANGE[1]) as usize;
        let rows = settings.samples.unwrap_or(rows);
        let systems = study.model.run.systems.clone().unwrap_or_else(|| vec![System::Reduced, System::Rigid]);
        if !kept {
            room(rows, systems.len() + 1, 0)?;
        }
        let options = settings.options(study, circled_axis(nutating.nearly_rigid, omega))?;
        Ok(Self { study, motion, systems, times: even_times(rows, duration), options, nutating })
    }

    /// Whether the file asks for the reduced equations about the spin.
    fn asks_about_spin(&self) -> bool {
        self.study.model.run.spin_manifold.is_some() || self.systems.contains(&System::SpinManifold)
    }

    /// The reduced equations about the spin: where the file asks for them, and where those about rest are not enough and these hold.
    fn about_spin(
        &self,
        enough: bool,
        notes: &mut Vec<String>,
        watch: &mut dyn Watch,
    ) -> Result<Option<AboutSpinRecord>, StudyError> {
        let asked = self.asks_about_spin();
        if !asked && (enough || self.motion.body.coordinates().len() > about_spin::MAX_TRIED_COORDINATES) {
            return Ok(None);
        }
        let found = about_spin::that_holds(self.motion, &mut |share| watch.at(STAGE, share));
        let missing = match found {
            Ok(found) => return Ok((asked || found.holds()).then(|| found.record())),
            Err(StudyError::Interrupted) if asked => UNEXPANDED.to_owned(),
            Err(error) if asked => format!("There are no reduced equations about the spin: {error}."),
            Err(_) => return Ok(None),
        };
        notes.push(missing);
        Ok(None)
    }

    /// The histories, in the order asked for; a note says why one is missing.
    fn histories(
        &self,
        record: &mut RunRecord,
        frames: &mut Option<Frames>,
        kept: &mut Option<KeptRun>,
        watch: &mut dyn Watch,
    ) -> Result<(), StudyError> {
        for system in &self.systems {
            if watch.at(system.recorded(), 0.0).is_break() {
                record.notes.push(INTERRUPTED.replace("{system}", system.recorded()));
                continue;
            }
            match self.history(*system, record, frames, kept, watch) {
                Ok(followed) => add(record, followed),
                Err(error) if *system == System::Reduced && error.is_of_the_series() => {
                    record.notes.push(NO_SERIES.into());
                    if !self.systems.contains(&System::Full) {
                        let followed = self.history(System::Full, record, frames, kept, watch)?;
                        add(record, followed);
                    }
                }
                Err(failure) => return Err(failure),
            }
        }
        if self.motion.starts_displaced() {
            record.notes.push(format!("{DISPLACED}: {SETTLES}."));
        }
        let end = self.times.last().copied().unwrap_or_default();
        let parting = parting(self.motion, end, &self.options, watch);
        record.notes.extend(parting.as_ref().map(Parting::doubt));
        let forced = self.motion.system().acts();
        let note = |each: &&HistoryRecord| each.system != System::SpinManifold.recorded();
        let drift = |each: &HistoryRecord| {
            let &HistoryRecord { energy, energy_drift: drift, dissipated, left_out, .. } = each;
            energy_note(&each.system, forced, Accounts { energy, drift, dissipated, left_out })
        };
        let loads =
            |each: &HistoryRecord| load_doubt(judged::along_the_motion(each.load_ratio), each.load_ratio);
        let ringing = |each: &HistoryRecord| each.ringing.map(|ringing| ringing_doubt(of_record(ringing)));
        let mut doubts: Vec<_> = record.histories.iter().filter_map(ringing).collect();
        let reduced = record.histories.iter().filter(|each| each.system == System::Reduced.recorded());
        for history in reduced {
            let fastest = judged::at_the_fastest(self.motion, &history.columns)?;
            doubts.extend(fastest.as_ref().map(Fastest::doubt));
        }
        doubts.extend(record.histories.iter().filter_map(loads));
        record.notes.extend(doubts);
        record.notes.extend(record.histories.iter().filter(note).filter_map(drift));
        Ok(())
    }

    /// The proof against the full system, where the file asks for it.
    fn verification(
        &self,
        notes: &mut Vec<String>,
        watch: &mut dyn Watch,
    ) -> Result<Option<VerificationRecord>, StudyError> {
        if self.study.model.run.verify.is_none() {
            return Ok(None);
        }
        let plan = self.study.verification_plan(PartialVerify::default());
        let found = verification::follow(self.motion, &plan, watch)?;
        if found.is_none() {
            notes.push(UNPROVED.into());
        }
        Ok(found.map(|found| record::verification(&plan, &found)))
    }

    /// The averaged rotation, where the file asks for it.
    fn evolution(
        &self,
        start: Start,
        notes: &mut Vec<String>,
        watch: &mut dyn Watch,
    ) -> Result<Option<EvolutionRecord>, StudyError> {
        if self.study.model.run.evolve.is_none() {
            return Ok(None);
        }
        let settings = EvolveSettings::resolve(PartialEvolve::default(), self.study)?;
        let Evolved { record, notes: remarks } = evolution::follow(self.study, start, &settings, watch)?;
        notes.extend(remarks);
        if record.status != "finished" {
            notes.push(format!("Over many revolutions: {}", record.message));
        }
        Ok(Some(record))
    }

    /// A history, with a note on it; of the first one that is followed, also the frames.
    fn history(
        &self,
        system: System,
        record: &RunRecord,
        frames: &mut Option<Frames>,
        kept: &mut Option<KeptRun>,
        watch: &mut dyn Watch,
    ) -> Result<(HistoryRecord, Option<String>), StudyError> {
        let name = system.recorded();
        let body = self.motion.system().body;
        let equations = self.motion.equations(system, self.options.form);
        let table = HistoryTable::new(body.support(), Some(self.nutating.of(system)));
        let list = match frames {
            None => {
                let count = body.coordinates().len();
                FrameList::new(Frames::stride(self.times.len(), count), count)
            }
            Some(_) => FrameList::default(),
        };
        let (mut log, mut resumed) = (None, None);
        if let Some(kept) = kept {
            kept.begin(with_unfinished(
                record,
                record::unfinished(system, equations, &self.options, table.columns()),
            ))?;
            let widths = [table.columns().len(), list.width()];
            let (opened, found) = HistoryLog::open(kept, name, widths)?;
            (log, resumed) = (Some(opened), found);
        }
        let mut sink = HistorySink::new(table, &self.times, list, log, (&mut *watch, name));
        if let Some(resumed) = resumed {
            sink.resume(resumed)?;
        }
        sink.log_if_long()?;
        let about_spin = SpinManifoldSettings::resolve(PartialSpinManifold::default(), None, self.study)?;
        let (run, verdict) =
            self.motion.follow(system, &about_spin, &self.times, &self.options, &mut sink)?;
        let mut followed = sink.finish()?;
        if frames.is_none() {
            let list = std::mem::take(&mut followed.frames);
            *frames = Some(Frames {
                system: name.into(),
                samples: list.samples,
                coordinates: list.coordinates,
                count: body.coordinates().len(),
            });
        }
        if matches!(
            run.outcome,
            Outcome::Failed(_) | Outcome::Missed(_) | Outcome::StepLimit | Outcome::LeftRange(_)
        ) {
            watch.remark(&format!("{name}: {}", record::status(self.study, run.outcome, run.last.t).1));
        }
        let mut history = record::history(system, equations, &self.options, followed, (self.study, &run));
        let note = verdict.as_ref().and_then(OnManifold::note).or_else(|| scanned(run.scan));
        if let Some((status, message)) = verdict.and_then(|verdict| verdict.status(run.outcome)) {
            (history.status, history.message) = (status.into(), message);
        }
        Ok((history, note))
    }

    /// Whether forces spun a history of the reduced equations up to where these fail.
    fn is_outgrown(&self, history: &HistoryRecord) -> bool {
        let reduced = history.system == System::Reduced.recorded();
        let fastest = || judged::at_the_fastest(self.motion, &history.columns).ok().flatten();
        reduced && fastest().is_some_and(|found| found.fails())
    }

    /// Whether everything asked for was followed to its end and verified.
    fn is_done(&self, record: &RunRecord) -> bool {
        let ended = |status: &str| matches!(status, "finished" | "event");
        let followed = |history: &HistoryRecord| {
            ended(&history.status)
                && judged::along_the_motion(history.load_ratio) != Verdict::Fails
                && !self.is_outgrown(history)
        };
        record.histories.len() == self.systems.len()
            && record.histories.iter().all(followed)
            && record.verification.is_some() == self.study.model.run.verify.is_some()
            && record.verification.as_ref().is_none_or(|verification| verification.reached)
            && record.evolution.as_ref().is_none_or(|evolution| evolution.status == "finished")
    }
}

/// Adds a history, and the note on it.
fn add(record: &mut RunRecord, (history, note): (HistoryRecord, Option<String>)) {
    record.histories.push(history);
    record.notes.extend(note.filter(|note| !record.notes.contains(note)));
}

/// Error of an angular velocity, from a record.
fn of_record(RingingRecord { from, to, omega, share }: RingingRecord) -> Ringing {
    Ringing { from, to, omega, share }
}

/// Note on the formulas of the time that were followed.
fn scanned(Scan { evaluations, breakpoints, stops }: Scan) -> Option<String> {
    (evaluations > 0).then(|| {
        format!(
            "Formulas of t were followed through the run: {evaluations} evaluations, {breakpoints} breakpoints, {stops} stops."
        )
    })
}

/// The record so far with a history that begins.
fn with_unfinished(record: &RunRecord, history: HistoryRecord) -> RunRecord {
    let mut record = record.clone();
    record.histories.push(history);
    record
}
