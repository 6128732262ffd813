//! Postorder of the elimination tree, which makes columns of equal structure neighbours.

use super::graph::Graph;

/// The same elimination with every vertex right after its children; the fill does not change.
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
                (below, roots[below]) = (roots[below], place);
            }
            if roots[below] == NONE {
                roots[below] = place;
                parents[below] = place;
            }
        }
    }
    parents
}
