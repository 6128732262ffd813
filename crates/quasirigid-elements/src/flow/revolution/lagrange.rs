/// Polynomials that are 1 at one node and 0 at the others: values and slopes at a place, node by node.
pub(super) fn lagrange(nodes: &[f64], x: f64) -> Vec<[f64; 2]> {
    let value = |j: usize, without: usize| -> f64 {
        let others = (0..nodes.len()).filter(|i| *i != j && *i != without);
        others.map(|i| (x - nodes[i]) / (nodes[j] - nodes[i])).product()
    };
    let slope = |j: usize| {
        let others = (0..nodes.len()).filter(|i| *i != j);
        others.map(|i| value(j, i) / (nodes[j] - nodes[i])).sum()
    };
    (0..nodes.len()).map(|j| [value(j, j), slope(j)]).collect()
}
