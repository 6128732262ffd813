//! A model with the body that it describes.

use std::collections::BTreeMap;
use std::io::Read;
use std::path::Path;
use std::sync::{Arc, Mutex, OnceLock, PoisonError};

use quasirigid::dynamics::Start;
use quasirigid::elements::{Built, Condensation, Resolution, SettledTank, SlowLiquid, Slug, Surface, Visual};
use quasirigid::model::control::Controls;
use quasirigid::model::force::Force;
use quasirigid::model::{FlexibleBody, Marker, ReducedBody};
use quasirigid::reduction::{ReductionError, reduce};
use quasirigid_io::model::Model;

use crate::as_observed::{self, Observed};
use crate::controlled;
use crate::encounters;
use crate::error::StudyError;
use crate::incomplete::beyond;
use crate::skin;
use crate::start::initial;
use crate::{liquids, materials, resolution, sheets, slugs, tanks};

/// Study: an assembled model that answers every question.
///
/// ```
/// use quasirigid_study::Study;
///
/// # fn main() -> Result<(), quasirigid_study::StudyError> {
/// # let model = concat!(env!("CARGO_MANIFEST_DIR"), "/../../examples/three-masses/model.toml");
/// let study = Study::open(model, Some(3))?;
/// println!("{} coordinates, {:?} rad/s", study.body.coordinates().len(), study.initial()?.omega);
/// # Ok(())
/// # }
/// ```
#[derive(Debug)]
pub struct Study {
    /// The model, with notes on suspect values.
    pub model: Model,
    /// Body of the model.
    pub body: FlexibleBody,
    /// External forces, on places of the body.
    pub forces: Vec<Force<Marker>>,
    /// Controllers, on places of the body.
    pub controls: Controls,
    /// Rates of cyclic coordinates at the start (rad/s), where the model gives them.
    pub speeds: Vec<(usize, f64)>,
    /// Effect of each liquid on a slow rotation.
    pub liquids: Vec<SlowLiquid>,
    /// Tanks that are partly full, with their liquids settled.
    pub tanks: Vec<SettledTank>,
    /// Liquids that slide along partly full rings.
    pub slugs: Vec<Slug>,
    /// Condensation of the unknowns of the parts into few coordinates.
    pub condensation: Option<Condensation>,
    /// Approximation of a solid inside a surface.
    pub resolution: Option<Resolution>,
    /// What the spin makes of the body, where its shape or its moments were observed in rotation.
    pub(crate) observed: Option<Observed>,
    /// Order of the reduced equations.
    pub order: usize,
    /// Whether somebody asked for that order.
    pub(crate) order_given: bool,
    /// Visual geometry of the elements, once it was asked for.
    visuals: OnceLock<Vec<Visual>>,
    /// Reduced equations by order, once they were asked for.
    reductions: Mutex<BTreeMap<usize, Arc<ReducedBody>>>,
    /// The study with sliding liquids and driven parts held, once it was asked for.
    held: OnceLock<Box<Self>>,
}

impl Study {
    /// Study of a model file, at an order of the reduced equations, or at the file's own.
    ///
    /// # Errors
    /// [`StudyError::Model`] for a file that cannot be read, and for a body that cannot be.
    pub fn open(path: impl AsRef<Path>, order: Option<usize>) -> Result<Self, StudyError> {
        Self::new(Model::read(path.as_ref())?, order)
    }

    /// Study of the text of a model file; `name` stands for the file in messages.
    ///
    /// # Errors
    /// As [`open`](Self::open).
    pub fn read_from(name: &Path, text: impl Read, order: Option<usize>) -> Result<Self, StudyError> {
        Self::new(Model::read_from(name, text)?, order)
    }

    /// Study of a model.
    ///
    /// # Errors
    /// As [`open`](Self::open).
    pub fn new(model: Model, order: Option<usize>) -> Result<Self, StudyError> {
        Self::assembled(model, order, false)
    }

    /// Study of a model whose visual geometry is made with its body: of a large mesh it costs next to nothing there, and afterwards as much
    /// as the body again.
    ///
    /// # Errors
    /// As [`open`](Self::open).
    pub fn with_visuals(model: Model, order: Option<usize>) -> Result<Self, StudyError> {
        Self::assembled(model, order, true)
    }

    fn assembled(mut model: Model, order: Option<usize>, drawn: bool) -> Result<Self, StudyError> {
        let order_given = order.is_some() || model.run.order_given;
        let order = order.unwrap_or(model.run.order);
        model.assembly.reduction.order = order;
        let errors = model.assembly.check();
        if !errors.is_empty() {
            return Err(model.diagnose_all(&errors).into());
        }
        let observed = as_observed::relax(&mut model)?;
        let built = if drawn { model.assembly.build_with_visuals() } else { model.assembly.build() };
        let Built {
            body,
            forces,
            controls,
            condensation,
            speeds,
            liquids: slow,
            tanks,
            slugs,
            resolution,
            visuals,
        } = built.map_err(|error| model.diagnose(&error))?;
        let visuals = if drawn { OnceLock::from(visuals) } else { OnceLock::new() };
        model.notes.splice(..0, observed.iter().map(|observed| observed.note(&body)));
        model.notes.extend(beyond(&model.assembly, order));
        model.notes.extend(liquids::notes(&model.assembly, &slow));
        model.notes.extend(controlled::note(&controls));
        let passing = encounters::notes(&body, &forces)?;
        model.notes.splice(..0, passing);
        if let Some(resolution) = &resolution {
            settle(&mut model, resolution);
        }
        let reductions = Mutex::default();
        let mut study = Self {
            model,
            body,
            forces,
            controls,
            speeds,
            liquids: slow,
            tanks,
            slugs,
            condensation,
            resolution,
            observed,
            order,
            order_given,
            visuals,
            reductions,
            held: OnceLock::new(),
        };
        if !study.model.assembly.appendages.is_empty() {
            let start = study.initial().ok();
            let note = start.and_then(|start| sheets::note(&study.model.assembly, start.omega));
            study.model.notes.splice(..0, note);
        }
        let notes: Vec<String> = materials::flow_note(&study)
            .into_iter()
            .chain(tanks::notes(&study))
            .chain(slugs::notes(&study))
            .collect();
        study.model.notes.splice(..0, notes);
        Ok(study)
    }

    /// Visual geometry of the elements.
    ///
    /// # Errors
    /// As [`open`](Self::open).
    pub fn visuals(&self) -> Result<&[Visual], StudyError> {
        if self.visuals.get().is_none() {
            let built = self.model.assembly.build_with_visuals();
            let built = built.map_err(|error| self.model.diagnose(&error))?;
            // a second build in another thread made the same
            let _ = self.visuals.set(built.visuals);
        }
        Ok(self.visuals.get().map_or(&[], Vec::as_slice))
    }

    /// Reduced equations of the body at an order, derived once: a study that has answered is not changed.
    pub(crate) fn reduced(&self, order: usize) -> Result<Arc<ReducedBody>, ReductionError> {
        let kept = || self.reductions.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some(reduced) = kept().get(&order) {
            return Ok(Arc::clone(reduced));
        }
        let reduced = Arc::new(reduce(&self.body, order)?);
        Ok(Arc::clone(kept().entry(order).or_insert(reduced)))
    }

    /// The study with its sliding liquids held where they lie at rest and its driven parts locked where they start; none where nothing slides
    /// or is driven.
    pub(crate) fn held(&self) -> Result<Option<&Self>, StudyError> {
        if self.body.frictions().is_empty() && self.body.drives().is_empty() {
            return Ok(None);
        }
        if self.held.get().is_none() {
            let held = Self::assembled(slugs::held(&self.model), Some(self.order), false)?;
            // a second build in another thread made the same
            let _ = self.held.set(Box::new(Self { order_given: self.order_given, ..held }));
        }
        Ok(self.held.get().map(|held| &**held))
    }

    /// Initial rotation of the model, from any of its forms.
    ///
    /// # Errors
    /// [`StudyError`] for a model without a rotation, and for one that its body cannot have.
    pub fn initial(&self) -> Result<Start, StudyError> {
        skin::check(self, initial(self)?)
    }
}

/// Notes the resolution of a solid, and takes its approximation for the ends of the ranges of the materials too.
fn settle(model: &mut Model, resolution: &Resolution) {
    let solids = &model.assembly.surfaces;
    model.notes.extend(solids.iter().filter_map(|solid| resolution::note(&solid.name, resolution)));
    let settled = |surface: &mut Surface| *surface = surface.settled(resolution);
    model.extremes.iter_mut().flat_map(|ends| ends.iter_mut()).for_each(|end| {
        end.surfaces.iter_mut().for_each(settled);
    });
}
