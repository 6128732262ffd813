//! Pyramids as two tetrahedra each. The base is cut from its corner of the least number, so that two cells on one base agree.

use quasirigid_mesh::Mesh;

/// Number of nodes of a pyramid: its base, then its top.
pub(crate) const NODES: usize = 5;

/// Nodes of a pyramid with the middles of its edges; one more is the middle of its base.
pub(crate) const CURVED: usize = 13;

/// Corner of the base with the least number.
pub(crate) fn least(labels: &[u64]) -> usize {
    (0..4).min_by_key(|corner| labels.get(*corner)).unwrap_or(0)
}

/// Nodes of the two tetrahedra, by their places in a pyramid with these numbers.
pub(crate) fn halves(labels: &[u64]) -> [[usize; 4]; 2] {
    let [a, b, c, d] = [0, 1, 2, 3].map(|corner| (least(labels) + corner) % 4);
    [[a, b, c, 4], [a, c, d, 4]]
}

/// Nodes of the two tetrahedra of ten nodes, by their places in a pyramid of 13 with these numbers: base, top, middles of the sides of the
/// base, those of the upright edges. None is the middle of the base.
pub(crate) fn curved_halves(labels: &[u64]) -> [[Option<usize>; 10]; 2] {
    let [[a, b, c, top], [_, _, d, _]] = halves(labels);
    let [at, side, up] = [0, NODES, NODES + 4].map(|first| move |corner: usize| Some(first + corner));
    [
        [at(a), at(b), at(c), at(top), side(a), side(b), None, up(a), up(b), up(c)],
        [at(a), at(c), at(d), at(top), None, side(c), side(d), up(a), up(c), up(d)],
    ]
}

/// Middle of a base with middles on its sides.
pub(crate) fn middle_of_base(corners: [[f64; 3]; 4], sides: [[f64; 3]; 4]) -> [f64; 3] {
    let sum = |places: &[[f64; 3]; 4], axis: usize| places.iter().map(|place| place[axis]).sum::<f64>();
    [0, 1, 2].map(|axis| 0.5 * sum(&sides, axis) - 0.25 * sum(&corners, axis))
}

/// How many pyramids were divided, in words: their halves have one number.
pub(crate) fn note(mesh: &Mesh) -> Option<String> {
    let count = mesh.cells.windows(2).filter(|pair| pair[0].label == pair[1].label).count();
    (count > 0).then(|| told(count))
}

/// What became of so many pyramids, in words.
pub(crate) fn told(count: usize) -> String {
    format!("pyramids are two tetrahedra each ({count})")
}
