//! Picture of an answer in a file.

use std::path::Path;

use quasirigid_study::report::png;

use super::PIXELS;
use crate::failure::Failure;
use crate::message::remark;
use crate::output;

/// Picture of an answer, whose place is checked before the work.
pub struct Picture<'a> {
    path: Option<&'a Path>,
    is_png: bool,
    overwrite: bool,
}

impl<'a> Picture<'a> {
    /// A picture in an .svg or .png file; none without a path.
    pub fn at(path: Option<&'a Path>, overwrite: bool) -> Result<Self, Failure> {
        let ending = path.and_then(Path::extension).map(|ending| ending.to_ascii_lowercase());
        let is_png = ending.as_deref().is_some_and(|ending| ending == "png");
        if let Some(path) = path {
            if !is_png && ending.as_deref().is_none_or(|ending| ending != "svg") {
                return Err(Failure::FigureEnding { path: path.to_owned() });
            }
            output::check_file(path, overwrite)?;
        }
        Ok(Self { path, is_png, overwrite })
    }

    /// Writes the picture, if one is asked for; false where there is nothing to draw or the file is not known to be on the disk.
    pub fn write(&self, svg: impl FnOnce() -> Option<String>, quiet: bool) -> Result<bool, Failure> {
        let Some(path) = self.path else { return Ok(true) };
        let Some(svg) = svg() else {
            remark("there is nothing to draw, and no figure is written");
            return Ok(false);
        };
        let bytes = if self.is_png { png(&svg, PIXELS)? } else { svg.into_bytes() };
        let placed = output::to_file(path, self.overwrite, |out| out.write_all(&bytes))?;
        if !quiet && !output::is_stdout(path) {
            remark(&format!("wrote {}", placed.path.display()));
        }
        Ok(placed.told(path))
    }
}
