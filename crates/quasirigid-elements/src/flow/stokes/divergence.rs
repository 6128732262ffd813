use super::cell::{CORNERS, NODES};

/// Divergence of velocities that are zero on the walls, weighted with each pressure: `B u = ∫ λ_p ∇·u dV` (m²).
///
/// Velocities and pressures stand row by row, a row per component of a node or per vertex, `width` numbers to a row.
pub(super) struct Divergence {
    unknowns: usize,
    pub vertices: usize,
    cells: Vec<Part>,
}

/// Part of a cell.
struct Part {
    nodes: [Option<u32>; NODES],
    vertices: [u32; CORNERS],
    entries: [[[f64; 3]; CORNERS]; NODES],
}

impl Divergence {
    /// Zero divergence, for so many nodes that move and so many vertices.
    pub fn new(unknowns: usize, vertices: usize) -> Self {
        Self { unknowns, vertices, cells: Vec::new() }
    }

    /// Adds a cell.
    pub fn add(
        &mut self,
        nodes: [Option<u32>; NODES],
        vertices: [u32; CORNERS],
        entries: [[[f64; 3]; CORNERS]; NODES],
    ) {
        self.cells.push(Part { nodes, vertices, entries });
    }

    /// `B u`.
    pub fn times(&self, u: &[f64], width: usize) -> Vec<f64> {
        let mut product = vec![0.0; self.vertices * width];
        self.each(|vertex, unknown, entry| {
            let row = &mut product[vertex * width..][..width];
            row.iter_mut().zip(&u[unknown * width..][..width]).for_each(|(sum, u)| *sum += entry * u);
        });
        product
    }

    /// `Bᵀ p`.
    pub fn transposed_times(&self, p: &[f64], width: usize) -> Vec<f64> {
        let mut product = vec![0.0; 3 * self.unknowns * width];
        self.each(|vertex, unknown, entry| {
            let row = &mut product[unknown * width..][..width];
            row.iter_mut().zip(&p[vertex * width..][..width]).for_each(|(sum, p)| *sum += entry * p);
        });
        product
    }

    /// Every part of an entry, with its row and column.
    fn each(&self, mut visit: impl FnMut(usize, usize, f64)) {
        for cell in &self.cells {
            for (node, entries) in cell.nodes.iter().zip(&cell.entries) {
                let Some(node) = node else { continue };
                for (vertex, entries) in cell.vertices.iter().zip(entries) {
                    for (axis, entry) in entries.iter().enumerate() {
                        visit(*vertex as usize, 3 * *node as usize + axis, *entry);
                    }
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// `p·Bu = u·Bᵀp`, for velocities and pressures side by side, with nodes on the wall and shared by cells.
    #[test]
    fn the_transpose_is_adjoint() {
        let wave = |seed: usize, i: usize| (1.7 * i as f64 + 0.9 * seed as f64).sin();
        let (unknowns, vertices, width) = (15, 6, 2);
        let mut divergence = Divergence::new(unknowns, vertices);
        for cell in 0..2 {
            let nodes = std::array::from_fn(|i| (i % 4 != 1).then_some((5 * cell + i) as u32));
            let corners = std::array::from_fn(|i| (2 * cell + i) as u32);
            let entry = |i: usize, j: usize, axis: usize| wave(cell, 12 * i + 3 * j + axis);
            let entries = std::array::from_fn(|i| {
                std::array::from_fn(|j| std::array::from_fn(|axis| entry(i, j, axis)))
            });
            divergence.add(nodes, corners, entries);
        }
        let u: Vec<f64> = (0..3 * unknowns * width).map(|i| wave(5, i)).collect();
        let p: Vec<f64> = (0..vertices * width).map(|i| wave(7, i)).collect();
        let (Bu, Bp) = (divergence.times(&u, width), divergence.transposed_times(&p, width));
        for column in 0..width {
            let along = |a: &[f64], b: &[f64]| -> f64 {
                a.iter().zip(b).skip(column).step_by(width).map(|(a, b)| a * b).sum()
            };
            let (left, right) = (along(&p, &Bu), along(&u, &Bp));
            assert!(left.abs() > 0.1 && (left - right).abs() < 1e-12 * left.abs(), "{left} {right}");
        }
    }
}
