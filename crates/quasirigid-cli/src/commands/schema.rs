use quasirigid_io::model::reference;

use crate::failure::Failure;
use crate::{ExitStatus, output};

/// Prints the JSON Schema of the model file.
pub fn schema() -> Result<ExitStatus, Failure> {
    output::print(&format!("{:#}\n", reference::schema()))?;
    Ok(ExitStatus::Done)
}
