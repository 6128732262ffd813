//! The order in which unknowns are eliminated, which decides how much a factor fills.

use super::graph::Graph;
#[cfg(feature = "metis")]
use super::metis;
use super::postorder::postordered;

/// Method for the order of elimination.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[non_exhaustive]
pub enum Ordering {
    /// Minimum degree for matrices that are small or fill little, else the first of the others that is built in.
    #[default]
    Automatic,
    /// Approximate minimum degree.
    MinimumDegree,
    /// Nested dissection by METIS.
    #[cfg(feature = "metis")]
    Metis,
    /// Nested dissection after Pellegrini (1996), without a line of C.
    Scotch,
}

/// Nested dissection pays above so many unknowns.
const DISSECTED_SIZE: usize = 2000;
/// Neighbours of a vertex, on average, up to which a graph is almost a tree, which fills little in any order.
const FEW_NEIGHBOURS: usize = 4;

/// The graph of a matrix with its vertices in the order of elimination, right after those that hand them their updates.
pub(super) struct Dissection {
    pub graph: Graph,
    pub order: Vec<u32>,
}

impl Dissection {
    /// Unknowns in the order of elimination.
    pub fn unknowns(&self) -> Vec<usize> {
        let members = self.order.iter().flat_map(|vertex| &self.graph.members[*vertex as usize]);
        members.map(|unknown| *unknown as usize).collect()
    }
}

/// Nested dissection of a matrix, and the method that gave it; none stands for minimum degree.
pub(super) fn dissection(
    starts: &[usize],
    rows: &[u32],
    ordering: Ordering,
) -> (Option<Dissection>, Ordering) {
    let size = starts.len() - 1;
    let automatic = ordering == Ordering::Automatic;
    if ordering == Ordering::MinimumDegree || automatic && size < DISSECTED_SIZE {
        return (None, Ordering::MinimumDegree);
    }
    let graph = Graph::of(starts, rows);
    if automatic && graph.neighbours.len() <= FEW_NEIGHBOURS * graph.size() {
        return (None, Ordering::MinimumDegree);
    }
    let (vertices, found) = match ordering {
        #[cfg(feature = "metis")]
        Ordering::Automatic | Ordering::Metis => (metis::dissection(&graph), Ordering::Metis),
        _ => (scotch(&graph), Ordering::Scotch),
    };
    let Some(vertices) = vertices else { return (None, Ordering::MinimumDegree) };
    let order = postordered(&graph, &vertices);
    (Some(Dissection { graph, order }), found)
}

fn scotch(graph: &Graph) -> Option<Vec<u32>> {
    let pattern = feral_scotch::CscPattern::new(graph.size(), &graph.starts, &graph.neighbours)?;
    let order = feral_scotch::scotch_order(&pattern).ok()?;
    let mut seen = vec![false; graph.size()];
    for vertex in &order {
        let seen = seen.get_mut(usize::try_from(*vertex).ok()?)?;
        if std::mem::replace(seen, true) {
            return None;
        }
    }
    (order.len() == graph.size()).then(|| order.into_iter().map(|vertex| vertex as u32).collect())
}
