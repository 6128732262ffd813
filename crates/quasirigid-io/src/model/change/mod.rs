//! Changed copies of a model: values replaced by path in the text of the file.
//! Studies and programs name keys by one kind of path, such as `spring.boom.stiffness`; all else in the text stays, comments included.
//! A path leads through tables and lists that are there, and its last segment may be a new key, which the reader of the model then judges.

mod error;
mod node;
mod number;
mod path;

use toml_edit::{DocumentMut, Item, Table};

pub use error::ChangeError;
pub use number::WrittenNumber;
pub use path::Path;

use super::key_value::KeyValue;
use node::Node;

/// Tables that stand once and that a path may begin although the file leaves them out.
const OPTIONAL: [&str; 3] = ["body", "initial", "run"];

/// Text of a model with values replaced by path: `[("spring.boom.stiffness", "600 N/m".into())]`.
///
/// A path is a table, the name or the number (from 1) of an entry where the table is a list, and a key; further segments are keys of inner
/// tables and numbers (from 1) of components. Names with blanks or dots stand in quotes, as in TOML; a number in quotes is a name.
///
/// ```
/// use quasirigid_io::model::changed;
///
/// let text = "[[spring]]\nname = \"boom\"\nstiffness = 500.0 # N/m\n";
/// let stiffer = changed(text, &[("spring.boom.stiffness", "6 kN/m".into())])?;
/// assert_eq!(stiffer, "[[spring]]\nname = \"boom\"\nstiffness = \"6 kN/m\" # N/m\n");
/// # Ok::<(), quasirigid_io::model::ChangeError>(())
/// ```
///
/// # Errors
/// [`ChangeError`] for a text that is not TOML, and for a path that leads nowhere.
pub fn changed(text: &str, changes: &[(&str, KeyValue)]) -> Result<String, ChangeError> {
    let template = Template::new(text)?;
    let changes = changes.iter().map(|(path, given)| Ok((path.parse::<Path>()?, given.clone())));
    template.changed(&changes.collect::<Result<Vec<_>, ChangeError>>()?)
}

/// A model text read once, of which many changed copies are made.
#[derive(Clone, Debug)]
pub struct Template {
    document: DocumentMut,
}

impl Template {
    /// Reads the text of a model.
    ///
    /// # Errors
    /// [`ChangeError::NotToml`].
    pub fn new(text: &str) -> Result<Self, ChangeError> {
        let document = text.parse::<DocumentMut>();
        let document =
            document.map_err(|cause| ChangeError::NotToml { cause: cause.message().to_owned() })?;
        Ok(Self { document })
    }

    /// The text with values replaced by path.
    ///
    /// # Errors
    /// [`ChangeError`] for a path that leads nowhere.
    pub fn changed(&self, changes: &[(Path, KeyValue)]) -> Result<String, ChangeError> {
        let mut document = self.document.clone();
        for (path, given) in changes {
            place(&mut document, path, given)?;
        }
        Ok(document.to_string())
    }

    /// Whether a path leads to a value or to a place for one, and to which.
    ///
    /// # Errors
    /// [`ChangeError`] for a path that leads nowhere.
    pub fn find(&self, path: &Path) -> Result<KeyContent, ChangeError> {
        let mut document = self.document.clone();
        let probe = KeyValue::Bool(false);
        let before = with(&mut document, path, |node, last| Ok(node.get(last).map(Node::found)))?;
        // an entry that is there may still not be replaced by a plain value
        place(&mut document, path, &probe)?;
        Ok(before.unwrap_or(KeyContent::New))
    }
}

/// Content of the place that a path leads to.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum KeyContent {
    /// A value that is no list and no table.
    Plain,
    /// A list or a table.
    Compound,
    /// No value: the key is new in its table.
    New,
}

/// Puts a value at the place of a path.
fn place(document: &mut DocumentMut, path: &Path, given: &KeyValue) -> Result<(), ChangeError> {
    with(document, path, |mut node, last| {
        node.put(last, given.written(), matches!(given, KeyValue::Table(_) | KeyValue::List(_)))
    })
}

/// Calls a function with the table or list above the last segment of a path.
fn with<T>(
    document: &mut DocumentMut,
    path: &Path,
    work: impl FnOnce(Node<'_>, &path::Segment) -> Result<T, String>,
) -> Result<T, ChangeError> {
    let (last, above) =
        path.segments().split_last().ok_or_else(|| path.error(0, "the path is empty".to_owned()))?;
    if let Some(first) = above.first().map(|segment| segment.text.as_str())
        && OPTIONAL.contains(&first)
        && !document.contains_key(first)
    {
        document.insert(first, Item::Table(Table::new()));
    }
    let mut node = Node::Table(document.as_table_mut());
    for (at, segment) in above.iter().enumerate() {
        node = node.below(segment).map_err(|reason| path.error(at, reason))?;
    }
    work(node, last).map_err(|reason| path.error(above.len(), reason))
}
