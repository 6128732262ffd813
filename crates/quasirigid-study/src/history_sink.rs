//! Observer of a history of a run: rows as they come, the extremes of a long history, frames for the picture, and the log of a run in work.

use std::ops::ControlFlow;

use quasirigid::dynamics::{Checkpoint, Observer, PropagateError, Sample};
use quasirigid_io::record::{Column, Extremes, RowTable};

use crate::error::StudyError;
use crate::history_columns::HistoryTable;
use crate::kept_run::{HistoryLog, Resumed};
use crate::watch::Watch;

/// Numbers of a sample in a frame.
pub(crate) const FRAME: usize = 26;

/// Frames of a history: every so many rows a sample with the internal coordinates and their rates.
#[derive(Clone, Debug, Default)]
pub(crate) struct FrameList {
    stride: u64,
    /// Number of coordinates.
    count: usize,
    pub samples: Vec<Sample>,
    pub coordinates: Vec<Vec<f64>>,
}

impl FrameList {
    pub fn new(stride: usize, count: usize) -> Self {
        Self { stride: stride as u64, count, ..Self::default() }
    }

    /// Numbers of a frame.
    pub fn width(&self) -> usize {
        FRAME + 2 * self.count
    }

    fn row(&self, frame: usize) -> Vec<f64> {
        [&packed(&self.samples[frame])[..], &self.coordinates[frame]].concat()
    }

    fn push(&mut self, row: &[f64]) {
        self.samples.push(unpacked(&row[..FRAME]));
        self.coordinates.push(row[FRAME..].to_vec());
    }
}

/// Observer of a history of a run.
pub(crate) struct HistorySink<'a, 'r> {
    table: HistoryTable<'a>,
    rows: Extremes,
    frames: FrameList,
    /// Energy (J) at the first row.
    energy: f64,
    /// Energy (J) that each dissipator took, by name, once a propagation has ended.
    pub budget: Vec<(String, f64)>,
    log: Option<HistoryLog<'r>>,
    /// State to go on from.
    resumes: Option<Checkpoint>,
    /// Failure of the log, which ends the propagation.
    failure: Option<StudyError>,
    stopped: bool,
    watch: &'a mut dyn Watch,
    stage: &'a str,
    duration: f64,
    row: Vec<f64>,
    coordinates: Vec<f64>,
}

/// What a history leaves.
pub(crate) struct Followed {
    pub columns: Vec<Column>,
    /// Rows in all.
    pub rows: u64,
    /// The log of a history that the columns do not hold whole.
    pub log: Option<RowTable>,
    pub energy: f64,
    pub budget: Vec<(String, f64)>,
    pub frames: FrameList,
}

impl<'a, 'r> HistorySink<'a, 'r> {
    /// Of a table with so many rows to come, logged where a run is kept.
    pub fn new(
        table: HistoryTable<'a>,
        times: &[f64],
        frames: FrameList,
        log: Option<HistoryLog<'r>>,
        (watch, stage): (&'a mut dyn Watch, &'a str),
    ) -> Self {
        // without a log every row is kept
        let rows = if log.is_some() { times.len() as u64 } else { 0 };
        let rows = Extremes::new(&table.columns(), rows);
        let duration = times.last().copied().unwrap_or(0.0);
        Self {
            table,
            rows,
            frames,
            energy: f64::NAN,
            budget: Vec::new(),
            log,
            resumes: None,
            failure: None,
            stopped: false,
            watch,
            stage,
            duration,
            row: Vec::new(),
            coordinates: Vec::new(),
        }
    }

    /// Goes on from what a run left.
    pub fn resume(&mut self, resumed: Resumed) -> Result<(), StudyError> {
        let Resumed { tables: [rows, frames], mut checkpoint } = resumed;
        self.energy = checkpoint.load().ok_or(PropagateError::Checkpoint)?;
        self.table.load(&mut checkpoint).ok_or(PropagateError::Checkpoint)?;
        rows.for_each(|row| self.rows.push(row))?;
        frames.for_each(|row| self.frames.push(row))?;
        self.resumes = Some(checkpoint.rest());
        Ok(())
    }

    /// Puts the log on the disk at once, for a history that memory does not hold.
    pub fn log_if_long(&mut self) -> Result<(), StudyError> {
        match &mut self.log {
            Some(log) if !self.rows.is_whole() && !log.is_open() => log.start(),
            _ => Ok(()),
        }
    }

    /// What the history leaves.
    pub fn finish(self) -> Result<Followed, StudyError> {
        if let Some(failure) = self.failure {
            return Err(failure);
        }
        let rows = self.rows.rows();
        let log = match self.log {
            Some(log) if !self.rows.is_whole() => log.into_rows()?,
            _ => None,
        };
        Ok(Followed {
            columns: self.rows.into_columns(),
            rows,
            log,
            energy: self.energy,
            budget: self.budget,
            frames: self.frames,
        })
    }

    fn log_row(&mut self, is_frame: bool) -> Result<(), StudyError> {
        let Some(log) = &mut self.log else { return Ok(()) };
        log.row(&self.row)?;
        if is_frame { log.frame(&self.frames.row(self.frames.samples.len() - 1)) } else { Ok(()) }
    }

    /// Puts the log and a checkpoint on the disk.
    fn keep(&mut self, state: &Checkpoint) -> Result<(), StudyError> {
        let Some(log) = &mut self.log else { return Ok(()) };
        if !log.is_open() {
            log.start()?;
            // a history that is not logged from the start is held whole
            self.rows.each(|row| log.row(row))?;
            (0..self.frames.samples.len()).try_for_each(|frame| log.frame(&self.frames.row(frame)))?;
        }
        let mut checkpoint = Checkpoint::default();
        checkpoint.save(self.energy);
        self.table.save(&mut checkpoint);
        checkpoint.save_rest(state);
        log.checkpoint(&checkpoint)
    }
}

impl Observer for HistorySink<'_, '_> {
    fn sample(&mut self, sample: &Sample) {
        let is_frame = self.rows.rows().is_multiple_of(self.frames.stride.max(1)) && self.frames.stride > 0;
        if self.rows.rows() == 0 {
            self.energy = sample.energy;
        }
        self.table.fill(sample, &[], &mut self.row);
        self.rows.push(&self.row);
        if is_frame {
            self.frames.samples.push(*sample);
            self.frames.coordinates.push(self.coordinates.clone());
        }
        if let Err(failure) = self.log_row(is_frame) {
            self.failure.get_or_insert(failure);
        }
    }

    fn keeps_coordinates(&self) -> bool {
        self.frames.stride > 0 && self.rows.rows().is_multiple_of(self.frames.stride)
    }

    fn coordinates(&mut self, q: &[f64], rate: &[f64]) {
        if self.keeps_coordinates() {
            self.coordinates.clear();
            self.coordinates.extend(q.iter().chain(rate));
        }
    }

    fn budget(&mut self, energies: &[(String, f64)]) {
        self.budget = energies.to_vec();
    }

    fn resumes(&mut self) -> Option<Checkpoint> {
        self.resumes.take()
    }

    fn wants_checkpoint(&self) -> bool {
        self.log.as_ref().is_some_and(|log| log.is_due() || self.stopped && log.is_open())
    }

    fn checkpoint(&mut self, checkpoint: Checkpoint) {
        if let Err(failure) = self.keep(&checkpoint) {
            self.failure.get_or_insert(failure);
        }
    }

    fn progress(&mut self, t: f64) -> ControlFlow<()> {
        let flow = self.watch.at(self.stage, t / self.duration);
        self.stopped = flow.is_break();
        if self.failure.is_some() { ControlFlow::Break(()) } else { flow }
    }
}

fn packed(s: &Sample) -> [f64; FRAME] {
    let mut row = [0.0; FRAME];
    let parts: [&[f64]; 13] = [
        &[s.t],
        &s.omega,
        &s.attitude,
        &s.angular_momentum,
        &[s.energy],
        &[s.dissipated],
        &[s.work],
        &[s.energy_drift],
        &[s.momentum_drift],
        &[s.revolutions],
        &s.place,
        &s.velocity,
        &s.pole,
    ];
    row.iter_mut().zip(parts.into_iter().flatten()).for_each(|(entry, number)| *entry = *number);
    row
}

fn unpacked(row: &[f64]) -> Sample {
    let triple = |at: usize| [row[at], row[at + 1], row[at + 2]];
    Sample {
        t: row[0],
        omega: triple(1),
        attitude: [row[4], row[5], row[6], row[7]],
        angular_momentum: triple(8),
        energy: row[11],
        dissipated: row[12],
        work: row[13],
        energy_drift: row[14],
        momentum_drift: row[15],
        revolutions: row[16],
        place: triple(17),
        velocity: triple(20),
        pole: triple(23),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn samples_are_packed_and_unpacked() {
        let row: Vec<f64> = (0..FRAME).map(|place| 0.1 + place as f64).collect();
        assert_eq!(packed(&unpacked(&row))[..], row);
    }
}
