//! Pyramids of five nodes as two tetrahedra. The base is cut from its corner of the least number, so that two pyramids on one base agree.

use quasirigid_mesh::Mesh;

/// Number of nodes of a pyramid: its base, then its top.
pub(super) const NODES: usize = 5;

/// Nodes of the two tetrahedra, by their places in a pyramid with these numbers.
pub(super) fn halves(labels: &[u64]) -> [[usize; 4]; 2] {
    let least = (0..4).min_by_key(|corner| labels.get(*corner)).unwrap_or(0);
    let [a, b, c, d] = [0, 1, 2, 3].map(|corner| (least + corner) % 4);
    [[a, b, c, 4], [a, c, d, 4]]
}

/// How many pyramids were divided, in words: their halves have one number.
pub(super) fn note(mesh: &Mesh) -> Option<String> {
    let count = mesh.cells.windows(2).filter(|pair| pair[0].label == pair[1].label).count();
    (count > 0).then(|| format!("pyramids are two tetrahedra each ({count})"))
}
