use std::ops::Range;
use std::str::FromStr;

use crate::model::key::{Keys, Shape, key, list, words};
use crate::model::value::Value;
use crate::model::{KeyPath, Named, System};
use crate::nearest::nearest;
use crate::units::Dimension;

pub(super) const ANSWER: Keys = Keys {
    known: &[
        key("quantities", list(&Shape::Text), "paths"),
        key("times", list(&Shape::Number).in_unit("s").or("the end"), "of columns of `simulate`"),
        key(
            "system",
            words(&["full", "reduced", "rigid", "manifold"]).or("`\"reduced\"`"),
            "that `simulate` follows",
        ),
        key("percentiles", list(&Shape::Number).or("16, 50, 84"), ""),
    ],
};

/// Percentiles of a summary unless the study names others.
const PERCENTILES: [f64; 3] = [16.0, 50.0, 84.0];

/// Command whose answer a quantity is read from.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Command {
    /// Validity of the reduced equations.
    Check,
    /// Modes about the steady spin.
    Modes,
    /// Secular evolution.
    Evolve,
    /// History of the spin.
    Simulate,
    /// Verification against the full system.
    Verify,
}

impl Named for Command {
    const VALUES: &'static [(&'static str, Self, &'static str)] = &[
        ("check", Self::Check, ""),
        ("modes", Self::Modes, ""),
        ("evolve", Self::Evolve, ""),
        ("simulate", Self::Simulate, ""),
        ("verify", Self::Verify, ""),
    ];
}

/// Quantity that is asked of every row: a path into the JSON object that a command prints.
#[derive(Clone, Debug, PartialEq)]
pub struct Quantity {
    /// The path as written.
    pub name: String,
    /// Command that prints the object.
    pub command: Command,
    /// Segments below the command.
    pub path: Vec<String>,
    /// Place in the study.
    pub span: Range<usize>,
}

/// Quantities of every row.
#[derive(Clone, Debug, PartialEq)]
pub struct Answer {
    /// The quantities.
    pub quantities: Vec<Quantity>,
    /// Times (s) at which the quantities of `simulate` are taken, each as written; the end alone if there are none.
    pub times: Vec<(String, f64)>,
    /// System that `simulate` follows.
    pub system: System,
    /// Percentiles of the summary, from 0 to 100.
    pub percentiles: Vec<f64>,
}

/// Reads `[answer]`.
pub(super) fn answer(value: &Value<'_>) -> Option<Answer> {
    let table = value.table("[answer]", &ANSWER)?;
    let list = table.required("quantities", "quantities = [\"evolve.time\", \"check.valid\"]");
    let quantities = list.and_then(|list| {
        let read = list.list("a list of paths", quantity)?;
        if read.is_empty() {
            return list.refuse("there are no quantities", "empty", "name at least one");
        }
        Some(read)
    });
    let times = table.read_or("times", Vec::new(), |value| times(&value));
    let system = table.read_or("system", System::Reduced, |value| value.named());
    let percentiles = table.read_or("percentiles", PERCENTILES.to_vec(), |value| {
        value.list("a list of percentiles", |item| {
            item.between(Dimension::NUMBER, [0.0, 100.0], "between 0 and 100")
        })
    });
    let quantities = quantities?;
    for (index, one) in quantities.iter().enumerate() {
        if quantities[..index].iter().any(|other| other.name == one.name) {
            let message = format!("the quantity `{}` is asked for twice", one.name);
            return value.refuse_at(one.span.clone(), message, "again", "name each once");
        }
    }
    Some(Answer { quantities, times: times?, system: system?, percentiles: percentiles? })
}

fn quantity(value: Value<'_>) -> Option<Quantity> {
    match value.text()?.parse::<Quantity>() {
        Ok(found) => Some(Quantity { span: value.span(), ..found }),
        Err(QuantityError { message, label, help }) => value.refuse(message, label, help),
    }
}

/// Text that is no quantity.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct QuantityError {
    /// What is wrong.
    pub message: String,
    /// The same in two words, for the place in the text.
    pub label: &'static str,
    /// What to write instead; may be empty.
    pub help: String,
}

impl FromStr for Quantity {
    type Err = QuantityError;

    fn from_str(name: &str) -> Result<Self, QuantityError> {
        let refuse = |message: String, label, help| QuantityError { message, label, help };
        let path = name.parse::<KeyPath>();
        let path = path.map_err(|error| refuse(error.to_string(), "not a path", String::new()))?;
        let mut names = path.names();
        let first = names.next().unwrap_or_default();
        let Some(command) = Command::of(first) else {
            let words = Command::VALUES.iter().map(|(word, _, _)| *word);
            let meant = nearest(first, words.clone())
                .map(|word| format!("did you mean `{word}`? "))
                .unwrap_or_default();
            let list = words.collect::<Vec<_>>().join(", ");
            let message = format!("a quantity begins with a command, and `{first}` is not one");
            return Err(refuse(message, "no command", format!("{meant}the commands are {list}")));
        };
        let path: Vec<String> = names.map(str::to_owned).collect();
        if path.is_empty() {
            let help = format!(
                "write such as {first}.name; `quasirigid {first} MODEL.toml --json` shows what there is"
            );
            let message = format!("`{first}` is a command; name a quantity of its answer");
            return Err(refuse(message, "a command", help));
        }
        Ok(Self { name: name.to_owned(), command, path, span: 0..0 })
    }
}

impl std::fmt::Display for QuantityError {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let gap = if self.help.is_empty() { "" } else { "; " };
        write!(f, "{}{gap}{}", self.message, self.help)
    }
}

impl std::error::Error for QuantityError {}

/// Reads times that ascend.
fn times(value: &Value<'_>) -> Option<Vec<(String, f64)>> {
    let read = value.list("a list of times", |item| {
        let seconds = item.positive(Dimension::TIME)?;
        Some((item.words().map_or_else(|| format!("{seconds} s"), str::to_owned), seconds))
    })?;
    if read.windows(2).any(|pair| !(pair[0].1 < pair[1].1)) {
        return value.refuse("the times do not ascend", "in this order", "write the earliest first");
    }
    Some(read)
}
