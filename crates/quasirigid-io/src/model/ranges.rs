//! How well the rheologies of a body are known.

use std::collections::HashMap;

use quasirigid::elements::{Assembly, ElementId, ElementKind};

use super::rheology::Extremes;

/// Ranges of the rheologies of each element, in the order of its regions, members or layers where it has several.
#[derive(Default)]
pub(super) struct Ranges {
    of: HashMap<ElementId, Vec<Extremes>>,
}

impl Ranges {
    /// The elements of a kind, which have a rheology each, without their ranges, which are noted.
    pub(super) fn note<T>(&mut self, kind: ElementKind, elements: Vec<(T, Extremes)>) -> Vec<T> {
        self.note_several(kind, elements.into_iter().map(|(element, range)| (element, vec![range])))
    }

    /// The same of elements that may have several.
    pub(super) fn note_several<T>(
        &mut self,
        kind: ElementKind,
        elements: impl Iterator<Item = (T, Vec<Extremes>)>,
    ) -> Vec<T> {
        let noted = elements.enumerate().map(|(index, (element, ranges))| {
            self.set(kind.at(index), ranges);
            element
        });
        noted.collect()
    }

    /// Notes the ranges of an element.
    pub(super) fn set(&mut self, element: ElementId, ranges: Vec<Extremes>) {
        self.of.insert(element, ranges);
    }

    /// The body with every rheology at its least and at its greatest, if there are ranges.
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
