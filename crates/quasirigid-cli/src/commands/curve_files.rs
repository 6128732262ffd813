//! Files that the curves of an answer are written to: tables, pictures, and forms of a command's own.

use std::path::{Path, PathBuf};

use quasirigid_io::model::Named;
use quasirigid_io::record::{Column, TableFormat};
use quasirigid_study::Study;
use quasirigid_study::report::png;
use serde_json::json;

use super::{PIXELS, inputs_beside};
use crate::failure::Failure;
use crate::message::remark;
use crate::output;

/// Form of a file, by its ending.
#[derive(Clone, Copy)]
enum Form<T> {
    Table(TableFormat),
    Svg,
    Png,
    Own(T),
}

/// Files whose forms and places are checked before the work.
pub struct CurveFiles<'a, T> {
    files: Vec<(&'a Path, Form<T>)>,
    overwrite: bool,
}

/// Files with their bytes, and whether each is a table that cannot hold what it was computed from.
pub struct CurveBytes<'a> {
    files: Vec<(&'a Path, Vec<u8>, bool)>,
    overwrite: bool,
}

impl<'a, T: Copy> CurveFiles<'a, T> {
    /// Files at some paths; `own` knows the endings that only this command has, `unknown` says which there are.
    pub fn at(
        paths: &'a [PathBuf],
        overwrite: bool,
        own: impl Fn(&str) -> Option<T>,
        unknown: impl Fn(PathBuf) -> Failure,
    ) -> Result<Self, Failure> {
        let checked = |path: &'a PathBuf| {
            output::check_file(path, overwrite)?;
            let ending = path.extension().map(|ending| ending.to_ascii_lowercase());
            let ending = ending.as_ref().and_then(|ending| ending.to_str()).unwrap_or_default();
            let table = TableFormat::VALUES.iter().find(|(name, ..)| *name == ending);
            let form = match (table, ending) {
                (Some((_, format, _)), _) => Some(Form::Table(*format)),
                (None, "svg") => Some(Form::Svg),
                (None, "png") => Some(Form::Png),
                _ => own(ending).map(Form::Own),
            };
            Ok((path.as_path(), form.ok_or_else(|| unknown(path.clone()))?))
        };
        let files = paths.iter().map(checked).collect::<Result<_, Failure>>()?;
        Ok(Self { files, overwrite })
    }

    /// The bytes of all files, from the columns of the curves, their picture in SVG, and what a form of the command's own makes.
    pub fn filled(
        self,
        study: &Study,
        columns: &Vec<Column>,
        svg: impl Fn(&[Column]) -> Option<String>,
        own: impl Fn(T) -> Result<Vec<u8>, Failure>,
    ) -> Result<CurveBytes<'a>, Failure> {
        let drawn = || svg(columns).unwrap_or_default();
        let bytes = |form| -> Result<Vec<u8>, Failure> {
            Ok(match form {
                Form::Table(format) => format.bytes(columns, Some(&json!(study.inputs()).to_string()))?,
                Form::Svg => drawn().into_bytes(),
                Form::Png => png(&drawn(), PIXELS)?,
                Form::Own(form) => own(form)?,
            })
        };
        let filled = |(path, form)| Ok((path, bytes(form)?, matches!(form, Form::Table(TableFormat::Csv))));
        let files = self.files.into_iter().map(filled).collect::<Result<_, Failure>>()?;
        Ok(CurveBytes { files, overwrite: self.overwrite })
    }
}

impl CurveBytes<'_> {
    /// Writes the files, with the inputs beside tables in text; whether all stand where they were asked for.
    pub fn write(self, study: &Study, quiet: bool) -> Result<bool, Failure> {
        let mut in_place = true;
        for (path, bytes, is_text) in self.files {
            let placed = output::to_file(path, self.overwrite, |out| out.write_all(&bytes))?;
            if !quiet && !output::is_stdout(path) {
                remark(&format!("wrote {}", placed.path.display()));
            }
            in_place &= placed.told(path);
            if is_text {
                in_place &= inputs_beside(&study.inputs(), &placed.path, self.overwrite)?;
            }
        }
        Ok(in_place)
    }
}
