//! Stiffness, damping and mass of a structure, summed over its elements by several threads.
//! Element matrices are made side by side, a batch at a time, and added in the order of the elements: the sums have the same bits for any
//! number of threads.

use std::ops::Range;

use nalgebra::DMatrix;

use super::discrete::Structure;
use super::sum::DofMap;
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

/// Matrices of one element over its unknowns.
struct Made {
    /// None of an element that has mass alone.
    stiffness: Option<DMatrix<f64>>,
    damping: Vec<DMatrix<f64>>,
    mass: DMatrix<f64>,
}

/// Entries of the matrices that exist at once, and the elements from which on several threads pay.
const BATCH: usize = 1 << 20;
const MANY: usize = 512;

impl Sums {
    /// Adds the elements. (K1)–(K3)
    pub fn add(&mut self, structure: &Structure, maps: &[DofMap]) {
        let team = if maps.len() < MANY { Team::alone() } else { Team::new() };
        for batch in batches(maps) {
            watch::progress(batch.start as f64 / maps.len() as f64);
            let made =
                team.map(batch.clone().collect(), |element| Made::new(structure, element, &maps[element]));
            let all = || batch.clone().map(|element| maps[element].unknowns()).zip(&made);
            let material = |element: usize| structure.elements[element].material();
            for (number, sum) in self.stiffness.iter_mut().enumerate() {
                let own = batch.clone().zip(all()).filter(|(element, _)| material(*element) == number);
                let stiff =
                    own.filter_map(|(_, (unknowns, made))| Some((unknowns, made.stiffness.as_ref()?)));
                add(sum, stiff, &team);
            }
            add(&mut self.mass, all().map(|(unknowns, made)| (unknowns, &made.mass)), &team);
            let damped =
                all().flat_map(|(unknowns, made)| made.damping.iter().map(move |part| (unknowns, part)));
            add(&mut self.damping, damped, &team);
        }
    }
}

impl Made {
    fn new(structure: &Structure, element: usize, map: &DofMap) -> Self {
        let element = &structure.elements[element];
        let material = &structure.materials[element.material()];
        let (K, M) = (element.stiffness(), element.mass());
        let shares = [(&K, material.per_stiffness), (&M, material.per_mass)];
        let mut damping: Vec<_> = shares
            .iter()
            .filter(|(_, share)| *share != 0.0)
            .map(|(part, share)| map.tied(part, *share))
            .collect();
        damping.extend(element.damping().map(|dashpots| map.tied(&dashpots, 1.0)));
        let stiff = K.iter().any(|entry| *entry != 0.0);
        Self { stiffness: stiff.then(|| map.tied(&K, 1.0)), damping, mass: map.tied(&M, 1.0) }
    }
}

/// Ranges of elements whose matrices have about `BATCH` entries together.
fn batches(maps: &[DofMap]) -> Vec<Range<usize>> {
    let mut batches: Vec<Range<usize>> = Vec::new();
    let mut entries = BATCH;
    for (element, map) in maps.iter().enumerate() {
        match batches.last_mut() {
            Some(batch) if entries < BATCH => batch.end += 1,
            _ => {
                batches.push(element..element + 1);
                entries = 0;
            }
        }
        entries += map.unknowns().len().pow(2);
    }
    batches
}

fn add<'m>(
    sum: &mut Symmetric,
    parts: impl Iterator<Item = (&'m [Option<u32>], &'m DMatrix<f64>)>,
    team: &Team,
) {
    let parts: Vec<_> = parts.map(|(unknowns, matrix)| (unknowns, matrix.as_slice())).collect();
    if !parts.is_empty() {
        sum.add_all(&parts, team).expect("the pattern has the places of every element");
    }
}
