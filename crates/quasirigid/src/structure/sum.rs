use std::sync::Arc;

use nalgebra::DMatrix;

use super::freedoms::Freedoms;
use crate::finite::Element;
use crate::math::symmetric::{Pattern, Symmetric};

/// Unknowns of an element, and its freedoms as combinations of them.
pub(super) struct Tie {
    unknowns: Vec<Option<u32>>,
    /// A row per freedom; none where each freedom is an unknown or held.
    shares: Option<DMatrix<f64>>,
}

impl Tie {
    pub fn new(freedoms: &Freedoms, element: &dyn Element) -> Self {
        let rows: Vec<&[(usize, f64)]> = freedoms.rows(element.nodes(), element.freedoms()).collect();
        if rows.iter().all(|row| matches!(row, [] | [(_, 1.0)])) {
            let unknowns = rows.iter().map(|row| row.first().map(|(unknown, _)| *unknown as u32)).collect();
            return Self { unknowns, shares: None };
        }
        let mut unknowns: Vec<usize> =
            rows.iter().flat_map(|row| row.iter().map(|(unknown, _)| *unknown)).collect();
        unknowns.sort_unstable();
        unknowns.dedup();
        let mut shares = DMatrix::zeros(rows.len(), unknowns.len());
        for (number, row) in rows.iter().enumerate() {
            for (unknown, share) in *row {
                shares[(number, unknowns.partition_point(|known| known < unknown))] += share;
            }
        }
        Self {
            unknowns: unknowns.iter().map(|unknown| Some(*unknown as u32)).collect(),
            shares: Some(shares),
        }
    }

    /// Adds a multiple of the symmetric matrix of an element.
    pub fn add(&self, matrix: &DMatrix<f64>, factor: f64, sum: &mut Symmetric) {
        if factor == 0.0 {
            return;
        }
        let tied = match &self.shares {
            Some(shares) => factor * shares.tr_mul(matrix) * shares,
            None => factor * matrix,
        };
        sum.add(&self.unknowns, tied.as_slice()).expect("the pattern has the places of every element");
    }

    /// Freedoms of the element in displacements of the unknowns, a row per freedom.
    pub fn moved(&self, fields: &DMatrix<f64>) -> DMatrix<f64> {
        let unknown = |i: usize, j: usize| self.unknowns[i].map_or(0.0, |place| fields[(j, place as usize)]);
        let unknowns = DMatrix::from_fn(self.unknowns.len(), fields.nrows(), unknown);
        match &self.shares {
            Some(shares) => shares * unknowns,
            None => unknowns,
        }
    }

    fn groups(&self, groups: &[u32]) -> Vec<u32> {
        let group = |unknown: u32| groups.partition_point(|first| *first <= unknown) as u32 - 1;
        let mut joined: Vec<u32> = self.unknowns.iter().flatten().map(|unknown| group(*unknown)).collect();
        joined.sort_unstable();
        joined.dedup();
        joined
    }
}

/// The places that the matrices of elements fill.
pub(super) fn pattern(freedoms: &Freedoms, ties: &[Tie]) -> Arc<Pattern> {
    let groups = freedoms.groups();
    let lists: Vec<Vec<u32>> = ties.iter().map(|tie| tie.groups(&groups)).collect();
    let pattern = Pattern::new(&groups, lists.iter().map(Vec::as_slice));
    Arc::new(pattern.expect("groups ascend and each list names groups"))
}
