use super::change::Template;
use super::value::Value;
use crate::study_file::{Values, Varied, vary};

/// Reads `[uncertainty]`: keys of the same file with the distributions from which studies draw them.
pub(super) fn uncertainty(value: &Value<'_>, text: &str) -> Option<Vec<Varied>> {
    let keys = vary(value)?;
    let template = match Template::new(text) {
        Ok(template) => template,
        Err(error) => {
            let help = "studies change the text of the model, so all of it must be plain TOML; write a number beyond 9.2e18 as 1e19";
            return value.refuse(error.to_string(), "cannot be drawn", help);
        }
    };
    let known = keys.iter().map(|varied| match (&varied.values, template.find(&varied.key)) {
        (Values::Drawn(_), Ok(_)) => Some(()),
        (Values::Grid(_), _) => value.refuse_at(
            varied.span.clone(),
            format!("`{}` is uncertain, so it needs a distribution, not a grid", varied.key),
            "no distribution",
            "write such as { uniform = [1.0, 2.0] } or { log-normal = { median = 100, decades = 1 } }",
        ),
        (_, Err(error)) => {
            let help = "name a key of this file by its path, such as \"material.rock.density\"";
            value.refuse_at(varied.span.clone(), error.to_string(), "no such key", help)
        }
    });
    known.collect::<Vec<_>>().into_iter().collect::<Option<Vec<()>>>()?;
    Some(keys)
}
