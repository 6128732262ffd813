use super::{notes, open, whole};
use crate::args::{Derive, DeriveFormat};
use crate::failure::Failure;
use crate::{ExitStatus, output};

/// Prints the reduced equations.
pub fn derive(arguments: &Derive) -> Result<ExitStatus, Failure> {
    let study = open(&arguments.common)?;
    notes(&study, &arguments.common);
    let equations = whole(&arguments.common, || study.derive())?;
    let format = if arguments.common.json { DeriveFormat::Json } else { arguments.format };
    let mut text = match format {
        DeriveFormat::Text => equations.text(),
        DeriveFormat::Json => equations.json(),
        DeriveFormat::Latex => equations.latex(),
    };
    if !text.ends_with('\n') {
        text.push('\n');
    }
    output::print(&text)?;
    Ok(ExitStatus::Done)
}
