//! Tables of named columns, each with its unit: NumPy arrays and Arrow streams on the memory of the study, without a copy.
//! Arrays are read-only, since all of them share that memory.
#![allow(unsafe_code)]

use std::sync::Arc;

use numpy::{Element, PyArray1, PyArrayMethods, ndarray::ArrayView1};
use pyo3::IntoPyObjectExt;
use pyo3::prelude::*;
use pyo3::types::PyCapsule;
use quasirigid_io::record::Column;
use quasirigid_io::table_file::{CellColumn, Cells};

use crate::arrow;
use crate::failure::Failure;
use crate::series::{Series, Values};

/// A table of columns of equal length.
#[pyclass(frozen, module = "quasirigid._core")]
#[derive(Debug)]
pub struct Columns {
    series: Arc<Vec<Series>>,
    rows: usize,
}

impl Columns {
    pub fn new(series: Vec<Series>) -> Self {
        let rows = series.iter().map(Series::rows).min().unwrap_or(0);
        Self { series: Arc::new(series), rows }
    }

    /// Columns of the results of a study; a number that is missing is NaN.
    pub fn of_cells(columns: Vec<CellColumn>) -> Self {
        let series = columns.into_iter().map(|CellColumn { name, unit, cells }| {
            let values = match cells {
                Cells::Counts(values) => Values::Counts(Arc::new(values)),
                Cells::Booleans(values) => Values::Booleans(Arc::new(values)),
                Cells::Texts(values) => Values::Texts(Arc::new(values)),
                Cells::Numbers(values) => {
                    let numbers = values.into_iter().map(|value| value.unwrap_or(f64::NAN));
                    Values::Numbers(Arc::new(numbers.collect()))
                }
            };
            Series { name, unit, values }
        });
        Self::new(series.collect())
    }

    /// The columns of numbers.
    pub fn numbers(&self) -> Vec<Column> {
        let column = |series: &Series| match &series.values {
            Values::Numbers(values) => {
                Some(Column { name: series.name.clone(), unit: series.unit.clone(), values: values.to_vec() })
            }
            _ => None,
        };
        self.series.iter().filter_map(column).collect()
    }

    /// The columns of a history or an evolution.
    pub fn of_record(columns: Vec<Column>) -> Self {
        let series = columns.into_iter().map(|column| Series {
            name: column.name,
            unit: column.unit,
            values: Values::Numbers(Arc::new(column.values)),
        });
        Self::new(series.collect())
    }
}

#[pymethods]
impl Columns {
    /// Columns from names, units and values of equal length: arrays of numbers, counts or truth values, or lists of truth values or texts
    /// with none where one is missing.
    #[new]
    fn from_parts(names: Vec<String>, units: Vec<String>, values: Vec<Bound<'_, PyAny>>) -> PyResult<Self> {
        if names.len() != units.len() || names.len() != values.len() {
            return Err(Failure::Input("names, units and values of a table differ in number".into()).into());
        }
        let mut series = Vec::with_capacity(names.len());
        for ((name, unit), values) in names.into_iter().zip(units).zip(values) {
            let kind: String = match values.getattr_opt("dtype")? {
                Some(dtype) => dtype.getattr("kind")?.extract()?,
                None => String::new(),
            };
            let values = match kind.as_str() {
                "f" => Values::Numbers(Arc::new(values.extract()?)),
                "i" | "u" => Values::Counts(Arc::new(values.extract()?)),
                _ => match values.extract() {
                    Ok(truths) => Values::Booleans(Arc::new(truths)),
                    Err(_) => Values::Texts(Arc::new(values.extract()?)),
                },
            };
            series.push(Series { name, unit, values });
        }
        let columns = Self::new(series);
        if columns.series.iter().any(|each| each.rows() != columns.rows) {
            return Err(Failure::Input("the columns of a table differ in length".into()).into());
        }
        Ok(columns)
    }

    #[getter]
    fn rows(&self) -> usize {
        self.rows
    }

    #[getter]
    fn names(&self) -> Vec<&str> {
        self.series.iter().map(|series| series.name.as_str()).collect()
    }

    #[getter]
    fn units(&self) -> Vec<&str> {
        self.series.iter().map(|series| series.unit.as_str()).collect()
    }

    /// The values of a column by its number: a read-only array of numbers or counts, or a list of truth values or texts.
    fn values<'py>(this: &Bound<'py, Self>, column: usize) -> PyResult<Bound<'py, PyAny>> {
        let columns = this.get();
        let Some(series) = columns.series.get(column) else {
            return Err(Failure::Input(format!("no column {column}")).into());
        };
        match &series.values {
            Values::Texts(texts) => texts.as_slice().into_bound_py_any(this.py()),
            Values::Booleans(truths) => truths.as_slice().into_bound_py_any(this.py()),
            Values::Counts(counts) => Ok(shared(this, counts)),
            Values::Numbers(numbers) => Ok(shared(this, numbers)),
        }
    }

    /// The table as a stream of the Arrow C interface.
    fn arrow_stream<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyCapsule>> {
        let stream = arrow::Stream::new(Arc::clone(&self.series), self.rows);
        PyCapsule::new_with_value(py, stream, arrow::STREAM)
    }

    /// The types of the columns as a schema of the Arrow C interface.
    fn arrow_schema<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyCapsule>> {
        PyCapsule::new_with_value(py, arrow::Schema::of(&self.series), arrow::SCHEMA)
    }
}

/// A read-only array on the memory of a column of the table.
fn shared<'py, T: Element>(table: &Bound<'py, Columns>, values: &[T]) -> Bound<'py, PyAny> {
    let view = ArrayView1::from(values);
    // SAFETY: the array keeps the table alive, which is frozen and never changes or moves the numbers.
    let array = unsafe { PyArray1::borrow_from_array(&view, table.clone().into_any()) };
    array.readwrite().make_nonwriteable();
    array.into_any()
}
