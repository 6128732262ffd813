//! Blocks of the system matrices: stiffness and damping over some coordinates.

use nalgebra::{SMatrix, SVector};

use crate::model::Rheology;

/// Entries of a matrix, with row and column.
pub(crate) type Entries = Vec<(usize, usize, f64)>;

/// Part of the symmetric matrices over some coordinates.
#[derive(Clone, Debug)]
pub(crate) struct Block {
    /// Name of the dissipator; blocks of the same name are one dissipator.
    pub name: String,
    pub columns: Vec<usize>,
    pub stiffness: Vec<Vec<f64>>,
    pub damping: Vec<Vec<f64>>,
    /// Rheology of this stiffness: response to periodic strain, beside the damping.
    pub rheology: Rheology,
}

impl Block {
    /// Block of a law for the displacement of one end relative to another, given per unit of each coordinate that moves them.
    pub fn between<const N: usize>(
        name: &str,
        rheology: &Rheology,
        moved: &[(usize, SVector<f64, N>)],
        stiffness: &SMatrix<f64, N, N>,
        damping: &SMatrix<f64, N, N>,
    ) -> Self {
        let form = |matrix: &SMatrix<f64, N, N>| {
            let row = |e: &SVector<f64, N>| moved.iter().map(|(_, f)| e.dot(&(matrix * f))).collect();
            moved.iter().map(|(_, e)| row(e)).collect()
        };
        Self {
            name: name.to_owned(),
            columns: moved.iter().map(|(column, _)| *column).collect(),
            stiffness: form(stiffness),
            damping: form(damping),
            rheology: rheology.clone(),
        }
    }

    /// Entries of one matrix of the block, with their rows and columns in the whole.
    pub fn entries(&self, matrix: &[Vec<f64>]) -> Entries {
        let rows = self.columns.iter().zip(matrix);
        rows.flat_map(|(j, row)| self.columns.iter().zip(row).map(|(k, entry)| (*j, *k, *entry))).collect()
    }

    /// Losses of the block: its damping, with that of a Kelvin-Voigt material, and the part of its stiffness that has another loss.
    pub fn losses(&self, elastic: &Entries) -> (Entries, Option<(Rheology, Entries)>) {
        let mut damping = self.entries(&self.damping);
        match &self.rheology {
            Rheology::Elastic => (damping, None),
            Rheology::KelvinVoigt { time } => {
                damping.extend(elastic.iter().map(|(j, k, entry)| (*j, *k, time * entry)));
                (damping, None)
            }
            other => (damping, Some((other.clone(), elastic.clone()))),
        }
    }
}
