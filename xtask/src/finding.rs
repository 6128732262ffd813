use std::fmt;

/// Something a check found, and where.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Finding {
    /// Path relative to the workspace root.
    pub file: String,
    /// Line, from 1.
    pub line: usize,
    /// Whether the finding fails the check.
    pub weight: Weight,
    /// Problem, and its remedy.
    pub message: String,
}

/// Weight of a finding.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Weight {
    /// Fails the check.
    Error,
    /// Is printed and passes.
    Warning,
}

impl Finding {
    /// A finding that fails the check.
    pub fn error(file: &str, line: usize, message: impl Into<String>) -> Self {
        Self { file: file.to_owned(), line, weight: Weight::Error, message: message.into() }
    }

    /// A finding that is printed and passes.
    pub fn warning(file: &str, line: usize, message: impl Into<String>) -> Self {
        Self { weight: Weight::Warning, ..Self::error(file, line, message) }
    }
}

impl fmt::Display for Finding {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let prefix = match self.weight {
            Weight::Error => "",
            Weight::Warning => "warning: ",
        };
        write!(f, "{}:{}: {prefix}{}", self.file, self.line, self.message)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_finding_prints_as_a_place_an_editor_can_open() {
        assert_eq!(Finding::error("a/b.rs", 7, "wrong").to_string(), "a/b.rs:7: wrong");
        assert_eq!(Finding::warning("a/b.rs", 7, "odd").to_string(), "a/b.rs:7: warning: odd");
    }
}
