use std::path::Path;

use quasirigid_study::sweep::{Cell, Finished, RowAnswer, RunOptions, Status, Sweep, text};
use serde_json::{Value, json};

use super::{default_folder, former_names};
use crate::args::SweepArgs;
use crate::failure::Failure;
use crate::interrupt::Interrupt;
use crate::message::remark;
use crate::progress::Terminal;
use crate::{ExitStatus, output};

/// Answers the same question of many bodies.
pub fn sweep(arguments: &SweepArgs) -> Result<ExitStatus, Failure> {
    if arguments.out.as_deref().is_some_and(output::is_stdout) {
        return Err(Failure::FolderOnStdout { option: "-o" });
    }
    let interrupt = Interrupt::listen()?;
    let mut terminal = Terminal::new(&interrupt, arguments.quiet);
    let sweep = Sweep::open(&arguments.study, &mut terminal)?;
    former_names(&sweep.study.former_names, arguments.quiet);
    if let Some(row) = arguments.row {
        drop(terminal);
        return one_row(&sweep, row, arguments.json);
    }
    let folder = arguments.out.clone().unwrap_or_else(|| default_folder(&arguments.study, "study", "-sweep"));
    let options = RunOptions {
        resume: arguments.resume,
        shard: arguments.shard,
        threads: arguments.threads.map(usize::from),
    };
    interrupt.keep();
    let finished = sweep.run(&folder, &options, &mut terminal)?;
    drop(terminal);
    interrupt.forget();
    told(arguments, &folder, &finished)
}

/// Prints the summary, or says what is still to do.
fn told(arguments: &SweepArgs, folder: &Path, finished: &Finished) -> Result<ExitStatus, Failure> {
    let Finished { summary, parts_there, parts, elsewhere, interrupted } = finished;
    let Some(record) = summary else {
        let place = folder.display();
        if *interrupted {
            remark(&format!(
                "interrupted; {parts_there} of {parts} parts are in {place}; continue with --resume"
            ));
            return Ok(ExitStatus::CheckFailed);
        }
        if arguments.json {
            output::print(&format!("{:#}\n", json!({ "parts": parts, "parts_there": parts_there })))?;
        } else if !arguments.quiet {
            let others = if *elsewhere > 0 {
                format!("; another process is working on {elsewhere} more")
            } else {
                String::new()
            };
            output::print(&format!("{parts_there} of {parts} parts are in {place}{others}.\n"))?;
        }
        return Ok(ExitStatus::Done);
    };
    if arguments.json {
        let mut object = json!(record);
        object["folder"] = json!(folder.display().to_string());
        output::print(&format!("{object:#}\n"))?;
    } else if !arguments.quiet {
        output::print(&format!("{}\n  Results: {}\n", text(record), folder.display()))?;
    }
    let count = |status: Status| record.status.get(status.word()).copied().unwrap_or(0);
    let bad = count(Status::Invalid) + count(Status::Failed);
    Ok(if bad == 0 { ExitStatus::Done } else { ExitStatus::CheckFailed })
}

/// Prints the model of a row and its answers.
fn one_row(sweep: &Sweep, row: u64, for_machines: bool) -> Result<ExitStatus, Failure> {
    let index = sweep.index(row)?;
    let answer = sweep.answer(index)?;
    let model = sweep.model_text(index).unwrap_or_default();
    let RowAnswer { outputs, status, reason, note, .. } = &answer;
    if for_machines {
        let cells: serde_json::Map<String, Value> = sweep
            .outputs
            .iter()
            .zip(outputs)
            .map(|(column, cell)| (column.name.clone(), value(cell)))
            .collect();
        let object = json!({
            "row": row, "status": status.word(), "reason": reason, "note": note, "model": model, "answers": cells,
        });
        output::print(&format!("{object:#}\n"))?;
    } else {
        let mut text = format!("{}\n# row {row}: {}\n", model.trim_end(), status.word());
        for (column, cell) in sweep.outputs.iter().zip(outputs) {
            let unit = if column.unit.is_empty() { String::new() } else { format!(" {}", column.unit) };
            text.push_str(&match cell {
                Cell::Missing => format!("# {} is not known\n", column.name),
                Cell::Number(number) => format!("# {} = {number:?}{unit}\n", column.name),
                Cell::Boolean(truth) => format!("# {} = {truth}\n", column.name),
                Cell::Text(words) => format!("# {} = {words:?}\n", column.name),
            });
        }
        for line in [reason, note].into_iter().filter(|line| !line.is_empty()) {
            text.push_str(&format!("# {line}\n"));
        }
        output::print(&text)?;
    }
    Ok(match status {
        Status::Answered | Status::Refused => ExitStatus::Done,
        Status::Invalid | Status::Failed => ExitStatus::CheckFailed,
    })
}

fn value(cell: &Cell) -> Value {
    match cell {
        Cell::Missing => Value::Null,
        Cell::Number(number) => json!(number),
        Cell::Boolean(truth) => json!(truth),
        Cell::Text(text) => json!(text),
    }
}
