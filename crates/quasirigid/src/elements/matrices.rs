use nalgebra::{SMatrix, SVector};

use super::ElementError;
use crate::math::sparse::SparseRows;
use crate::model::{Dissipator, Lossy, Rheology};

/// Entries of a matrix, with row and column.
pub(super) type Entries = Vec<(usize, usize, f64)>;

/// Part of the symmetric matrices over some coordinates.
#[derive(Clone, Debug)]
pub(super) struct Block {
    /// Name of what dissipates; blocks of the same name are one dissipator.
    pub name: String,
    pub columns: Vec<usize>,
    pub stiffness: Vec<Vec<f64>>,
    pub damping: Vec<Vec<f64>>,
    /// How what has this stiffness answers periodic strain, beside the damping.
    pub rheology: Rheology,
}

/// Stiffness and damping of all coordinates, the parts of the stiffness with a loss of their own, and what dissipates. (I9), (G1),
/// (D1)
pub(super) struct Matrices {
    pub stiffness: SparseRows<f64>,
    pub damping: SparseRows<f64>,
    pub lossy: Vec<Lossy>,
    pub dissipators: Vec<Dissipator>,
}

/// A dissipator while its entries are collected.
struct Draft {
    name: String,
    damping: Entries,
    loss: Option<(Rheology, Entries)>,
}

impl Matrices {
    /// Adds up the blocks of a body of this many coordinates, and the friction of what turns inside it, by name.
    pub fn sum(
        size: usize,
        blocks: impl Iterator<Item = Result<Block, ElementError>>,
        friction: &[(String, Entries)],
    ) -> Result<Self, ElementError> {
        let (mut stiffness, mut damping): (Entries, Entries) = (Vec::new(), Vec::new());
        let mut materials: Vec<(Rheology, Entries)> = Vec::new();
        let mut drafts: Vec<Draft> = Vec::new();
        for block in blocks {
            let block = block?;
            let elastic = block.entries(&block.stiffness);
            let (viscous, loss) = block.losses(&elastic);
            if let Some((rheology, entries)) = &loss {
                match materials.iter_mut().find(|(known, _)| known == rheology) {
                    Some((_, sum)) => sum.extend_from_slice(entries),
                    None => materials.push((rheology.clone(), entries.clone())),
                }
            }
            damping.extend_from_slice(&viscous);
            stiffness.extend(elastic);
            Draft::add(&mut drafts, &block.name, &viscous, loss);
        }
        for (name, entries) in friction {
            damping.extend_from_slice(entries);
            Draft::add(&mut drafts, name, entries, None);
        }
        let lossy = |(rheology, entries)| Lossy { rheology, stiffness: SparseRows::sum(size, entries) };
        Ok(Self {
            stiffness: SparseRows::sum(size, stiffness),
            damping: SparseRows::sum(size, damping),
            lossy: materials.into_iter().map(lossy).collect(),
            dissipators: drafts.into_iter().map(|draft| draft.finished(size)).collect(),
        })
    }
}

impl Block {
    /// Law for the displacement of one end relative to another, given per unit of each coordinate that moves them.
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

    /// Entries of one of its matrices, with their rows and columns in the whole.
    fn entries(&self, matrix: &[Vec<f64>]) -> Entries {
        let rows = self.columns.iter().zip(matrix);
        rows.flat_map(|(j, row)| self.columns.iter().zip(row).map(|(k, entry)| (*j, *k, *entry))).collect()
    }

    /// Its damping, that of a Kelvin-Voigt material with it, and what of its stiffness has another loss.
    fn losses(&self, elastic: &Entries) -> (Entries, Option<(Rheology, Entries)>) {
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

impl Draft {
    /// Adds damping and loss to the dissipator of a name; what has neither is none.
    fn add(drafts: &mut Vec<Self>, name: &str, damping: &Entries, loss: Option<(Rheology, Entries)>) {
        let damping = damping.iter().copied().filter(|(_, _, entry)| *entry != 0.0);
        let mut damping = damping.peekable();
        if damping.peek().is_none() && loss.is_none() {
            return;
        }
        let joins = |draft: &&mut Self| {
            let same = match (&draft.loss, &loss) {
                (Some((known, _)), Some((rheology, _))) => known == rheology,
                _ => true,
            };
            same && draft.name == name
        };
        let Some(draft) = drafts.iter_mut().find(joins) else {
            drafts.push(Self { name: name.to_owned(), damping: damping.collect(), loss });
            return;
        };
        draft.damping.extend(damping);
        match (&mut draft.loss, loss) {
            (Some((_, entries)), Some((_, more))) => entries.extend(more),
            (known @ None, more) => *known = more,
            (Some(_), None) => {}
        }
    }

    fn finished(self, size: usize) -> Dissipator {
        let lossy = |(rheology, entries)| Lossy { rheology, stiffness: SparseRows::sum(size, entries) };
        Dissipator {
            name: self.name,
            damping: SparseRows::sum(size, self.damping),
            loss: self.loss.map(lossy),
        }
    }
}
