//! Real modes of NASTRAN, from whatever file: angular frequencies, and shapes by degrees of freedom, as matrices.

use std::collections::BTreeMap;

use crate::matrix::error::MatrixProblem;
use crate::matrix::listed::{Listed, LocatedProblem, Symmetry};
use crate::matrix::{Dof, MatrixFile};

/// Name of the column of angular frequencies (rad/s).
pub(crate) const FREQUENCIES: &str = "FREQUENCIES";
/// Name of the matrix whose columns are the shapes.
pub(crate) const SHAPES: &str = "SHAPES";

/// Real modes.
#[derive(Default)]
pub(crate) struct Modes {
    /// Angular frequencies (rad/s).
    pub frequencies: Vec<f64>,
    pub shapes: Vec<Shape>,
    /// Whether the shapes are along the axes of the basic system at every grid point.
    pub basic: bool,
}

/// Values of a shape.
#[derive(Default)]
pub(crate) struct Shape {
    pub values: Vec<(Dof, f64)>,
}

impl Modes {
    /// Names of what there is.
    pub fn names(&self) -> Vec<String> {
        let named = [(FREQUENCIES, self.frequencies.is_empty()), (SHAPES, self.shapes.is_empty())];
        named.iter().filter(|(_, none)| !none).map(|(name, _)| (*name).to_owned()).collect()
    }

    /// The column of angular frequencies, or the shapes, one in each column; none of another name.
    ///
    /// # Errors
    /// A number that is not finite, or a degree of freedom twice in a shape.
    pub fn matrix(self, name: &str) -> Result<Option<MatrixFile>, LocatedProblem> {
        if name.eq_ignore_ascii_case(FREQUENCIES) && !self.frequencies.is_empty() {
            let mut listed = Listed::new(self.frequencies.len(), 1).map_err(|problem| (0, problem))?;
            for (mode, frequency) in self.frequencies.iter().enumerate() {
                listed.add(mode, 0, finite(*frequency)?, 0)?;
            }
            return listed.unique(Symmetry::General).map(Some);
        }
        if name.eq_ignore_ascii_case(SHAPES) && !self.shapes.is_empty() {
            return self.columns().map(Some);
        }
        Ok(None)
    }

    fn columns(self) -> Result<MatrixFile, LocatedProblem> {
        let all = self.shapes.iter().flat_map(|shape| &shape.values);
        let mut rows: BTreeMap<Dof, usize> = all.map(|(dof, _)| (*dof, 0)).collect();
        for (row, number) in rows.values_mut().enumerate() {
            *number = row;
        }
        let mut listed = Listed::new(rows.len(), self.shapes.len()).map_err(|problem| (0, problem))?;
        for (column, shape) in self.shapes.into_iter().enumerate() {
            for (dof, value) in shape.values {
                listed.add(rows[&dof], column, finite(value)?, 0)?;
            }
        }
        let matrix = listed.unique(Symmetry::General)?;
        Ok(MatrixFile { labels: Some(rows.into_keys().collect()), ..matrix })
    }
}

fn finite(value: f64) -> Result<f64, LocatedProblem> {
    if value.is_finite() {
        return Ok(value);
    }
    Err((0, MatrixProblem::NotFinite { found: value.to_string().into() }))
}
