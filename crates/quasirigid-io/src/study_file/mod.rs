//! Study files: a model, the keys that are varied in it, and the quantities that are asked of every row.
//! A study varies keys by grids, draws them from distributions, or takes them from a table with one body in each row.
//! Keys of the model and quantities are paths; the contract is section "Studies" of the guide.

mod answer;
mod columns;
mod distribution;
mod grid;
mod measure;
mod table;
mod vary;

use std::path::{Path, PathBuf};

use answer::ANSWER;
pub use answer::{Answer, Command, Quantity, QuantityError};
use columns::COLUMN;
pub use columns::{ColumnSource, KeySource};
pub use distribution::{Distribution, Drawn};
pub use grid::Grid;
use table::TABLE;
pub use table::{TableColumn, TableSource};
pub(crate) use vary::{ANY as VALUES, vary};
pub use vary::{Values, Varied};

use crate::model::diagnostic::Problems;
use crate::model::key::{COUNT, Keys, Shape, TEXT, integer, key, named, table, words};
use crate::model::table::Table;
use crate::model::{Diagnostic, ModelError, Named, Source, syntax};

pub(crate) const STUDY: Keys = Keys {
    known: &[
        key("model", TEXT, "file, beside the study"),
        key("seed", COUNT.or("0"), "of the draws"),
        key(
            "samples",
            integer(1, MOST_SAMPLES as u64).or("1"),
            "draws for every grid point and row of the table",
        ),
        key(
            "sampling",
            words(&["random", "latin-hypercube", "sobol"]).or("`\"random\"`"),
            "spread of the draws; Sobol has at most 65536",
        ),
        key("part", integer(1, MOST_IN_PART as u64).or("4096"), "rows of a file of results"),
        key("vary", named(&Shape::Shared("values")).or("none"), "keys of the model and their values"),
        key("table", table(&TABLE).or("none"), "bodies, a row each"),
        key(
            "columns",
            named(&Shape::Any(&[Shape::Text, Shape::Table(&COLUMN)])).or("none"),
            "keys of the model and the columns that give them; the others are left out",
        ),
        key("answer", table(&ANSWER), ""),
    ],
};

/// Most draws for one point, and most rows of one part.
const MOST_SAMPLES: usize = 10_000_000_000;
pub(crate) const MOST_IN_PART: usize = 1_000_000;
/// Rows of a part unless the study says otherwise.
const PART: usize = 4096;
/// Longest Sobol sequence of the library behind it.
const MOST_SOBOL: usize = 1 << 16;

/// Method by which draws are spread.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Sampling {
    /// Independent draws.
    Random,
    /// Latin hypercube: one draw in each of as many equally probable intervals of every key as there are draws.
    LatinHypercube,
    /// Owen-scrambled Sobol sequence.
    Sobol,
}

impl Named for Sampling {
    const VALUES: &'static [(&'static str, Self, &'static str)] = &[
        ("random", Self::Random, "independent draws"),
        ("latin-hypercube", Self::LatinHypercube, "one draw in each equally probable interval"),
        ("sobol", Self::Sobol, "Owen-scrambled Sobol sequence"),
    ];
}

/// Study of many bodies, read.
#[derive(Clone, Debug, PartialEq)]
pub struct StudyFile {
    /// Text of the study.
    pub source: Source,
    /// File of the model.
    pub model: PathBuf,
    /// Seed of the draws.
    pub seed: u64,
    /// Draws for each grid point and each row of the table.
    pub samples: usize,
    /// Method by which draws are spread.
    pub sampling: Sampling,
    /// Rows of a part of the results.
    pub part: usize,
    /// Keys that are varied, in the order of the file.
    pub vary: Vec<Varied>,
    /// Table of bodies.
    pub table: Option<TableSource>,
    /// Keys that columns of the table give by `[columns]`, in the order of the file; none where the study has no such table.
    pub columns: Option<Vec<KeySource>>,
    /// Quantities of every row.
    pub answer: Answer,
    /// Notes on former names of keys and words, with those of today.
    pub former_names: Vec<String>,
}

impl StudyFile {
    /// Reads a study file.
    ///
    /// # Errors
    /// [`ModelError::Unreadable`] if there is no text to read, [`ModelError::Invalid`] with every mistake in it.
    pub fn read(path: &Path) -> Result<Self, ModelError> {
        Self::new(Source::read(path)?)
    }

    /// Reads the text of a study file; `file` stands in messages, and the model and the table are looked for beside it.
    ///
    /// # Errors
    /// [`ModelError::Invalid`] with every mistake in the text.
    pub fn parse(file: &Path, text: &str) -> Result<Self, ModelError> {
        Self::new(Source::new(file, text.to_owned()))
    }

    /// A mistake at a place of the study, in the form of those that reading finds.
    #[must_use]
    pub fn refuse(
        &self,
        span: std::ops::Range<usize>,
        message: String,
        label: &str,
        help: Option<String>,
    ) -> ModelError {
        let diagnostic = Diagnostic { span, message, label: label.to_owned(), help };
        ModelError::Invalid { model: self.source.clone(), diagnostics: vec![diagnostic] }
    }

    fn new(source: Source) -> Result<Self, ModelError> {
        let problems = Problems::new(&source.text);
        let content = content(&source, &problems);
        let diagnostics = problems.into_diagnostics();
        match content {
            Some(study) if diagnostics.is_empty() => Ok(study),
            _ => Err(ModelError::Invalid { model: source, diagnostics }),
        }
    }
}

fn content(source: &Source, problems: &Problems<'_>) -> Option<StudyFile> {
    let tree = syntax::tree(&source.text, problems)?;
    let file = Table::new("the study", 0..0, &tree, &STUDY, &|_| None, problems);
    let folder = source.file.parent().unwrap_or(Path::new(""));
    let model = file.read("model", "model = \"model.toml\"", |value| value.text());
    let seed = file.read_or("seed", 0, |value| value.integer(0..=i64::MAX as usize));
    let samples = file.get("samples").map(|value| value.integer(1..=MOST_SAMPLES));
    let sampling = file.read_or("sampling", Sampling::Random, |value| value.named());
    let part = file.read_or("part", PART, |value| value.integer(1..=MOST_IN_PART));
    let vary = file.read_or("vary", Vec::new(), |value| vary::vary(&value));
    let table = file.get("table").map(|value| table::table(&value, folder));
    let answer = match file.required("answer", "[answer] with quantities = [\"evolve.time\"]") {
        Some(value) => answer::answer(&value),
        None => None,
    };
    let columns = file.get("columns").map(|value| columns::columns(&value));
    let (vary, table) = (vary?, table.map_or(Some(None), |table| table.map(Some))?);
    let columns = columns.map_or(Some(None), |columns| columns.map(Some))?;
    if let (Some(_), Some(TableSource { columns: named, .. }), Some(value)) =
        (&columns, &table, file.get("columns"))
        && !named.is_empty()
    {
        let help = "move what stands in `columns` of [table] into [columns]";
        return value.refuse("columns are named in [columns] and in [table]", "named twice", help);
    }
    if let (Some(_), None, Some(value)) = (&columns, &table, file.get("columns")) {
        let help = "add [table] with file = \"bodies.csv\"";
        return value.refuse("[columns] without a table that has them", "no [table]", help);
    }
    let spread = columns.iter().flatten().find(|source| !source.sigma.is_empty());
    if let (None, Some(source)) = (&samples, spread) {
        let message = format!("`{}` has an uncertainty, but the study has no `samples`", source.key);
        let help = "add a line such as: samples = 100, above [columns]";
        problems.report(Diagnostic::new(source.span.clone(), message, "how many draws?").help(help));
        return None;
    }
    let drawn = vary.iter().find(|varied| matches!(varied.values, Values::Drawn(_)));
    let samples = match (samples, drawn) {
        (Some(samples), _) => samples?,
        (None, None) => 1,
        (None, Some(varied)) => {
            let message =
                format!("`{}` is drawn from a distribution, but the study has no `samples`", varied.key);
            let help = "add a line such as: samples = 1000, above [vary]";
            problems.report(Diagnostic::new(varied.span.clone(), message, "how many draws?").help(help));
            return None;
        }
    };
    let sampling = sampling?;
    if sampling == Sampling::Sobol && samples > MOST_SOBOL {
        return file.get("samples")?.refuse(
            format!("`samples` is {samples}, but a Sobol sequence here has at most {MOST_SOBOL}"),
            "too many for this sampling",
            "write sampling = \"random\" or \"latin-hypercube\", or fewer samples",
        );
    }
    if vary.is_empty() && table.is_none() && samples == 1 {
        let help = "add [vary] with keys of the model, or [table] with a file of bodies";
        problems
            .report(Diagnostic::new(0..0, "the study varies nothing", "no [vary], no [table]").help(help));
        return None;
    }
    Some(StudyFile {
        source: source.clone(),
        model: folder.join(model?),
        seed: seed? as u64,
        samples,
        sampling,
        part: part?,
        vary,
        table,
        columns,
        answer: answer?,
        former_names: problems.former_names(),
    })
}
