//! Many starts of one body in one call, on every core.
//! A row is computed from its own start alone, so that the threads and their number change no bit. A row that fails, even by a panic,
//! is a row with its reason; only a signal ends the whole. Rows in work when it comes are left to end by themselves, so that nobody
//! waits for them.

use std::ops::ControlFlow;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::mpsc::{self, RecvTimeoutError};
use std::time::Duration;

use numpy::{PyArray1, PyArray3, PyArrayMethods, PyReadonlyArray2};
use pyo3::prelude::*;
use quasirigid::dynamics::Start;
use quasirigid_io::record::Column;
use quasirigid_study::histories::{Table, room};
use quasirigid_study::settings::{PartialEvolve, PartialRun};
use quasirigid_study::{Study, StudyError, Watch};
use rayon::prelude::*;

use crate::columns::Columns;
use crate::failure::Failure;
use crate::pool::pool;
use crate::reduced::rows;
use crate::series::Series;
use crate::watching::Shared;

/// Watch of one row: it ends with the whole, and keeps its remarks to itself.
pub struct RowWatch<'a> {
    pub shared: &'a Shared,
    pub remarks: Vec<String>,
}

impl Watch for RowWatch<'_> {
    fn at(&mut self, _: &str, _: f64) -> ControlFlow<()> {
        if self.shared.stopped() { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
    }

    fn remark(&mut self, sentence: &str) {
        self.remarks.push(sentence.to_owned());
    }
}

/// Angular velocities of an array `(n, 3)`.
pub fn starts(initial: &PyReadonlyArray2<'_, f64>) -> Result<Vec<[f64; 3]>, Failure> {
    rows(initial)
}

/// Computes every row, in the order of the starts.
fn each<T: Send + 'static>(
    study: &Arc<Study>,
    starts: &[[f64; 3]],
    shared: &Arc<Shared>,
    row: impl Fn(&Study, Start, &mut RowWatch) -> Result<T, Failure> + Send + Sync + 'static,
) -> Result<Vec<Result<T, Failure>>, Failure> {
    let (study, own, starts) = (Arc::clone(study), Arc::clone(shared), starts.to_vec());
    on_pool(shared, move || {
        let (done, count) = (AtomicUsize::new(0), starts.len());
        let rows = starts.par_iter().map(|omega| {
            let found = one(&study, *omega, &own, &row);
            let done = done.fetch_add(1, Ordering::Relaxed) + 1;
            own.tell("rows", done as f64 / count as f64);
            found
        });
        rows.collect()
    })
}

/// Does work on the threads of the pool, and leaves it there when a signal comes.
pub fn on_pool<T: Send + 'static>(
    shared: &Shared,
    work: impl FnOnce() -> T + Send + 'static,
) -> Result<T, Failure> {
    let (answer, answers) = mpsc::channel();
    pool()?.spawn(move || {
        // Nobody listens once a signal has come.
        let _ = answer.send(work());
    });
    loop {
        match answers.recv_timeout(INTERRUPT_INTERVAL) {
            Ok(found) => return Ok(found),
            Err(RecvTimeoutError::Timeout) if !shared.stopped() => {}
            Err(RecvTimeoutError::Timeout) => return Err(StudyError::Interrupted.into()),
            Err(RecvTimeoutError::Disconnected) => return Err(Failure::Panic("a row was lost".into())),
        }
    }
}

/// Time between two looks whether the rows are to end.
const INTERRUPT_INTERVAL: Duration = Duration::from_millis(50);

/// Computes one row.
fn one<T>(
    study: &Study,
    omega: [f64; 3],
    shared: &Shared,
    row: &impl Fn(&Study, Start, &mut RowWatch) -> Result<T, Failure>,
) -> Result<T, Failure> {
    if shared.stopped() {
        return Err(StudyError::Interrupted.into());
    }
    if !omega.iter().all(|rate| rate.is_finite()) {
        return Err(Failure::Input(format!("the angular velocity {omega:?} is not finite")));
    }
    let mut watch = RowWatch { shared, remarks: Vec::new() };
    let start = Start::new(omega, study.model.initial.attitude);
    catch_unwind(AssertUnwindSafe(|| row(study, start, &mut watch)))
        .unwrap_or_else(|cause| Err(Failure::panicked(&*cause)))
}

/// Columns of numbers of the secular evolutions, with their units.
const NUMBERS: [(&str, &str); 11] = [
    ("wx", "rad/s"),
    ("wy", "rad/s"),
    ("wz", "rad/s"),
    ("time", "s"),
    ("turns", "1"),
    ("power", "W"),
    ("ratio_start", "1"),
    ("ratio_end", "1"),
    ("separatrix_time", "s"),
    ("damping_time", "s"),
    ("growth_time", "s"),
];
/// Columns of texts.
const TEXTS: [&str; 5] = ["status", "mode_start", "mode_end", "method", "message"];

/// A secular evolution as a row.
struct EvolutionRow {
    numbers: [f64; NUMBERS.len()],
    texts: [String; TEXTS.len()],
}

/// The secular evolution from each start: one row each. A number that no method gives is NaN.
pub fn evolve(
    study: &Arc<Study>,
    starts: &[[f64; 3]],
    asked: PartialEvolve,
    shared: &Arc<Shared>,
) -> Result<Columns, Failure> {
    // an ensemble has no tables, whose rows are most of the work
    let asked = PartialEvolve { samples: Some(2), ..asked };
    let found = each(study, starts, shared, move |study, start, watch| {
        let evolved = study.evolve_from(start, asked.clone(), watch)?;
        let answers = evolved.has_numbers();
        let record = evolved.record;
        let number = |value: f64| if answers { value } else { f64::NAN };
        let [wx, wy, wz] = start.omega;
        Ok(EvolutionRow {
            numbers: [
                wx,
                wy,
                wz,
                number(record.time),
                number(record.revolutions),
                number(record.power),
                number(record.ratio_start),
                number(record.ratio_end),
                number(record.separatrix_time.unwrap_or(f64::NAN)),
                record.damping_time,
                record.growth_time,
            ],
            texts: [record.status, record.mode_start, record.mode_end, record.road, record.message],
        })
    })?;
    let rows: Vec<EvolutionRow> = found
        .into_iter()
        .zip(starts)
        .map(|(row, omega)| {
            row.unwrap_or_else(|failure| {
                let mut numbers = [f64::NAN; NUMBERS.len()];
                numbers[..3].copy_from_slice(omega);
                let mut texts: [String; TEXTS.len()] = Default::default();
                texts[0] = "error".into();
                texts[TEXTS.len() - 1] = failure.text();
                EvolutionRow { numbers, texts }
            })
        })
        .collect();
    let numbers = NUMBERS.iter().enumerate().map(|(i, (name, unit))| {
        Series::numbers(name, unit, rows.iter().map(|row| row.numbers[i]).collect())
    });
    let texts = TEXTS
        .iter()
        .enumerate()
        .map(|(i, name)| Series::texts(name, rows.iter().map(|row| row.texts[i].clone()).collect()));
    Ok(Columns::new(numbers.chain(texts).collect()))
}

/// Histories from many starts, or paths of the angular velocity alone, whose columns have no names.
pub struct Histories {
    names: Vec<String>,
    units: Vec<String>,
    /// Values: for each start, for each column, one for each sample; NaN behind the end of a history.
    pub values: Vec<f64>,
    shape: [usize; 3],
    holds: Vec<bool>,
    status: Vec<String>,
    message: Vec<String>,
    notes: Vec<Vec<String>>,
}

/// One history as a row.
struct HistoryRow {
    columns: Vec<Column>,
    holds: bool,
    status: &'static str,
    message: String,
    notes: Vec<String>,
}

/// A history from each start.
pub fn simulate(
    study: &Arc<Study>,
    starts: &[[f64; 3]],
    asked: &PartialRun,
    table: Table,
    shared: &Arc<Shared>,
) -> Result<Histories, Failure> {
    let samples = study.table_rows(asked, &table);
    let asked = PartialRun { samples: Some(samples), ..asked.clone() };
    // Rows and the array made of them stand in memory together.
    let kept = if table.coordinates || table.displacements { study.body.coordinates().len() } else { 0 };
    room(samples, 2 * starts.len(), kept)?;
    let found = each(study, starts, shared, move |study, start, watch| {
        let history = study.simulate_from(start, &asked, &table, watch)?;
        Ok(HistoryRow {
            holds: history.holds(),
            message: history.reason().unwrap_or(&history.message).to_owned(),
            notes: [watch.remarks.clone(), history.notes].concat(),
            columns: history.columns,
            status: history.status,
        })
    })?;
    Ok(Histories::of(found, samples))
}

impl Histories {
    fn of(found: Vec<Result<HistoryRow, Failure>>, samples: usize) -> Self {
        let first = found.iter().find_map(|row| row.as_ref().ok());
        let columns = first.map_or(&[][..], |row| &row.columns);
        let names: Vec<String> = columns.iter().map(|column| column.name.clone()).collect();
        let units = columns.iter().map(|column| column.unit.clone()).collect();
        let width = names.len() * samples;
        let mut histories = Self::new(names, units, [found.len(), columns.len(), samples]);
        for (i, row) in found.into_iter().enumerate() {
            match row {
                Ok(row) => {
                    let place = &mut histories.values[i * width..(i + 1) * width];
                    for (place, column) in place.chunks_mut(samples.max(1)).zip(&row.columns) {
                        let rows = column.values.len().min(samples);
                        place[..rows].copy_from_slice(&column.values[..rows]);
                    }
                    histories.tell(row.holds, row.status, row.message, row.notes);
                }
                Err(failure) => histories.tell(false, "error", failure.text(), Vec::new()),
            }
        }
        histories
    }

    /// Rows of which nothing is told yet.
    pub fn new(names: Vec<String>, units: Vec<String>, shape: [usize; 3]) -> Self {
        let values = vec![f64::NAN; shape.iter().product()];
        let (holds, status, message, notes) = Default::default();
        Self { names, units, values, shape, holds, status, message, notes }
    }

    /// Tells the next row.
    pub fn tell(&mut self, holds: bool, status: &str, message: String, notes: Vec<String>) {
        self.holds.push(holds);
        self.status.push(status.to_owned());
        self.message.push(message);
        self.notes.push(notes);
    }
}

/// Parts of [`Histories`] in Python.
#[derive(IntoPyObject)]
pub struct Parts<'py> {
    names: Vec<String>,
    units: Vec<String>,
    values: Bound<'py, PyArray3<f64>>,
    holds: Bound<'py, PyArray1<bool>>,
    status: Vec<String>,
    message: Vec<String>,
    notes: Vec<Vec<String>>,
}

impl<'py> IntoPyObject<'py> for Histories {
    type Target = PyAny;
    type Output = Bound<'py, PyAny>;
    type Error = PyErr;

    fn into_pyobject(self, py: Python<'py>) -> PyResult<Self::Output> {
        let Self { names, units, values, shape, holds, status, message, notes } = self;
        let values = PyArray1::from_vec(py, values).reshape(shape)?;
        let holds = PyArray1::from_vec(py, holds);
        let parts = Parts { names, units, values, holds, status, message, notes };
        Ok(parts.into_pyobject(py)?.into_any())
    }
}
