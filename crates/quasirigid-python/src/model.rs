//! A model with its studies, and every question of a user.
//! The body of a model is assembled at the first question, once for each order, since that may take long; a model that was read is
//! never changed. Each method reads its arguments, calls the study and hands the answer on.

use std::collections::BTreeMap;
use std::path::PathBuf;
use std::sync::{Arc, Mutex, PoisonError};

use numpy::PyReadonlyArray2;
use pyo3::prelude::*;
use quasirigid::dynamics::Rounding;
use quasirigid_io::model::{
    self as file, EvolveMethod, ManifoldMasters, ManifoldStyle, MastersError, Power, System,
};
use quasirigid_io::record::TableFormat;
use quasirigid_study::fill_map::FillMapSettings;
use quasirigid_study::histories::Table;
use quasirigid_study::linear::{LinearAt, LinearSettings};
use quasirigid_study::modes::{PrincipalAxis, SteadySpinSettings};
use quasirigid_study::settings::{PartialEvolve, PartialRun, PartialSpinManifold, PartialVerify};
use quasirigid_study::{Study, StudyError};

use crate::answers::{self, Answer, RunAnswer, RunPlace};
use crate::arguments::{Quantity, deprecated, named};
use crate::columns::Columns;
use crate::ensemble::{self, Histories};
use crate::failure::Failure;
use crate::infer::{self, DesignArgs, InferArgs};
use crate::light_curve::LightCurveArgs;
use crate::reduced::Reduced;
use crate::spin_paths;
use crate::stepper::Stepper;
use crate::watching::{Shared, interruptible};

/// A model file that was read.
#[pyclass(frozen, module = "quasirigid._core")]
#[derive(Debug)]
pub struct Model {
    parsed: file::Model,
    /// Studies by the order asked for.
    studies: Mutex<BTreeMap<Option<usize>, Arc<Study>>>,
}

type Observer = Option<Py<PyAny>>;

impl Model {
    fn of(read: Result<file::Model, file::ModelError>) -> Result<Self, Failure> {
        let parsed = read.map_err(StudyError::from)?;
        let errors = parsed.assembly.check();
        if !errors.is_empty() {
            return Err(StudyError::from(parsed.diagnose_all(&errors)).into());
        }
        Ok(Self { parsed, studies: Mutex::default() })
    }

    /// The model, with a warning for each former name in its file.
    fn warned(self) -> PyResult<Self> {
        self.parsed.former_names.iter().try_for_each(|note| deprecated(note))?;
        Ok(self)
    }

    /// The study at an order, or at the model's own.
    pub fn study(&self, order: Option<usize>) -> Result<Arc<Study>, Failure> {
        let kept = || self.studies.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some(study) = kept().get(&order) {
            return Ok(Arc::clone(study));
        }
        let study = Arc::new(Study::new(self.parsed.clone(), order)?);
        Ok(Arc::clone(kept().entry(order).or_insert(study)))
    }

    /// Asks the study at an order, without the interpreter lock.
    fn ask<T: Send>(
        &self,
        py: Python<'_>,
        (order, observer): (Option<usize>, Observer),
        question: impl FnOnce(&Arc<Study>, &Arc<Shared>) -> Result<T, Failure> + Send,
    ) -> PyResult<T> {
        Ok(interruptible(py, observer.as_ref(), |shared| question(&self.study(order)?, shared))?)
    }
}

#[pymethods]
impl Model {
    /// Reads the text of a model file; `file` stands in messages, and paths in the text are relative to its folder.
    #[new]
    fn new(py: Python<'_>, text: String, file: PathBuf) -> PyResult<Self> {
        interruptible(py, None, |_| Self::of(file::Model::parse(&file, &text)))?.warned()
    }

    /// Reads a model file.
    #[staticmethod]
    fn read(py: Python<'_>, file: PathBuf) -> PyResult<Self> {
        interruptible(py, None, |_| Self::of(file::Model::read(&file)))?.warned()
    }

    #[getter]
    fn text(&self) -> &str {
        &self.parsed.source.text
    }

    #[getter]
    fn file(&self) -> PathBuf {
        self.parsed.source.file.clone()
    }

    #[getter]
    fn name(&self) -> &str {
        &self.parsed.name
    }

    #[getter]
    fn sha256(&self) -> &str {
        &self.parsed.source.sha256
    }

    #[getter]
    fn order(&self) -> usize {
        self.parsed.run.order
    }

    /// Validity of the reduced equations.
    fn check(&self, py: Python<'_>, order: Option<usize>, observer: Observer) -> PyResult<Answer> {
        self.ask(py, (order, observer), |study, _| answers::check(study))
    }

    /// Modes about steady spins.
    fn modes(
        &self,
        py: Python<'_>,
        spin: Option<[f64; 3]>,
        axis: Option<&str>,
        certificate: Option<PathBuf>,
        order: Option<usize>,
        observer: Observer,
    ) -> PyResult<Answer> {
        let axis = named::<PrincipalAxis>(axis, "axis")?;
        let asked = SteadySpinSettings { omega: spin, axis, all: false };
        self.ask(py, (order, observer), |study, _| answers::modes(study, asked, certificate.as_deref()))
    }

    /// Effective modal masses of the parts on a held carrier.
    fn effective_masses(
        &self,
        py: Python<'_>,
        about: Option<[f64; 3]>,
        observer: Observer,
    ) -> PyResult<Answer> {
        self.ask(py, (None, observer), |study, _| answers::effective_masses(study, about))
    }

    /// Time constants over fill and spin.
    fn fills(
        &self,
        py: Python<'_>,
        tanks: Vec<String>,
        range: ([f64; 2], Option<[f64; 2]>, [usize; 2]),
        order: Option<usize>,
        observer: Observer,
    ) -> PyResult<Answer> {
        let (fills, spins, counts) = range;
        let asked = FillMapSettings { tanks, fills, spins, counts };
        self.ask(py, (order, observer), |study, shared| answers::fills(study, &asked, shared))
    }

    /// The light curve of the rotating body.
    fn light_curve(
        &self,
        py: Python<'_>,
        settings: RunArgs,
        asked: LightCurveArgs,
        order: Option<usize>,
        observer: Observer,
    ) -> PyResult<Answer> {
        let (run, asked) = (settings.partial()?, asked.settings()?);
        self.ask(py, (order, observer), |study, shared| answers::light_curve(study, &run, &asked, shared))
    }

    /// Derivatives of an answer with respect to keys.
    fn sensitivity(
        &self,
        py: Python<'_>,
        of: &str,
        keys: Vec<String>,
        order: Option<usize>,
        observer: Observer,
    ) -> PyResult<Answer> {
        let keys = answers::keys(&keys)?;
        self.ask(py, (order, observer), |study, shared| answers::sensitivity(study, of, &keys, shared))
    }

    /// Numbers of the model inferred from measurements.
    fn infer(
        &self,
        py: Python<'_>,
        history: (Option<PathBuf>, Option<f64>),
        asked: InferArgs,
        order: Option<usize>,
        observer: Observer,
    ) -> PyResult<Answer> {
        let asked = asked.settings()?;
        self.ask(py, (order, observer), |study, shared| infer::infer(study, &history, &asked, shared))
    }

    /// What planned measurements would tell.
    fn design(
        &self,
        py: Python<'_>,
        asked: DesignArgs,
        order: Option<usize>,
        observer: Observer,
    ) -> PyResult<Answer> {
        let asked = asked.settings()?;
        self.ask(py, (order, observer), |study, shared| infer::design(study, &asked, shared))
    }

    /// Linear model about a steady state.
    fn linear(
        &self,
        py: Python<'_>,
        at: Option<&str>,
        spin: Option<[f64; 3]>,
        channels: (Vec<String>, Vec<String>),
        band: Option<[f64; 2]>,
        observer: Observer,
    ) -> PyResult<Answer> {
        let (inputs, outputs) = channels;
        let at = spin.map(LinearAt::Rate).or_else(|| at.and_then(LinearAt::named));
        let asked = LinearSettings { at, inputs, outputs, band, truncation: None };
        self.ask(py, (None, observer), |study, _| answers::linear(study, &asked))
    }

    /// The reduced equations as source of another language.
    fn export(
        &self,
        py: Python<'_>,
        to: &str,
        path: PathBuf,
        order: Option<usize>,
        overwrite: bool,
        observer: Observer,
    ) -> PyResult<Answer> {
        self.ask(py, (order, observer), |study, _| answers::export(study, to, &path, overwrite))
    }

    /// Reduced equations about the spin.
    fn about_spin(
        &self,
        py: Python<'_>,
        asked: SpinManifoldArgs,
        axis: Option<&str>,
        observer: Observer,
    ) -> PyResult<Answer> {
        let axis = named::<PrincipalAxis>(axis, "axis")?;
        let asked = asked.partial()?;
        self.ask(py, (None, observer), |study, _| answers::about_spin(study, asked, axis))
    }

    /// The reduced equations.
    fn reduce(&self, py: Python<'_>, order: Option<usize>, observer: Observer) -> PyResult<Reduced> {
        self.ask(py, (order, observer), |study, _| Reduced::of(Arc::clone(study)))
    }

    /// The body for steps under held torques.
    fn stepper(
        &self,
        py: Python<'_>,
        full: bool,
        tolerance: f64,
        order: Option<usize>,
        observer: Observer,
    ) -> PyResult<Stepper> {
        self.ask(py, (order, observer), |study, _| {
            if full { Stepper::full(study, tolerance) } else { Stepper::reduced(study, tolerance) }
        })
    }

    /// A history of the spin.
    fn simulate(
        &self,
        py: Python<'_>,
        settings: RunArgs,
        table: TableArgs,
        certificate: Option<PathBuf>,
        order: Option<usize>,
        observer: Observer,
    ) -> PyResult<Answer> {
        let (asked, table) = (settings.partial()?, table.table()?);
        self.ask(py, (order, observer), |study, shared| {
            answers::simulate(study, &asked, &table, certificate.as_deref(), shared)
        })
    }

    /// Histories from many angular velocities.
    fn simulate_all(
        &self,
        py: Python<'_>,
        initial: PyReadonlyArray2<'_, f64>,
        settings: RunArgs,
        table: TableArgs,
        order: Option<usize>,
        observer: Observer,
    ) -> PyResult<Histories> {
        let starts = ensemble::starts(&initial)?;
        let (asked, table) = (settings.partial()?, table.table()?);
        self.ask(py, (order, observer), |study, shared| {
            ensemble::simulate(study, &starts, &asked, table, shared)
        })
    }

    /// Angular velocities from many angular velocities.
    fn spins(
        &self,
        py: Python<'_>,
        initial: PyReadonlyArray2<'_, f64>,
        asked: SpinsArgs,
        order: Option<usize>,
        observer: Observer,
    ) -> PyResult<Histories> {
        let starts = ensemble::starts(&initial)?;
        let form = named(asked.form.as_deref(), "form")?;
        let settings = PartialRun { tolerance: asked.tolerance, form, ..PartialRun::default() };
        let rounding = if asked.reproducible { Rounding::Reproducible } else { Rounding::Fastest };
        self.ask(py, (order, observer), |study, shared| {
            spin_paths::spins(study, &starts, &asked.times, &settings, rounding, shared)
        })
    }

    /// The secular evolution.
    fn evolve(
        &self,
        py: Python<'_>,
        asked: EvolveArgs,
        order: Option<usize>,
        observer: Observer,
    ) -> PyResult<Answer> {
        let (draws, asked) = (asked.uncertainty_samples, asked.partial()?);
        self.ask(py, (order, observer), |study, shared| answers::evolve(study, asked, draws, shared))
    }

    /// The secular evolution from many angular velocities.
    fn evolve_all(
        &self,
        py: Python<'_>,
        initial: PyReadonlyArray2<'_, f64>,
        asked: EvolveArgs,
        order: Option<usize>,
        observer: Observer,
    ) -> PyResult<Columns> {
        let (starts, asked) = (ensemble::starts(&initial)?, asked.partial()?);
        self.ask(py, (order, observer), |study, shared| ensemble::evolve(study, &starts, asked, shared))
    }

    /// The reduced equations against the full system.
    fn verify(
        &self,
        py: Python<'_>,
        orders: Option<Vec<usize>>,
        revolutions: Option<f64>,
        halvings: Option<usize>,
        order: Option<usize>,
        observer: Observer,
    ) -> PyResult<Answer> {
        let asked = PartialVerify { revolutions, orders, halvings };
        self.ask(py, (order, observer), |study, shared| answers::verify(study, asked, shared))
    }

    /// The main job, and its record.
    fn run(
        &self,
        py: Python<'_>,
        place: Option<Place>,
        settings: RunArgs,
        order: Option<usize>,
        observer: Observer,
    ) -> PyResult<RunAnswer> {
        let asked = settings.partial()?;
        let place = place.map(Place::read).transpose()?;
        self.ask(py, (order, observer), |study, shared| answers::run(study, &asked, place.as_ref(), shared))
    }

    /// BibTeX entries of what the model uses.
    fn cite(&self) -> String {
        quasirigid_study::cite::bibtex(&self.parsed)
    }
}

/// Place of the record of a run, as a dictionary.
#[derive(FromPyObject)]
#[pyo3(from_item_all)]
pub struct Place {
    folder: PathBuf,
    tables: Option<Vec<String>>,
    resume: bool,
}

impl Place {
    fn read(self) -> Result<RunPlace, Failure> {
        let Self { folder, tables, resume } = self;
        let format = |name: &String| named::<TableFormat>(Some(name), "tables");
        let formats = |names: Vec<String>| names.iter().map(format).collect::<Result<Option<Vec<_>>, _>>();
        Ok(RunPlace { folder, tables: tables.map(formats).transpose()?.flatten(), resume })
    }
}

/// Settings of histories, as a dictionary; what is absent is the model's own.
#[derive(FromPyObject)]
#[pyo3(from_item_all)]
pub struct RunArgs {
    duration: Option<Quantity>,
    samples: Option<usize>,
    tolerance: Option<f64>,
    form: Option<String>,
    integrator: Option<String>,
}

impl RunArgs {
    fn partial(&self) -> Result<PartialRun, Failure> {
        Ok(PartialRun {
            duration: self.duration.as_ref().map(|time| time.seconds("duration")).transpose()?,
            tolerance: self.tolerance,
            samples: self.samples,
            form: named(self.form.as_deref(), "form")?,
            integrator: named(self.integrator.as_deref(), "integrator")?,
        })
    }
}

/// Settings of spins, as a dictionary.
#[derive(FromPyObject)]
#[pyo3(from_item_all)]
pub struct SpinsArgs {
    times: Vec<f64>,
    tolerance: Option<f64>,
    form: Option<String>,
    reproducible: bool,
}

/// Contents of a table, as a dictionary.
#[derive(FromPyObject)]
#[pyo3(from_item_all)]
pub struct TableArgs {
    system: Option<String>,
    coordinates: bool,
    displacements: bool,
    times: Option<Vec<f64>>,
    spin_manifold: SpinManifoldArgs,
}

/// Settings of the reduced equations about the spin, as a dictionary; what is absent is the model's own.
#[derive(FromPyObject)]
#[pyo3(from_item_all)]
pub struct SpinManifoldArgs {
    degree: Option<usize>,
    masters: Option<MasterModes>,
    style: Option<String>,
}

/// A word, or frequencies (rad/s).
#[derive(FromPyObject)]
enum MasterModes {
    Word(String),
    Frequencies(Vec<f64>),
}

impl SpinManifoldArgs {
    fn partial(&self) -> Result<PartialSpinManifold, Failure> {
        let refuse = |error: MastersError| Failure::Input(format!("masters: {error}"));
        let masters = match &self.masters {
            None => None,
            Some(MasterModes::Word(word)) => Some(word.parse().map_err(refuse)?),
            Some(MasterModes::Frequencies(list)) => Some(ManifoldMasters::of(list.clone()).map_err(refuse)?),
        };
        let style = named::<ManifoldStyle>(self.style.as_deref(), "style")?;
        Ok(PartialSpinManifold { degree: self.degree, masters, style })
    }
}

impl TableArgs {
    fn table(self) -> Result<Table, Failure> {
        let system = named::<System>(self.system.as_deref(), "system")?;
        let manifold = self.spin_manifold.partial()?;
        let Self { coordinates, displacements, times, .. } = self;
        Ok(Table { system, coordinates, displacements, times, manifold })
    }
}

/// Settings of an evolution, as a dictionary; what is absent is the model's own.
#[derive(FromPyObject)]
#[pyo3(from_item_all)]
pub struct EvolveArgs {
    start: Option<Quantity>,
    until: Option<Quantity>,
    duration: Option<Quantity>,
    samples: Option<usize>,
    power: Option<String>,
    method: Option<String>,
    uncertainty_samples: Option<usize>,
}

impl EvolveArgs {
    fn partial(&self) -> Result<PartialEvolve, Failure> {
        Ok(PartialEvolve {
            start: self.start.as_ref().map(|at| at.target("start")).transpose()?,
            until: self.until.as_ref().map(|at| at.target("until")).transpose()?,
            duration: self.duration.as_ref().map(|time| time.seconds("duration")).transpose()?,
            samples: self.samples,
            power: named::<Power>(self.power.as_deref(), "power")?,
            method: named::<EvolveMethod>(self.method.as_deref(), "method")?,
        })
    }
}
