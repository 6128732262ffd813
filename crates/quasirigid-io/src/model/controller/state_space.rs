//! State spaces. (Y1)

use quasirigid_body::control::{ControlLaw, LinearLaw};

use super::{Draft, outputs, quaternion};
use crate::model::channel::measurement;
use crate::model::table::Table;
use crate::model::value::Value;
use crate::units::Dimension;

pub(super) fn state_space(table: &Table<'_>, _: Option<f64>) -> Option<Draft> {
    let target = quaternion(table)?;
    let channels = table.required("inputs", "inputs = [\"attitude.x\", \"rate.x\"]")?;
    let inputs = channels.list("a list of channels", |item| {
        Some((measurement(&item, target)?, item.text()?.to_owned(), 0.0))
    })?;
    let outputs = outputs(table, None)?;
    let rows = |key: &'static str| {
        let row = |row: Value<'_>| row.list("a row of numbers", |item| item.quantity(Dimension::NUMBER));
        table.read_or(key, Vec::new(), |value| value.list("a list of rows", row))
    };
    let (A, B, C, D) = (rows("A"), rows("B"), rows("C"), rows("D"));
    let (A, B, mut C, mut D) = (A?, B?, C?, D?);
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
