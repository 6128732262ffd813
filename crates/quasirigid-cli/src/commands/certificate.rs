use std::path::Path;

use quasirigid_study::certificate::Certificate;

use crate::failure::Failure;
use crate::message::remark;
use crate::output;

/// Refuses a file that cannot be written, before the work for it starts.
pub fn check(path: Option<&Path>, overwrite: bool) -> Result<(), Failure> {
    let Some(path) = path else { return Ok(()) };
    if output::is_stdout(path) {
        return Err(Failure::CertificateOnStdout);
    }
    output::check_file(path, overwrite).map_err(|failure| match failure {
        Failure::Exists { path, .. } => Failure::Exists { path, option: "--certificate" },
        other => other,
    })
}

/// Writes a certificate, if one was asked for; returns whether it stands in its place.
pub fn write(
    certified: Option<(&Certificate, &Path)>,
    overwrite: bool,
    quiet: bool,
) -> Result<bool, Failure> {
    let Some((certificate, path)) = certified else { return Ok(true) };
    let placed = output::to_file(path, overwrite, |out| out.write_all(certificate.text().as_bytes()))?;
    if !quiet {
        remark(&format!("wrote {}", placed.path.display()));
    }
    Ok(placed.told(path))
}
