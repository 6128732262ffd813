use nalgebra::DMatrix;

use super::discrete::{Discrete, joint_unknowns, times};
use super::sum::Tie;
use crate::model::Rheology;
use crate::structure::Block;

/// Stiffness and damping between displacements, a row each: a block for each dissipator and for each matter without loss. (D1)
///
/// What a matter shared by several dissipators gives to each is added up element by element, once the displacements are few: the
/// many unknowns have one matrix for each matter, however many parts are made of it.
pub(super) fn blocks(discrete: &Discrete<'_>, fields: &DMatrix<f64>) -> Vec<Block> {
    let columns: Vec<usize> = (0..fields.nrows()).collect();
    let matters = &discrete.structure.matters;
    let block = |name: String, matter: usize, [stiffness, damping]: [Option<DMatrix<f64>>; 2]| Block {
        name,
        columns: columns.clone(),
        stiffness: stiffness.map(rows).unwrap_or_default(),
        damping: damping.map(rows).unwrap_or_default(),
        rheology: matters[matter].rheology.clone(),
    };
    let between = |matrix| fields * times(matrix, fields).transpose();
    let elastic = (0..matters.len()).filter(|matter| matters[*matter].rheology == Rheology::Elastic);
    let mut blocks: Vec<Block> = elastic
        .map(|matter| block(String::new(), matter, [Some(between(&discrete.stiffness[matter])), None]))
        .collect();
    let budget = Budget::of(discrete);
    let shared = |matter| budget.dissipators.iter().filter(|(_, other)| *other == matter).count() > 1;
    let lossy = |matter: usize| matters[matter].rheology != Rheology::Elastic;
    let alone = budget.dissipators.len() == 1;
    let split = (!alone).then(|| budget.split(discrete, fields, |matter| lossy(matter) && shared(matter)));
    let mut parts = split.into_iter().flatten();
    for (number, (_, matter)) in budget.dissipators.iter().enumerate() {
        let (stiffness, damping) = match parts.next() {
            Some([stiffness, damping]) => (Some(stiffness), Some(damping)),
            None => (None, discrete.damping.as_ref().map(between)),
        };
        let stiffness = if shared(*matter) { stiffness } else { Some(between(&discrete.stiffness[*matter])) };
        let stiffness = stiffness.filter(|_| lossy(*matter));
        blocks.push(block(budget.name(number), *matter, [stiffness, damping]));
    }
    blocks
}

/// What dissipates in a structure: each owner of elements and joints with each matter it has that dissipates.
struct Budget<'a> {
    /// Name of the owner, and matter.
    dissipators: Vec<(&'a str, usize)>,
    /// Dissipator of each element; none of one that is elastic.
    elements: Vec<Option<usize>>,
    /// The same of the joints.
    joints: Vec<Option<usize>>,
}

impl<'a> Budget<'a> {
    fn of(discrete: &Discrete<'a>) -> Self {
        let structure = discrete.structure;
        let mut dissipators: Vec<(&str, usize)> = Vec::new();
        let mut place = |owner: &'a str, matter: usize| {
            let known = dissipators.iter().position(|known| *known == (owner, matter));
            known.unwrap_or_else(|| {
                dissipators.push((owner, matter));
                dissipators.len() - 1
            })
        };
        let braked = |damping: Option<DMatrix<f64>>| damping.is_some_and(|damping| damping.amax() != 0.0);
        let elements = structure.elements.iter().zip(structure.owner_of_each());
        let elements = elements
            .map(|(element, owner)| {
                let matter = element.matter();
                let dissipates = structure.matters[matter].dissipates() || braked(element.damping());
                dissipates.then(|| place(owner, matter))
            })
            .collect();
        let joints = structure.joints.iter().map(|joint| {
            let braked = joint.damping.iter().any(|entry| *entry != 0.0);
            let dissipates = structure.matters[joint.matter].dissipates() || braked;
            dissipates.then(|| place(&joint.name, joint.matter))
        });
        let joints = joints.collect();
        Self { dissipators, elements, joints }
    }

    /// Name of a dissipator: that of its owner, with a number if the owner has several materials that dissipate.
    fn name(&self, number: usize) -> String {
        let (owner, _) = self.dissipators[number];
        let own = |(other, (name, _)): (usize, &(&str, usize))| (*name == owner).then_some(other);
        let all: Vec<usize> = self.dissipators.iter().enumerate().filter_map(own).collect();
        match all.iter().position(|other| *other == number) {
            Some(place) if all.len() > 1 => format!("{owner} material {}", place + 1),
            _ => owner.to_owned(),
        }
    }

    /// Stiffness, of the matters that are wanted, and damping of each dissipator between displacements.
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
            let matter = &structure.matters[element.matter()];
            let moved = Tie::new(&discrete.freedoms, element.as_ref()).moved(fields);
            let add = |sum: &mut DMatrix<f64>, factor: f64, matrix: &DMatrix<f64>| {
                *sum += factor * moved.tr_mul(&(matrix * &moved));
            };
            if wanted(element.matter()) || matter.per_stiffness != 0.0 {
                let K = element.stiffness();
                add(stiffness, 1.0, &K);
                add(damping, matter.per_stiffness, &K);
            }
            if matter.per_mass != 0.0 {
                add(damping, matter.per_mass, &element.mass());
            }
            if let Some(dashpots) = element.damping() {
                add(damping, 1.0, &dashpots);
            }
        }
        for (joint, number) in structure.joints.iter().zip(&self.joints) {
            let Some([stiffness, damping]) = number.map(|number| &mut sums[number]) else { continue };
            for (axis, unknown) in joint_unknowns(&discrete.freedoms, joint) {
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
