//! Observer of a table: its rows as they come, in memory or, of a long one, in a file.

use std::ops::ControlFlow;
use std::path::{Path, PathBuf};

use quasirigid::dynamics::{Observer, Sample};
use quasirigid_io::record::{Column, RowLog, RowTable};

use crate::error::StudyError;
use crate::history_columns::{HistoryTable, Internal};
use crate::watch::Watch;

/// Observer of a table.
pub(crate) struct TableSink<'a> {
    table: HistoryTable<'a>,
    internal: Internal<'a>,
    columns: Vec<Column>,
    log: Option<(PathBuf, RowLog)>,
    /// Energy (J) that each dissipator took, by name, once a propagation has ended.
    pub budget: Vec<(String, f64)>,
    failure: Option<StudyError>,
    watch: &'a mut dyn Watch,
    duration: f64,
    row: Vec<f64>,
    controls: Vec<f64>,
    coordinates: [Vec<f64>; 2],
}

impl<'a> TableSink<'a> {
    /// Of a table with output times, logged in a file if one is given.
    pub fn new(
        table: HistoryTable<'a>,
        internal: Internal<'a>,
        times: &[f64],
        log: Option<&Path>,
        watch: &'a mut dyn Watch,
    ) -> Result<Self, StudyError> {
        let columns: Vec<Column> = table.columns().into_iter().chain(internal.columns()).collect();
        let open = |path: &Path| match RowLog::create(path, columns.len()) {
            Ok(log) => Ok((path.to_owned(), log)),
            Err(cause) => Err(StudyError::Write { path: path.to_owned(), cause }),
        };
        Ok(Self {
            log: log.map(open).transpose()?,
            table,
            internal,
            columns,
            budget: Vec::new(),
            failure: None,
            watch,
            duration: times.last().copied().unwrap_or(0.0),
            row: Vec::new(),
            controls: Vec::new(),
            coordinates: [Vec::new(), Vec::new()],
        })
    }

    /// The columns, and the rows of a logged table, whose columns have no values.
    pub fn finish(self) -> Result<(Vec<Column>, Option<RowTable>), StudyError> {
        if let Some(failure) = self.failure {
            return Err(failure);
        }
        let close = |(path, log): (PathBuf, RowLog)| {
            log.into_table().map_err(|cause| StudyError::Write { path, cause })
        };
        Ok((self.columns, self.log.map(close).transpose()?))
    }
}

impl Observer for TableSink<'_> {
    fn sample(&mut self, sample: &Sample) {
        self.table.fill(sample, &self.controls, &mut self.row);
        let [q, rate] = &self.coordinates;
        self.internal.fill(q, rate, &mut self.row);
        match &mut self.log {
            None => self
                .columns
                .iter_mut()
                .zip(&self.row)
                .for_each(|(column, number)| column.values.push(*number)),
            Some((path, log)) => {
                if let Err(cause) = log.push(&self.row) {
                    self.failure.get_or_insert(StudyError::Write { path: path.clone(), cause });
                }
            }
        }
    }

    fn keeps_coordinates(&self) -> bool {
        !self.internal.is_empty()
    }

    fn coordinates(&mut self, q: &[f64], rate: &[f64]) {
        for (kept, new) in self.coordinates.iter_mut().zip([q, rate]) {
            kept.clear();
            kept.extend(new);
        }
    }

    fn keeps_controls(&self) -> bool {
        self.table.is_controlled()
    }

    fn controls(&mut self, values: &[f64]) {
        self.controls.clear();
        self.controls.extend(values);
    }

    fn budget(&mut self, energies: &[(String, f64)]) {
        self.budget = energies.to_vec();
    }

    fn progress(&mut self, t: f64) -> ControlFlow<()> {
        let flow = self.watch.at("propagating", t / self.duration);
        if self.failure.is_some() { ControlFlow::Break(()) } else { flow }
    }
}
