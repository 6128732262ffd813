use std::path::Path;

use quasirigid_io::model::Model;
use quasirigid_io::record::{RunRecord, TableFormat};
use quasirigid_study::run::RunOutcome;
use quasirigid_study::{Keeping, Study, summary};

use super::{default_folder, former_names, is_standard_input, model, whole};
use crate::args::RunArgs;
use crate::failure::Failure;
use crate::interrupt::Interrupt;
use crate::message::remark;
use crate::output::{Folder, Placed};
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
    if arguments.out.as_deref().is_some_and(output::is_stdout) {
        return Err(Failure::FolderOnStdout { option: "-o" });
    }
    let study = whole(common, || Study::with_visuals(model(common)?, common.order))?;
    former_names(&study.model.former_names, common.quiet);
    study.initial()?;
    let path =
        arguments.out.clone().unwrap_or_else(|| default_folder(&study.model.source.file, "model", "-run"));
    let overwrite = *overwrite || *resume && is_partial(&path, &study.model);
    Folder::check(&path, overwrite)?;
    let asked = arguments.run.partial()?;
    let interrupt = Interrupt::listen()?;
    let keeping = Keeping::beside(&path, *resume);
    let ours = *resume || !keeping.folder.exists();
    let work = || {
        let mut terminal = Terminal::new(&interrupt, common.quiet);
        let found = study.run_kept(&asked, Some(&keeping), &mut terminal)?;
        let placed = place(&found, &path, overwrite, arguments.tables.as_deref())?;
        Ok((found, placed))
    };
    let (mut found, placed) = work().inspect_err(|failure: &Failure| {
        if failure.is_of_writing() && ours && keeping.folder.is_dir() {
            let kept = keeping.folder.display();
            remark(&format!(
                "{kept} is kept; once files can be written, the same command with --resume continues"
            ));
        }
    })?;
    let in_place = placed.told(&path);
    let kept = found.release();
    if common.json {
        output::print(&format!("{:#}\n", serde_json::json!(found.record)))?;
    } else if !common.quiet {
        output::print_verdict(&summary::text(&found.record, &placed.path), &found.record.validity.overall)?;
    }
    if arguments.open {
        output::open(&placed.path.join(REPORT))?;
    }
    if let Some(kept) = kept {
        let (folder, asked) = (kept.display(), keeping.folder.display());
        let rename = if kept == keeping.folder { String::new() } else { format!("rename it {asked}, and ") };
        remark(&format!("{folder} is kept; {rename}the same command with --resume continues the run"));
    }
    Ok(if found.holds && in_place { ExitStatus::Done } else { ExitStatus::CheckFailed })
}

/// Writes the record, with its report, in its place.
fn place(
    found: &RunOutcome,
    path: &Path,
    overwrite: bool,
    tables: Option<&[TableFormat]>,
) -> Result<Placed, Failure> {
    let folder = Folder::new(path, overwrite)?;
    folder.write_record(&found.record, tables.unwrap_or(found.record.usual_formats()))?;
    found.files().iter().try_for_each(|(name, text)| folder.write(name, text))?;
    folder.finish()
}

/// Whether a folder has a record of this model that was interrupted.
fn is_partial(path: &Path, model: &Model) -> bool {
    RunRecord::read(path).is_ok_and(|record| {
        let interrupted = record.histories.iter().any(|history| history.status == "interrupted");
        interrupted && record.model.sha256 == model.source.sha256
    })
}
