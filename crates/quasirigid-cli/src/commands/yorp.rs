use std::path::Path;

use quasirigid_io::model::Named;
use quasirigid_io::record::TableFormat;
use quasirigid_study::Study;
use quasirigid_study::report::{png, yorp_picture};
use quasirigid_study::yorp::{Yorp, YorpSettings};
use serde_json::json;

use super::{PIXELS, inputs_beside, open};
use crate::args::YorpArgs;
use crate::failure::Failure;
use crate::message::remark;
use crate::{ExitStatus, output};

/// Files that the curves are written to.
#[derive(Clone, Copy)]
enum Written {
    Table(TableFormat),
    Svg,
    Png,
}

/// Gives the mean torque of sunlight by the obliquity.
pub fn yorp(arguments: &YorpArgs) -> Result<ExitStatus, Failure> {
    let YorpArgs { common, albedo, emissivity, thermal_inertia, out, overwrite } = arguments;
    let form = |path| {
        output::check_file(path, *overwrite)?;
        written(path)
    };
    let forms = out.iter().map(|path| form(path)).collect::<Result<Vec<_>, Failure>>()?;
    let study = open(common)?;
    let asked = YorpSettings { albedo: *albedo, emissivity: *emissivity, thermal_inertia: *thermal_inertia };
    let found = study.yorp(asked)?;
    let files = out.iter().zip(forms).map(|(path, form)| Ok((path, form, bytes(&study, &found, form)?)));
    let files = files.collect::<Result<Vec<_>, Failure>>()?;
    output::print_answer(common.json, || study.with_inputs(found.json()), || found.text())?;
    let mut in_place = true;
    for (path, form, bytes) in files {
        let placed = output::to_file(path, *overwrite, |out| out.write_all(&bytes))?;
        if !common.quiet && !output::is_stdout(path) {
            remark(&format!("wrote {}", placed.path.display()));
        }
        in_place &= placed.told(path);
        if matches!(form, Written::Table(TableFormat::Csv)) {
            in_place &= inputs_beside(&study.inputs(), &placed.path, *overwrite)?;
        }
    }
    Ok(if in_place && found.holds { ExitStatus::Done } else { ExitStatus::CheckFailed })
}

/// Form of a file, by its ending.
fn written(path: &Path) -> Result<Written, Failure> {
    let ending = path.extension().map(|ending| ending.to_ascii_lowercase());
    let ending = ending.as_ref().and_then(|ending| ending.to_str()).unwrap_or_default();
    let table = TableFormat::VALUES.iter().find(|(name, ..)| *name == ending);
    match (table, ending) {
        (Some((_, format, _)), _) => Ok(Written::Table(*format)),
        (None, "svg") => Ok(Written::Svg),
        (None, "png") => Ok(Written::Png),
        _ => Err(Failure::YorpEnding { path: path.to_owned() }),
    }
}

fn bytes(study: &Study, found: &Yorp, form: Written) -> Result<Vec<u8>, Failure> {
    let svg = || yorp_picture(&found.columns()).unwrap_or_default();
    Ok(match form {
        Written::Table(format) => format.bytes(&found.columns(), Some(&json!(study.inputs()).to_string()))?,
        Written::Svg => svg().into_bytes(),
        Written::Png => png(&svg(), PIXELS)?,
    })
}
