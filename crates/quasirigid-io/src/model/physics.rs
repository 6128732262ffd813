use quasirigid_body::control::ControlProblem;
use quasirigid_elements::{Assembly, ElementError, Problem};

use super::Diagnostic;
use super::spans::Spans;

/// Diagnostic of a law of mechanics that an element breaks, at its place in the file.
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
        | Problem::Control(ControlProblem::NoField)
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
