//! Studies of many bodies: in this process, or row by row for the workers of a cluster.

use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex, PoisonError};

use pyo3::prelude::*;
use pyo3::types::PyBytes;
use quasirigid_study::sweep::{self as study, Finished, RunOptions, SweepError};

use crate::arguments::deprecated;
use crate::columns::Columns;
use crate::failure::Failure;
use crate::values::Json;
use crate::watching::interruptible;

type Observer = Option<Py<PyAny>>;

/// Parts of the study that are there, of how many; how many others work on, and whether the work was told to end.
type Ended = (u64, u64, u64, bool);

/// Study of many bodies, read and checked.
#[pyclass(frozen, module = "quasirigid._core")]
#[derive(Debug)]
pub struct Sweep(Arc<study::Sweep>);

#[pymethods]
impl Sweep {
    /// Reads a study: the file, or a text for which `file` stands; and its model, where that stands in no file.
    #[staticmethod]
    fn open(
        py: Python<'_>,
        file: PathBuf,
        text: Option<String>,
        model: Option<String>,
        observer: Observer,
    ) -> PyResult<Self> {
        let sweep = interruptible(py, observer.as_ref(), |shared| {
            let mut watch = &**shared;
            let sweep = match &text {
                Some(text) => study::Sweep::parse(&file, text, model.as_deref(), &mut watch),
                None => study::Sweep::open(&file, &mut watch),
            };
            Ok(sweep?)
        });
        let sweep = sweep?;
        sweep.study.former_names.iter().try_for_each(|note| deprecated(note))?;
        Ok(Self(Arc::new(sweep)))
    }

    #[getter]
    fn rows(&self) -> u64 {
        self.0.rows()
    }

    #[getter]
    fn sha256(&self) -> &str {
        &self.0.sha256
    }

    /// Time that a row took (s).
    #[getter]
    fn row_time(&self) -> f64 {
        self.0.row_time
    }

    /// Text of the model of a row, by its number from 1.
    fn model_text(&self, row: u64) -> PyResult<String> {
        let index = self.0.index(row).map_err(Failure::from)?;
        Ok(self.0.model_text(index).map_err(Failure::Input)?)
    }

    /// Answers the rows into a folder.
    fn run(
        &self,
        py: Python<'_>,
        folder: PathBuf,
        resume: bool,
        threads: Option<usize>,
        observer: Observer,
    ) -> PyResult<Ended> {
        let options = RunOptions { resume, shard: None, threads };
        let finished = interruptible(py, observer.as_ref(), |shared| {
            Ok(self.0.run(&folder, &options, &mut &**shared)?)
        });
        Ok(ended(&finished?))
    }

    /// Answers some rows, for [`Collector::keep`].
    fn answer<'py>(&self, py: Python<'py>, rows: Vec<u64>) -> PyResult<Bound<'py, PyBytes>> {
        let lines = py.detach(|| self.0.answer_lines(&rows)).map_err(Failure::from)?;
        Ok(PyBytes::new(py, &lines))
    }

    /// The collector of rows that others answer.
    fn collect(&self, folder: PathBuf, resume: bool) -> PyResult<Collector> {
        let collector = study::Collector::open(Arc::clone(&self.0), &folder, resume);
        Ok(Collector(Mutex::new(Some(collector.map_err(Failure::from)?))))
    }
}

/// Collector of rows that others answer.
#[pyclass(frozen, module = "quasirigid._core")]
#[derive(Debug)]
pub struct Collector(Mutex<Option<study::Collector>>);

impl Collector {
    fn with<T>(&self, work: impl FnOnce(&mut study::Collector) -> Result<T, SweepError>) -> PyResult<T> {
        let mut kept = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        let Some(collector) = kept.as_mut() else {
            return Err(Failure::Input("the collection has ended".into()).into());
        };
        Ok(work(collector).map_err(Failure::from)?)
    }
}

#[pymethods]
impl Collector {
    /// Rows that nobody has yet.
    fn next(&self, py: Python<'_>, most: usize) -> PyResult<Option<Vec<u64>>> {
        py.detach(|| self.with(|collector| collector.next(most)))
    }

    /// Number of rows with an answer.
    #[getter]
    fn done(&self) -> PyResult<u64> {
        self.with(|collector| Ok(collector.done()))
    }

    /// Keeps answers.
    fn keep(&self, py: Python<'_>, lines: &[u8]) -> PyResult<()> {
        py.detach(|| self.with(|collector| collector.keep(lines)))
    }

    /// Ends the collection.
    fn finish(&self, py: Python<'_>) -> PyResult<Ended> {
        let collector = self.0.lock().unwrap_or_else(PoisonError::into_inner).take();
        let Some(collector) = collector else { return Ok((0, 0, 0, true)) };
        Ok(ended(&py.detach(|| collector.finish()).map_err(Failure::from)?))
    }
}

fn ended(finished: &Finished) -> Ended {
    let Finished { parts_there, parts, elsewhere, interrupted, .. } = finished;
    (*parts_there, *parts, *elsewhere, *interrupted)
}

/// The rows and the summary of a folder of results, and the text of its summary.
#[pyfunction]
pub fn read_sweep(py: Python<'_>, folder: PathBuf) -> PyResult<(Columns, Json, String)> {
    let found = py.detach(|| study::read(Path::new(&folder))).map_err(Failure::from)?;
    let text = study::text(&found.summary);
    let summary = serde_json::to_value(&found.summary).map_err(|error| Failure::File(error.to_string()))?;
    Ok((Columns::of_cells(found.columns), Json(summary), text))
}
