//! Dictionaries of Python as the text of a model file, and changes of such a text.
//! The vocabulary is the file's: tables are dictionaries, arrays of tables are lists of them. NumPy's numbers and arrays count as
//! numbers and lists. What TOML has no word for is refused with its place.

use pyo3::prelude::*;
use pyo3::types::{PyBool, PyDict, PyFloat, PyInt, PyList, PyString, PyTuple};
use quasirigid_io::model::{KeyValue, changed};
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

/// Text of a model with values replaced by path, as `spring.boom.stiffness`.
#[pyfunction]
pub fn with_changes(text: &str, changes: &Bound<'_, PyDict>) -> PyResult<String> {
    let mut given = Vec::with_capacity(changes.len());
    for (path, item) in changes {
        let Ok(path) = path.cast::<PyString>() else {
            return Ok(refuse(format!("the path {} is not a text", shown(&path)))?);
        };
        let path = text_of(path)?;
        let item = value(&item, &path, 0)?;
        given.push((path, self::given(item)));
    }
    let given: Vec<(&str, KeyValue)> =
        given.iter().map(|(path, given)| (path.as_str(), given.clone())).collect();
    Ok(changed(text, &given).map_err(|error| Failure::Input(error.to_string()))?)
}

/// A value of TOML for a key of a model.
fn given(value: Value) -> KeyValue {
    match value {
        Value::Float(number) => KeyValue::Number(number),
        Value::Integer(number) => KeyValue::Integer(number),
        Value::Boolean(truth) => KeyValue::Bool(truth),
        Value::String(text) => KeyValue::Text(text),
        Value::Datetime(time) => KeyValue::Text(time.to_string()),
        Value::Array(items) => KeyValue::List(items.into_iter().map(given).collect()),
        Value::Table(entries) => {
            KeyValue::Table(entries.into_iter().map(|(key, item)| (key, given(item))).collect())
        }
    }
}

fn table(dictionary: &Bound<'_, PyDict>, place: &str, depth: usize) -> Result<Table, Failure> {
    let mut table = Table::new();
    for (key, item) in dictionary {
        let Ok(name) = key.cast::<PyString>() else {
            let place = if place.is_empty() { "the model" } else { place };
            return refuse(format!("{place}: the key {} is not a text", shown(&key)));
        };
        let name = text_of(name)?;
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
        return Ok(Value::String(text_of(item)?));
    }
    if item.is_none() {
        return refuse(format!("{place} is None; leave it out"));
    }
    if let Ok(plain) = item.call_method0("tolist") {
        return value(&plain, place, depth + 1);
    }
    let kind = item.get_type().name()?;
    refuse(format!(
        "{place}: a {kind} is not allowed in a model; give a number, a text, a list or a dictionary"
    ))
}

/// The text of a string, which in Python may hold halves of characters.
fn text_of(text: &Bound<'_, PyString>) -> Result<String, Failure> {
    let told =
        |_| Failure::Input(format!("{} is not valid text: UTF-8 cannot write its surrogates", shown(text)));
    text.to_cow().map(|text| text.into_owned()).map_err(told)
}

/// An object as Python shows it.
fn shown(item: &Bound<'_, PyAny>) -> String {
    item.repr().map_or_else(|_| "that".to_owned(), |text| text.to_string())
}

fn refuse<T>(message: String) -> Result<T, Failure> {
    Err(Failure::Input(message))
}
