//! Certificates: an answer with all that is needed to check it without this program.
//! A certificate states equations and their solutions as numbers that are read back exactly; `tools/check_certificate.py` checks them, modes in
//! arithmetic of 50 digits, and shares no code with us.
//! Guide: docs/guide/24-certificates.md.

mod history;
mod modes;

use serde::Serialize;
use serde_json::{Value, json};

use crate::error::StudyError;
use crate::study::Study;
use crate::words::MAY_NOT_HOLD;

/// Kind of the document.
const KIND: &str = "quasirigid-certificate";
/// Version of the document: a checker refuses one that it does not know.
const VERSION: u32 = 1;

/// Certificate of an answer.
#[derive(Clone, Debug)]
pub struct Certificate {
    document: Value,
}

impl Certificate {
    /// The document, a JSON object that ends with a line break. Numbers are the shortest that are read back exactly.
    #[must_use]
    pub fn text(&self) -> String {
        format!("{}\n", self.document)
    }

    /// The document as a value.
    #[must_use]
    pub fn json(&self) -> &Value {
        &self.document
    }
}

/// Content of a certificate beside the model.
struct Content<'a, T: Serialize> {
    /// Command whose answer it is.
    of: &'a str,
    /// Statements in words.
    claims: Vec<String>,
    /// Statements that are not made.
    not_claimed: Vec<String>,
    /// Relative errors allowed.
    tolerances: Value,
    /// Numbers, under the key of their kind.
    witness: (&'a str, T),
}

impl Study {
    /// The document with the model, whose text and checksum stand in it.
    fn certified<T: Serialize>(&self, content: Content<T>) -> Result<Certificate, StudyError> {
        let source = &self.model.source;
        let (key, witness) = content.witness;
        let witness = json!(witness);
        if let Some(place) = not_finite(&witness, key) {
            return Err(refused(format!("{place} is not a finite number")));
        }
        let files: Vec<_> = crate::inputs::named_files(&self.model).collect();
        let doubts = self.model.notes.iter().filter(|note| note.starts_with(MAY_NOT_HOLD)).cloned();
        let not_claimed: Vec<String> = doubts.chain(content.not_claimed).collect();
        let document = json!({
            "kind": KIND,
            "version": VERSION,
            "of": content.of,
            "program": env!("CARGO_PKG_VERSION"),
            "units": "SI",
            "axes": "those of the model file, with the origin at the pole: the centre of mass at rest, or the fixed point",
            "model": { "name": self.model.name, "sha256": source.sha256, "text": source.text, "files": files },
            "claims": content.claims,
            "not_claimed": not_claimed,
            "tolerances": content.tolerances,
            key: witness,
        });
        Ok(Certificate { document })
    }
}

/// An answer without a certificate.
fn refused(reason: impl Into<String>) -> StudyError {
    StudyError::Uncertified { reason: reason.into() }
}

/// Place of a number that is not finite, which JSON cannot hold; a time constant may be none.
fn not_finite(value: &Value, place: &str) -> Option<String> {
    match value {
        Value::Null if !place.ends_with("time_constant") => Some(place.to_owned()),
        Value::Array(entries) => {
            entries.iter().enumerate().find_map(|(i, entry)| not_finite(entry, &format!("{place}[{i}]")))
        }
        Value::Object(entries) => {
            entries.iter().find_map(|(key, entry)| not_finite(entry, &format!("{place}.{key}")))
        }
        _ => None,
    }
}
