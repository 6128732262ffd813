use quasirigid_io::record::RunRecord;
use quasirigid_study::report::{GltfOptions, gltf, page};

use crate::args::Report;
use crate::failure::Failure;
use crate::message::remark;
use crate::{ExitStatus, output};

/// Name of the report in the folder of its record.
const REPORT: &str = "report.html";

/// Makes the report of a record again, or the body in motion as a glTF file.
pub fn report(arguments: &Report) -> Result<ExitStatus, Failure> {
    let Report { folder, out, gltf: model, duration, deformation, overwrite, quiet } = arguments;
    // the report of a record is made by this program, and made again from the record alone
    let (path, overwrite) = match out.as_ref().or(model.as_ref()) {
        Some(path) => (path.clone(), *overwrite),
        None => (folder.join(REPORT), true),
    };
    output::check_file(&path, overwrite)?;
    let record = RunRecord::read(folder)?;
    let bytes = match model {
        Some(_) => {
            let scene = record.scene.as_ref().ok_or_else(|| Failure::NoScene { folder: folder.clone() })?;
            gltf(scene, &options(*duration, *deformation)?)
        }
        None => page(&record).into_bytes(),
    };
    let placed = output::to_file(&path, overwrite, |out| out.write_all(&bytes))?;
    if !quiet {
        remark(&format!("wrote {}", placed.path.display()));
    }
    Ok(if placed.told(&path) { ExitStatus::Done } else { ExitStatus::CheckFailed })
}

fn options(duration: Option<f64>, deformation: Option<f64>) -> Result<GltfOptions, Failure> {
    let usual = GltfOptions::default();
    let checked = |option: &'static str, value: Option<f64>| match value {
        Some(value) if !(value > 0.0 && value.is_finite()) => Err(Failure::NotPositive { option, value }),
        other => Ok(other),
    };
    Ok(GltfOptions {
        duration: checked("--duration", duration)?.unwrap_or(usual.duration),
        deformation: checked("--deformation", deformation)?,
    })
}
