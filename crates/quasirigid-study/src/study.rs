//! A model with the body that it describes.

use std::io::Read;
use std::path::Path;

use quasirigid::dynamics::Start;
use quasirigid::elements::{Built, Condensation, Resolution, SlowLiquid, Surface};
use quasirigid::model::force::Force;
use quasirigid::model::{FlexibleBody, Marker};
use quasirigid_io::model::Model;

use crate::error::StudyError;
use crate::incomplete::beyond;
use crate::start::initial;
use crate::{liquids, resolution};

/// A model, assembled: what every question is asked of.
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
    /// The model, with notes on what is suspect in it.
    pub model: Model,
    /// Its body.
    pub body: FlexibleBody,
    /// External forces, on its places.
    pub forces: Vec<Force<Marker>>,
    /// Rates of cyclic coordinates at the start (rad/s), where the model gives them.
    pub speeds: Vec<(usize, f64)>,
    /// What each liquid does to a slow rotation.
    pub liquids: Vec<SlowLiquid>,
    /// How the unknowns of its parts became few coordinates.
    pub condensation: Option<Condensation>,
    /// How a solid inside a surface is approximated.
    pub resolution: Option<Resolution>,
    /// Order of the reduced equations.
    pub order: usize,
}

impl Study {
    /// Of a model file, at an order of the reduced equations, or at the file's own.
    ///
    /// # Errors
    /// [`StudyError::Model`] for a file that cannot be read, and for a body that cannot be.
    pub fn open(path: impl AsRef<Path>, order: Option<usize>) -> Result<Self, StudyError> {
        Self::new(Model::read(path.as_ref())?, order)
    }

    /// The same of the text of a model file; `name` stands for the file in messages.
    ///
    /// # Errors
    /// As [`open`](Self::open).
    pub fn read_from(name: &Path, text: impl Read, order: Option<usize>) -> Result<Self, StudyError> {
        Self::new(Model::read_from(name, text)?, order)
    }

    /// The same of a model.
    ///
    /// # Errors
    /// As [`open`](Self::open).
    pub fn new(mut model: Model, order: Option<usize>) -> Result<Self, StudyError> {
        let order = order.unwrap_or(model.run.order);
        model.assembly.reduction.order = order;
        let errors = model.assembly.check();
        if !errors.is_empty() {
            return Err(model.diagnose_all(&errors).into());
        }
        let Built { body, forces, condensation, speeds, liquids: slow, resolution } =
            model.assembly.build().map_err(|error| model.diagnose(&error))?;
        model.notes.extend(beyond(&model.assembly, order));
        model.notes.extend(liquids::notes(&model.assembly, &slow));
        if let Some(resolution) = &resolution {
            settle(&mut model, resolution);
        }
        Ok(Self { model, body, forces, speeds, liquids: slow, condensation, resolution, order })
    }

    /// The rotation that the model starts with, however it describes it.
    ///
    /// # Errors
    /// [`StudyError`] for a model without a rotation, and for one that its body cannot have.
    pub fn initial(&self) -> Result<Start, StudyError> {
        initial(&self.model, &self.body, self.order)
    }
}

/// Notes how well a solid is resolved, and takes the same approximation for the ends of the ranges of its materials.
fn settle(model: &mut Model, resolution: &Resolution) {
    let solids = &model.assembly.surfaces;
    model.notes.extend(solids.iter().filter_map(|solid| resolution::note(&solid.name, resolution)));
    let settled = |surface: &mut Surface| *surface = surface.settled(resolution);
    model.extremes.iter_mut().flat_map(|ends| ends.iter_mut()).for_each(|end| {
        end.surfaces.iter_mut().for_each(settled);
    });
}
