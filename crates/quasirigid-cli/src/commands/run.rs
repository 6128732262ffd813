use std::path::{Path, PathBuf};

use quasirigid_io::model::Model;
use quasirigid_io::record::RunRecord;
use quasirigid_study::{Keeping, Study, summary};

use super::{is_standard_input, model, propagation, whole};
use crate::args::RunArgs;
use crate::failure::Failure;
use crate::interrupt::Interrupt;
use crate::message::remark;
use crate::output::Folder;
use crate::progress::Terminal;
use crate::{ExitStatus, output};

/// Name of the report in the folder.
const REPORT: &str = "report.html";

/// The main job: check, reduce, propagate, and write the record with its report.
pub fn run(arguments: &RunArgs) -> Result<ExitStatus, Failure> {
    let RunArgs { common, overwrite, resume, .. } = arguments;
    if arguments.out.is_none() && is_standard_input(common) {
        return Err(Failure::NamelessRun);
    }
    let study = whole(common, || Study::with_visuals(model(common)?, common.order))?;
    study.initial()?;
    let path = arguments.out.clone().unwrap_or_else(|| default_folder(&study.model));
    let overwrite = *overwrite || *resume && is_partial(&path, &study.model);
    Folder::check(&path, overwrite)?;
    let asked = propagation(&arguments.propagation)?;
    let interrupt = Interrupt::listen()?;
    let keeping = Keeping::beside(&path, *resume);
    let found = study.run_kept(&asked, Some(&keeping), &mut Terminal::new(&interrupt, common.quiet))?;
    let folder = Folder::new(&path, overwrite)?;
    let formats = arguments.tables.as_deref().unwrap_or(found.record.usual_formats());
    found.record.write(&folder.building(), formats)?;
    found.files().iter().try_for_each(|(name, text)| folder.write(name, text))?;
    let placed = folder.finish()?;
    let in_place = placed.told(&path);
    if common.json {
        output::print(&format!("{:#}\n", serde_json::json!(found.record)))?;
    } else if !common.quiet {
        output::print_verdict(&summary::text(&found.record, &placed.path), &found.record.validity.overall)?;
    }
    if arguments.open {
        output::open(&placed.path.join(REPORT))?;
    }
    let holds = found.holds;
    if let Some(kept) = found.settle() {
        remark(&format!("{} is kept; the same command with --resume goes on with the run", kept.display()));
    }
    Ok(if holds && in_place { ExitStatus::Done } else { ExitStatus::CheckFailed })
}

/// Whether a folder has a record of this model that was interrupted.
fn is_partial(path: &Path, model: &Model) -> bool {
    RunRecord::read(path).is_ok_and(|record| {
        let interrupted = record.histories.iter().any(|history| history.status == "interrupted");
        interrupted && record.model.sha256 == model.source.sha256
    })
}

/// The file's name with `-run`; a file called `model.toml` has the name of its folder.
fn default_folder(model: &Model) -> PathBuf {
    let file = &model.source.file;
    let folder =
        file.parent().and_then(Path::file_name).filter(|_| file.file_stem() == Some("model".as_ref()));
    let name = folder.or(file.file_stem()).unwrap_or_default().to_string_lossy();
    PathBuf::from(format!("{name}-run"))
}
