use std::io::IsTerminal;
use std::path::Path;

use quasirigid_io::export::{Exported, Fmu, Target, identifier};
use serde_json::json;

use super::{open, whole};
use crate::args::ExportArgs;
use crate::failure::Failure;
use crate::message::remark;
use crate::output::{Folder, Placed};
use crate::{ExitStatus, output};

/// Writes the reduced equations as source of another language.
pub fn export(arguments: &ExportArgs) -> Result<ExitStatus, Failure> {
    let ExportArgs { common, to, out, overwrite } = arguments;
    let in_stdout = output::is_stdout(out);
    match (in_stdout, to.is_folder()) {
        (true, true) => return Err(Failure::FolderOnStdout { option: "--out" }),
        (true, _) if matches!(to, Target::Fmu(_)) && std::io::stdout().is_terminal() => {
            return Err(Failure::BinaryOnTerminal { format: "an FMU" });
        }
        (true, false) if common.json => return Err(Failure::TwiceOnStdout { option: "--json" }),
        (_, true) => Folder::check(out, false)?,
        (_, false) => output::check_file(out, *overwrite)?,
    }
    let stem = out.file_stem().unwrap_or_default().to_string_lossy();
    let name = identifier(&stem);
    if to.names_its_file() && !in_stdout && name != stem {
        return Err(Failure::NamedLikeItsFile { path: out.clone(), name });
    }
    let study = open(common)?;
    let name = if in_stdout { identifier(&study.model.name) } else { name };
    let found = whole(common, || study.export(*to, &name))?;
    found.wrong.iter().filter(|_| common.quiet).for_each(|reason| remark(reason));
    found.notes.iter().filter(|_| !common.quiet).for_each(|note| remark(note));
    let placed = written(&found.exported, out, (to.is_folder(), *overwrite))?;
    let as_asked = placed.told(out);
    if common.json {
        let mut object = found.json();
        object["path"] = json!(placed.path.display().to_string());
        output::print(&format!("{:#}\n", study.with_inputs(object)))?;
    } else if !common.quiet && !in_stdout {
        output::print(&format!("Wrote {}. {}\n", placed.path.display(), found.sentence()))?;
    }
    Ok(if as_asked && found.wrong.is_none() { ExitStatus::Done } else { ExitStatus::CheckFailed })
}

fn written(exported: &Exported, out: &Path, (folder, overwrite): (bool, bool)) -> Result<Placed, Failure> {
    match exported {
        Exported::Source(files) if folder => {
            let building = Folder::new(out, false)?;
            files.iter().try_for_each(|file| building.write(&file.name, &file.text))?;
            building.finish()
        }
        Exported::Source(files) => output::to_file(out, overwrite, |place| {
            files.iter().try_for_each(|file| place.write_all(file.text.as_bytes()))
        }),
        Exported::Unit(Fmu { bytes, .. }) => output::to_file(out, overwrite, |place| place.write_all(bytes)),
    }
}
