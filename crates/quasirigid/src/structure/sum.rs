use std::sync::Arc;

use nalgebra::DMatrix;

use super::dofs::Dofs;
use crate::finite::Element;
use crate::math::symmetric::Pattern;

/// Unknowns of an element, and its degrees of freedom as combinations of them.
pub(super) struct DofMap {
    unknowns: Vec<Option<u32>>,
    /// A row per degree of freedom; none where each degree of freedom is an unknown or fixed.
    shares: Option<DMatrix<f64>>,
}

impl DofMap {
    pub fn new(dofs: &Dofs, element: &dyn Element) -> Self {
        let rows: Vec<&[(usize, f64)]> = dofs.rows(element.nodes(), element.dofs()).collect();
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

    /// Unknowns, none in place of a fixed degree of freedom.
    pub fn unknowns(&self) -> &[Option<u32>] {
        &self.unknowns
    }

    /// A multiple of the symmetric matrix of an element, over the unknowns.
    pub fn tied(&self, matrix: &DMatrix<f64>, factor: f64) -> DMatrix<f64> {
        match &self.shares {
            Some(shares) => factor * shares.tr_mul(matrix) * shares,
            None => factor * matrix,
        }
    }

    /// Displacements of the unknowns over the degrees of freedom of the element, a row per degree of freedom.
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

/// Pattern of the matrices of elements.
pub(super) fn pattern(dofs: &Dofs, maps: &[DofMap]) -> Arc<Pattern> {
    let groups = dofs.groups();
    let lists: Vec<Vec<u32>> = maps.iter().map(|map| map.groups(&groups)).collect();
    let pattern = Pattern::new(&groups, lists.iter().map(Vec::as_slice));
    Arc::new(pattern.expect("groups ascend and each list names groups"))
}
