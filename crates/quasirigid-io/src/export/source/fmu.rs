//! Functional mock-up units of FMI 2.0 and 3.0: the C source with its description in an archive, compiled where there is a compiler.

use std::env::consts::{ARCH, DLL_EXTENSION, OS};
use std::fs;
use std::io::{Cursor, Write};
use std::path::Path;
use std::process::{Command, Stdio};

use sha2::{Digest, Sha256};
use zip::ZipWriter;
use zip::write::SimpleFileOptions;

use super::fmi_description::{BUILD, described};
use super::language::{FileName, Language};
use super::{FreeBody, SourceFile, languages};

/// Version of the standard.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Fmi {
    /// FMI 2.0.
    Two,
    /// FMI 3.0.
    Three,
}

impl Fmi {
    fn language(self) -> Language {
        let files = match self {
            Self::Two => &TWO,
            Self::Three => &THREE,
        };
        Language { files, ..languages::C }
    }

    /// Name of this platform in the standard, if it has one.
    fn platform(self) -> Option<String> {
        match (self, ARCH, OS) {
            (Self::Two, "x86_64", "linux") => Some("linux64".into()),
            (Self::Two, "x86_64", "macos") => Some("darwin64".into()),
            (Self::Three, "x86_64" | "aarch64", "linux") => Some(format!("{ARCH}-linux")),
            (Self::Three, "x86_64" | "aarch64", "macos") => Some(format!("{ARCH}-darwin")),
            _ => None,
        }
    }
}

/// Names of files with a hyphen are never those of a body.
const HEADER: (FileName, &str) = (FileName::Ending(".h"), include_str!("templates/body.h"));
const BODY: (FileName, &str) = (FileName::Ending(".c"), include_str!("templates/body.c"));
const SHARED: (FileName, &str) = (FileName::Whole("fmi-unit.h"), include_str!("templates/fmi-unit.h"));
const TWO: [(FileName, &str); 4] =
    [HEADER, BODY, SHARED, (FileName::Whole("fmi-2.c"), include_str!("templates/fmi2.c"))];
const THREE: [(FileName, &str); 4] =
    [HEADER, BODY, SHARED, (FileName::Whole("fmi-3.c"), include_str!("templates/fmi3.c"))];

/// A functional mock-up unit.
#[derive(Clone, Debug)]
pub struct Fmu {
    /// The archive.
    pub bytes: Vec<u8>,
    /// Whether it holds a library for this platform, beside the source.
    pub compiled: bool,
}

impl FreeBody<'_> {
    /// The body as a functional mock-up unit for model exchange and co-simulation.
    #[must_use]
    pub fn fmu(&self, version: Fmi) -> Fmu {
        let token = self.token();
        let sources = self.sources(&version.language(), &token);
        let library = version.platform().and_then(|platform| {
            let bytes = compiled(self.name, &sources)?;
            Some((format!("binaries/{platform}/{}.{DLL_EXTENSION}", self.name), bytes))
        });
        let compiled = library.is_some();
        let mut entries =
            vec![("modelDescription.xml".to_owned(), described(self, version, &token).into_bytes())];
        entries.extend(library);
        if version == Fmi::Three {
            entries.push((
                "sources/buildDescription.xml".into(),
                BUILD.replace("{{name}}", self.name).into_bytes(),
            ));
        }
        let named = |file: SourceFile| (format!("sources/{}", file.name), file.text.into_bytes());
        entries.extend(sources.into_iter().map(named));
        Fmu { bytes: archive(&entries), compiled }
    }

    /// Hash of the equations, by which a description and a library know each other.
    fn token(&self) -> String {
        let files = self.sources(&Fmi::Three.language(), "");
        let mut hash = Sha256::new();
        files.iter().for_each(|file| hash.update(&file.text));
        let hex: String = hash.finalize().iter().take(16).map(|byte| format!("{byte:02x}")).collect();
        let parts = [0..8, 8..12, 12..16, 16..20, 20..32].map(|range| &hex[range]);
        format!("{{{}}}", parts.join("-"))
    }
}

/// The bytes of the library that the C compiler makes of some files; none without a compiler that does.
fn compiled(name: &str, sources: &[SourceFile]) -> Option<Vec<u8>> {
    let folder = tempfile::tempdir().ok()?;
    sources.iter().try_for_each(|file| fs::write(folder.path().join(&file.name), &file.text)).ok()?;
    let units = sources
        .iter()
        .map(|file| file.name.as_str())
        .filter(|file| Path::new(file).extension() == Some("c".as_ref()));
    let status = Command::new("cc")
        .args(["-std=c99", "-O2", "-fPIC", "-shared", "-fvisibility=hidden", "-o", name])
        .args(units)
        .arg("-lm")
        .current_dir(folder.path())
        .stdin(Stdio::null())
        .stdout(Stdio::null())
        .stderr(Stdio::null())
        .status();
    let done = status.is_ok_and(|status| status.success());
    done.then(|| fs::read(folder.path().join(name)).ok()).flatten()
}

/// An archive that is the same for the same files.
fn archive(entries: &[(String, Vec<u8>)]) -> Vec<u8> {
    let mut archive = ZipWriter::new(Cursor::new(Vec::new()));
    for (name, bytes) in entries {
        let started = archive.start_file(name.as_str(), SimpleFileOptions::DEFAULT);
        started.expect("no name stands twice");
        archive.write_all(bytes).expect("memory takes any bytes");
    }
    archive.finish().expect("memory takes any bytes").into_inner()
}
