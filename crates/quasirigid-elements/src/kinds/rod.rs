//! Hysteresis rods as elements. (Y10), (Y11)

use crate::Assembly;
use crate::element::Element;
use crate::error::{ElementError, ElementId, ElementKind, Field, Problem, at};
use crate::model::control::{ControlProblem, HysteresisLoop, HysteresisRod};
use crate::number;

/// Key of the demagnetisation factor.
const DEMAGNETIZATION: Field = Field::new("demagnetization");

impl Element for HysteresisRod {
    fn check(&self, id: ElementId, body: &Assembly) -> Vec<ElementError> {
        lawful(id, self, body).err().into_iter().collect()
    }
}

/// Accepts a rod on a body: the rod with an axis of length one.
fn lawful(id: ElementId, rod: &HysteresisRod, body: &Assembly) -> Result<HysteresisRod, ElementError> {
    let positive = |key: &'static str, value: f64| number::positive(value).map_err(at(id, Field::new(key)));
    let axis = number::unit(rod.axis).map_err(at(id, Field::AXIS))?.into();
    positive("volume", rod.volume)?;
    let HysteresisLoop { saturation, remanence, coercivity } = rod.material;
    positive("saturation", saturation)?;
    positive("remanence", remanence)?;
    positive("coercivity", coercivity)?;
    if remanence >= saturation {
        return Err(at(id, Field::new("remanence"))(Problem::Remanent { remanence, saturation }));
    }
    let factor = rod.demagnetization;
    if !(0.0..1.0).contains(&factor) {
        return Err(at(id, DEMAGNETIZATION)(Problem::Demagnetization { factor }));
    }
    if body.magnetic_field.is_none() {
        return Err(at(id, Field::NAME)(Problem::Control(ControlProblem::NoField)));
    }
    Ok(HysteresisRod { axis, ..rod.clone() })
}

impl Assembly {
    /// Rods with axes of length one.
    pub(crate) fn lawful_rods(&self) -> Result<Vec<HysteresisRod>, ElementError> {
        let rods = self.rods.iter().enumerate();
        rods.map(|(index, rod)| lawful(ElementKind::Rod.at(index), rod, self)).collect()
    }
}
