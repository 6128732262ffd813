//! Postorder of the elimination tree, which makes columns of equal structure neighbours.

use super::graph::Graph;

/// Postorder: an equivalent elimination with every vertex right after its children; the fill does not change.
///
/// Liu, The role of elimination trees in sparse factorization, SIAM J. Matrix Anal. Appl. 11 (1990), 134.
pub(super) fn postordered(graph: &Graph, order: &[u32]) -> Vec<u32> {
    let parents = parents(graph, order);
    let size = order.len();
    // Children as linked lists, in the order of elimination.
    let (mut child, mut sibling) = (vec![NONE; size + 1], vec![NONE; size]);
    for place in (0..size).rev() {
        let parent = if parents[place] == NONE { size } else { parents[place] };
        sibling[place] = child[parent];
        child[parent] = place;
    }
    let mut path = vec![size];
    let mut sorted = Vec::with_capacity(size);
    while let Some(place) = path.last().copied() {
        let next = child[place];
        if next == NONE {
            path.pop();
            sorted.extend(order.get(place).copied());
        } else {
            child[place] = sibling[next];
            path.push(next);
        }
    }
    sorted
}

const NONE: usize = usize::MAX;

/// Parent of each place in the elimination tree, by paths to the roots that are shortened as they are walked.
fn parents(graph: &Graph, order: &[u32]) -> Vec<usize> {
    let mut places = vec![0; order.len()];
    order.iter().enumerate().for_each(|(place, vertex)| places[*vertex as usize] = place);
    let (mut parents, mut roots) = (vec![NONE; order.len()], vec![NONE; order.len()]);
    for (place, vertex) in order.iter().enumerate() {
        for mut below in
            graph.neighbours(*vertex as usize).map(|other| places[other]).filter(|other| *other < place)
        {
            while roots[below] != NONE && roots[below] != place {
                below = std::mem::replace(&mut roots[below], place);
            }
            if roots[below] == NONE {
                roots[below] = place;
                parents[below] = place;
            }
        }
    }
    parents
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeSet;

    use proptest::prelude::*;

    use super::*;

    /// Places that fill when the vertices are eliminated one by one.
    fn fill(graph: &Graph, order: &[u32]) -> usize {
        let mut sets: Vec<BTreeSet<usize>> =
            (0..graph.size()).map(|v| graph.neighbours(v).collect()).collect();
        let mut places = 0;
        for vertex in order {
            let around = std::mem::take(&mut sets[*vertex as usize]);
            places += around.len();
            for a in &around {
                sets[*a].remove(&(*vertex as usize));
                sets[*a].extend(around.iter().filter(|b| *b != a));
            }
        }
        places
    }

    fn graph(size: usize, edges: &[(usize, usize)]) -> Graph {
        let mut columns = vec![BTreeSet::new(); size];
        edges.iter().for_each(|(a, b)| _ = columns[*a.min(b)].insert(*a.max(b) as u32));
        let (mut starts, mut rows) = (vec![0], Vec::new());
        for (column, below) in columns.iter().enumerate() {
            rows.push(column as u32);
            rows.extend(below.iter().filter(|row| **row as usize != column));
            starts.push(rows.len());
        }
        Graph::of(&starts, &rows)
    }

    proptest! {
        #[test]
        fn postorder_keeps_the_fill_and_puts_parents_last(
            edges in prop::collection::vec((0..30_usize, 0..30_usize), 0..60),
            keys in prop::collection::vec(any::<u16>(), 30),
        ) {
            let graph = graph(30, &edges);
            let mut order: Vec<u32> = (0..graph.size() as u32).collect();
            order.sort_by_key(|vertex| keys[*vertex as usize]);
            let sorted = postordered(&graph, &order);
            prop_assert_eq!(sorted.iter().collect::<BTreeSet<_>>().len(), order.len());
            prop_assert_eq!(fill(&graph, &sorted), fill(&graph, &order));
            // In a postorder the vertices below each one are those right before it.
            let parents = parents(&graph, &sorted);
            for (place, parent) in parents.iter().enumerate().filter(|(_, parent)| **parent != NONE) {
                prop_assert!(*parent > place);
                prop_assert!((place + 1..*parent).all(|between| parents[between] <= *parent));
            }
        }

        /// A clique is one vertex, whatever its size, and weights add up.
        #[test]
        fn unknowns_with_the_same_neighbours_are_one_vertex(edges in prop::collection::vec((0..12_usize, 0..12_usize), 0..20)) {
            let thrice: Vec<(usize, usize)> = edges
                .iter()
                .copied()
                .chain((0..12).map(|node| (node, node)))
                .flat_map(|(a, b)| (0..9).map(move |k| (3 * a + k / 3, 3 * b + k % 3)))
                .collect();
            let (one, three) = (graph(12, &edges), graph(36, &thrice));
            prop_assert_eq!(&one.neighbours, &three.neighbours);
            prop_assert_eq!(one.members.iter().map(|m| 3 * m.len()).collect::<Vec<_>>(),
                three.members.iter().map(Vec::len).collect::<Vec<_>>());
        }
    }
}
