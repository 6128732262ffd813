use std::io::{self, IsTerminal};
use std::path::{Path, PathBuf};

use quasirigid_io::record::RunRecord;
use quasirigid_study::report::{figure_names, picture, png};

use super::PIXELS;
use crate::args::{PictureFormat, Plot};
use crate::failure::Failure;
use crate::message::remark;
use crate::{ExitStatus, output};

/// Draws one figure of a record, or lists the figures that it has.
pub fn plot(arguments: &Plot) -> Result<ExitStatus, Failure> {
    let Plot { folder, figure, overwrite, quiet, .. } = arguments;
    let Some(name) = figure else {
        let record = RunRecord::read(folder)?;
        let names = figure_names(&record);
        output::print(&names.iter().map(|name| format!("{name}\n")).collect::<String>())?;
        return Ok(ExitStatus::Done);
    };
    let format = format(arguments)?;
    let path = arguments.out.clone().unwrap_or_else(|| PathBuf::from(name).with_extension(format.ending()));
    output::check_file(&path, *overwrite)?;
    if output::is_stdout(&path) && format == PictureFormat::Png && io::stdout().is_terminal() {
        return Err(Failure::BinaryOnTerminal { format: "png" });
    }
    let record = RunRecord::read(folder)?;
    let svg = picture(&record, name).ok_or_else(|| unknown(folder, name, figure_names(&record)))?;
    let bytes = match format {
        PictureFormat::Svg => svg.into_bytes(),
        PictureFormat::Png => png(&svg, arguments.pixels.unwrap_or(PIXELS))?,
    };
    let placed = output::to_file(&path, *overwrite, |out| out.write_all(&bytes))?;
    if !quiet && !output::is_stdout(&path) {
        remark(&format!("wrote {}", placed.path.display()));
    }
    Ok(if placed.told(&path) { ExitStatus::Done } else { ExitStatus::CheckFailed })
}

/// The format asked for, or that of the file's name.
fn format(arguments: &Plot) -> Result<PictureFormat, Failure> {
    let ending = arguments.out.as_deref().and_then(Path::extension);
    let named = [PictureFormat::Svg, PictureFormat::Png]
        .into_iter()
        .find(|format| ending.is_some_and(|ending| ending.eq_ignore_ascii_case(format.ending())));
    let format = match (arguments.format, named, &arguments.out) {
        (Some(format), ..) | (None, Some(format), _) => format,
        (None, None, None) => PictureFormat::Svg,
        (None, None, Some(path)) if output::is_stdout(path) => PictureFormat::Svg,
        (None, None, Some(path)) => return Err(Failure::PictureEnding { path: path.clone() }),
    };
    if format == PictureFormat::Svg && arguments.pixels.is_some() {
        return Err(Failure::PixelsOfSvg);
    }
    Ok(format)
}

fn unknown(folder: &Path, name: &str, known: Vec<&'static str>) -> Failure {
    let folder = folder.to_owned();
    if known.is_empty() {
        return Failure::NoFigures { folder };
    }
    Failure::NoFigure { folder, name: name.to_owned(), known }
}
