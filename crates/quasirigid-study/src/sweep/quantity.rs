//! Quantities as paths into the JSON objects of the commands, and their units.
//! A list of objects is entered by the name of an entry or its number from 0, another list by number; below `modes` the names of the modes
//! may follow directly.

use quasirigid_io::study_file::{Command, Quantity};
use serde_json::Value;

/// Value that a path leads to, or why it leads to none.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Found<'a> {
    /// A value.
    Value(&'a Value),
    /// A number that is infinite: JSON writes it as `null`.
    Infinite,
    /// A value that is not known: `null`.
    Unknown,
    /// Nothing: the reason, in words.
    Absent(String),
}

/// Times of an evolution that JSON writes as `null` where they are infinite; those that are unknown are listed.
const UNBOUNDED: [&str; 4] = ["time", "turns", "damping_time", "growth_time"];

/// Looks up a quantity in the object that its command prints.
pub(super) fn find<'a>(quantity: &Quantity, object: &'a Value) -> Found<'a> {
    let mut value = object;
    for (at, segment) in quantity.path.iter().enumerate() {
        let inside = match value {
            Value::Object(entries) => entries.get(segment),
            Value::Array(items) => entry(items, segment),
            _ => None,
        };
        let named = || {
            (at == 0 && quantity.command == Command::Modes)
                .then(|| entry(object["modes"].as_array()?, segment))?
        };
        match inside.or_else(named) {
            Some(next) => value = next,
            None if value.is_null() => return Found::Unknown,
            None => return Found::Absent(absent(quantity, at, value)),
        }
    }
    if !value.is_null() {
        return Found::Value(value);
    }
    let name = quantity.path.last().map_or("", String::as_str);
    let listed = object["not_known"].as_array();
    let unbounded =
        quantity.command == Command::Evolve && quantity.path.len() == 1 && UNBOUNDED.contains(&name);
    match listed {
        Some(unknown) if unbounded && !unknown.iter().any(|each| each == name) => Found::Infinite,
        _ => Found::Unknown,
    }
}

fn entry<'a>(items: &'a [Value], segment: &str) -> Option<&'a Value> {
    items
        .iter()
        .find(|item| item.get("name").is_some_and(|name| name == segment))
        .or_else(|| items.get(segment.parse::<usize>().ok()?.checked_sub(1)?))
}

/// Most names that a message lists.
const LISTED: usize = 30;

fn absent(quantity: &Quantity, at: usize, value: &Value) -> String {
    let names: Vec<String> = match value {
        Value::Object(entries) => entries.keys().cloned().collect(),
        Value::Array(items) => (1..)
            .zip(items)
            .map(|(i, item)| {
                item.get("name").and_then(Value::as_str).map_or_else(|| usize::to_string(&i), str::to_owned)
            })
            .collect(),
        _ => Vec::new(),
    };
    let segment = &quantity.path[at];
    if names.is_empty() {
        return format!("`{}`: there is no `{segment}`", quantity.name);
    }
    let list = names[..names.len().min(LISTED)].join(", ");
    let modes = if at == 0 && quantity.command == Command::Modes {
        let modes = value["modes"].as_array().into_iter().flatten();
        let names: Vec<&str> = modes.filter_map(|mode| mode["name"].as_str()).collect();
        format!("; the modes are {}", names.join(", "))
    } else {
        String::new()
    };
    format!("`{}`: there is no `{segment}`; there is {list}{modes}", quantity.name)
}

/// Unit of a quantity by the name under which the commands print it; empty for pure numbers and for names not listed.
pub(super) fn unit(quantity: &Quantity) -> &'static str {
    let words = quantity.path.iter().rev().find(|segment| segment.parse::<usize>().is_err());
    match words.map_or("", String::as_str) {
        "time" | "time_range" | "time_constant" | "separatrix_time" | "lingering" | "damping_time"
        | "growth_time" | "rotation_period" | "precession_period" | "relaxation_times" | "T1" | "T2"
        | "T3" | "t" | "duration" | "least" | "greatest" => "s",
        "frequency" | "frequencies" | "free_frequencies" | "seen_from_outside" | "spin" | "omega" | "wx"
        | "wy" | "wz" => "rad/s",
        "decay_rate" | "decay_rates" => "1/s",
        "nutation_least" | "nutation_greatest" | "nutation_min" | "nutation_max" => "rad",
        "momentum" => "N m s",
        "power" => "W",
        "energy" | "dissipated" | "work" | "energy_drift" => "J",
        "x" | "y" | "z" | "position" | "R0x" | "R0y" | "R0z" | "pole" => "m",
        "vx" | "vy" | "vz" | "velocity" => "m/s",
        _ => "",
    }
}

#[cfg(test)]
mod tests {
    use serde_json::json;

    use super::*;

    fn quantity(command: Command, path: &[&str]) -> Quantity {
        let path: Vec<String> = path.iter().map(|each| (*each).to_owned()).collect();
        Quantity { name: path.join("."), command, path, span: 0..0 }
    }

    #[test]
    fn paths_lead_through_names_numbers_and_modes() {
        let object = json!({ "spin": [1.0, 2.0, 3.0], "modes": [{ "name": "nutation", "time_constant": 5.0, "damping_ratio": null }] });
        let at = |path: &[&str]| format!("{:?}", find(&quantity(Command::Modes, path), &object));
        assert_eq!(at(&["spin", "2"]), "Value(Number(2.0))");
        for path in [
            &["nutation", "time_constant"][..],
            &["modes", "nutation", "time_constant"],
            &["modes", "1", "time_constant"],
        ] {
            assert_eq!(at(path), "Value(Number(5.0))");
        }
        assert_eq!(at(&["nutation", "damping_ratio"]), "Unknown");
        assert!(
            at(&["tip", "time_constant"])
                .contains("there is no `tip`; there is modes, spin; the modes are nutation")
        );
        for number in ["0", "4"] {
            let said = format!("there is no `{number}`; there is 1, 2, 3");
            assert!(at(&["spin", number]).contains(&said));
        }
        assert!(at(&["spin", "1", "x"]).starts_with("Absent"));
    }

    #[test]
    fn time_that_never_ends_is_infinite_and_not_unknown() {
        let time = quantity(Command::Evolve, &["time"]);
        assert_eq!(find(&time, &json!({ "time": null, "not_known": [] })), Found::Infinite);
        assert_eq!(find(&time, &json!({ "time": null, "not_known": ["time"] })), Found::Unknown);
    }
}
