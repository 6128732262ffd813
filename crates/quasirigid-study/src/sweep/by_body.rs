//! Percentiles of each body of a table whose rows are drawn: one row a body, beside the rows of all draws.

use quasirigid_io::record::Ordered;
use quasirigid_io::table_file::{CellColumn, CellKind, Cells, csv_header, csv_rows};

use super::folder::{BODIES_FILE, Folder};
use super::{Sweep, SweepError};

/// Writes the percentiles of each body, where a table gives bodies of several rows each.
pub(super) fn write(sweep: &Sweep, folder: &Folder<'_>) -> Result<(), SweepError> {
    let Some(bodies) = &sweep.bodies else { return Ok(()) };
    let rows = (sweep.rows / bodies.rows()) as usize;
    if rows < 2 {
        return Ok(());
    }
    let read = |name: &str| -> Result<Option<CellColumn>, SweepError> {
        Ok(folder.read(&[name])?.into_iter().find(|column| column.name == name))
    };
    let mut columns = vec![CellColumn {
        name: "body".into(),
        unit: String::new(),
        cells: Cells::Counts((1..=bodies.rows() as i64).collect()),
    }];
    let named =
        sweep.inputs.iter().filter(|input| input.kind == CellKind::Text && is_of_table(sweep, &input.name));
    for input in named {
        if let Some(CellColumn { cells: Cells::Texts(texts), name, unit }) = read(&input.name)? {
            columns.push(CellColumn {
                name,
                unit,
                cells: Cells::Texts(texts.into_iter().step_by(rows).collect()),
            });
        }
    }
    if let Some(CellColumn { cells: Cells::Texts(states), .. }) = read("status")? {
        let answered = |chunk: &[Option<String>]| {
            chunk.iter().filter(|status| status.as_deref() == Some("answered")).count() as i64
        };
        let counts = states.chunks(rows).map(answered).collect();
        columns.push(CellColumn {
            name: "answered".into(),
            unit: String::new(),
            cells: Cells::Counts(counts),
        });
    }
    for output in sweep.outputs.iter().filter(|output| output.kind == CellKind::Number) {
        let Some(CellColumn { cells: Cells::Numbers(values), .. }) = read(&output.name)? else { continue };
        let ordered =
            |chunk: &[Option<f64>]| Ordered::new(&output.name, chunk.iter().flatten().copied().collect());
        let bodies: Vec<Ordered> = values.chunks(rows).map(ordered).collect();
        for percent in &sweep.study.answer.percentiles {
            let of_body = |body: &Ordered| body.percentile(*percent);
            columns.push(CellColumn {
                name: format!("{} at {percent} %", output.name),
                unit: output.unit.clone(),
                cells: Cells::Numbers(bodies.iter().map(of_body).collect()),
            });
        }
    }
    folder.put(BODIES_FILE, |out| {
        out.write_all(&csv_header(&columns))?;
        out.write_all(&csv_rows(&columns))
    })
}

/// Whether an input stands in the table, and not among the keys that the study varies.
fn is_of_table(sweep: &Sweep, name: &str) -> bool {
    sweep.study.vary.iter().all(|varied| varied.key.to_string() != name)
}
