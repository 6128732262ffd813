use std::fmt;
use std::str::FromStr;

use toml_edit::Key;

use super::ChangeError;

/// Most bytes and segments of a path.
const MAX_BYTES: usize = 1000;
const DEEPEST: usize = 16;

/// Path of a key of a model, such as `spring.boom.stiffness`.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Path {
    text: String,
    segments: Vec<Segment>,
}

/// One part of a path.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Segment {
    /// The name or key.
    pub(super) text: String,
    /// The number that stands for an entry of a list, from 1; none for a text in quotes.
    pub(super) number: Option<usize>,
}

impl Path {
    /// Last segment of the path.
    #[must_use]
    pub fn key(&self) -> &str {
        self.segments.last().map_or("", |segment| &segment.text)
    }

    /// The segments, without quotes.
    pub fn names(&self) -> impl Iterator<Item = &str> {
        self.segments.iter().map(|segment| segment.text.as_str())
    }

    pub(super) fn segments(&self) -> &[Segment] {
        &self.segments
    }

    /// An error at a segment.
    pub(super) fn error(&self, segment: usize, reason: String) -> ChangeError {
        ChangeError::Nowhere { path: self.text.clone(), segment, reason }
    }
}

impl FromStr for Path {
    type Err = ChangeError;

    fn from_str(text: &str) -> Result<Self, ChangeError> {
        let refuse = |cause: String| ChangeError::NotAPath { path: shortened(text), cause };
        if text.len() > MAX_BYTES {
            return Err(refuse(format!("it has {} bytes", text.len())));
        }
        let keys = Key::parse(text).map_err(|cause| {
            let cause = cause.message().lines().next().unwrap_or("not a key").to_owned();
            refuse(cause)
        })?;
        if keys.len() > DEEPEST {
            return Err(refuse(format!("it has {} segments, more than {DEEPEST}", keys.len())));
        }
        Ok(Self { text: text.to_owned(), segments: keys.iter().map(segment).collect() })
    }
}

fn segment(key: &Key) -> Segment {
    let quoted = key.display_repr().starts_with(['"', '\'']);
    let number = if quoted { None } else { key.get().parse().ok() };
    Segment { text: key.get().to_owned(), number }
}

fn shortened(text: &str) -> String {
    text.chars().take(60).collect()
}

impl fmt::Display for Path {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.text)
    }
}
