//! Names of columns with their units: `P [h]`, `P (h)`, `period_h`, or a unit in the row below.

use crate::units::Measure;

/// Endings of names that are units and nothing else, with the unit.
const ENDINGS: [(&str, &str); 14] = [
    ("_h", "h"),
    ("_hr", "h"),
    ("_hrs", "h"),
    ("_hour", "h"),
    ("_hours", "h"),
    ("_day", "d"),
    ("_days", "d"),
    ("_min", "min"),
    ("_sec", "s"),
    ("_km", "km"),
    ("_deg", "deg"),
    ("_rad", "rad"),
    ("_kg", "kg"),
    ("_GPa", "GPa"),
];
/// Words of catalogues for units that have another name here; those that stand for pure numbers have none.
const WORDS: [(&str, &str); 18] = [
    ("hours", "h"),
    ("hour", "h"),
    ("hrs", "h"),
    ("days", "d"),
    ("day", "d"),
    ("sec", "s"),
    ("seconds", "s"),
    ("degrees", "deg"),
    ("degree", "deg"),
    ("g/cm3", "g/cm^3"),
    ("g/cm**3", "g/cm^3"),
    ("g.cm-3", "g/cm^3"),
    ("kg/m3", "kg/m^3"),
    ("kg/m**3", "kg/m^3"),
    ("kg.m-3", "kg/m^3"),
    ("mag", ""),
    ("---", ""),
    ("-", ""),
];

/// The unit that a text of a table names; empty of a pure number, none where it is no unit.
pub(super) fn unit(text: &str) -> Option<String> {
    let text = text.trim();
    if let Some((_, unit)) = WORDS.iter().find(|(word, _)| *word == text) {
        return Some((*unit).to_owned());
    }
    let measures = !text.is_empty() && !text.starts_with(|letter: char| letter.is_ascii_digit());
    (measures && Measure::parse(&format!("1 {text}")).is_ok()).then(|| text.to_owned())
}

/// The name of a column without its unit, and the unit, where the header gives one in brackets.
pub(super) fn bracketed(title: &str) -> Option<(&str, String)> {
    let pair = [('[', ']'), ('(', ')')].into_iter().find(|(_, end)| title.ends_with(*end))?;
    let inner = title.strip_suffix(pair.1)?;
    let (name, text) = inner.rsplit_once(pair.0)?;
    let name = name.trim_end();
    Some((name, unit(text)?)).filter(|_| !name.is_empty())
}

/// The name of a column without the unit that its header gives in brackets.
#[must_use]
pub fn bracketed_name(title: &str) -> Option<&str> {
    bracketed(title).map(|(name, _)| name)
}

/// The unit with which a name ends, as `period_h` does.
#[must_use]
pub fn ending(name: &str) -> Option<&'static str> {
    let (_, unit) = ENDINGS.iter().find(|(ending, _)| name.ends_with(ending) && name.len() > ending.len())?;
    Some(unit)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn units_stand_in_brackets_or_at_the_end_of_a_name() {
        assert_eq!(bracketed("P [h]"), Some(("P", "h".to_owned())));
        assert_eq!(bracketed("rho(g/cm3)"), Some(("rho", "g/cm^3".to_owned())));
        assert_eq!(bracketed("H (mag)"), Some(("H", String::new())));
        for title in ["class (SMASS)", "P", "[h]", "N (1)", "f(x"] {
            assert_eq!(bracketed(title), None, "{title}");
        }
        assert_eq!(
            [ending("period_h"), ending("D_km"), ending("_h"), ending("depth")],
            [Some("h"), Some("km"), None, None]
        );
    }
}
