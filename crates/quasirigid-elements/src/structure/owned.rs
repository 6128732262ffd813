use nalgebra::DMatrix;

use super::discrete::Discrete;

/// Name of masses without an owner: the points of a body without a carrier.
const POINTS: &str = "points";

/// Mass matrix of each owner of elements between displacements, a row each, by name. (M5)
pub(super) fn masses(discrete: &Discrete<'_>, fields: &DMatrix<f64>) -> Vec<(String, DMatrix<f64>)> {
    let structure = discrete.structure;
    let mut sums: Vec<(&str, DMatrix<f64>)> = Vec::new();
    for (element, owner) in structure.elements.iter().zip(structure.owner_of_each()) {
        let mass = element.mass();
        if mass.amax() == 0.0 {
            continue;
        }
        let moved = discrete.dofs.spread(element.nodes(), element.dofs(), fields).transpose();
        let own = moved.tr_mul(&(mass * &moved));
        match sums.iter_mut().find(|(name, _)| *name == owner) {
            Some((_, sum)) => *sum += own,
            None => sums.push((owner, own)),
        }
    }
    let called = |name: &str| if name.is_empty() { POINTS.to_owned() } else { name.to_owned() };
    sums.into_iter().map(|(name, sum)| (called(name), sum)).collect()
}
