use super::key::Keys;
use super::table::Table;
use super::value::{Value, alternatives};

/// A kind of table, chosen by one of its keys, such as `kind`.
pub(super) struct Kind<R: 'static> {
    /// The word that chooses the kind.
    pub(super) word: &'static str,
    /// The table as messages call it.
    pub(super) title: &'static str,
    /// Keys of the table.
    pub(super) keys: Keys,
    /// Meaning of the kind; empty where the word says it.
    pub(super) meaning: &'static str,
    /// Function that reads the table.
    pub(super) read: R,
}

/// A kind, titled by the table, the key and its word; its keys are some of the `ANY` of its file.
macro_rules! kind {
    ($table:literal, $word:literal, $names:expr, $meaning:literal, $read:expr) => {
        kind!($table, "kind", $word, $names, $meaning, $read)
    };
    ($table:literal, $key:literal, $word:literal, $names:expr, $meaning:literal, $read:expr) => {
        Kind {
            word: $word,
            title: concat!($table, " of ", $key, " \"", $word, "\""),
            keys: Keys { known: &pick(ANY.known, $names) },
            meaning: $meaning,
            read: $read,
        }
    };
}
pub(super) use kind;

/// Documentation of a kind of table.
pub(super) struct Variant {
    pub(super) word: &'static str,
    pub(super) keys: &'static Keys,
    pub(super) meaning: &'static str,
}

/// Documentation of kinds.
pub(super) fn variants<R>(kinds: &'static [Kind<R>]) -> Vec<Variant> {
    kinds.iter().map(|kind| Variant { word: kind.word, keys: &kind.keys, meaning: kind.meaning }).collect()
}

/// Opens a table of the kind that one of its keys names; `title` and `any` are the name and the keys of a table without that key.
pub(super) fn opened<'a, R>(
    value: &Value<'a>,
    title: &'static str,
    key: &'static str,
    any: &'static Keys,
    kinds: &'static [Kind<R>],
) -> Option<(Table<'a>, &'static Kind<R>)> {
    let Some(word) = value.entry(key) else {
        let words: Vec<String> = kinds.iter().map(|kind| format!("{:?}", kind.word)).collect();
        value.table(title, any)?.required(key, &format!("{key} = {}", alternatives(&words)));
        return None;
    };
    let choices: Vec<_> = kinds.iter().map(|kind| (kind.word, kind)).collect();
    let kind = word.choice(&choices)?;
    let others = |unknown: &str| {
        let with = kinds.iter().filter(|kind| kind.keys.has(unknown));
        let words: Vec<String> = with.map(|kind| format!("{key} = {:?}", kind.word)).collect();
        (!words.is_empty()).then(|| alternatives(&words))
    };
    Some((value.table_among(kind.title, &kind.keys, &others)?, kind))
}

/// The kind that an opened table names.
pub(super) fn of_table<R>(
    table: &Table<'_>,
    key: &'static str,
    kinds: &'static [Kind<R>],
) -> Option<&'static Kind<R>> {
    let word = table.get(key)?.words()?;
    kinds.iter().find(|kind| kind.word == word)
}
