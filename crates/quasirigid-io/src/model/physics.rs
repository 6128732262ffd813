use quasirigid::elements::{Assembly, ElementError, Problem};

use super::Diagnostic;
use super::spans::Spans;

/// What a law of mechanics says against an element, at the place of the file it is about.
pub(super) fn diagnostic(error: &ElementError, assembly: &Assembly, spans: &Spans) -> Diagnostic {
    let ElementError { element, field, problem } = error;
    let span = spans.find(*element, *field);
    let message = match problem {
        Problem::Mechanism { .. } | Problem::NoInertia { .. } | Problem::NoBody => problem.to_string(),
        Problem::BesideWhole
        | Problem::InsideNothing
        | Problem::HeavyInside
        | Problem::Memory { .. }
        | Problem::NotAttached
        | Problem::Circle { .. } => {
            format!("{}: {problem}", assembly.described(*element))
        }
        _ => format!("`{field}` of {}: {problem}", assembly.described(*element)),
    };
    let diagnostic = Diagnostic::new(span, message, problem.label());
    match problem.advice(element.kind) {
        Some(help) => diagnostic.help(help),
        None => diagnostic,
    }
}
