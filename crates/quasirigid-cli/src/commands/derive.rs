use quasirigid_study::Study;
use serde_json::json;

use super::{open, whole, with_inputs};
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
        DeriveFormat::Json => ending_with_inputs(&equations.json(), &study),
        DeriveFormat::Latex => equations.latex(),
    };
    if !text.ends_with('\n') {
        text.push('\n');
    }
    output::print(&text)?;
    Ok(ExitStatus::Done)
}

/// The text of a JSON object, whose keys keep their order, with what went into it as the last.
fn ending_with_inputs(object: &str, study: &Study) -> String {
    let text = object.trim_end();
    let open = text.strip_suffix('}').unwrap_or(text).trim_end();
    format!("{open},\n\"inputs\": {}\n}}", json!(study.inputs()))
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
        || with_inputs(&study, equations.json()),
        || equations.text(),
    )?;
    Ok(if equations.holds() { ExitStatus::Done } else { ExitStatus::CheckFailed })
}
