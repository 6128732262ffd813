use super::{open, whole};
use crate::args::{About, Derive, DeriveFormat};
use crate::failure::Failure;
use crate::{ExitStatus, output};

/// Prints the reduced equations.
pub fn derive(arguments: &Derive) -> Result<ExitStatus, Failure> {
    let format = if arguments.common.json { DeriveFormat::Json } else { arguments.format };
    match arguments.about {
        About::Rest if arguments.spin_manifold.is_given() || arguments.axis.is_some() => {
            Err(Failure::NotAboutSpin { with: "--about spin" })
        }
        About::Rest => about_rest(arguments, format),
        About::Spin => about_spin(arguments, format),
    }
}

fn about_rest(arguments: &Derive, format: DeriveFormat) -> Result<ExitStatus, Failure> {
    let study = open(&arguments.common)?;
    let equations = whole(&arguments.common, || study.derive())?;
    let mut text = match format {
        DeriveFormat::Text => equations.text(),
        DeriveFormat::Json => study.ending_with_inputs(&equations.json()),
        DeriveFormat::Latex => equations.latex(),
    };
    if !text.ends_with('\n') {
        text.push('\n');
    }
    output::print(&text)?;
    Ok(ExitStatus::Done)
}

fn about_spin(arguments: &Derive, format: DeriveFormat) -> Result<ExitStatus, Failure> {
    if format == DeriveFormat::Latex {
        return Err(Failure::NoLatexAboutSpin);
    }
    let study = open(&arguments.common)?;
    let asked = arguments.spin_manifold.partial();
    let equations = whole(&arguments.common, || study.about_spin(asked, arguments.axis))?;
    output::print_answer(
        format == DeriveFormat::Json,
        || study.with_inputs(equations.json()),
        || equations.text(),
    )?;
    Ok(if equations.holds() { ExitStatus::Done } else { ExitStatus::CheckFailed })
}
