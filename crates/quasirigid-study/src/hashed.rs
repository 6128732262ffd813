//! Checksum of texts and files: SHA-256 of everything that a result depends on.

use std::io::{self, Write};
use std::path::Path;

use quasirigid_io::disk::open_regular;
use sha2::{Digest, Sha256};

/// Checksum in work, as a writer.
#[derive(Default)]
pub(crate) struct Hashed(Sha256);

impl Hashed {
    /// Adds a text, apart from the next.
    pub fn text(&mut self, text: &str) {
        self.0.update(text.as_bytes());
        self.0.update([0]);
    }

    /// Adds the contents of a file, and returns their length.
    pub fn file(&mut self, path: &Path) -> io::Result<u64> {
        io::copy(&mut open_regular(path)?, self)
    }

    /// The checksum in hexadecimal.
    pub fn finish(self) -> String {
        self.0.finalize().iter().map(|byte| format!("{byte:02x}")).collect()
    }
}

impl Write for Hashed {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.0.update(bytes);
        Ok(bytes.len())
    }

    fn flush(&mut self) -> io::Result<()> {
        Ok(())
    }
}
