use std::collections::HashSet;
use std::fmt;

use super::error::{Fault, MatrixProblem, Place, Row};
use crate::text_file::{lines, text, whole};

/// A degree of freedom as a finite-element code names it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Dof {
    /// Label of the node.
    pub node: u64,
    /// 1 to 3 for displacements along the axes, 4 to 6 for rotations about them, 0 for a point that has one degree of freedom
    /// only.
    pub component: u8,
}

impl fmt::Display for Dof {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}.{}", self.node, self.component)
    }
}

/// Lines `node.component` or `node component`.
pub(super) fn read(bytes: &[u8]) -> Result<Vec<Dof>, Fault> {
    let (mut dofs, mut known) = (Vec::new(), HashSet::new());
    for (line, words) in lines(text::<MatrixProblem>(bytes)?) {
        let place = Place::Line(line);
        let dof = dof(words).map_err(|problem| (place.clone(), problem))?;
        if !known.insert(dof) {
            return Err((place, MatrixProblem::DofTwice { dof }));
        }
        dofs.push(dof);
    }
    if dofs.is_empty() { Err((Place::File, MatrixProblem::Empty)) } else { Ok(dofs) }
}

fn dof(line: &str) -> Result<Dof, MatrixProblem> {
    let words: Vec<&str> = line
        .split(|c: char| c.is_whitespace() || ".,;".contains(c))
        .filter(|word| !word.is_empty())
        .collect();
    let [node, component] = words[..] else {
        return Err(MatrixProblem::Values { found: words.len(), row: Row::Dof });
    };
    let node = whole(node, Row::Dof)?;
    match whole(component, Row::Dof)? {
        component @ 1..=6 => Ok(Dof { node, component: component as u8 }),
        _ => Err(MatrixProblem::Component { found: component.into() }),
    }
}
