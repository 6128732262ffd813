//! Static responses of a structure: on its carrier, or floating in the Tisserand frame; and its lowest modes.
//! A floating stiffness is singular, so it is factored with six pins, which carry no load when the loads are in balance.
//! Equations (K7) and (K15), docs/theory/12-structures.md.

use nalgebra::{DMatrix, Matrix3, Vector3};

use super::discrete::{Discrete, times};
use super::rigid::{Rigid, RigidMotionStiffness};
use crate::math::eigen::NoConvergence;
use crate::math::factor::{Analysis, Factor, Method, NotPositive};
use crate::math::krylov::Pencil;
use crate::math::memory::{self, TooMuchMemory};
use crate::math::symmetric::Symmetric;
use crate::math::watch;

/// Static responses of a structure to loads: on its carrier, or floating in the Tisserand frame.
pub(super) struct Solver {
    factor: Factor,
    /// Rigid motions, of a structure that floats.
    rigid: Option<Rigid>,
    /// Resistance to rigid motions.
    resistance: Option<RigidMotionStiffness>,
}

/// Cause for which a structure has no solver.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Unsolved {
    /// A motion meets no stiffness.
    Singular(NotPositive),
    /// The factor has no room.
    Memory(TooMuchMemory),
}

impl From<NotPositive> for Unsolved {
    fn from(singular: NotPositive) -> Self {
        Self::Singular(singular)
    }
}

/// Factor of a matrix, after a check of the memory.
fn factor(matrix: &Symmetric) -> Result<Factor, Unsolved> {
    let Method { precision, ordering } = Method::default();
    watch::stage("ordering the unknowns");
    let analysis = Analysis::new(matrix, ordering)?;
    watch::stage("factoring the stiffness");
    memory::ask(analysis.bytes(precision)).map_err(Unsolved::Memory)?;
    Ok(analysis.factor(precision)?)
}

impl Solver {
    /// Solver of a structure, floating or on its carrier.
    ///
    /// # Errors
    /// [`Unsolved`] with a motion that meets no stiffness, or with the memory that the factor needs.
    pub fn new(discrete: &Discrete<'_>, floating: bool) -> Result<Self, Unsolved> {
        if !floating {
            return Ok(Self { factor: factor(&discrete.total)?, rigid: None, resistance: None });
        }
        let rigid = Rigid::new(discrete);
        let factor = factor(&pinned(discrete))?;
        let resistance = RigidMotionStiffness::new(discrete, &rigid, &factor)?;
        Ok(Self { factor, rigid: Some(rigid), resistance })
    }

    /// Whether the structure floats.
    pub fn floats(&self) -> bool {
        self.rigid.is_some()
    }

    /// Displacements under forces, a row each. A floating structure is loaded by the forces and by the inertia that they cause, and keeps
    /// its linear and angular momentum at zero. (K7)
    pub fn answers(&self, mut forces: DMatrix<f64>) -> DMatrix<f64> {
        if let Some(rigid) = &self.rigid {
            rigid.balance(&mut forces);
        }
        let width = forces.nrows();
        if width == 0 {
            return forces;
        }
        self.factor.solve(forces.as_mut_slice(), width);
        if let Some(resistance) = &self.resistance {
            resistance.correct(&mut forces);
        }
        if let Some(rigid) = &self.rigid {
            rigid.settle(&mut forces);
        }
        forces
    }
}

impl Solver {
    /// The lowest modes of vibration, a row each.
    ///
    /// # Errors
    /// [`NoConvergence`] if they are not found.
    pub fn modes(&self, discrete: &Discrete<'_>, count: usize) -> Result<DMatrix<f64>, NoConvergence> {
        let size = discrete.dofs.unknowns().len();
        let answer = |x: &mut [f64]| {
            let found = self.answers(DMatrix::from_row_slice(1, size, x));
            x.copy_from_slice(found.as_slice());
        };
        let stiffness = |x: &[f64]| self.stiffness(discrete, x);
        let mass = |x: &[f64]| discrete.mass.times(x);
        let pencil = Pencil { size, stiffness: &stiffness, solve: &answer, mass: &mass };
        let found = if count == 0 { Vec::new() } else { pencil.largest(count)? };
        let mut modes = DMatrix::from_fn(found.len(), size, |row, column| found[row][column]);
        if let Some(rigid) = &self.rigid {
            rigid.settle(&mut modes);
        }
        Ok(modes)
    }

    /// `Pᵀ C P x` where something resists a rigid motion, else `C x`, which is the same. (K15)
    fn stiffness(&self, discrete: &Discrete<'_>, x: &[f64]) -> Vec<f64> {
        let (Some(rigid), Some(_)) = (&self.rigid, &self.resistance) else { return discrete.total.times(x) };
        let mut settled = DMatrix::from_row_slice(1, x.len(), x);
        rigid.settle(&mut settled);
        let mut forces = times(&discrete.total, &settled);
        rigid.balance(&mut forces);
        forces.as_slice().to_vec()
    }
}

/// Stiffness with six pins: enough to fix a rigid body, and too few to strain one. (K7)
fn pinned(discrete: &Discrete<'_>) -> Symmetric {
    let diagonal = discrete.total.diagonal();
    let firm = diagonal.iter().sum::<f64>() / diagonal.len().max(1) as f64;
    let unknown =
        |node, component| discrete.dofs.row(node, component).first().map(|(unknown, _)| *unknown as u32);
    let mut pinned = discrete.total.clone();
    for (node, pins) in pins(discrete) {
        let unknowns: Vec<Option<u32>> =
            (0..pins.nrows()).map(|component| unknown(node, component)).collect();
        pinned.add(&unknowns, (firm * pins).as_slice()).expect("a node joins its own unknowns");
    }
    pinned
}

/// Distance of the third pin from the line of the others, relative to their distance, below which all nodes are in a line.
const IN_LINE: f64 = 1e-6;

/// Pinned nodes, and the components of their motion: three nodes, or one with rotations where there are no three off one line.
fn pins(discrete: &Discrete<'_>) -> Vec<(usize, DMatrix<f64>)> {
    let nodes = &discrete.structure.nodes;
    let free: Vec<usize> =
        (0..nodes.len()).filter(|node| discrete.structure.constraints[*node].is_free()).collect();
    let farthest = |measure: &dyn Fn(Vector3<f64>) -> f64| {
        let far = |a: &&usize, b: &&usize| measure(nodes[**a].place).total_cmp(&measure(nodes[**b].place));
        free.iter().max_by(far).copied().unwrap_or_default()
    };
    if free.is_empty() {
        return Vec::new();
    }
    let center = discrete.structure.middle();
    let a = farthest(&|place| (place - center).norm());
    let start = nodes[a].place;
    let b = farthest(&|place| (place - start).norm());
    let line = (nodes[b].place - start).try_normalize(0.0).unwrap_or_else(Vector3::x);
    let c = farthest(&|place| (place - start).cross(&line).norm());
    let height = (nodes[c].place - start).cross(&line).norm();
    let in_line = free.len() < 3 || height <= IN_LINE * (nodes[b].place - start).norm();
    if let (true, Some(node)) = (in_line, free.iter().find(|node| nodes[**node].rotations)) {
        return vec![(*node, DMatrix::identity(6, 6))];
    }
    let normal = line.cross(&(nodes[c].place - start)).try_normalize(0.0).unwrap_or_else(Vector3::y);
    let whole = Matrix3::identity();
    let pins = [(a, whole), (b, whole - line * line.transpose()), (c, normal * normal.transpose())];
    pins.map(|(node, block)| (node, DMatrix::from_column_slice(3, 3, block.as_slice()))).to_vec()
}
