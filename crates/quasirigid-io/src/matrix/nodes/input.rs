use super::{NodeList, NodeTable};
use crate::matrix::error::{Fault, MatrixProblem, Place, Row};
use crate::matrix::listed::LocatedProblem;
use crate::matrix::text::number;
use crate::text_file::{lines, text, whole};

/// `*NODE` blocks.
pub(in crate::matrix) fn read(bytes: &[u8]) -> Result<NodeTable, Fault> {
    nodes(text::<MatrixProblem>(bytes)?).map_err(|(line, problem)| (Place::Line(line), problem))?.sorted()
}

fn nodes(text: &str) -> Result<NodeList, LocatedProblem> {
    let (mut found, mut inside) = (NodeList::default(), false);
    for (line, content) in lines(text).filter(|(_, content)| !content.starts_with("**")) {
        let refused = |problem| (line, problem);
        if content.starts_with('*') {
            inside = is_block(content).map_err(refused)?;
        } else if inside {
            let (label, place) = node(content).map_err(refused)?;
            found.add(label, place, line)?;
        }
    }
    Ok(found)
}

/// Whether the lines after this keyword are nodes.
fn is_block(keyword: &str) -> Result<bool, MatrixProblem> {
    let keyword = keyword.to_uppercase();
    let mut words = keyword.split(',').map(str::trim);
    match words.next().unwrap_or_default() {
        "*NODE" => {
            let other = words.find(|word| !word.is_empty() && !word.replace(' ', "").starts_with("NSET="));
            other.map_or(Ok(true), |found| {
                Err(MatrixProblem::OwnSystem { found: format!("*NODE, {found}").into() })
            })
        }
        found @ ("*TRANSFORM" | "*SYSTEM") => Err(MatrixProblem::OwnSystem { found: found.into() }),
        _ => Ok(false),
    }
}

fn node(line: &str) -> Result<(u64, [f64; 3]), MatrixProblem> {
    let mut words: Vec<&str> = line.split(',').map(str::trim).collect();
    // A comma may end the line.
    words.pop_if(|last| last.is_empty());
    let [label, x, y, z] = words[..] else {
        return Err(MatrixProblem::Values { found: words.len(), row: Row::InputNode });
    };
    let along = |word| number(word, Row::InputNode);
    Ok((whole(label, Row::InputNode)?, [along(x)?, along(y)?, along(z)?]))
}
