use std::borrow::Cow;
use std::ffi::OsString;
use std::io::{self, IsTerminal, Write};
use std::ops::Range;

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
            say(&located(&file, &text, diagnostic));
        }
        let count = diagnostics.len();
        let problems = if count == 1 { "1 problem".into() } else { format!("{count} problems") };
        remark(&format!("{file}: {problems}; nothing was computed"));
    } else {
        remark(&failure.to_string());
    }
}

/// Prints what is wrong with the arguments, or the help that they ask for; without colours where an argument would steer the terminal.
///
/// # Errors
/// Those of the system.
pub fn of_arguments(error: &clap::Error) -> io::Result<()> {
    let steers = |argument: OsString| visible(&argument.to_string_lossy()) != argument.to_string_lossy();
    if std::env::args_os().any(steers) {
        write!(io::stderr(), "{}", visible(&error.render().to_string()))
    } else {
        error.print()
    }
}

/// Prints a remark on standard error.
pub fn remark(text: &str) {
    say(&layout::message(&visible(&format!("quasirigid: {text}"))));
}

/// Prints lines on standard error. Where that is full or closed they are lost, and the work goes on.
fn say(lines: &str) {
    let _ = writeln!(std::io::stderr().lock(), "{lines}");
}

/// A diagnostic as `file:line:column: message`, the source line, and the advice.
fn located(file: &str, text: &str, diagnostic: &Diagnostic) -> String {
    let colour = std::io::stderr().is_terminal() && std::env::var_os("NO_COLOR").is_none();
    let config = Config::default().with_color(colour).with_index_type(IndexType::Byte);
    let place = Excerpt::of(text, diagnostic.span.clone());
    let span = (file, place.span.clone());
    let mut report = Report::build(ReportKind::Error, span.clone())
        .with_config(config)
        .with_message(layout::paragraph_after(&visible(&diagnostic.message), ERROR))
        .with_label(Label::new(span).with_message(visible(&diagnostic.label)).with_color(Color::Red));
    if let Some(help) = &diagnostic.help {
        report = report.with_help(layout::narrowed(&visible(help), MARGIN));
    }
    let mut bytes = Vec::new();
    let written = report.finish().write((file, Source::from(&*place.text)), &mut bytes);
    let (line, column) = diagnostic.position(text);
    match written {
        Ok(()) => {
            let (_, shown) = diagnostic.at(place.span).position(&place.text);
            let shown = format!("{file}:{line}:{shown} ");
            String::from_utf8_lossy(&bytes).replacen(&shown, &format!("{file}:{line}:{column} "), 1)
        }
        Err(_) => format!("{file}:{line}:{column}: {}", visible(&diagnostic.message)),
    }
}

/// Bytes of a line before and behind a place that are shown of a long line.
const BEFORE: usize = 60;
const BEHIND: usize = 120;

/// A text in which the line of a place is cut around the place if it is long, and the place there.
struct Excerpt<'a> {
    text: Cow<'a, str>,
    span: Range<usize>,
}

impl<'a> Excerpt<'a> {
    fn of(text: &'a str, span: Range<usize>) -> Self {
        let line_end = |at: usize| text[at..].find('\n').map_or(text.len(), |newline| at + newline);
        let (at, last) = (text.floor_char_boundary(span.start), text.floor_char_boundary(span.end));
        let start = text[..at].rfind('\n').map_or(0, |newline| newline + 1);
        let end = line_end(at);
        if text[start..line_end(last)].lines().all(|line| line.len() <= BEFORE + BEHIND) {
            return Self { text: text.into(), span };
        }
        let first = text.ceil_char_boundary(at.saturating_sub(BEFORE).max(start));
        let behind = text.floor_char_boundary((at + BEHIND).min(end));
        let before = if first > start { "…" } else { "" };
        let after = if behind < end { "…" } else { "" };
        let cut = format!("{}{before}{}{after}{}", &text[..start], &text[first..behind], &text[end..]);
        let place = at + before.len() + start - first;
        let length = span.end.min(behind).saturating_sub(at);
        Self { text: cut.into(), span: place..place + length }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Of a line of megabytes a screen line is shown, with the place at its own column.
    #[test]
    fn long_lines_are_cut_around_the_place() {
        let text = format!("first = 1\nkey = [{}]  # é\nlast = 2\n", "[], ".repeat(1_000_000));
        for at in [10, 500, 3_000_001, text.len() - 20] {
            let diagnostic =
                Diagnostic { span: at..at + 2, message: "no".into(), label: "here".into(), help: None };
            let said = located("m.toml", &text, &diagnostic);
            let (line, column) = diagnostic.position(&text);
            assert!(said.len() < 1500, "{}", said.len());
            assert!(said.contains(&format!("m.toml:{line}:{column} ")), "{said}");
            let whole = Diagnostic { span: 10..text.len() - 12, ..diagnostic };
            assert!(located("m.toml", &text, &whole).len() < 1500);
        }
    }
}
