//! Numbers in the text of a model, each with its path, so that a program can vary them one by one.

use toml_edit::{Item, TableLike, Value};

use super::node::in_path;
use super::{ChangeError, Path, Template};
use crate::model::key_value::KeyValue;
use crate::units::Measure;

/// Number that no model has, to find the place that a path leads to.
const MARK: f64 = 8.190_367_254_131_7e-271;

/// Number in the text of a model.
#[derive(Clone, Debug, PartialEq)]
pub struct WrittenNumber {
    /// Path of its key.
    pub path: Path,
    /// The number as written.
    pub number: f64,
    /// Its unit as written; none of a plain number, which is in SI units.
    pub unit: Option<String>,
    /// Size (in the unit) that a change is measured by: of the number, and for a zero that of the largest beside it in its list.
    pub scale: f64,
}

impl WrittenNumber {
    /// The value with another number in the same unit.
    #[must_use]
    pub fn with(&self, number: f64) -> KeyValue {
        match &self.unit {
            None => KeyValue::Number(number),
            Some(unit) => KeyValue::Text(format!("{number} {unit}")),
        }
    }
}

impl Template {
    /// All numbers of the text, plain or with a unit, in its order.
    #[must_use]
    pub fn numbers(&self) -> Vec<WrittenNumber> {
        let mut found = Vec::new();
        of_table(self.document.as_table(), "", &mut found);
        found
    }

    /// The number of a key, however its path names the entries; none where it is no number.
    ///
    /// # Errors
    /// [`ChangeError`] for a path that leads nowhere.
    pub fn number(&self, path: &Path) -> Result<Option<WrittenNumber>, ChangeError> {
        let marked = Self::new(&self.changed(&[(path.clone(), KeyValue::Number(MARK))])?)?;
        let place = marked.numbers().into_iter().find(|each| each.number == MARK);
        Ok(place.and_then(|place| self.numbers().into_iter().find(|each| each.path == place.path)))
    }
}

fn of_table(table: &dyn TableLike, above: &str, found: &mut Vec<WrittenNumber>) {
    for (key, item) in table.iter() {
        of_item(item, &below(above, &in_path(key)), found);
    }
}

fn of_item(item: &Item, path: &str, found: &mut Vec<WrittenNumber>) {
    match item {
        Item::None => (),
        Item::Value(value) => of_value(value, path, found),
        Item::Table(table) => of_table(table, path, found),
        Item::ArrayOfTables(tables) => {
            let tables: Vec<&dyn TableLike> =
                tables.iter().map(|table| -> &dyn TableLike { table }).collect();
            for (table, entry) in tables.iter().zip(entries(&tables)) {
                of_table(*table, &below(path, &entry), found);
            }
        }
    }
}

fn of_value(value: &Value, path: &str, found: &mut Vec<WrittenNumber>) {
    match value {
        Value::InlineTable(table) => of_table(table, path, found),
        Value::Array(list) => {
            let tables: Option<Vec<&dyn TableLike>> = list
                .iter()
                .map(|value| value.as_inline_table().map(|table| -> &dyn TableLike { table }))
                .collect();
            let names = match &tables {
                Some(tables) => entries(tables),
                None => (1..=list.len()).map(|number| number.to_string()).collect(),
            };
            let first = found.len();
            for (value, entry) in list.iter().zip(names) {
                of_value(value, &below(path, &entry), found);
            }
            if tables.is_none() {
                measure_zeros(&mut found[first..]);
            }
        }
        _ => found.extend(written(value, path)),
    }
}

/// Gives zeros the scale of the largest number of the same unit.
fn measure_zeros(list: &mut [WrittenNumber]) {
    for i in 0..list.len() {
        let alike = list.iter().filter(|other| other.unit == list[i].unit);
        let largest = alike.map(|other| other.number.abs()).fold(0.0, f64::max);
        if list[i].number == 0.0 {
            list[i].scale = largest;
        }
    }
}

fn written(value: &Value, path: &str) -> Option<WrittenNumber> {
    let (number, unit) = match value {
        Value::Float(number) => (*number.value(), None),
        Value::Integer(number) => (*number.value() as f64, None),
        Value::String(text) => {
            let measure = Measure::parse(text.value()).ok()?;
            (measure.number, Some(measure.unit.to_owned()))
        }
        _ => return None,
    };
    let path = path.parse().ok()?;
    number.is_finite().then(|| WrittenNumber { path, number, unit, scale: number.abs() })
}

/// Segments that lead to the tables of a list: their names, and the number of a table whose name another has or that has none.
fn entries(tables: &[&dyn TableLike]) -> Vec<String> {
    let names: Vec<Option<&str>> = tables.iter().map(|table| table.get("name")?.as_str()).collect();
    let alone = |name: &str| names.iter().filter(|other| **other == Some(name)).count() == 1;
    let entry = |(number, name): (usize, &Option<&str>)| match name {
        Some(name) if alone(name) => in_path(name),
        _ => number.to_string(),
    };
    (1..).zip(&names).map(entry).collect()
}

fn below(path: &str, segment: &str) -> String {
    if path.is_empty() { segment.to_owned() } else { format!("{path}.{segment}") }
}

#[cfg(test)]
mod tests {
    use super::*;

    const TEXT: &str = r#"
name = "5 kg of nothing, and no number"
[body]
mass = 120
inertia = ["30 kg m^2", 40.0, 0]
free = true
[[spring]]
name = "long boom"
position = [0.0, 0, 2.5]
stiffness = "6 kN/m"
[[spring]]
name = "twin"
mass = 1.0
[[spring]]
name = "twin"
mass = 2.0
[run]
orders = [{ name = "a", at = 3 }]
"#;

    #[test]
    fn numbers_are_found_with_their_paths_units_and_scales() {
        let template = Template::new(TEXT).unwrap();
        let numbers = template.numbers();
        let told: Vec<_> = numbers
            .iter()
            .map(|each| (each.path.to_string(), each.number, each.unit.as_deref(), each.scale))
            .collect();
        let known: &[(&str, f64, Option<&str>, f64)] = &[
            ("body.mass", 120.0, None, 120.0),
            ("body.inertia.1", 30.0, Some("kg m^2"), 30.0),
            ("body.inertia.2", 40.0, None, 40.0),
            ("body.inertia.3", 0.0, None, 40.0),
            ("spring.\"long boom\".position.1", 0.0, None, 2.5),
            ("spring.\"long boom\".position.2", 0.0, None, 2.5),
            ("spring.\"long boom\".position.3", 2.5, None, 2.5),
            ("spring.\"long boom\".stiffness", 6.0, Some("kN/m"), 6.0),
            ("spring.2.mass", 1.0, None, 1.0),
            ("spring.3.mass", 2.0, None, 2.0),
            ("run.orders.a.at", 3.0, None, 3.0),
        ];
        assert_eq!(told.len(), known.len(), "{told:?}");
        for (told, known) in told.iter().zip(known) {
            assert_eq!((told.0.as_str(), told.1, told.2, told.3), *known);
        }
    }

    #[test]
    fn numbers_are_found_by_any_name_of_their_entry() {
        let template = Template::new(TEXT).unwrap();
        let number = |path: &str| template.number(&path.parse().unwrap());
        let found = number("spring.1.stiffness").unwrap().unwrap();
        assert_eq!((found.path.to_string().as_str(), found.number), ("spring.\"long boom\".stiffness", 6.0));
        assert_eq!(number("body.free").unwrap(), None);
        assert_eq!(number("body.density").unwrap(), None);
        assert!(number("spring.twin.mass").is_err());
    }

    #[test]
    fn each_path_leads_back_to_its_number() {
        let template = Template::new(TEXT).unwrap();
        for number in template.numbers() {
            let changed = template.changed(&[(number.path.clone(), number.with(7.25))]).unwrap();
            let again = Template::new(&changed).unwrap().numbers();
            let found = again.iter().find(|other| other.path == number.path).unwrap();
            assert_eq!((found.number, &found.unit), (7.25, &number.unit), "{changed}");
        }
    }
}
