//! Connected components of a graph.

/// Connected components of the graph whose edges are `pairs`, each ascending, in the order of their first elements.
#[must_use]
pub fn connected_components(size: usize, pairs: impl IntoIterator<Item = [usize; 2]>) -> Vec<Vec<usize>> {
    let mut root: Vec<usize> = (0..size).collect();
    let find = |root: &mut Vec<usize>, mut element: usize| {
        while root[element] != element {
            root[element] = root[root[element]];
            element = root[element];
        }
        element
    };
    for [a, b] in pairs {
        let (a, b) = (find(&mut root, a), find(&mut root, b));
        root[a.max(b)] = a.min(b);
    }
    let mut number = vec![usize::MAX; size];
    let mut components: Vec<Vec<usize>> = Vec::new();
    for element in 0..size {
        let first = find(&mut root, element);
        if first == element {
            number[first] = components.len();
            components.push(Vec::new());
        }
        components[number[first]].push(element);
    }
    components
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn components_come_in_the_order_of_their_first_elements() {
        let expected = [vec![0, 5], vec![1, 2, 4, 6], vec![3]];
        assert_eq!(connected_components(7, [[6, 2], [4, 1], [2, 4], [5, 0], [1, 6]]), expected);
    }
}
