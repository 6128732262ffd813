//! Matrices for the tests of the factor, here and in `tests/suite`: springs on a grid and on a ring.

use std::sync::Arc;

use super::{Pattern, Symmetric};

/// Springs between all nodes of a cubic grid that share a cell, three unknowns to a node, each in a unit of its own,
/// and a foundation under every node. The first `held` nodes are fixed.
pub fn grid(nodes: usize, held: usize, foundation: f64, unit: impl Fn(usize) -> f64) -> Symmetric {
    let count = nodes.pow(3);
    let place = |node: usize| [node % nodes, node / nodes % nodes, node / nodes / nodes].map(|i| i as f64);
    let first: Vec<u32> = (0..=count).map(|node| 3 * node.saturating_sub(held) as u32).collect();
    let mut springs = Vec::new();
    for a in 0..count {
        for b in a + 1..count {
            let (p, q) = (place(a), place(b));
            let d: [f64; 3] = std::array::from_fn(|i| q[i] - p[i]);
            if d.iter().all(|d| d.abs() < 1.5) {
                springs.push(([a as u32, b as u32], d));
            }
        }
    }
    let pattern = Pattern::new(&first, springs.iter().map(|(nodes, _)| nodes.as_slice())).unwrap();
    let mut matrix = Symmetric::zero(Arc::new(pattern));
    for (nodes, d) in &springs {
        let unknowns: Vec<Option<u32>> = nodes
            .iter()
            .flat_map(|node| (0..3).map(|i| (*node as usize >= held).then(|| first[*node as usize] + i)))
            .collect();
        let unit = |i: usize| unknowns[i].map_or(1.0, |unknown| unit(unknown as usize));
        let square: f64 = d.iter().map(|d| d * d).sum();
        let entry = |i: usize, j: usize| {
            let sign = if i / 3 == j / 3 { 1.0 } else { -1.0 };
            let soil = if i == j { foundation } else { 0.0 };
            unit(i) * unit(j) * (sign * d[i % 3] * d[j % 3] / square + soil)
        };
        let element: Vec<f64> = (0..36).map(|place| entry(place / 6, place % 6)).collect();
        matrix.add(&unknowns, &element).unwrap();
    }
    matrix
}

/// Unit of an unknown, from 1e-9 to 1e9, in no order.
pub fn odd_unit(unknown: usize) -> f64 {
    10_f64.powi((unknown * 7 % 19) as i32 - 9)
}

/// Large enough for branches and separators.
pub fn cut() -> Symmetric {
    grid(12, 30, 0.002, odd_unit)
}

/// Springs between nodes of one to eleven unknowns on a ring with long chords, and from all to a node of thirty.
pub fn uneven() -> Symmetric {
    let (nodes, hub) = (260_u32, 99);
    let mut first = vec![0];
    for node in 0..nodes {
        let size = if node == hub { 30 } else { 1 + node * node % 11 };
        first.push(first[node as usize] + size);
    }
    let chords = (0..nodes).flat_map(|node| [1, 7, 31].map(|step| [node, (node + step) % nodes]));
    let springs: Vec<[u32; 2]> =
        chords.chain((0..nodes).filter(|node| *node != hub).map(|node| [node, hub])).collect();
    let pattern = Pattern::new(&first, springs.iter().map(|nodes| nodes.as_slice())).unwrap();
    let mut matrix = Symmetric::zero(Arc::new(pattern));
    for (place, nodes) in springs.iter().enumerate() {
        let own = |node: &u32| first[*node as usize]..first[*node as usize + 1];
        let unknowns: Vec<u32> = nodes.iter().flat_map(own).collect();
        let unit = |unknown: u32| odd_unit(unknown as usize);
        let stretch =
            |unknown: u32| unit(unknown) * f64::from((unknown * 13 + place as u32) % 7) - 3.0 * unit(unknown);
        let mut element = Vec::new();
        for i in &unknowns {
            let soil = |j: u32| if *i == j { 2.0 * unit(j).powi(2) } else { 0.0 };
            element.extend(unknowns.iter().map(|j| stretch(*i) * stretch(*j) + soil(*j)));
        }
        matrix.add(&unknowns.into_iter().map(Some).collect::<Vec<_>>(), &element).unwrap();
    }
    matrix
}
