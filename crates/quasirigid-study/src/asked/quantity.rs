//! Quantities as paths into the JSON objects of the commands, and their units.
//! A list of objects is entered by the name of an entry or its number from 1, another list by number; below `modes` the names of the modes
//! may follow directly. A name that two entries have is a question to the user, never the first of them.

use quasirigid_io::model::Named;
use quasirigid_io::study_file::{Command, Quantity};
use serde_json::Value;

use crate::words::significant;

/// Value that a path leads to, or why it leads to none.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum QuantityValue<'a> {
    /// A value.
    Value(&'a Value),
    /// A number that is infinite: JSON writes it as `null`.
    Infinite,
    /// A value that is not known: `null`.
    Unknown,
    /// Nothing: the reason, in words.
    Absent(String),
    /// Several entries, or a number that no entry has any more: how to name one, in words.
    Unclear(String),
}

/// Times of an evolution that JSON writes as `null` where they are infinite; those that are unknown are listed.
const UNBOUNDED: [&str; 4] = ["time", "turns", "damping_time", "growth_time"];

/// Looks up a quantity in the object that its command prints.
pub(crate) fn find<'a>(quantity: &Quantity, object: &'a Value) -> QuantityValue<'a> {
    let mut value = object;
    for (at, segment) in quantity.path.iter().enumerate() {
        let inside = match value {
            Value::Object(entries) => entries.get(segment).map(Entry::One),
            Value::Array(items) => entry(items, segment),
            _ => None,
        };
        let named = || {
            (at == 0 && quantity.command == Command::Modes)
                .then(|| entry(object["modes"].as_array()?, segment))?
        };
        match inside.or_else(named) {
            Some(Entry::One(next)) => value = next,
            Some(Entry::Several(named)) => return QuantityValue::Unclear(which(quantity, at, &named)),
            Some(Entry::Zero) => {
                let first = numbered(quantity, at, 1);
                return QuantityValue::Unclear(format!(
                    "`{}`: entries are counted from 1, so that 0 is now 1; write `{first}`",
                    quantity.name
                ));
            }
            None if value.is_null() => return QuantityValue::Unknown,
            None => return QuantityValue::Absent(absent(quantity, at, value)),
        }
    }
    if !value.is_null() {
        return QuantityValue::Value(value);
    }
    let name = quantity.path.last().map_or("", String::as_str);
    let listed = object["not_known"].as_array();
    let unbounded =
        quantity.command == Command::Evolve && quantity.path.len() == 1 && UNBOUNDED.contains(&name);
    match listed {
        Some(unknown) if unbounded && !unknown.iter().any(|each| each == name) => QuantityValue::Infinite,
        _ => QuantityValue::Unknown,
    }
}

/// Entry of a list that a segment names.
enum Entry<'a> {
    One(&'a Value),
    /// Entries of one name, each with its number.
    Several(Vec<(usize, &'a Value)>),
    /// The number 0.
    Zero,
}

fn entry<'a>(items: &'a [Value], segment: &str) -> Option<Entry<'a>> {
    let is_named = |item: &Value| item.get("name").is_some_and(|name| name == segment);
    let named: Vec<_> = (1..).zip(items).filter(|(_, item)| is_named(item)).collect();
    match (named.as_slice(), segment.parse::<usize>()) {
        ([(_, one)], _) => Some(Entry::One(one)),
        ([], Ok(0)) => Some(Entry::Zero),
        ([], Ok(number)) => items.get(number - 1).map(Entry::One),
        ([], Err(_)) => None,
        _ => Some(Entry::Several(named)),
    }
}

/// The path of a quantity with a number in place of a segment.
fn numbered(quantity: &Quantity, at: usize, number: usize) -> String {
    let mut path = quantity.path.clone();
    path[at] = number.to_string();
    let plain = |segment: &String| {
        let bare = |byte: u8| byte.is_ascii_alphanumeric() || matches!(byte, b'-' | b'_');
        if segment.bytes().all(bare) { segment.clone() } else { format!("{segment:?}") }
    };
    let path: Vec<String> = path.iter().map(plain).collect();
    format!("{}.{}", quantity.command.name(), path.join("."))
}

/// Question which of several entries of one name is meant.
fn which(quantity: &Quantity, at: usize, named: &[(usize, &Value)]) -> String {
    let number = |entry: &Value, key: &str| entry[key].as_f64().map(|value| significant(value, 4));
    let list = named.iter().take(LISTED).map(|(place, entry)| {
        let path = numbered(quantity, at, *place);
        match (number(entry, "frequency"), number(entry, "decay_rate")) {
            (Some(frequency), Some(decay_rate)) => {
                format!("`{path}` (frequency {frequency} rad/s, decay rate {decay_rate} 1/s)")
            }
            _ => format!("`{path}`"),
        }
    });
    let (name, count) = (&quantity.path[at], named.len());
    let list = list.collect::<Vec<_>>().join(", ");
    format!("`{}`: {count} entries have the name `{name}`; write the number of one: {list}", quantity.name)
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
pub(crate) fn unit(quantity: &Quantity) -> &'static str {
    let words = quantity.path.iter().rev().find(|segment| segment.parse::<usize>().is_err());
    match words.map_or("", String::as_str) {
        "time" | "time_range" | "time_constant" | "separatrix_time" | "lingering" | "damping_time"
        | "growth_time" | "rotation_period" | "precession_period" | "effective_period"
        | "relaxation_times" | "T1" | "T2" | "T3" | "t" | "duration" | "least" | "greatest" => "s",
        "frequency" | "frequencies" | "free_frequencies" | "seen_from_outside" | "spin" | "omega" | "wx"
        | "wy" | "wz" => "rad/s",
        "decay_rate" | "decay_rates" => "1/s",
        "nutation_least" | "nutation_greatest" | "nutation_min" | "nutation_max" | "wobble" => "rad",
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
        assert!(at(&["spin", "4"]).contains("there is no `4`; there is 1, 2, 3"));
        let zero = at(&["spin", "0"]);
        assert!(
            zero.contains("`spin.0`: entries are counted from 1") && zero.contains("write `modes.spin.1`"),
            "{zero}"
        );
        assert!(at(&["spin", "1", "x"]).starts_with("Absent"));
    }

    #[test]
    fn one_name_of_two_modes_is_a_question() {
        let mode =
            |name: &str, frequency: f64| json!({ "name": name, "frequency": frequency, "decay_rate": 0.25 });
        let object = json!({ "modes": [mode("nutation", 0.5), mode("tip", 6.0), mode("tip", 7.0)] });
        for (path, numbered) in [
            (&["tip", "frequency"][..], "modes.2.frequency"),
            (&["modes", "tip", "frequency"], "modes.modes.2.frequency"),
        ] {
            let QuantityValue::Unclear(said) = find(&quantity(Command::Modes, path), &object) else {
                panic!("one of two modes was taken")
            };
            assert!(said.contains("2 entries have the name `tip`"), "{said}");
            assert!(
                said.contains(&format!("`{numbered}` (frequency 6.000 rad/s, decay rate 0.2500 1/s)")),
                "{said}"
            );
        }
        let second = find(&quantity(Command::Modes, &["3", "frequency"]), &object);
        assert_eq!(second, QuantityValue::Value(&json!(7.0)));
    }

    #[test]
    fn time_that_never_ends_is_infinite_and_not_unknown() {
        let time = quantity(Command::Evolve, &["time"]);
        assert_eq!(find(&time, &json!({ "time": null, "not_known": [] })), QuantityValue::Infinite);
        assert_eq!(find(&time, &json!({ "time": null, "not_known": ["time"] })), QuantityValue::Unknown);
    }
}
