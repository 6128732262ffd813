use nalgebra::{DMatrix, Vector3};

use super::freedoms::{Freedoms, Hold, Node, Unknown};
use super::sum::{Tie, pattern};
use crate::finite::Element;
use crate::math::memory::{self, TooMuchMemory};
use crate::math::symmetric::Symmetric;
use crate::math::watch;
use crate::model::Rheology;

/// Finite elements between nodes, as the parts of a body give them.
#[derive(Default)]
pub(crate) struct Structure {
    pub nodes: Vec<Node>,
    /// How each node is held.
    pub holds: Vec<Hold>,
    pub elements: Vec<Box<dyn Element>>,
    /// Names of what elements belong to, each with the end of its elements.
    pub owners: Vec<(String, usize)>,
    pub joints: Vec<Joint>,
    pub matters: Vec<Matter>,
}

impl Structure {
    /// Mean of the places of the nodes (m), in the file's frame.
    pub fn middle(&self) -> Vector3<f64> {
        self.nodes.iter().map(|node| node.place).sum::<Vector3<f64>>() / self.nodes.len().max(1) as f64
    }

    /// Gives all elements that have no owner yet to the one of this name.
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

    /// Number of the matter with a rheology, and damping in proportion to mass (1/s) and stiffness (s), which it gets if it is
    /// new.
    pub fn matter(&mut self, rheology: &Rheology, [per_mass, per_stiffness]: [f64; 2]) -> usize {
        let matter = Matter { rheology: rheology.clone(), per_mass, per_stiffness };
        self.matters.iter().position(|known| *known == matter).unwrap_or_else(|| {
            self.matters.push(matter);
            self.matters.len() - 1
        })
    }
}

/// How a kind of matter dissipates.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Matter {
    pub rheology: Rheology,
    /// Damping per mass (1/s).
    pub per_mass: f64,
    /// Damping per stiffness (s).
    pub per_stiffness: f64,
}

impl Matter {
    /// Whether it takes energy, dashpots apart.
    pub fn dissipates(&self) -> bool {
        self.rheology != Rheology::Elastic || self.per_mass != 0.0 || self.per_stiffness != 0.0
    }
}

/// Springs and dashpots about the axes of a joint.
#[derive(Clone, Debug)]
pub(crate) struct Joint {
    /// What it is called as a dissipator.
    pub name: String,
    /// The node that is held by it.
    pub node: usize,
    /// Stiffness about each axis (N·m/rad).
    pub stiffness: Vec<f64>,
    /// Damping about each axis (N·m·s/rad).
    pub damping: Vec<f64>,
    pub matter: usize,
}

/// A structure as matrices over its unknowns.
pub(crate) struct Discrete<'a> {
    pub structure: &'a Structure,
    pub freedoms: Freedoms,
    /// Stiffness of each matter.
    pub stiffness: Vec<Symmetric>,
    /// Dashpots, and damping in proportion to mass or stiffness; none if there are none.
    pub damping: Option<Symmetric>,
    pub mass: Symmetric,
    /// Stiffness of the whole.
    pub total: Symmetric,
}

/// Bytes that an element takes beside the matrices, at least: its nodes, and their places in the matrices.
const ELEMENT: f64 = 1024.0;
/// Matrices beside the stiffness of each matter: zero, damping, mass, the whole, and one to factor.
const MATRICES: usize = 5;

impl<'a> Discrete<'a> {
    /// Adds up the elements. (K1)–(K3)
    ///
    /// # Errors
    /// [`TooMuchMemory`] if the matrices have no room.
    pub fn new(structure: &'a Structure, freedoms: Freedoms) -> Result<Self, TooMuchMemory> {
        memory::ask(structure.elements.len() as f64 * ELEMENT)?;
        let ties: Vec<Tie> =
            structure.elements.iter().map(|element| Tie::new(&freedoms, element.as_ref())).collect();
        let pattern = pattern(&freedoms, &ties);
        memory::ask(
            pattern.places() as f64 * size_of::<f64>() as f64 * (structure.matters.len() + MATRICES) as f64,
        )?;
        let zero = Symmetric::zero(pattern);
        let mut stiffness = vec![zero.clone(); structure.matters.len()];
        let (mut damping, mut mass) = (zero.clone(), zero.clone());
        watch::stage("assembling the elements");
        for (number, (element, tie)) in structure.elements.iter().zip(&ties).enumerate() {
            watch::progress(number as f64 / ties.len() as f64);
            let matter = &structure.matters[element.matter()];
            let (K, M) = (element.stiffness(), element.mass());
            tie.add(&K, 1.0, &mut stiffness[element.matter()]);
            tie.add(&M, 1.0, &mut mass);
            tie.add(&K, matter.per_stiffness, &mut damping);
            tie.add(&M, matter.per_mass, &mut damping);
            if let Some(dashpots) = element.damping() {
                tie.add(&dashpots, 1.0, &mut damping);
            }
        }
        for joint in &structure.joints {
            for (axis, unknown) in joint_unknowns(&freedoms, joint) {
                diagonal(unknown, joint.stiffness[axis], &mut stiffness[joint.matter]);
                diagonal(unknown, joint.damping[axis], &mut damping);
            }
        }
        let total = stiffness
            .iter()
            .fold(zero, |sum, part| sum.plus(1.0, part).expect("all matters are on one pattern"));
        let damping = damping.entries().iter().any(|entry| *entry != 0.0).then_some(damping);
        Ok(Self { structure, freedoms, stiffness, damping, mass, total })
    }

    /// What takes energy from a motion, as matrices; nothing that is a multiple of the stiffness.
    pub fn losses(&self) -> Vec<&Symmetric> {
        let matters = self.structure.matters.iter().zip(&self.stiffness);
        let several = self.structure.matters.len() > 1;
        let lossy = matters.filter(|(matter, _)| several && matter.rheology != Rheology::Elastic);
        self.damping.iter().chain(lossy.map(|(_, stiffness)| stiffness)).collect()
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
    freedoms: &'f Freedoms,
    joint: &'f Joint,
) -> impl Iterator<Item = (usize, usize)> + 'f {
    freedoms.unknowns().iter().enumerate().filter_map(move |(index, unknown)| match unknown {
        Unknown::Joint(node, axis) if *node == joint.node => Some((*axis, index)),
        _ => None,
    })
}
