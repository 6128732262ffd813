//! Ranges within which the rheologies of a body are known.

use std::collections::HashMap;

use quasirigid_elements::{Assembly, ElementId};

use super::rheology::Extremes;

/// Ranges of the rheologies of each element, in the order of its regions, members or layers where it has several.
#[derive(Default)]
pub(super) struct Ranges {
    of: HashMap<ElementId, Vec<Extremes>>,
}

impl Ranges {
    /// Notes the ranges of an element.
    pub(super) fn set(&mut self, element: ElementId, ranges: Vec<Extremes>) {
        self.of.insert(element, ranges);
    }

    /// The body with every rheology at the least and at the greatest of its range, if there are ranges.
    pub(super) fn ends(&self, assembly: &Assembly) -> Option<Box<[Assembly; 2]>> {
        self.of
            .values()
            .flatten()
            .any(Option::is_some)
            .then(|| Box::new([self.end(assembly, 0), self.end(assembly, 1)]))
    }

    fn end(&self, assembly: &Assembly, end: usize) -> Assembly {
        let mut assembly = assembly.clone();
        let mut left: HashMap<ElementId, _> =
            self.of.iter().map(|(element, ranges)| (*element, ranges.iter())).collect();
        for (element, rheology) in assembly.rheologies_mut() {
            if let Some(Some(ends)) = left.get_mut(&element).and_then(Iterator::next) {
                rheology.clone_from(&ends[end]);
            }
        }
        assembly
    }
}
