//! Matrices of the small motions about a steady spin as numbers that another program can read, for a check without this one.
//! Equations (M2) and (M3), docs/theory/15-modes.md.

use nalgebra::{Complex, Vector3};

use super::equilibrium::RelativeEquilibrium;
use super::unknowns::{Unknowns, between_axes};
use crate::math::sparse::SparseRows;
use crate::math::sym3;
use crate::model::{FlexibleBody, LiquidMemory, Rheology, SpinCoefficients, SpinMatrix};

/// Entries of a matrix that are not zero: row, column, value.
pub type Entries = Vec<(usize, usize, f64)>;

/// Matrices of `P(λ)(δω, δq) = 0` about a steady spin, in the unknowns after the angular velocity: coordinates, then the angles of
/// liquids whose impedance is known in place of their coordinates. (M3)
///
/// Components are in body axes. Units follow from those of the unknowns, m and rad.
#[derive(Clone, Debug)]
pub struct SpinMatrices {
    /// Name of each unknown; the coordinate that moves, or the liquid.
    pub names: Vec<String>,
    /// Coordinate of the body of each unknown; none for the angle of a liquid.
    pub coordinates: Vec<Option<usize>>,
    /// Inertia tensor `J_s` (kg·m²), `(3, 3)`.
    pub inertia: [[f64; 3]; 3],
    /// Angular momentum per rate of each unknown, `H`.
    pub h: Vec<[f64; 3]>,
    /// Angular momentum per displacement of each unknown, `U`.
    pub slopes: Vec<[f64; 3]>,
    /// Mass matrix `A`.
    pub mass: Entries,
    /// Damping matrix `B`.
    pub damping: Entries,
    /// Gyroscopic matrix `G`.
    pub gyroscopic: Entries,
    /// Stiffness matrix `C`.
    pub stiffness: Entries,
    /// Centrifugal stiffness `N`.
    pub centrifugal: Entries,
    /// Parts of `C` whose material has a law of its own.
    pub materials: Vec<(Rheology, Entries)>,
    omega: [f64; 3],
    liquids: Vec<(usize, LiquidMemory)>,
}

impl SpinMatrices {
    /// Matrices about a relative equilibrium.
    #[must_use]
    pub fn about(body: &FlexibleBody, equilibrium: &RelativeEquilibrium) -> Self {
        let coefficients = equilibrium.coefficients(body);
        let unknowns = Unknowns::exact(body);
        let kept = &unknowns.kept;
        let (h, slopes) = unknowns.couplings(&coefficients).unzip();
        let name = |j: usize| body.coordinates()[j].name.clone();
        let angles = unknowns
            .memories
            .iter()
            .flat_map(|(_, memory)| memory.axes.iter().map(|_| name(memory.coordinates.start)));
        let names: Vec<String> = kept.iter().map(|j| name(*j)).chain(angles).collect();
        let mut coordinates: Vec<Option<usize>> = kept.iter().copied().map(Some).collect();
        coordinates.resize(names.len(), None);
        let SpinCoefficients { inertia, mass, gyroscopic, centrifugal, .. } = &coefficients;
        let law = |material: &crate::model::Viscoelastic| {
            (material.rheology.clone(), of_sparse(&material.stiffness, kept))
        };
        Self {
            inertia: sym3::rows(*inertia),
            h,
            slopes,
            mass: of_spin(mass, kept),
            damping: of_sparse(body.damping(), kept),
            gyroscopic: of_spin(gyroscopic, kept),
            stiffness: of_sparse(body.stiffness(), kept),
            centrifugal: of_spin(centrifugal, kept),
            materials: body.viscoelastic().iter().map(law).collect(),
            omega: equilibrium.omega,
            liquids: unknowns.memories.iter().map(|(start, memory)| (*start, (*memory).clone())).collect(),
            names,
            coordinates,
        }
    }

    /// True if a material or a liquid makes the eigenproblem nonlinear.
    #[must_use]
    pub fn nonlinear(&self) -> bool {
        !(self.materials.is_empty() && self.liquids.is_empty())
    }

    /// Entries `λ a·Z(λ) b` of liquids at an eigenvalue (1/s, real and imaginary part): row, column, real and imaginary part (N·m).
    #[must_use]
    pub fn impedances(&self, lambda: [f64; 2]) -> Vec<(usize, usize, [f64; 2])> {
        let (lambda, omega) = (Complex::new(lambda[0], lambda[1]), Vector3::from(self.omega));
        let of_liquid = |(start, memory): &(usize, LiquidMemory)| {
            let start = *start;
            let entries = between_axes(memory, lambda, omega).into_iter();
            entries.map(move |(i, j, entry)| (start + i, start + j, [entry.re, entry.im]))
        };
        self.liquids.iter().flat_map(of_liquid).collect()
    }
}

fn of_spin(matrix: &SpinMatrix, kept: &[usize]) -> Entries {
    let mut entries = Vec::new();
    for (row, j) in kept.iter().enumerate() {
        for (column, k) in kept.iter().enumerate() {
            let value = matrix.at(*j, *k);
            if value != 0.0 {
                entries.push((row, column, value));
            }
        }
    }
    entries
}

fn of_sparse(matrix: &SparseRows<f64>, kept: &[usize]) -> Entries {
    let mut entries = Vec::new();
    for (row, j) in kept.iter().enumerate() {
        for (k, value) in matrix.row(*j) {
            if let (Ok(column), true) = (kept.binary_search(&k), *value != 0.0) {
                entries.push((row, column, *value));
            }
        }
    }
    entries
}
