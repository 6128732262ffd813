use std::ops::Range;

use super::distribution::{self, Drawn};
use super::grid::{self, Grid};
use crate::model::KeyPath;
use crate::model::key::Keys;
use crate::model::value::Value;

/// Key of a model with the values that it takes.
#[derive(Clone, Debug, PartialEq)]
pub struct Varied {
    /// The key.
    pub key: KeyPath,
    /// Place of the values in the file.
    pub span: Range<usize>,
    /// The values.
    pub values: Values,
}

/// Values of a key.
#[derive(Clone, Debug, PartialEq)]
pub enum Values {
    /// One after the other.
    Grid(Grid),
    /// Drawn from a distribution.
    Drawn(Drawn),
}

impl Values {
    /// The unit of the numbers; none for plain ones.
    #[must_use]
    pub fn unit(&self) -> Option<&str> {
        match self {
            Self::Grid(grid) => grid.unit(),
            Self::Drawn(drawn) => drawn.unit.as_deref(),
        }
    }
}

/// Keys of the tables that a varied key may have, in the order in which messages list them.
const KINDS: [&str; 7] = ["linear", "geometric", "list", "uniform", "log-uniform", "normal", "log-normal"];
pub(crate) const ANY: Keys = Keys {
    known: &[
        grid::LINEAR.known[0],
        grid::GEOMETRIC.known[0],
        grid::LIST.known[0],
        distribution::UNIFORM.known[0],
        distribution::LOG_UNIFORM.known[0],
        distribution::NORMAL.known[0],
        distribution::LOG_NORMAL.known[0],
        grid::LINEAR.known[1],
    ],
};

/// Reads `[vary]` of a study, or `[uncertainty]` of a model, in the order of the file.
pub(crate) fn vary(value: &Value<'_>) -> Option<Vec<Varied>> {
    let Some(entries) = value.entries() else {
        return value.mismatch("a table", "write a line for each key of the model");
    };
    let mut entries: Vec<_> = entries.collect();
    entries.sort_by_key(|(span, _)| span.start);
    let read: Vec<_> = entries.iter().map(|(span, value)| varied(span.clone(), value)).collect();
    let read: Vec<Varied> = read.into_iter().collect::<Option<_>>()?;
    for (index, one) in read.iter().enumerate() {
        if read[..index].iter().any(|other| other.key.names().eq(one.key.names())) {
            let help = "vary each key once";
            return value.refuse_at(
                one.span.clone(),
                format!("`{}` is varied twice", one.key),
                "again",
                help,
            );
        }
    }
    Some(read)
}

/// Reads one key with its values.
fn varied(span: Range<usize>, value: &Value<'_>) -> Option<Varied> {
    let help = "write such as { linear = [1.0, 2.0], count = 11 } or { uniform = [1.0, 2.0] }";
    if !value.is_table() {
        return value.mismatch("a table with the values", help);
    }
    let key = match value.key().parse::<KeyPath>() {
        Ok(key) => key,
        Err(error) => {
            let help = "write the path of a key in quotes, such as \"spring.boom.stiffness\"";
            return value.refuse_at(span, error.to_string(), "not a path", help);
        }
    };
    let kind = KINDS.into_iter().find(|kind| value.entry(kind).is_some());
    let values = match kind {
        Some("linear") => {
            Values::Grid(grid::numbers(&value.table("a linear grid", &grid::LINEAR)?, "linear")?)
        }
        Some("geometric") => {
            Values::Grid(grid::numbers(&value.table("a geometric grid", &grid::GEOMETRIC)?, "geometric")?)
        }
        Some("list") => Values::Grid(grid::list(&value.table("a list", &grid::LIST)?.get("list")?)?),
        Some("uniform") => Values::Drawn(distribution::uniform(
            &value.table("a distribution", &distribution::UNIFORM)?.get("uniform")?,
            false,
        )?),
        Some("log-uniform") => Values::Drawn(distribution::uniform(
            &value.table("a distribution", &distribution::LOG_UNIFORM)?.get("log-uniform")?,
            true,
        )?),
        Some("normal") => Values::Drawn(distribution::normal(
            &value.table("a distribution", &distribution::NORMAL)?.get("normal")?,
        )?),
        Some(_) => Values::Drawn(distribution::log_normal(
            &value.table("a distribution", &distribution::LOG_NORMAL)?.get("log-normal")?,
        )?),
        None => {
            value.table("the values of a key", &ANY)?;
            let message = format!("`{key}` has no values");
            return value.refuse(message, "no values", format!("write one of {}: {help}", KINDS.join(", ")));
        }
    };
    Some(Varied { key, span: value.span(), values })
}
