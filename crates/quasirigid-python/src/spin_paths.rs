//! Angular velocities from many starts in one call: blocks of starts on every core, eight trajectories at a time on each.

use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};

use numpy::{PyArray1, PyArray3, PyArrayMethods};
use pyo3::prelude::*;
use quasirigid::dynamics::Rounding;
use quasirigid_study::histories::room;
use quasirigid_study::settings::PartialRun;
use quasirigid_study::spins::Spins;
use quasirigid_study::{Study, StudyError};
use rayon::prelude::*;

use crate::ensemble::{RowWatch, on_pool};
use crate::failure::Failure;
use crate::watching::Shared;

/// Angular velocities from many starts.
pub struct SpinPaths {
    /// Angular velocities: for each start, for each time, three components; NaN behind the end.
    values: Vec<f64>,
    shape: [usize; 3],
    holds: Vec<bool>,
    status: Vec<String>,
    message: Vec<String>,
    notes: Vec<Vec<String>>,
}

/// Starts that one thread takes at a time: a few for each lane.
const BLOCK: usize = 64;

/// Angular velocities from each start at the output times (s).
pub fn spins(
    study: &Arc<Study>,
    starts: &[[f64; 3]],
    times: &[f64],
    asked: &PartialRun,
    rounding: Rounding,
    shared: &Arc<Shared>,
) -> Result<SpinPaths, Failure> {
    // Rows and the array made of them stand in memory together.
    room(times.len(), 2 * starts.len(), 0)?;
    let (settings, samples) = (asked.clone(), times.len());
    let (study, own, times, starts) =
        (Arc::clone(study), Arc::clone(shared), times.to_vec(), starts.to_vec());
    let found = on_pool(shared, move || {
        let asked = study.spins(&times, &settings, rounding)?;
        let (done, count) = (AtomicUsize::new(0), starts.len());
        let blocks = starts.par_chunks(BLOCK).map(|block| {
            let mut watch = RowWatch { shared: &own, remarks: Vec::new() };
            let found = catch_unwind(AssertUnwindSafe(|| asked.from(block, &mut watch)));
            let done = done.fetch_add(block.len(), Ordering::Relaxed) + block.len();
            own.tell("rows", done as f64 / count as f64);
            match found {
                Ok(found) => found.map_err(Failure::from),
                Err(cause) => Err(Failure::panicked(&*cause)),
            }
        });
        blocks.collect::<Result<Vec<_>, Failure>>()
    })??;
    Ok(SpinPaths::of(found.into_iter().flatten().collect(), samples))
}

impl SpinPaths {
    fn of(found: Vec<Result<Spins, StudyError>>, samples: usize) -> Self {
        let shape = [found.len(), samples, 3];
        let mut paths = Self {
            values: vec![f64::NAN; shape.iter().product()],
            shape,
            holds: Vec::with_capacity(shape[0]),
            status: Vec::with_capacity(shape[0]),
            message: Vec::with_capacity(shape[0]),
            notes: Vec::with_capacity(shape[0]),
        };
        let width = 3 * samples;
        for (i, row) in found.into_iter().enumerate() {
            let (holds, status, message, notes) = match row {
                Ok(spins) => {
                    let place = &mut paths.values[i * width..(i + 1) * width];
                    for (place, omega) in place.chunks_mut(3).zip(&spins.omega) {
                        place.copy_from_slice(omega);
                    }
                    let message = spins.reason().unwrap_or(&spins.message).to_owned();
                    (spins.holds(), spins.status, message, spins.notes)
                }
                Err(error) => (false, "error", Failure::from(error).text(), Vec::new()),
            };
            paths.holds.push(holds);
            paths.status.push(status.to_owned());
            paths.message.push(message);
            paths.notes.push(notes);
        }
        paths
    }
}

/// Parts of [`SpinPaths`] in Python.
#[derive(IntoPyObject)]
pub struct SpinParts<'py> {
    values: Bound<'py, PyArray3<f64>>,
    holds: Bound<'py, PyArray1<bool>>,
    status: Vec<String>,
    message: Vec<String>,
    notes: Vec<Vec<String>>,
}

impl<'py> IntoPyObject<'py> for SpinPaths {
    type Target = PyAny;
    type Output = Bound<'py, PyAny>;
    type Error = PyErr;

    fn into_pyobject(self, py: Python<'py>) -> PyResult<Self::Output> {
        let Self { values, shape, holds, status, message, notes } = self;
        let values = PyArray1::from_vec(py, values).reshape(shape)?;
        let holds = PyArray1::from_vec(py, holds);
        Ok(SpinParts { values, holds, status, message, notes }.into_pyobject(py)?.into_any())
    }
}
