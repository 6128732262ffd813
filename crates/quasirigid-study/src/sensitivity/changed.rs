//! Values of a quantity in changed copies of a model.

use std::sync::Arc;
use std::sync::atomic::AtomicBool;

use quasirigid_io::model::{KeyPath, KeyValue, Source, System, Template};
use quasirigid_io::study_file::{Answer, Quantity};

use crate::asked::{Status, answers};
use crate::error::StudyError;

/// Quantity of the changed copies of a model.
pub struct Changed<'a> {
    source: &'a Source,
    template: Template,
    asked: Answer,
    cancelled: &'a Arc<AtomicBool>,
}

/// Value that there is not.
pub enum Missing {
    /// The work was cancelled.
    Cancelled,
    /// No value, for this reason.
    No(Status, String),
}

impl<'a> Changed<'a> {
    /// Copies of a model, at another order of the reduced equations where one is given.
    pub fn new(
        source: &'a Source,
        order: Option<usize>,
        quantity: &Quantity,
        cancelled: &'a Arc<AtomicBool>,
    ) -> Result<Self, StudyError> {
        let mut template = Template::new(&source.text)?;
        if let Some(order) = order {
            let change = ("run.order".parse()?, KeyValue::Integer(order as i64));
            template = Template::new(&template.changed(&[change])?)?;
        }
        let asked = Answer {
            quantities: vec![quantity.clone()],
            times: Vec::new(),
            system: System::Reduced,
            percentiles: Vec::new(),
        };
        Ok(Self { source, template, asked, cancelled })
    }

    /// The text that is changed.
    pub fn template(&self) -> &Template {
        &self.template
    }

    /// The quantity of the model with these changes.
    pub fn value(&self, changes: &[(KeyPath, KeyValue)]) -> Result<f64, Missing> {
        let no = |reason: String| Missing::No(Status::Invalid, reason);
        let text = self.template.changed(changes).map_err(|error| no(error.to_string()))?;
        let found = answers(self.source, &text, &self.asked, self.cancelled).ok_or(Missing::Cancelled)?;
        let [quantity] = &self.asked.quantities[..] else { unreachable!("one quantity is asked for") };
        found.number(quantity).map_err(|(status, reason)| Missing::No(status, reason))
    }
}
