//! Tree of the supernodes, in which each hands its update to its parent.
//! It is cut into branches, one thread's work each, and the separators above them, whose own work is shared. The cut depends on the
//! matrix alone.

use super::supernodes::{Supernode, Supernodes};

/// Subtrees that one thread eliminates.
#[derive(Clone, Debug, Default)]
pub(super) struct Branch {
    /// Supernodes, children before their parents, each subtree on its own.
    pub nodes: Vec<usize>,
    /// Last nodes of the subtrees.
    pub roots: Vec<usize>,
    /// Entries of updates that exist at once.
    pub room: usize,
}

/// The tree cut into branches and separators.
#[derive(Clone, Debug)]
pub(super) struct Tree {
    pub children: Vec<Vec<usize>>,
    /// The costly first, so that branches eliminated side by side end together.
    pub branches: Vec<Branch>,
    /// Supernodes above the branches, ascending, so that parents come last.
    pub separators: Vec<usize>,
    /// Supernode of each column.
    pub owners: Vec<u32>,
}

/// Multiplications below which a tree is one branch, as threads would cost more than they save.
const SINGLE_BRANCH_WORK: f64 = 1e8;
/// A branch has no more than this share of all multiplications; the updates of a small one take little memory.
const SHARE: f64 = 1.0 / 256.0;

impl Tree {
    pub fn of(supernodes: &Supernodes) -> Self {
        let count = supernodes.count();
        let nodes: Vec<Supernode<'_>> = supernodes.iter().collect();
        let mut owners = vec![0; supernodes.size()];
        nodes.iter().enumerate().for_each(|(index, node)| owners[node.columns()].fill(index as u32));
        let mut children = vec![Vec::new(); count];
        let mut work: Vec<f64> = nodes.iter().map(Supernode::multiplications).collect();
        let all: f64 = work.iter().sum();
        let mut parents = vec![None; count];
        for index in 0..count {
            if let Some(first) = nodes[index].below.first() {
                let parent = owners[*first] as usize;
                parents[index] = Some(parent);
                children[parent].push(index);
                work[parent] += work[index];
            }
        }
        let most = if all < SINGLE_BRANCH_WORK { f64::INFINITY } else { SHARE * all };
        let above = |index: usize| work[index] > most;
        let separators: Vec<usize> = (0..count).filter(|index| above(*index)).collect();
        let roots = (0..count).filter(|index| !above(*index) && parents[*index].is_none_or(above));
        let mut branches = Vec::new();
        let (mut branch, mut sum) = (Branch::default(), 0.0);
        for root in roots {
            if sum + work[root] > most {
                branches.push(std::mem::take(&mut branch));
                sum = 0.0;
            }
            sum += work[root];
            descend(&children, root, &mut branch.nodes);
            branch.roots.push(root);
        }
        branches.push(branch);
        branches.retain(|branch| !branch.nodes.is_empty());
        let cost = |branch: &Branch| branch.roots.iter().map(|root| work[*root]).sum::<f64>();
        branches.sort_by(|a, b| cost(b).total_cmp(&cost(a)));
        for branch in &mut branches {
            branch.room = room(&nodes, &children, &branch.nodes);
        }
        Self { children, branches, separators, owners }
    }
}

/// A subtree, children before their parents.
fn descend(children: &[Vec<usize>], root: usize, nodes: &mut Vec<usize>) {
    let mut path = vec![(root, 0)];
    while let Some((node, next)) = path.last_mut() {
        if let Some(child) = children[*node].get(*next) {
            *next += 1;
            path.push((*child, 0));
        } else {
            nodes.push(*node);
            path.pop();
        }
    }
}

/// Most entries of updates on a stack from which each supernode takes those of its children before it leaves its own.
fn room(nodes: &[Supernode<'_>], children: &[Vec<usize>], order: &[usize]) -> usize {
    let square = |index: usize| nodes[index].below.len().pow(2);
    let (mut stack, mut most) = (0, 0);
    for index in order {
        most = most.max(stack + square(*index));
        stack -= children[*index].iter().map(|child| square(*child)).sum::<usize>();
        stack += square(*index);
    }
    most
}
