//! A formula as it is written down: its text and the names of its variables, read again when it is loaded.

use serde::{Deserialize, Serialize};

use super::{Expression, ExpressionError};

#[derive(Deserialize, Serialize)]
pub(super) struct Written {
    text: String,
    variables: Vec<String>,
}

impl From<Expression> for Written {
    fn from(Expression { text, variables, .. }: Expression) -> Self {
        Self { text, variables }
    }
}

impl TryFrom<Written> for Expression {
    type Error = ExpressionError;

    fn try_from(Written { text, variables }: Written) -> Result<Self, ExpressionError> {
        Self::parse(&text, &variables.iter().map(String::as_str).collect::<Vec<_>>())
    }
}
