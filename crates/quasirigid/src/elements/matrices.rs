use super::ElementError;
use crate::math::sparse::SparseRows;
use crate::model::{Lossy, Rheology};

/// Entries of a matrix, with row and column.
pub(super) type Entries = Vec<(usize, usize, f64)>;

/// Part of the symmetric matrices over some coordinates.
#[derive(Clone, Debug)]
pub(super) struct Block {
    pub columns: Vec<usize>,
    pub stiffness: Vec<Vec<f64>>,
    pub damping: Vec<Vec<f64>>,
    /// How what has this stiffness answers periodic strain, beside the damping.
    pub rheology: Rheology,
}

/// Stiffness and damping of all coordinates, and the parts of the stiffness with a loss of their own. (I9), (G1)
pub(super) struct Matrices {
    pub stiffness: SparseRows<f64>,
    pub damping: SparseRows<f64>,
    pub lossy: Vec<Lossy>,
}

impl Matrices {
    /// Adds up the blocks of a body of this many coordinates, and the friction of what turns inside it.
    pub fn sum(
        size: usize,
        blocks: impl Iterator<Item = Result<Block, ElementError>>,
        friction: Entries,
    ) -> Result<Self, ElementError> {
        let (mut stiffness, mut damping) = (Vec::new(), friction);
        let mut materials: Vec<(Rheology, Entries)> = Vec::new();
        for block in blocks {
            let block = block?;
            let elastic = block.entries(&block.stiffness);
            damping.extend(block.entries(&block.damping));
            match &block.rheology {
                Rheology::Elastic => {}
                Rheology::KelvinVoigt { time } => {
                    damping.extend(elastic.iter().map(|(j, k, entry)| (*j, *k, time * entry)));
                }
                other => match materials.iter_mut().find(|(rheology, _)| rheology == other) {
                    Some((_, entries)) => entries.extend_from_slice(&elastic),
                    None => materials.push((other.clone(), elastic.clone())),
                },
            }
            stiffness.extend(elastic);
        }
        let lossy = |(rheology, entries)| Lossy { rheology, stiffness: SparseRows::sum(size, entries) };
        Ok(Self {
            stiffness: SparseRows::sum(size, stiffness),
            damping: SparseRows::sum(size, damping),
            lossy: materials.into_iter().map(lossy).collect(),
        })
    }
}

impl Block {
    /// Entries of one of its matrices, with their rows and columns in the whole.
    fn entries(&self, matrix: &[Vec<f64>]) -> Entries {
        let rows = self.columns.iter().zip(matrix);
        rows.flat_map(|(j, row)| self.columns.iter().zip(row).map(|(k, entry)| (*j, *k, *entry))).collect()
    }
}
