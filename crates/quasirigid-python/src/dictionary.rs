//! Dictionaries of Python as the text of a model file.
//! The vocabulary is the file's: tables are dictionaries, arrays of tables are lists of them. NumPy's numbers and arrays count as
//! numbers and lists. What TOML has no word for is refused with its place.

use pyo3::prelude::*;
use pyo3::types::{PyBool, PyDict, PyFloat, PyInt, PyList, PyString, PyTuple};
use toml::{Table, Value};

use crate::failure::Failure;

/// Deepest nesting: a model has four levels; a list that holds itself has no end.
const DEEPEST: usize = 32;

/// TOML text of a dictionary.
#[pyfunction]
pub fn to_toml(model: &Bound<'_, PyDict>) -> PyResult<String> {
    let table = table(model, "", 0)?;
    Ok(toml::to_string(&table).map_err(|error| Failure::Input(format!("no TOML: {error}")))?)
}

fn table(dictionary: &Bound<'_, PyDict>, place: &str, depth: usize) -> Result<Table, Failure> {
    let mut table = Table::new();
    for (key, item) in dictionary {
        let Ok(name) = key.cast::<PyString>() else {
            let place = if place.is_empty() { "the model" } else { place };
            return refuse(format!("{place}: the key {} is not a text", shown(&key)));
        };
        let name = name.to_cow()?.into_owned();
        let inside = if place.is_empty() { name.clone() } else { format!("{place}.{name}") };
        table.insert(name, value(&item, &inside, depth)?);
    }
    Ok(table)
}

/// A value of TOML; `place` is its path in messages.
fn value(item: &Bound<'_, PyAny>, place: &str, depth: usize) -> Result<Value, Failure> {
    if depth > DEEPEST {
        return refuse(format!("{place}: the model is nested more than {DEEPEST} times"));
    }
    if let Ok(item) = item.cast::<PyDict>() {
        return Ok(Value::Table(table(item, place, depth + 1)?));
    }
    if item.is_instance_of::<PyList>() || item.is_instance_of::<PyTuple>() {
        let items = item.try_iter()?.enumerate();
        let items = items.map(|(i, each)| value(&each?, &format!("{place}[{i}]"), depth + 1));
        return Ok(Value::Array(items.collect::<Result<_, _>>()?));
    }
    if let Ok(item) = item.cast::<PyBool>() {
        return Ok(Value::Boolean(item.is_true()));
    }
    if item.is_instance_of::<PyInt>() {
        let number = item.extract::<i64>();
        return number
            .map(Value::Integer)
            .or_else(|_| refuse(format!("{place}: {} is too large", shown(item))));
    }
    if let Ok(item) = item.cast::<PyFloat>() {
        return Ok(Value::Float(item.value()));
    }
    if let Ok(item) = item.cast::<PyString>() {
        return Ok(Value::String(item.to_cow()?.into_owned()));
    }
    if item.is_none() {
        return refuse(format!("{place} is None; leave it out"));
    }
    if let Ok(plain) = item.call_method0("tolist") {
        return value(&plain, place, depth + 1);
    }
    let kind = item.get_type().name()?;
    refuse(format!(
        "{place}: a {kind} has no place in a model; give a number, a text, a list or a dictionary"
    ))
}

/// An object as Python shows it.
fn shown(item: &Bound<'_, PyAny>) -> String {
    item.repr().map_or_else(|_| "that".to_owned(), |text| text.to_string())
}

fn refuse<T>(message: String) -> Result<T, Failure> {
    Err(Failure::Input(message))
}
