use quasirigid::model::FlexibleBody;
use quasirigid::reduction::{ReductionError, degree_sizes, frequencies, reduce};
use quasirigid_io::export::{Derived, Mechanism};

use super::{Loaded, load, notes};
use crate::args::{Derive, DeriveFormat};
use crate::failure::Failure;
use crate::{Ending, output};

/// Prints the reduced equations.
pub fn derive(arguments: &Derive) -> Result<Ending, Failure> {
    let Loaded { model, body, order, .. } = load(&arguments.common)?;
    notes(&model, &arguments.common);
    let reduced = reduce(&body, order)?;
    let frequencies = frequencies(&body)?;
    let derived = Derived {
        name: &model.name,
        body: &body,
        reduced: &reduced,
        frequencies: &frequencies,
        mechanisms: &mechanisms(&body, order)?,
    };
    let format = if arguments.common.json { DeriveFormat::Json } else { arguments.format };
    let mut text = match format {
        DeriveFormat::Text => derived.text(),
        DeriveFormat::Json => derived.json(),
        DeriveFormat::Latex => derived.latex(),
    };
    if !text.ends_with('\n') {
        text.push('\n');
    }
    output::print(&text)?;
    Ok(Ending::Done)
}

/// What moves inside and what outside, each with the other locked, of a body that has both.
fn mechanisms(body: &FlexibleBody, order: usize) -> Result<Vec<Mechanism>, ReductionError> {
    if body.elastic() == 0 || body.cyclic().is_empty() {
        return Ok(Vec::new());
    }
    let alone = |name, part: &FlexibleBody| {
        let sizes = degree_sizes(&reduce(part, order)?, [1.0, 0.0, 0.0]);
        Ok(Mechanism { name, sizes: sizes.iter().map(|each| (each.degree, each.size)).collect() })
    };
    Ok(vec![
        alone("liquids and rotors", &body.stiff_outside())?,
        alone("springs and dashpots", &body.locked_inside())?,
    ])
}
