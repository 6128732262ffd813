use std::path::{Path, PathBuf};

use quasirigid_io::model::Model;
use quasirigid_study::{Study, summary};

use super::{is_standard_input, model, propagation, whole};
use crate::args::RunArgs;
use crate::failure::Failure;
use crate::interrupt::Interrupt;
use crate::output::Folder;
use crate::progress::Terminal;
use crate::{ExitStatus, output};

/// Name of the report in the folder.
const REPORT: &str = "report.html";

/// The main job: check, reduce, propagate, and write the record with its report.
pub fn run(arguments: &RunArgs) -> Result<ExitStatus, Failure> {
    let RunArgs { common, overwrite, .. } = arguments;
    if arguments.out.is_none() && is_standard_input(common) {
        return Err(Failure::NamelessRun);
    }
    let study = whole(common, || Study::with_visuals(model(common)?, common.order))?;
    study.initial()?;
    let path = arguments.out.clone().unwrap_or_else(|| default_folder(&study.model));
    Folder::check(&path, *overwrite)?;
    let asked = propagation(&arguments.propagation)?;
    let interrupt = Interrupt::listen()?;
    let found = study.run(&asked, &mut Terminal::new(&interrupt, common.quiet))?;
    let folder = Folder::new(&path, *overwrite)?;
    let formats = arguments.tables.as_deref().unwrap_or(found.record.usual_formats());
    found.record.write(&folder.building(), formats)?;
    found.files().iter().try_for_each(|(name, text)| folder.write(name, text))?;
    let placed = folder.finish()?;
    let in_place = placed.told(&path);
    if common.json {
        output::print(&format!("{:#}\n", serde_json::json!(found.record)))?;
    } else if !common.quiet {
        output::print(&summary::text(&found.record, &placed.path))?;
    }
    if arguments.open {
        output::open(&placed.path.join(REPORT))?;
    }
    Ok(if found.holds && in_place { ExitStatus::Done } else { ExitStatus::CheckFailed })
}

/// The file's name with `-run`; a file called `model.toml` has the name of its folder.
fn default_folder(model: &Model) -> PathBuf {
    let file = &model.source.file;
    let folder =
        file.parent().and_then(Path::file_name).filter(|_| file.file_stem() == Some("model".as_ref()));
    let name = folder.or(file.file_stem()).unwrap_or_default().to_string_lossy();
    PathBuf::from(format!("{name}-run"))
}
