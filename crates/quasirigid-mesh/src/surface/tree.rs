//! A tree of boxes around boxes, and pairs of boxes that overlap.

use std::ops::{ControlFlow, Range};

use super::geometry::bounds;

/// Lowest and highest corner of a box.
pub(super) type Bounds = [[f64; 3]; 2];

/// Most boxes in a node without children.
const LEAF: usize = 4;

/// A box around some of the boxes; its children, if any, share them.
pub(super) struct Node {
    pub bounds: Bounds,
    pub items: Range<usize>,
    pub children: Option<[usize; 2]>,
}

/// Boxes in an order in which neighbours are close, and the nodes over them, the root last.
pub(super) struct Tree {
    pub order: Vec<usize>,
    pub nodes: Vec<Node>,
}

/// Visits every pair of boxes that overlap or touch, until the visitor breaks off.
pub(super) fn overlapping(boxes: &[Bounds], mut visit: impl FnMut(usize, usize) -> ControlFlow<()>) {
    if boxes.is_empty() {
        return;
    }
    let tree = Tree::new(boxes);
    let root = tree.nodes.len() - 1;
    let mut open = vec![[root, root]];
    while let Some([a, b]) = open.pop() {
        let [first, second] = [&tree.nodes[a], &tree.nodes[b]];
        if !overlap(&first.bounds, &second.bounds) {
            continue;
        }
        match (first.children, second.children) {
            (Some([left, right]), _) if a == b => open.extend([[left, left], [right, right], [left, right]]),
            (Some(children), _) if second.children.is_none() || first.items.len() >= second.items.len() => {
                open.extend(children.map(|child| [child, b]));
            }
            (_, Some(children)) => open.extend(children.map(|child| [a, child])),
            _ => {
                for i in first.items.clone() {
                    let from = if a == b { i + 1 } else { second.items.start };
                    for j in from..second.items.end {
                        let pair = [tree.order[i], tree.order[j]];
                        let [p, q] = pair.map(|item| &boxes[item]);
                        if overlap(p, q) && visit(pair[0], pair[1]).is_break() {
                            return;
                        }
                    }
                }
            }
        }
    }
}

impl Tree {
    /// The tree over at least one box.
    pub fn new(boxes: &[Bounds]) -> Self {
        let mut tree = Self { order: (0..boxes.len()).collect(), nodes: Vec::new() };
        tree.build(boxes, 0..boxes.len());
        tree
    }

    /// Builds the node over a range of the order, halved at the median of the longest side.
    fn build(&mut self, boxes: &[Bounds], items: Range<usize>) -> usize {
        let bounds = bounds(self.order[items.clone()].iter().flat_map(|item| boxes[*item]));
        let mut children = None;
        if items.len() > LEAF {
            let length = |axis: &usize| bounds[1][*axis] - bounds[0][*axis];
            let longest =
                (0..3).fold(0, |best, axis| if length(&axis) > length(&best) { axis } else { best });
            let middle = |item: usize| boxes[item][0][longest] + boxes[item][1][longest];
            let half = items.len() / 2;
            self.order[items.clone()].select_nth_unstable_by(half, |a, b| middle(*a).total_cmp(&middle(*b)));
            let split = items.start + half;
            children = Some([self.build(boxes, items.start..split), self.build(boxes, split..items.end)]);
        }
        self.nodes.push(Node { bounds, items, children });
        self.nodes.len() - 1
    }
}

fn overlap([a_low, a_high]: &Bounds, [b_low, b_high]: &Bounds) -> bool {
    (0..3).all(|axis| a_low[axis] <= b_high[axis] && b_low[axis] <= a_high[axis])
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Boxes at places derived from their number, many of them equal in some coordinate.
    fn boxes(count: usize) -> Vec<Bounds> {
        let place = |n: usize| [n * 7 % 31, n * 11 % 23, n * 13 % 17].map(|x| x as f64);
        (0..count).map(place).map(|low| [low, low.map(|x| x + 3.0)]).collect()
    }

    #[test]
    fn every_pair_is_found_once() {
        for count in [0, 1, 5, 200] {
            let boxes = boxes(count);
            let mut found = Vec::new();
            overlapping(&boxes, |a, b| {
                found.push([a.min(b), a.max(b)]);
                ControlFlow::Continue(())
            });
            found.sort_unstable();
            let all = (0..count).flat_map(|a| (a + 1..count).map(move |b| [a, b]));
            let expected: Vec<_> = all.filter(|[a, b]| overlap(&boxes[*a], &boxes[*b])).collect();
            assert_eq!(found, expected);
        }
    }

    #[test]
    fn the_visitor_may_stop() {
        let mut visits = 0;
        overlapping(&[[[0.0; 3]; 2]; 50], |_, _| {
            visits += 1;
            if visits == 7 { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
        });
        assert_eq!(visits, 7);
    }
}
