//! Stiffness, damping and mass of a structure, summed over its elements by several threads.
//! Matrices of patches are made side by side, a batch at a time, and added in their order: the sums have the same bits for any number of
//! threads.

use nalgebra::DMatrix;

use super::discrete::Structure;
use super::patch::Patch;
use crate::math::symmetric::Symmetric;
use crate::math::threads::Team;
use crate::math::watch;

/// Matrices of a structure in the making.
pub(super) struct Sums {
    /// Stiffness of each material.
    pub stiffness: Vec<Symmetric>,
    pub damping: Symmetric,
    pub mass: Symmetric,
}

/// Matrices of one patch over its unknowns.
struct Made {
    /// None of elements that have mass alone.
    stiffness: Option<DMatrix<f64>>,
    damping: Option<DMatrix<f64>>,
    mass: DMatrix<f64>,
}

/// Entries of the matrices that exist at once, and the elements from which on several threads pay.
const BATCH: usize = 1 << 20;
const THREADED_ELEMENTS: usize = 512;

impl Sums {
    /// Adds the elements. (K1)–(K3)
    pub fn add(&mut self, structure: &Structure, patches: &[Patch]) {
        let elements = structure.elements.len();
        let team = if elements < THREADED_ELEMENTS { Team::alone() } else { Team::new() };
        for batch in batches(patches) {
            watch::progress(batch[0].elements.start as f64 / elements as f64);
            let made = team.map(batch.iter().collect(), |patch| Made::new(structure, patch));
            let all = || batch.iter().zip(&made);
            let material = |patch: &Patch| structure.elements[patch.elements.start].material();
            for (number, sum) in self.stiffness.iter_mut().enumerate() {
                let own = all().filter(|(patch, _)| material(patch) == number);
                add(sum, own.filter_map(|(patch, made)| Some((patch, made.stiffness.as_ref()?))), &team);
            }
            add(&mut self.mass, all().map(|(patch, made)| (patch, &made.mass)), &team);
            let damped = all().filter_map(|(patch, made)| Some((patch, made.damping.as_ref()?)));
            add(&mut self.damping, damped, &team);
        }
    }
}

impl Made {
    fn new(structure: &Structure, patch: &Patch) -> Self {
        let elements = &structure.elements[patch.elements.clone()];
        let material = &structure.materials[elements[0].material()];
        let numbered = || elements.iter().enumerate();
        let stiffness = numbered().map(|(number, element)| (number, element.stiffness()));
        let stiffness: Vec<_> = stiffness.filter(|(_, K)| K.iter().any(|entry| *entry != 0.0)).collect();
        let mass: Vec<_> = numbered().map(|(number, element)| (number, element.mass())).collect();
        let mut damping = Vec::new();
        for (parts, share) in [(&stiffness, material.per_stiffness), (&mass, material.per_mass)] {
            damping
                .extend(parts.iter().filter(|_| share != 0.0).map(|(number, part)| (*number, share * part)));
        }
        damping.extend(numbered().filter_map(|(number, element)| Some((number, element.damping()?))));
        let some = |parts: Vec<_>| (!parts.is_empty()).then(|| patch.sum(parts));
        Self { stiffness: some(stiffness), damping: some(damping), mass: patch.sum(mass) }
    }
}

/// Patches whose matrices have about `BATCH` entries together.
fn batches(patches: &[Patch]) -> Vec<&[Patch]> {
    let mut batches = Vec::new();
    let (mut start, mut entries) = (0, 0);
    for (end, patch) in patches.iter().enumerate() {
        if entries >= BATCH {
            batches.push(&patches[start..end]);
            (start, entries) = (end, 0);
        }
        entries += patch.unknowns.len().pow(2);
    }
    batches.push(&patches[start..]);
    batches.retain(|batch| !batch.is_empty());
    batches
}

fn add<'m>(sum: &mut Symmetric, parts: impl Iterator<Item = (&'m Patch, &'m DMatrix<f64>)>, team: &Team) {
    let parts: Vec<_> = parts.map(|(patch, matrix)| (&patch.unknowns[..], matrix.as_slice())).collect();
    if !parts.is_empty() {
        sum.add_all(&parts, team).expect("the pattern has the places of every element");
    }
}
