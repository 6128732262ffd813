use quasirigid::reduction::{frequencies, reduce};
use quasirigid_io::export::Derived;

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
    let derived = Derived { name: &model.name, body: &body, reduced: &reduced, frequencies: &frequencies };
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
