use quasirigid_io::model::{EvolveMethod, Power, Target};
use quasirigid_io::record::history_csv;
use serde_json::json;

use super::{initial, load, notes, seconds};
use crate::args::{self, Evolve, EvolveFormat};
use crate::evolution::{self, Asked};
use crate::failure::Failure;
use crate::interrupt::Interrupt;
use crate::message::remark;
use crate::{Ending, output};

/// Follows the averaged rotation over any number of turns.
pub fn evolve(arguments: &Evolve) -> Result<Ending, Failure> {
    let loaded = load(&arguments.common)?;
    notes(&loaded.model, &arguments.common);
    let start = initial(&loaded.model, &loaded.body, loaded.order)?;
    if let Some(path) = &arguments.out {
        output::check_file(path, arguments.overwrite)?;
    }
    let file = evolution::asked(&loaded.model);
    let asked = Asked {
        from: target("--from", arguments.from.as_deref())?,
        until: target("--to", arguments.to.as_deref())?.or(file.until),
        duration: match &arguments.duration {
            Some(text) => Some(seconds(text)?),
            None => file.duration,
        },
        samples: arguments.samples.map_or(file.samples, |samples| samples as usize),
        power: arguments.power.map(power).or(file.power),
        method: arguments.method.map(method).or(file.method),
    };
    let interrupt = Interrupt::listen()?;
    let (record, remarks) = evolution::follow(&loaded, start, &asked, &interrupt, arguments.common.quiet)?;
    interrupt.forget();
    if !arguments.common.quiet {
        remarks.iter().for_each(|note| remark(&format!("note: {note}")));
    }
    let in_place = match &arguments.out {
        Some(path) => {
            output::to_file(path, arguments.overwrite, |out| history_csv(&record.columns, out))?.told(path)
        }
        None => true,
    };
    if arguments.common.json {
        let mut object = json!(record);
        object.as_object_mut().map(|entries| entries.remove("columns"));
        object["mode"] = json!({ "start": record.mode_start, "end": record.mode_end });
        output::print(&format!("{object:#}\n"))?;
    } else if arguments.format == EvolveFormat::Csv {
        output::to_stdout(&interrupt, |out| history_csv(&record.columns, out))?;
    } else {
        output::print(&evolution::text(&loaded.model.name, &record))?;
    }
    if record.status == "finished" {
        return Ok(if in_place { Ending::Done } else { Ending::CheckFailed });
    }
    remark(&record.message);
    Ok(Ending::CheckFailed)
}

fn power(power: args::Power) -> Power {
    match power {
        args::Power::Polynomial => Power::Polynomial,
        args::Power::Harmonics => Power::Harmonics,
    }
}

fn method(method: args::EvolveMethod) -> EvolveMethod {
    match method {
        args::EvolveMethod::Average => EvolveMethod::Average,
        args::EvolveMethod::MicroRuns => EvolveMethod::MicroRuns,
        args::EvolveMethod::Direct => EvolveMethod::Direct,
        args::EvolveMethod::Modes => EvolveMethod::Modes,
    }
}

fn target(option: &'static str, text: Option<&str>) -> Result<Option<Target>, Failure> {
    let parsed = text.map(str::parse::<Target>).transpose();
    parsed.map_err(|cause| Failure::Target { option, cause: Box::new(cause) })
}
