use super::{NodeList, NodeTable};
use crate::matrix::error::{Fault, MatrixProblem, Place, Row};
use crate::matrix::text::number;
use crate::text_file::{lines, text, whole};

/// Lines `label x y z`, perhaps below one line of titles.
pub(in crate::matrix) fn read(bytes: &[u8]) -> Result<NodeTable, Fault> {
    let mut found = NodeList::default();
    let rows = lines(text::<MatrixProblem>(bytes)?).filter(|(_, line)| !line.starts_with('#'));
    for (index, (line, row)) in rows.enumerate() {
        if index == 0 && row.starts_with(|c: char| c.is_alphabetic() || c == '"') {
            continue;
        }
        let (label, place) = node(row).map_err(|problem| (Place::Line(line), problem))?;
        found.add(label, place, line).map_err(|(line, problem)| (Place::Line(line), problem))?;
    }
    found.table()
}

fn node(line: &str) -> Result<(u64, [f64; 3]), MatrixProblem> {
    let words: Vec<&str> = if line.contains([',', ';']) {
        line.split([',', ';']).map(str::trim).collect()
    } else {
        line.split_whitespace().collect()
    };
    let [label, x, y, z] = words[..] else {
        return Err(MatrixProblem::Values { found: words.len(), row: Row::Node });
    };
    let along = |word| number(word, Row::Node);
    Ok((whole(label, Row::Node)?, [along(x)?, along(y)?, along(z)?]))
}
