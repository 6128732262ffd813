use std::path::{Path, PathBuf};

use quasirigid_io::record::RunRecord;

use quasirigid_study::report::{Compared, GltfOptions, comparison_page, gltf, page, revolutions_per_frame};

use super::attitude;
use crate::args::Report;
use crate::failure::Failure;
use crate::message::remark;
use crate::{ExitStatus, output};

/// Name of the report in the folder of its record.
const REPORT: &str = "report.html";
/// Revolutions from one frame to the next above which an animation shows the body stroboscopically.
const STROBOSCOPIC: f64 = 0.5;
/// Name of the comparison of several records.
const COMPARISON: &str = "comparison.html";

/// Makes the report of a record again, the comparison of several, or the body in motion as a glTF file.
pub fn report(arguments: &Report) -> Result<ExitStatus, Failure> {
    let Report { folders, out, gltf: model, duration, deformation, open, overwrite, quiet, .. } = arguments;
    if let Some(path) = &arguments.attitude {
        return attitude::of_record(arguments, path);
    }
    if arguments.labels.are_given() {
        return Err(Failure::NoAttitudeFile { with: "--attitude FILE" });
    }
    // the report of a record is made by this program, and made again from the record alone
    let (path, overwrite) = match (out.as_ref().or(model.as_ref()), folders.as_slice()) {
        (Some(path), _) => (path.clone(), *overwrite),
        (None, [folder]) => (folder.join(REPORT), true),
        (None, _) => (PathBuf::from(COMPARISON), *overwrite),
    };
    output::check_file(&path, overwrite)?;
    if output::is_stdout(&path) && *open {
        return Err(Failure::OpenedStdout);
    }
    let bytes = match (model, folders.as_slice()) {
        (Some(_), [folder]) => {
            let record = RunRecord::read(folder)?;
            let scene = record.scene.as_ref().ok_or_else(|| Failure::NoScene { folder: folder.clone() })?;
            if let Some(turns) = revolutions_per_frame(scene).filter(|turns| *turns > STROBOSCOPIC && !quiet)
            {
                remark(&format!(
                    "note: the body makes up to {turns:.1} revolutions from one frame to the next, so the animation shows it \
                     stroboscopically; a record of a shorter run has its frames closer together"
                ));
            }
            gltf(scene, &options(*duration, *deformation)?)
        }
        (Some(_), _) => return Err(Failure::OneScene),
        (None, [folder]) => page(&RunRecord::read(folder)?).into_bytes(),
        (None, folders) => comparison(folders)?.into_bytes(),
    };
    let placed = output::to_file(&path, overwrite, |out| out.write_all(&bytes))?;
    if !quiet && !output::is_stdout(&path) {
        remark(&format!("wrote {}", placed.path.display()));
    }
    if *open {
        output::open(&placed.path)?;
    }
    Ok(if placed.told(&path) { ExitStatus::Done } else { ExitStatus::CheckFailed })
}

fn comparison(folders: &[PathBuf]) -> Result<String, Failure> {
    let records = folders.iter().map(|folder| RunRecord::read(folder)).collect::<Result<Vec<_>, _>>()?;
    let labels = labels(folders);
    let runs: Vec<Compared<'_>> =
        labels.iter().zip(&records).map(|(label, record)| Compared { label, record }).collect();
    Ok(comparison_page(&runs))
}

/// Names of the folders, or their paths where two have the same name.
fn labels(folders: &[PathBuf]) -> Vec<String> {
    let name = |folder: &Path| folder.file_name().map(|name| name.to_string_lossy().into_owned());
    let names: Vec<String> =
        folders.iter().map(|folder| name(folder).unwrap_or_else(|| folder.display().to_string())).collect();
    let unique = |label: &String| names.iter().filter(|other| *other == label).count() == 1;
    let label = |(name, folder): (&String, &PathBuf)| {
        if unique(name) { name.clone() } else { folder.display().to_string() }
    };
    names.iter().zip(folders).map(label).collect()
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
