use crate::math::dynamic_stiffness::{DynamicStiffness, Oscillator};
use crate::math::eigen::Dense;
use crate::math::lu::{ComplexDense, ComplexLu};
use crate::math::sparse::SparseRows;
use crate::math::sym3;
use crate::model::FlexibleBody;

/// Stiff linear part `L` of the rates of the coordinates and their momenta, solved by the implicit method. (T2), (T4)
#[derive(Clone, Debug)]
pub(super) enum StiffPart {
    /// Free vibrations of the recoiling body: constant, and sparse in a large body.
    Vibrations(Box<Oscillator>, Vec<DynamicStiffness>),
    /// Jacobian of the rates at a state, for curved paths and controllers, where `L` changes with the state.
    Jacobian(Dense, Vec<Option<ComplexLu>>),
}

impl StiffPart {
    /// Free vibrations with recoil, `M = A − SSᵀ/m* − hJ⁻¹hᵀ`: `q̇ = M⁻¹p`, `ṗ = −Bq̇ − Cq`. (V2)
    pub fn vibrations(body: &FlexibleBody) -> Self {
        let invariants = body.invariants();
        let n = body.coordinates().len();
        let A = SparseRows::sum(n, invariants.pairs.iter().map(|(j, k, pair)| (j, k, pair.A)).collect());
        let rows = invariants.S.iter().zip(&invariants.h).map(|(S, h)| [S[0], S[1], S[2], h[0], h[1], h[2]]);
        let mut weights = [[0.0; 6]; 6];
        let inverse = sym3::rows(sym3::inverse(invariants.J));
        for i in 0..3 {
            weights[i][i] = body.translation().unwrap_or(0.0);
            weights[3 + i][3..].copy_from_slice(&inverse[i]);
        }
        let vibrator =
            Oscillator::new(A, rows.collect(), weights, body.damping().clone(), body.stiffness().clone());
        Self::Vibrations(Box::new(vibrator), Vec::new())
    }

    /// Prepares to solve `(s − L) x = right` at the shifts `s` (1/s).
    pub fn shift(&mut self, shifts: [[f64; 2]; 4]) {
        match self {
            Self::Vibrations(vibrator, stiffness) => *stiffness = shifts.map(|s| vibrator.at(s)).into(),
            Self::Jacobian(rates, factors) => *factors = shifts.map(|s| factored(rates, s)).into(),
        }
    }

    /// Solves at the shift with this index, in place; NaN where `s` is an eigenvalue.
    pub fn solve(&mut self, shift: usize, right: &mut [[f64; 2]]) {
        match self {
            Self::Vibrations(vibrator, stiffness) => vibrator.solve(&mut stiffness[shift], right),
            Self::Jacobian(_, factors) => {
                match factors[shift].as_ref().and_then(|factor| factor.solve(right, 1)) {
                    Some(solved) => right.copy_from_slice(&solved),
                    None => right.fill([f64::NAN; 2]),
                }
            }
        }
    }
}

/// Factors of `s − L`.
fn factored(rates: &Dense, s: [f64; 2]) -> Option<ComplexLu> {
    let mut matrix = ComplexDense::zero(rates.size());
    matrix.add_scaled([-1.0, 0.0], rates);
    (0..rates.size()).for_each(|i| matrix.add(i, i, s));
    ComplexLu::new(&matrix)
}
