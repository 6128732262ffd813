//! State spaces. (Y1)

use std::path::Path;

use quasirigid_body::control::{ControlLaw, LinearLaw};

use super::{Draft, outputs, quaternion};
use crate::matrix::{MatrixProblem, read_matrix};
use crate::model::channel::measurement;
use crate::model::table::Table;
use crate::model::value::Value;
use crate::units::Dimension;

pub(super) fn state_space(table: &Table<'_>, _: Option<f64>, folder: &Path) -> Option<Draft> {
    let target = quaternion(table)?;
    let channels = table.required("inputs", "inputs = [\"attitude.x\", \"rate.x\"]")?;
    let inputs = channels.list("a list of channels", |item| {
        Some((measurement(&item, target)?, item.text()?.to_owned(), 0.0))
    })?;
    let outputs = outputs(table, None)?;
    let written = |key: &'static str| {
        let row = |row: Value<'_>| row.list("a row of numbers", |item| item.quantity(Dimension::NUMBER));
        table.read_or(key, Vec::new(), |value| value.list("a list of rows", row))
    };
    let rows = |key: &'static str| match table.get("matrices") {
        Some(_) if table.get(key).is_some() => {
            let message = format!("`{key}` here and `matrices`; give one of them");
            table.get(key)?.refuse(message, "twice", "the file of `matrices` has all four")
        }
        Some(file) => of_file(&file, key, folder),
        None => written(key),
    };
    let (A, B, C, D) = (rows("A"), rows("B"), rows("C"), rows("D"));
    let (A, B, mut C, mut D) = (A?, B?, C?, D?);
    if let Some(file) = table.get("matrices").filter(|_| A.is_empty() && D.is_empty()) {
        return file.refuse(
            "`matrices`: the file has neither A nor D",
            "no law",
            "name them so; a gain alone is D",
        );
    }
    if A.is_empty() && C.is_empty() {
        C = vec![Vec::new(); outputs.len()];
    }
    if D.is_empty() {
        D = vec![vec![0.0; inputs.len()]; outputs.len()];
    }
    let start = vec![0.0; A.len()];
    let law = ControlLaw::Linear(LinearLaw { E: vec![Vec::new(); A.len()], A, B, C, D });
    Some(Draft { deadbands: vec![0.0; inputs.len()], inputs, law, outputs, start })
}

/// Rows of the matrix of a name in a file; none where the file has other matrices.
fn of_file(file: &Value<'_>, name: &str, folder: &Path) -> Option<Vec<Vec<f64>>> {
    let matrix = match read_matrix(&folder.join(file.text()?), Some(name)) {
        Ok(matrix) => matrix,
        Err(error)
            if matches!(error.problem, MatrixProblem::NoSuchMatrix { .. } | MatrixProblem::Void { .. }) =>
        {
            return Some(Vec::new());
        }
        Err(error) => {
            let help = "it is looked for beside the model, and has A, B, C and D as scipy.io.savemat and numpy.savez write them";
            return file.refuse(format!("`matrices`: {error}"), "cannot be used", help);
        }
    };
    let mut rows = vec![vec![0.0; matrix.columns]; matrix.rows];
    matrix.entries.iter().for_each(|(row, column, value)| rows[*row][*column] = *value);
    Some(rows)
}
