use std::collections::HashMap;
use std::ops::Range;

use quasirigid_elements::{ElementId, ElementKind, Field};

/// Places of the elements of a model in its file.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Spans {
    elements: HashMap<ElementId, ElementSpans>,
    pub(super) networks: Vec<NetworkSpans>,
}

/// Place of a network, with the ranges of its points and springs.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct NetworkSpans {
    pub(super) points: Range<usize>,
    pub(super) springs: Range<usize>,
    pub(super) table: ElementSpans,
}

/// Places of an element and of its values.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct ElementSpans {
    /// Header of the element's table.
    pub(crate) header: Range<usize>,
    /// Values of the element, by key.
    pub(crate) values: Vec<(&'static str, Range<usize>)>,
}

impl Spans {
    /// Notes the places of elements.
    pub(super) fn note(&mut self, spans: impl IntoIterator<Item = (ElementId, ElementSpans)>) {
        self.elements.extend(spans);
    }

    /// The place of a value; that of its element where the file leaves the value out; the start of the file where the file
    /// leaves the element out.
    pub(super) fn find(&self, element: ElementId, field: Field) -> Range<usize> {
        let Some(spans) = self.elements.get(&element).or_else(|| self.network(element)) else {
            return 0..0;
        };
        let key = field.key();
        let value = spans.values.iter().find(|(known, _)| *known == key);
        value.map_or_else(|| spans.header.clone(), |(_, span)| span.clone())
    }

    /// The network that an element was made by.
    fn network(&self, ElementId { kind, index }: ElementId) -> Option<&ElementSpans> {
        let made = |network: &&NetworkSpans| match kind {
            ElementKind::Point => network.points.contains(&index),
            ElementKind::Spring => network.springs.contains(&index),
            _ => false,
        };
        self.networks.iter().find(made).map(|network| &network.table)
    }
}
