use std::convert::Infallible;

use quasirigid_study::report::yorp_picture;
use quasirigid_study::yorp::YorpSettings;

use super::curve_files::CurveFiles;
use super::open;
use crate::args::YorpArgs;
use crate::failure::Failure;
use crate::{ExitStatus, output};

/// Gives the mean torque of sunlight by the obliquity.
pub fn yorp(arguments: &YorpArgs) -> Result<ExitStatus, Failure> {
    let YorpArgs { common, albedo, emissivity, thermal_inertia, out, overwrite } = arguments;
    let none_of_its_own = |_: &str| None::<Infallible>;
    let files = CurveFiles::at(out, *overwrite, none_of_its_own, |path| Failure::YorpEnding { path })?;
    let study = open(common)?;
    let asked = YorpSettings { albedo: *albedo, emissivity: *emissivity, thermal_inertia: *thermal_inertia };
    let found = study.yorp(asked)?;
    let files = files.filled(&study, &found.columns(), yorp_picture, |never| match never {})?;
    output::print_answer(common.json, || study.with_inputs(found.json()), || found.text())?;
    let in_place = files.write(&study, common.quiet)?;
    Ok(if in_place && found.holds { ExitStatus::Done } else { ExitStatus::CheckFailed })
}
