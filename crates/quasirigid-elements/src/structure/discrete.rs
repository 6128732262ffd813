//! Structure and its matrices: finite elements between nodes, assembled over the unknowns.
//! Stiffness is kept by material, since each rheology needs its own; memory is asked for before anything is allocated.
//! Equations (K1) to (K3), docs/theory/12-structures.md.

use nalgebra::{DMatrix, Vector3};

use super::assembly::Sums;
use super::dofs::{Constraint, Dofs, Node, Unknown};
use super::patch::{patches, pattern};
use crate::finite::Element;
use crate::math::memory::{self, TooMuchMemory};
use crate::math::symmetric::Symmetric;
use crate::math::watch;
use crate::model::Rheology;

/// Structure: finite elements between nodes, as the parts of a body give them.
#[derive(Default)]
pub(crate) struct Structure {
    pub nodes: Vec<Node>,
    /// Constraint of each node.
    pub constraints: Vec<Constraint>,
    pub elements: Vec<Box<dyn Element>>,
    /// Names of the owners of elements, each with the end of its elements.
    pub owners: Vec<(String, usize)>,
    pub joints: Vec<Joint>,
    pub materials: Vec<MaterialDamping>,
}

impl Structure {
    /// Mean of the places of the nodes (m), in the file's frame.
    pub fn middle(&self) -> Vector3<f64> {
        self.nodes.iter().map(|node| node.place).sum::<Vector3<f64>>() / self.nodes.len().max(1) as f64
    }

    /// Assigns all elements without an owner to the one of this name.
    pub fn own(&mut self, name: &str) {
        self.owners.push((name.to_owned(), self.elements.len()));
    }

    /// Name of the owner of each element, in their order; empty where there is none.
    pub fn owner_of_each(&self) -> impl Iterator<Item = &str> {
        let starts = std::iter::once(0).chain(self.owners.iter().map(|(_, end)| *end));
        let owned = self.owners.iter().zip(starts);
        let owned = owned.flat_map(|((name, end), start)| std::iter::repeat_n(name.as_str(), end - start));
        owned.chain(std::iter::repeat(""))
    }

    /// Number of the material with a rheology, and damping in proportion to mass (1/s) and stiffness (s); a new material is added.
    pub fn material(&mut self, rheology: &Rheology, rayleigh: [f64; 2]) -> usize {
        self.named_material("", rheology, rayleigh)
    }

    /// The same of a material by its name, under which its loss is counted; a name without loss is none.
    pub fn named_material(&mut self, name: &str, rheology: &Rheology, rayleigh: [f64; 2]) -> usize {
        let [per_mass, per_stiffness] = rayleigh;
        let mut material =
            MaterialDamping { name: String::new(), rheology: rheology.clone(), per_mass, per_stiffness };
        if material.dissipates() {
            name.clone_into(&mut material.name);
        }
        self.materials.iter().position(|known| *known == material).unwrap_or_else(|| {
            self.materials.push(material);
            self.materials.len() - 1
        })
    }
}

/// Dissipation of a material.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct MaterialDamping {
    /// Name, by which two materials of one rheology stay apart; none of one that has no share of its own.
    pub name: String,
    pub rheology: Rheology,
    /// Damping per mass (1/s).
    pub per_mass: f64,
    /// Damping per stiffness (s).
    pub per_stiffness: f64,
}

impl MaterialDamping {
    /// Whether the material takes energy, dashpots apart.
    pub fn dissipates(&self) -> bool {
        self.rheology != Rheology::Elastic || self.per_mass != 0.0 || self.per_stiffness != 0.0
    }

    /// Whether another material, of whatever name, takes the same share of its energy.
    fn loses_like(&self, other: &Self) -> bool {
        let law = |material: &Self| (material.per_mass, material.per_stiffness);
        self.rheology == other.rheology && law(self) == law(other)
    }
}

/// Springs and dashpots about the axes of a joint.
#[derive(Clone, Debug)]
pub(crate) struct Joint {
    /// Name of the dissipator.
    pub name: String,
    /// Node that the joint constrains.
    pub node: usize,
    /// Stiffness about each axis (N·m/rad).
    pub stiffness: Vec<f64>,
    /// Damping about each axis (N·m·s/rad).
    pub damping: Vec<f64>,
    pub material: usize,
}

/// A structure as matrices over its unknowns.
pub(crate) struct Discrete<'a> {
    pub structure: &'a Structure,
    pub dofs: Dofs,
    /// Stiffness of each material.
    pub stiffness: Vec<Symmetric>,
    /// Dashpots, and damping in proportion to mass or stiffness; none if there are none.
    pub damping: Option<Symmetric>,
    pub mass: Symmetric,
    /// Stiffness of the whole.
    pub total: Symmetric,
}

/// Bytes of an element beside the matrices, at least: its nodes, and their places in the matrices.
const ELEMENT: f64 = 1024.0;
/// Matrices beside the stiffness of each material: zero, damping, mass, the whole, and one to factor.
const MATRICES: usize = 5;

impl<'a> Discrete<'a> {
    /// Sums the elements. (K1)–(K3)
    ///
    /// # Errors
    /// [`TooMuchMemory`] if the matrices have no room.
    pub fn new(structure: &'a Structure, dofs: Dofs) -> Result<Self, TooMuchMemory> {
        memory::ask(structure.elements.len() as f64 * ELEMENT)?;
        let patches = patches(structure, &dofs);
        let pattern = pattern(&dofs, &patches);
        memory::ask(
            pattern.places() as f64 * size_of::<f64>() as f64 * (structure.materials.len() + MATRICES) as f64,
        )?;
        let zero = Symmetric::zero(pattern);
        let stiffness = vec![zero.clone(); structure.materials.len()];
        let mut sums = Sums { stiffness, damping: zero.clone(), mass: zero.clone() };
        watch::stage("assembling the elements");
        sums.add(structure, &patches);
        let Sums { mut stiffness, mut damping, mass } = sums;
        for joint in &structure.joints {
            for (axis, unknown) in joint_unknowns(&dofs, joint) {
                diagonal(unknown, joint.stiffness[axis], &mut stiffness[joint.material]);
                diagonal(unknown, joint.damping[axis], &mut damping);
            }
        }
        let total = stiffness
            .iter()
            .fold(zero, |sum, part| sum.plus(1.0, part).expect("all matters are on one pattern"));
        let damping = damping.entries().iter().any(|entry| *entry != 0.0).then_some(damping);
        Ok(Self { structure, dofs, stiffness, damping, mass, total })
    }

    /// Unit forces or moments on the unknowns along components of nodes, a row each.
    pub fn unit_forces(&self, along: &[(usize, usize)]) -> DMatrix<f64> {
        let mut forces = DMatrix::zeros(along.len(), self.dofs.unknowns().len());
        for (number, (node, component)) in along.iter().enumerate() {
            for (unknown, share) in self.dofs.row(*node, *component) {
                forces[(number, *unknown)] += share;
            }
        }
        forces
    }

    /// Matrices that dissipate; none of them is a multiple of the stiffness.
    pub fn losses(&self) -> Vec<&Symmetric> {
        let materials = self.structure.materials.iter().zip(&self.stiffness);
        let several = self.structure.materials.array_windows().any(|[one, other]| !one.loses_like(other));
        let viscoelastic =
            materials.filter(|(material, _)| several && material.rheology != Rheology::Elastic);
        self.damping.iter().chain(viscoelastic.map(|(_, stiffness)| stiffness)).collect()
    }
}

/// Product of a symmetric matrix with vectors, a row each.
pub(super) fn times(matrix: &Symmetric, vectors: &DMatrix<f64>) -> DMatrix<f64> {
    let product = matrix.times_block(vectors.as_slice(), vectors.nrows());
    DMatrix::from_vec(vectors.nrows(), vectors.ncols(), product)
}

fn diagonal(unknown: usize, value: f64, sum: &mut Symmetric) {
    sum.add(&[Some(unknown as u32)], &[value]).expect("every pattern has its diagonal");
}

/// Axes of a joint, each with its unknown.
pub(super) fn joint_unknowns<'f>(
    dofs: &'f Dofs,
    joint: &'f Joint,
) -> impl Iterator<Item = (usize, usize)> + 'f {
    dofs.unknowns().iter().enumerate().filter_map(move |(index, unknown)| match unknown {
        Unknown::Joint(node, axis) if *node == joint.node => Some((*axis, index)),
        _ => None,
    })
}
