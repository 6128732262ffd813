use quasirigid_io::model::Target;
use quasirigid_io::record::history_csv;
use quasirigid_study::evolution::{self, Evolved};
use quasirigid_study::settings::{PartialEvolve, uncertainty_samples};
use quasirigid_study::sweep::uncertainty_text;
use quasirigid_study::{Setting, StudyError};
use serde_json::json;

use super::{inputs_beside, open};
use crate::args::{Evolve, EvolveFormat, seconds};
use crate::failure::Failure;
use crate::interrupt::Interrupt;
use crate::message::remark;
use crate::progress::Terminal;
use crate::{ExitStatus, output};

/// Follows the averaged rotation over any number of revolutions.
pub fn evolve(arguments: &Evolve) -> Result<ExitStatus, Failure> {
    let Evolve { common, out, overwrite, .. } = arguments;
    let study = open(common)?;
    study.initial()?;
    let printed = out.as_deref().is_some_and(output::is_stdout);
    if printed && common.json {
        return Err(Failure::TwiceOnStdout { option: "--json" });
    }
    if let Some(path) = out {
        output::check_file(path, *overwrite)?;
    }
    let asked = PartialEvolve {
        start: target(Setting::Start, arguments.start.as_deref())?,
        until: target(Setting::Until, arguments.until.as_deref())?,
        duration: arguments.duration.as_deref().map(seconds).transpose()?,
        samples: arguments.samples,
        power: arguments.power,
        method: arguments.method,
    };
    let draws = uncertainty_samples(arguments.uncertainty_samples).map_err(StudyError::from)?;
    let interrupt = Interrupt::listen()?;
    let watch = &mut Terminal::new(&interrupt, common.quiet);
    let evolved = study.evolve(asked, watch)?;
    let Evolved { record, notes: remarks } = &evolved;
    let uncertainty = match draws {
        Some(samples) => Some(study.uncertainty(samples, watch)?.ok_or(Failure::Abandoned)?),
        None => None,
    };
    interrupt.forget();
    if !common.quiet {
        let undrawn = study.undrawn(&Setting::flag).filter(|_| draws.is_none());
        remarks.iter().chain(&undrawn).for_each(|note| remark(&format!("note: {note}")));
    }
    let in_place = match out {
        Some(path) => {
            let placed = output::to_file(path, *overwrite, |out| history_csv(&record.columns, out))?;
            inputs_beside(&study.inputs(), &placed.path, *overwrite)? & placed.told(path)
        }
        None => true,
    };
    if common.json {
        let mut object = study.with_inputs(evolved.json());
        if let Some(uncertainty) = &uncertainty {
            object["uncertainty"] = json!(uncertainty);
        }
        output::print(&format!("{object:#}\n"))?;
    } else if printed {
        // the table is all that a program behind a pipe reads
    } else if arguments.format == EvolveFormat::Csv {
        output::to_stdout(&interrupt, |out| history_csv(&record.columns, out))?;
    } else {
        output::print(&evolution::text(&study.model.name, study.model.kind, record))?;
        if let Some(uncertainty) = &uncertainty {
            output::print(&uncertainty_text(uncertainty))?;
        }
    }
    if evolved.holds() {
        return Ok(if in_place { ExitStatus::Done } else { ExitStatus::CheckFailed });
    }
    let told = !common.json && !printed && arguments.format == EvolveFormat::Text;
    if !(told && record.status == "does-not-hold") {
        remark(&record.message);
    }
    Ok(ExitStatus::CheckFailed)
}

fn target(setting: Setting, text: Option<&str>) -> Result<Option<Target>, Failure> {
    let option = setting.flag();
    let parsed = text.map(str::parse::<Target>).transpose();
    parsed.map_err(|cause| Failure::Target { option, cause: Box::new(cause) })
}
