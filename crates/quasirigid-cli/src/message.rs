use std::ffi::OsString;
use std::io::IsTerminal;

use ariadne::{Color, Config, IndexType, Label, Report, ReportKind, Source};
use quasirigid_io::model::{Diagnostic, ModelError};

use crate::failure::Failure;
use quasirigid_io::visible::{masked, visible};
use quasirigid_study::layout;

/// Columns before a message, `Error: `.
const ERROR: usize = 7;
/// Columns before the advice, `│ Help: `, with the line numbers of long files.
const MARGIN: usize = 15;

/// Prints a failure on standard error: for a mistake in a model file with the line it is on.
pub fn print(failure: &Failure) {
    if let Some(ModelError::Invalid { model, diagnostics }) = failure.model() {
        let file = masked(&model.file.display().to_string());
        let text = masked(&model.text);
        for diagnostic in diagnostics {
            eprintln!("{}", located(&file, &text, diagnostic));
        }
        let count = diagnostics.len();
        let problems = if count == 1 { "1 problem".into() } else { format!("{count} problems") };
        remark(&format!("{file}: {problems}; nothing was computed"));
    } else {
        remark(&failure.to_string());
    }
}

/// Prints what is wrong with the arguments, or the help that they ask for; without colours where an argument would steer the terminal.
pub fn of_arguments(error: &clap::Error) {
    let steers = |argument: OsString| visible(&argument.to_string_lossy()) != argument.to_string_lossy();
    if std::env::args_os().any(steers) {
        eprint!("{}", visible(&error.render().to_string()));
    } else {
        let _ = error.print(); // nobody is left to tell
    }
}

/// Prints a remark on standard error.
pub fn remark(text: &str) {
    eprintln!("{}", layout::message(&visible(&format!("quasirigid: {text}"))));
}

/// A diagnostic as `file:line:column: message`, the source line, and the advice.
fn located(file: &str, text: &str, diagnostic: &Diagnostic) -> String {
    let colour = std::io::stderr().is_terminal() && std::env::var_os("NO_COLOR").is_none();
    let config = Config::default().with_color(colour).with_index_type(IndexType::Byte);
    let span = (file, diagnostic.span.clone());
    let mut report = Report::build(ReportKind::Error, span.clone())
        .with_config(config)
        .with_message(layout::paragraph_after(&visible(&diagnostic.message), ERROR))
        .with_label(Label::new(span).with_message(visible(&diagnostic.label)).with_color(Color::Red));
    if let Some(help) = &diagnostic.help {
        report = report.with_help(layout::narrowed(&visible(help), MARGIN));
    }
    let mut bytes = Vec::new();
    let written = report.finish().write((file, Source::from(text)), &mut bytes);
    let (line, column) = diagnostic.position(text);
    match written {
        Ok(()) => String::from_utf8_lossy(&bytes).into_owned(),
        Err(_) => format!("{file}:{line}:{column}: {}", visible(&diagnostic.message)),
    }
}
