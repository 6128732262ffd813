//! File with the input in work, so that an input survives a process that it kills.

use std::fs::File;
use std::io;
use std::os::unix::fs::FileExt;
use std::path::Path;

/// Bytes before the input: the number of executions and the length of the input.
const HEADER: usize = 16;

/// The file, of the process that executes.
#[derive(Debug)]
pub struct Scratch {
    file: File,
    executions: u64,
}

/// Content of the file of a process that has ended.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Remains {
    /// Executions begun.
    pub executions: u64,
    /// Input of the last execution.
    pub input: Vec<u8>,
}

impl Scratch {
    /// A new file at a path.
    ///
    /// # Errors
    /// What the file system says.
    pub fn new(path: &Path) -> io::Result<Self> {
        Ok(Self { file: File::create(path)?, executions: 0 })
    }

    /// Notes an input before its execution.
    ///
    /// # Errors
    /// What the file system says.
    pub fn note(&mut self, input: &[u8]) -> io::Result<()> {
        self.executions += 1;
        let mut bytes = Vec::with_capacity(HEADER + input.len());
        bytes.extend_from_slice(&self.executions.to_le_bytes());
        bytes.extend_from_slice(&(input.len() as u64).to_le_bytes());
        bytes.extend_from_slice(input);
        self.file.write_all_at(&bytes, 0)
    }
}

impl Remains {
    /// What a file holds; nothing if there is none.
    #[must_use]
    pub fn of(path: &Path) -> Self {
        let bytes = std::fs::read(path).unwrap_or_default();
        let number = |at: usize| Some(u64::from_le_bytes(bytes.get(at..at + 8)?.try_into().ok()?));
        let (Some(executions), Some(length)) = (number(0), number(8)) else { return Self::default() };
        let end = (HEADER + length as usize).min(bytes.len());
        Self { executions, input: bytes[HEADER..end].to_vec() }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_last_input_remains() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("scratch");
        let mut scratch = Scratch::new(&path).unwrap();
        scratch.note(b"a long first input").unwrap();
        scratch.note(b"second").unwrap();
        assert_eq!(Remains::of(&path), Remains { executions: 2, input: b"second".to_vec() });
        assert_eq!(Remains::of(&folder.path().join("none")), Remains::default());
    }
}
