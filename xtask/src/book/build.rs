use std::io::ErrorKind;
use std::path::Path;
use std::process::Command;

/// Builds the pages with mdBook; where that is not installed, says so.
///
/// # Errors
/// A sentence, if mdBook fails.
pub fn build(root: &Path) -> Result<(), String> {
    match Command::new("mdbook").arg("build").arg(root.join(super::SOURCE)).current_dir(root).status() {
        Ok(status) if status.success() => Ok(()),
        Ok(status) => Err(format!("mdbook failed, {status}")),
        Err(error) if error.kind() == ErrorKind::NotFound => {
            println!(
                "xtask book: mdbook is not installed (cargo install mdbook --locked), so no pages were built"
            );
            Ok(())
        }
        Err(error) => Err(format!("mdbook does not run: {error}")),
    }
}
