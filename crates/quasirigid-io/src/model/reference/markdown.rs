//! Tables of the guide, and the places in its chapters where they stand:
//! `<!-- keys: point spring -->` and `<!-- kinds: force -->`, up to `<!-- end -->`.

use super::{KeyReference, TableReference};

const END: &str = "<!-- end -->";

/// A chapter with its generated tables written anew.
///
/// # Errors
/// A marker that names no table, or is not closed.
pub fn filled(chapter: &str) -> Result<String, String> {
    let tables = super::tables();
    let (mut filled, mut rest) = (String::new(), chapter);
    while let Some(start) = rest.find("<!-- k") {
        let (before, marked) = rest.split_at(start);
        let (marker, _) = marked.split_once('\n').ok_or("a marker ends the chapter")?;
        let (_, after) = marked.split_once(END).ok_or_else(|| format!("{marker} has no {END}"))?;
        filled += &format!("{before}{marker}\n{}{END}", generated(marker, &tables)?);
        rest = after;
    }
    Ok(filled + rest)
}

fn generated(marker: &str, tables: &[TableReference]) -> Result<String, String> {
    let words = marker.trim_start_matches("<!-- ").trim_end_matches(" -->");
    let (what, names) = words.split_once(": ").ok_or_else(|| format!("{marker} names no table"))?;
    let find = |name| {
        let table = tables.iter().find(|table| table.name == name);
        table.ok_or_else(|| format!("{marker}: there is no table {name:?}"))
    };
    let named: Vec<&TableReference> = names.split(' ').map(find).collect::<Result<_, _>>()?;
    match (what, named.as_slice()) {
        ("keys", tables) => Ok(keys(tables)),
        ("kinds", [table]) => Ok(kinds(table)),
        _ => Err(format!("{marker} asks for neither keys nor the kinds of a table")),
    }
}

/// Keys of tables; those that several of them have alike stand once, at the end.
fn keys(tables: &[&TableReference]) -> String {
    let holders = |key: &KeyReference| -> Vec<&str> {
        tables.iter().filter(|table| table.keys.contains(key)).map(|table| table.name).collect()
    };
    let mut rows = Rows::new("table, key", "value (default)");
    for table in tables {
        let mut label = format!("**`{}`** ", table.title);
        for key in table.keys.iter().filter(|key| holders(key).len() == 1) {
            rows.add(&std::mem::take(&mut label), key);
        }
    }
    let mut listed: Vec<&KeyReference> = Vec::new();
    let mut last = Vec::new();
    for key in tables.iter().flat_map(|table| &table.keys) {
        let with = holders(key);
        if with.len() > 1 && !listed.contains(&key) {
            let label = if with == last { String::new() } else { format!("*{}:* ", with.join(", ")) };
            rows.add(&label, key);
            listed.push(key);
            last = with;
        }
    }
    rows.text
}

/// Kinds of a table, each with the keys that not every kind has.
fn kinds(table: &TableReference) -> String {
    let chosen = table.keys.first().map_or("", |key| key.name.as_str());
    let mut rows = Rows::new(&format!("`{chosen}`"), "keys");
    for kind in &table.kinds {
        let keys = kind.keys.iter().map(|key| format!("`{key}`")).collect::<Vec<_>>().join(", ");
        rows.row(&format!("`{:?}`", kind.word), &keys, kind.meaning);
    }
    rows.text
}

/// Rows of a table in Markdown.
struct Rows {
    text: String,
}

impl Rows {
    fn new(first: &str, second: &str) -> Self {
        Self { text: format!("|{first}|{second}|meaning|\n|---|---|---|\n") }
    }

    fn add(&mut self, label: &str, key: &KeyReference) {
        self.row(&format!("{label}`{}`", key.name), &key.value, key.meaning);
    }

    fn row(&mut self, first: &str, second: &str, third: &str) {
        self.text += &format!("|{first}|{second}|{third}|\n");
    }
}
