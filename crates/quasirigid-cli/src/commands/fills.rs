use std::path::Path;

use quasirigid_io::record::FillMapRecord;
use quasirigid_study::fill_map::{FillMapSettings, csv, text};
use quasirigid_study::report::{fill_map_picture, png};
use serde_json::json;

use super::{PIXELS, open_with};
use crate::args::FillsArgs;
use crate::failure::Failure;
use crate::message::remark;
use crate::progress::Terminal;
use crate::{ExitStatus, output};

/// Files that a map is written to.
#[derive(Clone, Copy)]
enum Written {
    Csv,
    Svg,
    Png,
}

/// Maps the time constants over fill and spin.
pub fn fills(arguments: &FillsArgs) -> Result<ExitStatus, Failure> {
    let FillsArgs { common, out, overwrite, .. } = arguments;
    let form = |path| {
        output::check_file(path, *overwrite)?;
        written(path)
    };
    let forms = out.iter().map(|path| form(path)).collect::<Result<Vec<_>, Failure>>()?;
    // each point of the map has the doubts of its own fill
    let study = open_with(common, |_, _| !common.quiet)?;
    let asked = FillMapSettings {
        tanks: arguments.tank.clone(),
        fills: arguments.fill,
        spins: arguments.spin,
        counts: arguments.points,
    };
    let record = study.fill_map(&asked, &mut Terminal::of_whole(common.quiet))?;
    output::print_answer(common.json, || study.with_inputs(json!(record)), || text(&record))?;
    let mut in_place = true;
    for (path, form) in out.iter().zip(forms) {
        let bytes = bytes(&record, form)?;
        let placed = output::to_file(path, *overwrite, |out| out.write_all(&bytes))?;
        if !common.quiet {
            remark(&format!("wrote {}", placed.path.display()));
        }
        in_place &= placed.told(path);
    }
    Ok(if in_place && record.holds { ExitStatus::Done } else { ExitStatus::CheckFailed })
}

/// Form of a file, by its ending.
fn written(path: &Path) -> Result<Written, Failure> {
    let ending = path.extension().map(|ending| ending.to_ascii_lowercase());
    match ending.as_ref().and_then(|ending| ending.to_str()) {
        Some("csv") => Ok(Written::Csv),
        Some("svg") => Ok(Written::Svg),
        Some("png") => Ok(Written::Png),
        _ => Err(Failure::FillMapEnding { path: path.to_owned() }),
    }
}

fn bytes(record: &FillMapRecord, form: Written) -> Result<Vec<u8>, Failure> {
    let svg = || fill_map_picture(record).ok_or(Failure::NoNutation);
    Ok(match form {
        Written::Csv => csv(record),
        Written::Svg => svg()?.into_bytes(),
        Written::Png => png(&svg()?, PIXELS)?,
    })
}
