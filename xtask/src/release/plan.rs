//! The steps of a release, as data: a dry run prints them, a run does them.

use std::fmt;

/// Folder of what is built.
pub const FOLDER: &str = "dist";
/// Files beside the program in its archive.
pub const BESIDE: [&str; 5] = ["README.md", "CHANGELOG.md", "LICENSE-APACHE", "LICENSE-MIT", "NOTICE"];
/// Packages with a list of materials, and the features that they are built with.
const PACKAGES: [(&str, &str); 2] = [("quasirigid-cli", " --all-features"), ("quasirigid-python", "")];

/// What a release is made of.
#[derive(Clone, Debug)]
pub struct Release {
    pub version: String,
    /// Seconds since 1970 of the commit, the date of every file.
    pub epoch: String,
    /// Platform, such as `x86_64-unknown-linux-gnu`.
    pub host: String,
    /// Profile of cargo.
    pub profile: String,
    /// Folder of cargo's output.
    pub target: String,
    /// Interpreter that has maturin.
    pub python: String,
}

/// A step.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Step {
    /// A program and its arguments.
    Run(Vec<String>),
    /// Copies of files, in a new folder.
    Gather { files: Vec<String>, folder: String },
    /// The list of the materials of a package with some features.
    Materials { package: &'static str, features: &'static str, file: String },
    /// SHA-256 of every file of the folder.
    Checksums { file: String },
}

/// Steps that build a release, in order.
pub fn plan(release: &Release) -> Vec<Step> {
    let Release { version, epoch, host, profile, target, python } = release;
    let name = format!("quasirigid-{version}-{host}");
    let words = |command: &str| command.split(' ').map(str::to_owned).collect::<Vec<_>>();
    let built = format!("{target}/{profile}/quasirigid{}", std::env::consts::EXE_SUFFIX);
    let files = std::iter::once(built).chain(BESIDE.map(str::to_owned)).collect();
    let mut archive = words("tar --sort=name --owner=0 --group=0 --numeric-owner --mode=go-w -C");
    archive.extend([FOLDER.into(), format!("--mtime=@{epoch}"), "--use-compress-program=gzip -n".into()]);
    archive.extend(words(&format!("-cf {FOLDER}/{name}.tar.gz {name}")));
    let mut wheel = vec![python.clone()];
    wheel.extend(words(&format!("-m maturin build --profile {profile} --locked --sdist --out {FOLDER}")));
    let mut steps = vec![
        Step::Run(words(&format!(
            "cargo build --profile {profile} --locked -p quasirigid-cli --all-features"
        ))),
        Step::Gather { files, folder: format!("{FOLDER}/{name}") },
        Step::Run(archive),
        Step::Run(wheel),
    ];
    steps.extend(PACKAGES.map(|(package, features)| {
        let file = format!("{FOLDER}/{package}-{version}.cdx.json");
        Step::Materials { package, features, file }
    }));
    steps.push(Step::Checksums { file: format!("{FOLDER}/SHA256SUMS") });
    steps
}

impl fmt::Display for Step {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Run(command) => write!(f, "run {}", shown(command)),
            Self::Gather { files, folder } => write!(f, "copy {} into {folder}", files.join(", ")),
            Self::Materials { package, file, .. } => write!(f, "list the materials of {package} in {file}"),
            Self::Checksums { file } => write!(f, "write the SHA-256 of each file to {file}"),
        }
    }
}

/// A command as a shell takes it.
pub fn shown(command: &[String]) -> String {
    let quoted =
        command.iter().map(|word| if word.contains(' ') { format!("'{word}'") } else { word.clone() });
    quoted.collect::<Vec<_>>().join(" ")
}

/// What a person does with a release that is built.
pub fn next(version: &str) -> String {
    format!(
        "\
A person does the rest:
  1. a second person does the same on the tag and compares {FOLDER}/SHA256SUMS
  2. git tag --sign v{version} --message \"quasirigid {version}\" && git push origin v{version}
  3. ssh-keygen -Y sign -n file -f KEY {FOLDER}/SHA256SUMS
  4. the files of {FOLDER} go to the release of the tag, the wheel and the source distribution to PyPI
  5. for crate in -linear -math -mesh -body -elements -dynamics \"\" -io -report -study -cli; do
         cargo publish --locked -p quasirigid$crate
     done"
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_plan_builds_archives_lists_and_checksums_in_this_order() {
        let release = Release {
            version: "0.2.0".into(),
            epoch: "1764547200".into(),
            host: "x86_64-unknown-linux-gnu".into(),
            profile: "release".into(),
            target: "target".into(),
            python: "python3".into(),
        };
        let shown: Vec<String> = plan(&release).iter().map(ToString::to_string).collect();
        let name = "quasirigid-0.2.0-x86_64-unknown-linux-gnu";
        assert_eq!(
            shown,
            [
                "run cargo build --profile release --locked -p quasirigid-cli --all-features".to_owned(),
                format!(
                    "copy target/release/quasirigid{}, README.md, CHANGELOG.md, LICENSE-APACHE, LICENSE-MIT, NOTICE into dist/{name}",
                    std::env::consts::EXE_SUFFIX
                ),
                format!(
                    "run tar --sort=name --owner=0 --group=0 --numeric-owner --mode=go-w -C dist --mtime=@1764547200 \
                     '--use-compress-program=gzip -n' -cf dist/{name}.tar.gz {name}"
                ),
                "run python3 -m maturin build --profile release --locked --sdist --out dist".to_owned(),
                "list the materials of quasirigid-cli in dist/quasirigid-cli-0.2.0.cdx.json".to_owned(),
                "list the materials of quasirigid-python in dist/quasirigid-python-0.2.0.cdx.json".to_owned(),
                "write the SHA-256 of each file to dist/SHA256SUMS".to_owned(),
            ]
        );
    }
}
