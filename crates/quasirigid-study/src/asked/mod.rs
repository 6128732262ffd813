//! Quantities that are asked of a model and of its changed copies: values in the JSON objects that the commands print.

mod answers;
mod quantity;

pub(crate) use answers::{Answered, answers, answers_watched};
pub(crate) use quantity::{QuantityValue, find, unit};

/// Status of an answer, the best first.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Status {
    /// Every command answered.
    Answered,
    /// A command refused, in words: what is asked does not exist, or no method holds.
    Refused,
    /// The text is no model.
    Invalid,
    /// A computation failed.
    Failed,
}

impl Status {
    /// All of them, the best first.
    pub const ALL: [Self; 4] = [Self::Answered, Self::Refused, Self::Invalid, Self::Failed];

    /// The word in tables.
    #[must_use]
    pub fn word(self) -> &'static str {
        match self {
            Self::Answered => "answered",
            Self::Refused => "refused",
            Self::Invalid => "invalid",
            Self::Failed => "failed",
        }
    }

    pub(crate) fn of(word: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|status| status.word() == word)
    }
}
