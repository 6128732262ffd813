//! Budget of dissipation of a structure: stiffness and damping of each dissipator over few fields.
//! Shares are made element by element only where several owners have one material, after the condensation, when fields are few.
//! Equation (D1), docs/theory/11-materials.md.

use nalgebra::DMatrix;

use super::discrete::{Discrete, MaterialDamping, joint_unknowns, times};
use crate::model::Rheology;
use crate::structure::Block;

/// Stiffness and damping between displacements, a row each: a block for each dissipator and for each material without loss. (D1)
///
/// The share of each dissipator in a material is summed element by element, once the displacements are few: the many unknowns have one
/// matrix for each material, however many parts are made of it.
pub(super) fn blocks(discrete: &Discrete<'_>, fields: &DMatrix<f64>) -> Vec<Block> {
    let columns: Vec<usize> = (0..fields.nrows()).collect();
    let materials = &discrete.structure.materials;
    let block = |name: String, material: usize, [stiffness, damping]: [Option<DMatrix<f64>>; 2]| Block {
        name,
        columns: columns.clone(),
        stiffness: stiffness.map(rows).unwrap_or_default(),
        damping: damping.map(rows).unwrap_or_default(),
        rheology: materials[material].rheology.clone(),
    };
    let between = |matrix| fields * times(matrix, fields).transpose();
    let elastic = (0..materials.len()).filter(|material| materials[*material].rheology == Rheology::Elastic);
    let mut blocks: Vec<Block> = elastic
        .map(|material| block(String::new(), material, [Some(between(&discrete.stiffness[material])), None]))
        .collect();
    let budget = Budget::of(discrete);
    let shared = |material| budget.dissipators.iter().filter(|(_, other)| *other == material).count() > 1;
    let viscoelastic = |material: usize| materials[material].rheology != Rheology::Elastic;
    let alone = budget.dissipators.len() == 1;
    let split = (!alone)
        .then(|| budget.split(discrete, fields, |material| viscoelastic(material) && shared(material)));
    let mut parts = split.into_iter().flatten();
    for (number, (_, material)) in budget.dissipators.iter().enumerate() {
        let (stiffness, damping) = match parts.next() {
            Some([stiffness, damping]) => (Some(stiffness), Some(damping)),
            None => (None, discrete.damping.as_ref().map(between)),
        };
        let stiffness =
            if shared(*material) { stiffness } else { Some(between(&discrete.stiffness[*material])) };
        let stiffness = stiffness.filter(|_| viscoelastic(*material));
        blocks.push(block(budget.name(number, materials), *material, [stiffness, damping]));
    }
    blocks
}

/// Dissipators of a structure: each owner of elements and joints with each of its materials that dissipates.
struct Budget<'a> {
    /// Name of the owner, and number of the material.
    dissipators: Vec<(&'a str, usize)>,
    /// Dissipator of each element; none of an elastic one.
    elements: Vec<Option<usize>>,
    /// Dissipator of each joint; none of one without loss.
    joints: Vec<Option<usize>>,
}

impl<'a> Budget<'a> {
    fn of(discrete: &Discrete<'a>) -> Self {
        let structure = discrete.structure;
        let mut dissipators: Vec<(&str, usize)> = Vec::new();
        let mut place = |owner: &'a str, material: usize| {
            let known = dissipators.iter().position(|known| *known == (owner, material));
            known.unwrap_or_else(|| {
                dissipators.push((owner, material));
                dissipators.len() - 1
            })
        };
        let braked = |damping: Option<DMatrix<f64>>| damping.is_some_and(|damping| damping.amax() != 0.0);
        let elements = structure.elements.iter().zip(structure.owner_of_each());
        let elements = elements
            .map(|(element, owner)| {
                let material = element.material();
                let dissipates = structure.materials[material].dissipates() || braked(element.damping());
                dissipates.then(|| place(owner, material))
            })
            .collect();
        let joints = structure.joints.iter().map(|joint| {
            let braked = joint.damping.iter().any(|entry| *entry != 0.0);
            let dissipates = structure.materials[joint.material].dissipates() || braked;
            dissipates.then(|| place(&joint.name, joint.material))
        });
        let joints = joints.collect();
        Self { dissipators, elements, joints }
    }

    /// Name of a dissipator: that of its owner, with that of the material, or a number, if the owner has several materials that dissipate.
    fn name(&self, number: usize, materials: &[MaterialDamping]) -> String {
        let (owner, material) = self.dissipators[number];
        let name = &materials[material].name;
        let own = |(other, (name, _)): (usize, &(&str, usize))| (*name == owner).then_some(other);
        let all: Vec<usize> = self.dissipators.iter().enumerate().filter_map(own).collect();
        match all.iter().position(|other| *other == number) {
            Some(_) if all.len() > 1 && !name.is_empty() => format!("{owner} {name}"),
            Some(place) if all.len() > 1 => format!("{owner} material {}", place + 1),
            _ => owner.to_owned(),
        }
    }

    /// Stiffness, of the materials that are wanted, and damping of each dissipator between displacements.
    fn split(
        &self,
        discrete: &Discrete<'_>,
        fields: &DMatrix<f64>,
        wanted: impl Fn(usize) -> bool,
    ) -> Vec<[DMatrix<f64>; 2]> {
        let zero = DMatrix::zeros(fields.nrows(), fields.nrows());
        let mut sums = vec![[zero.clone(), zero]; self.dissipators.len()];
        let structure = discrete.structure;
        for (element, number) in structure.elements.iter().zip(&self.elements) {
            let Some([stiffness, damping]) = number.map(|number| &mut sums[number]) else { continue };
            let material = &structure.materials[element.material()];
            let moved = discrete.dofs.spread(element.nodes(), element.dofs(), fields).transpose();
            let add = |sum: &mut DMatrix<f64>, factor: f64, matrix: &DMatrix<f64>| {
                *sum += factor * moved.tr_mul(&(matrix * &moved));
            };
            if wanted(element.material()) || material.per_stiffness != 0.0 {
                let K = element.stiffness();
                add(stiffness, 1.0, &K);
                add(damping, material.per_stiffness, &K);
            }
            if material.per_mass != 0.0 {
                add(damping, material.per_mass, &element.mass());
            }
            if let Some(dashpots) = element.damping() {
                add(damping, 1.0, &dashpots);
            }
        }
        for (joint, number) in structure.joints.iter().zip(&self.joints) {
            let Some([stiffness, damping]) = number.map(|number| &mut sums[number]) else { continue };
            for (axis, unknown) in joint_unknowns(&discrete.dofs, joint) {
                let turn = fields.column(unknown);
                let square = turn * turn.transpose();
                *stiffness += joint.stiffness[axis] * &square;
                *damping += joint.damping[axis] * square;
            }
        }
        sums
    }
}

fn rows(matrix: DMatrix<f64>) -> Vec<Vec<f64>> {
    matrix.row_iter().map(|row| row.iter().copied().collect()).collect()
}
