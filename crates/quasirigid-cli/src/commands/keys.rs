use quasirigid_io::model::reference::{self, KeyReference, TableReference};
use textwrap::Options;

use crate::args::KeysArgs;
use crate::failure::Failure;
use crate::{ExitStatus, output};

/// Columns of a page.
const WIDTH: usize = 80;

/// Prints the keys of the model file: of one table or of all.
pub fn keys(arguments: &KeysArgs) -> Result<ExitStatus, Failure> {
    let tables = chosen(arguments.table.as_deref())?;
    let text = || tables.iter().map(page).collect::<Vec<_>>().join("\n");
    output::print_answer(arguments.json, || serde_json::json!({ "tables": tables }), text)?;
    Ok(ExitStatus::Done)
}

/// The table with a name, with brackets or without; every table where none is named.
fn chosen(name: Option<&str>) -> Result<Vec<TableReference>, Failure> {
    let mut tables = reference::tables();
    let Some(name) = name else { return Ok(tables) };
    let bare = name.trim_matches(['[', ']']);
    tables.retain(|table| table.name == bare || table.title.trim_matches(['[', ']']) == bare);
    if tables.is_empty() {
        let advice = match reference::nearest_table(bare) {
            Some(meant) => format!("did you mean {meant:?}?"),
            None => "quasirigid keys lists them".to_owned(),
        };
        return Err(Failure::NoTable { name: name.to_owned(), advice });
    }
    Ok(tables)
}

/// Keys of a table below its title, then its kinds.
fn page(table: &TableReference) -> String {
    let entries = table.keys.iter().map(|key| (key.name.clone(), told(key)));
    let kinds = table.kinds.iter().map(|kind| (format!("{:?}", kind.word), with(&kind.keys, kind.meaning)));
    let entries: Vec<(String, String)> = entries.chain(kinds).collect();
    let width = entries.iter().map(|(name, _)| name.chars().count()).max().unwrap_or_default();
    let line = |(name, text): &(String, String)| {
        let (first, rest) = (format!("  {name:width$}  "), " ".repeat(width + 4));
        let options = Options::new(WIDTH).initial_indent(&first).subsequent_indent(&rest);
        textwrap::fill(&plain(text), options).trim_end().to_owned() + "\n"
    };
    let lines: String = entries.iter().map(line).collect();
    format!("{}: {}\n{lines}", table.title, table.meaning)
}

/// Value and meaning of a key.
fn told(key: &KeyReference) -> String {
    if key.meaning.is_empty() { key.value.clone() } else { format!("{}; {}", key.value, key.meaning) }
}

/// Meaning of a kind, with the keys that not every kind has.
fn with(keys: &[&str], meaning: &str) -> String {
    let keys = keys.join(", ");
    if keys.is_empty() || meaning.is_empty() {
        format!("{keys}{meaning}")
    } else {
        format!("{keys}; {meaning}")
    }
}

/// A text without the signs of code.
fn plain(text: &str) -> String {
    text.replace('`', "")
}
