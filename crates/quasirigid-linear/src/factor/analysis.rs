//! Symbolic analysis of a factor: its order, size and cost, before its entries are computed.

use super::softest::refusal;
use super::{Factor, FactorWork, LARGE, NotPositive, Ordering, Precision, Stored, Structure, unit_diagonal};
use crate::symmetric::Symmetric;

/// A symmetric matrix with the order in which its unknowns are eliminated and the places of its factor.
#[derive(Clone, Debug)]
pub struct Analysis {
    matrix: Symmetric,
    scale: Vec<f64>,
    /// None of a matrix without rows.
    structure: Option<Structure>,
    ordering: Ordering,
}

impl Analysis {
    /// Orders the unknowns and finds where the factor fills.
    ///
    /// # Errors
    /// [`NotPositive`] names the rows whose diagonal is not positive, or all if the structure has no room in memory.
    pub fn new(matrix: &Symmetric, ordering: Ordering) -> Result<Self, NotPositive> {
        let scale = unit_diagonal(&matrix.diagonal())?;
        let matrix = matrix.clone();
        if scale.is_empty() {
            return Ok(Self { matrix, scale, structure: None, ordering });
        }
        let Some(structure) = Structure::new(&matrix, ordering) else {
            return Err(NotPositive { direction: vec![1.0; scale.len()] });
        };
        Ok(Self { ordering: structure.ordering, structure: Some(structure), matrix, scale })
    }

    /// Entries that the factor will store.
    #[must_use]
    pub fn entries(&self) -> usize {
        self.structure.as_ref().map_or(0, Structure::entries)
    }

    /// Bytes that computing the factor will take, at least, with as many threads as it would take here.
    #[must_use]
    pub fn bytes(&self, precision: Precision) -> f64 {
        let Some(structure) = &self.structure else { return 0.0 };
        let entries = self.matrix.entries().len();
        if self.begins_single(precision) {
            structure.bytes::<f32>(entries)
        } else {
            structure.bytes::<f64>(entries)
        }
    }

    fn begins_single(&self, precision: Precision) -> bool {
        let large = precision == Precision::Automatic && self.scale.len() > LARGE;
        large || precision == Precision::Single
    }

    /// Multiplications that the factorisation will take.
    #[must_use]
    pub fn multiplications(&self) -> f64 {
        self.structure.as_ref().map_or(0.0, Structure::multiplications)
    }

    /// Computes the factor.
    ///
    /// # Errors
    /// [`NotPositive`] holds a direction in which the matrix is singular or indefinite.
    pub fn factor(self, precision: Precision) -> Result<Factor, NotPositive> {
        let begins_single = self.begins_single(precision);
        let work = FactorWork {
            unknowns: self.scale.len(),
            entries: self.entries(),
            multiplications: self.multiplications(),
            precision: Precision::Double,
            ordering: self.ordering,
            iterations: 0,
        };
        let mut factor = Factor { matrix: self.matrix, scale: self.scale, triangle: Stored::Nothing, work };
        let Some(structure) = self.structure else { return Ok(factor) };
        if begins_single {
            factor.work.precision = Precision::Single;
            factor.triangle = factor.triangle_of(&structure).map_or(Stored::Nothing, Stored::Single);
            if factor.holds()? {
                return Ok(factor);
            }
            // Frees the memory of the first factor before the second is made.
            factor.triangle = Stored::Nothing;
        }
        factor.work.precision = Precision::Double;
        factor.work.iterations = 0;
        factor.triangle = factor.triangle_of(&structure).map_or(Stored::Nothing, Stored::Double);
        if factor.holds()? { Ok(factor) } else { Err(refusal(&factor.matrix, &structure, &factor.scale)) }
    }
}
