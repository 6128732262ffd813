use thiserror::Error;

/// A change of a model that cannot be made.
#[derive(Clone, Debug, Error, PartialEq, Eq)]
#[non_exhaustive]
pub enum ChangeError {
    /// The text of the model is not TOML.
    #[error("the model is not valid TOML: {cause}")]
    NotToml {
        /// Message of the parser.
        cause: String,
    },
    /// A path that is not written like keys of TOML.
    #[error(
        "the path `{path}` cannot be read: {cause}; write table, name or number, key, with dots between them"
    )]
    NotAPath {
        /// The path.
        path: String,
        /// Message of the parser.
        cause: String,
    },
    /// A segment of a path that leads nowhere.
    #[error("`{path}`: {reason}")]
    Nowhere {
        /// The path.
        path: String,
        /// Number of the segment, from 0.
        segment: usize,
        /// Reason, with the entries that are there instead.
        reason: String,
    },
}
