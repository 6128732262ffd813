//! Rigid motions of a floating structure: balance of loads, removal of rigid parts, and springs that resist a rotation of the whole.
//! A spring across the line of its ends gives the six pins a load; the twelve-row correction restores the Tisserand frame.
//! Equations (K7) and (K15), docs/theory/12-structures.md.

use nalgebra::{DMatrix, Matrix6, SMatrix, Vector3, Vector6};

use super::discrete::{Discrete, times};
use super::dofs::Unknown;
use crate::math::factor::{Factor, NotPositive};

/// Six rigid motions of a structure, a row each, and their forces of inertia. (K7)
pub(super) struct Rigid {
    fields: DMatrix<f64>,
    forces: DMatrix<f64>,
    inverse: Matrix6<f64>,
}

impl Rigid {
    pub fn new(discrete: &Discrete<'_>) -> Self {
        let center = discrete.structure.middle();
        let nodes = &discrete.structure.nodes;
        let unknowns = discrete.dofs.unknowns();
        let mut fields = DMatrix::zeros(6, unknowns.len());
        for (column, unknown) in unknowns.iter().enumerate() {
            if let Unknown::Node(node, component) = *unknown {
                let motion = motions(nodes[node].place - center);
                fields.column_mut(column).copy_from(&motion.column(component));
            }
        }
        let forces = times(&discrete.mass, &fields);
        let matrix = Matrix6::from_fn(|i, j| fields.row(i).dot(&forces.row(j)));
        let inverse = matrix.try_inverse().unwrap_or_else(Matrix6::zeros);
        Self { fields, forces, inverse }
    }

    /// Removes the forces of the rigid acceleration that the loads cause.
    pub fn balance(&self, forces: &mut DMatrix<f64>) {
        let shares = &*forces * self.fields.transpose() * self.inverse;
        forces.gemm(-1.0, &shares, &self.forces, 1.0);
    }

    /// Removes the rigid part of the displacements.
    pub fn settle(&self, displacements: &mut DMatrix<f64>) {
        let shares = &*displacements * self.forces.transpose() * self.inverse;
        displacements.gemm(-1.0, &shares, &self.fields, 1.0);
    }
}

/// Displacement and rotation of a place `s` from the centre in each of the six motions, a row each.
fn motions(s: Vector3<f64>) -> SMatrix<f64, 6, 6> {
    let mut motions = SMatrix::<f64, 6, 6>::identity();
    motions.fixed_view_mut::<3, 3>(3, 0).copy_from(&s.cross_matrix());
    motions
}

/// Energy of a rigid motion, relative to the energies of its displacements one by one, that is rounding.
const RIGID_ENERGY_ROUNDING: f64 = 1e-13;
/// Share of its stiffness below which a motion of the floating structure meets none.
const LOOSE: f64 = 1e-13;

type Matrix12 = SMatrix<f64, 12, 12>;

/// Difference of the stiffness where the structure floats although something resists a rigid motion, as a spring between nodes apart does
/// that acts across the line between them: `Pᵀ C P − C = Bᵀ Q B`, with twelve rows `B`. (K15)
pub(super) struct RigidMotionStiffness {
    /// `B`.
    rows: DMatrix<f64>,
    /// `B Cₚ⁻¹`.
    answers: DMatrix<f64>,
    /// `(1 + Q B Cₚ⁻¹ Bᵀ)⁻¹ Q`.
    between: Matrix12,
}

impl RigidMotionStiffness {
    /// Resistance to rigid motions; none if nothing resists them.
    ///
    /// # Errors
    /// [`NotPositive`] contains a motion that only the pins resist.
    pub fn new(discrete: &Discrete<'_>, rigid: &Rigid, pinned: &Factor) -> Result<Option<Self>, NotPositive> {
        let resisting = times(&discrete.total, &rigid.fields);
        let energies = &resisting * rigid.fields.transpose();
        let diagonal = discrete.total.diagonal();
        let resisted = rigid.fields.row_iter().enumerate().any(|(motion, field)| {
            let alone: f64 = field.iter().zip(&diagonal).map(|(x, entry)| entry * x * x).sum();
            energies[(motion, motion)] > RIGID_ENERGY_ROUNDING * alone
        });
        if !resisted {
            return Ok(None);
        }
        let mut rows = DMatrix::zeros(12, diagonal.len());
        rows.rows_mut(0, 6).copy_from(&resisting);
        rows.rows_mut(6, 6).copy_from(&(rigid.inverse * &rigid.forces));
        let mut answers = rows.clone();
        pinned.solve(answers.as_mut_slice(), 12);
        let units = Vector6::from_fn(|i, _| rows.row(6 + i).dot(&answers.row(6 + i)).sqrt());
        if !units.iter().all(|unit| *unit > 0.0) {
            return Ok(None);
        }
        for matrix in [&mut rows, &mut answers] {
            for (i, unit) in units.iter().enumerate() {
                matrix.row_mut(i).scale_mut(*unit);
                matrix.row_mut(6 + i).scale_mut(unit.recip());
            }
        }
        let mut Q = Matrix12::zeros();
        for i in 0..6 {
            (Q[(i, 6 + i)], Q[(6 + i, i)]) = (-1.0, -1.0);
            (0..6).for_each(|j| Q[(6 + i, 6 + j)] = units[i] * energies[(i, j)] * units[j]);
        }
        let compliance = &rows * answers.transpose();
        let ratio: Matrix12 = Matrix12::identity() + Q * Matrix12::from_fn(|i, j| compliance[(i, j)]);
        match ratio.try_inverse() {
            Some(inverse) if LOOSE * inverse.amax() * ratio.amax() < 1.0 => {
                Ok(Some(Self { rows, answers, between: inverse * Q }))
            }
            _ => Err(NotPositive { direction: loose(&ratio, &answers) }),
        }
    }

    /// Corrects responses to loads in balance, found with pins, to those of the floating structure: Woodbury's identity.
    pub fn correct(&self, displacements: &mut DMatrix<f64>) {
        let shares = &*displacements * self.rows.transpose() * self.between.transpose();
        displacements.gemm(-1.0, &shares, &self.answers, 1.0);
    }
}

/// Motion that meets no stiffness, its largest entry one.
fn loose(ratio: &Matrix12, answers: &DMatrix<f64>) -> Vec<f64> {
    let shares = ratio.svd(false, true).v_t.map(|rows| rows.row(11).into_owned());
    let Some(shares) = shares else { return vec![0.0; answers.ncols()] };
    let motion = shares * answers;
    let scale = motion.amax();
    motion.iter().map(|entry| entry / scale).collect()
}
