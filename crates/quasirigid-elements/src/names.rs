//! Names: elements, links and connections as messages and budgets of dissipation show them.
//! Links may have no name, yet each dissipator needs one of its own: it is made of the ends, and numbered where it repeats.

use std::collections::HashMap;

use crate::element::{Element, Named, Role};
use crate::kinds::part::Anchor;
use crate::{Assembly, ElementId, End};

/// Name of the carrier.
const CARRIER: &str = "carrier";

impl Assembly {
    /// Name given to an element; none of an element without a name, and of one that is not there.
    #[must_use]
    pub fn name(&self, element: ElementId) -> Option<&str> {
        self.element(element).map(Named::name).filter(|name| !name.is_empty())
    }

    /// Description of an element for its user: `beam "boom"`, with a number in place of a missing name, `the carrier` for a single one.
    #[must_use]
    pub fn described(&self, element: ElementId) -> String {
        let words = self.element(element).and_then(Element::words).unwrap_or(element.kind.words());
        match self.name(element) {
            Some(name) => format!("{words} {name:?}"),
            None if element.kind.is_single() => format!("the {words}"),
            None => format!("{words} {}", element.index + 1),
        }
    }

    /// Names of the links as dissipators: their own, or after their ends, `spring tip-carrier`.
    pub(crate) fn link_names(&self) -> HashMap<ElementId, String> {
        let mut numbers = Numbers::default();
        let links = self.each().filter(|(id, _)| id.kind.role() == Role::Link);
        let name = |(id, element): (ElementId, &dyn Element)| {
            if !element.name().is_empty() {
                return (id, element.name().to_owned());
            }
            let ends: Vec<String> = element
                .attachment_points()
                .iter()
                .map(|attachment_point| self.end_name(attachment_point.end))
                .collect();
            (id, numbers.of(format!("{} {}", id.kind.words(), ends.join("-"))))
        };
        links.map(name).collect()
    }

    fn end_name(&self, end: End) -> String {
        match end {
            End::Carrier => CARRIER.to_owned(),
            End::Point(index) => self.points.get(index).map_or_else(String::new, |point| point.name.clone()),
            End::Hinged(on) => {
                let hinged = self.hinged.get(on.hinged);
                let place = hinged.and_then(|hinged| Some((&hinged.name, &hinged.places.get(on.place)?.0)));
                place.map_or_else(String::new, |(name, place)| format!("{name} {place}"))
            }
            End::Node(node) => {
                let part = &self.parts[node.part];
                format!("{} {}", part.name, part.node_name(node.node))
            }
        }
    }

    /// Name of a connection as a dissipator, after what it joins: `connection boom-carrier`.
    pub(crate) fn connection_name(&self, index: usize) -> String {
        let mut numbers = Numbers::default();
        let connections = self.connections.iter().take(index + 1);
        let names = connections.map(|connection| {
            let [from, to] = [&connection.from, &connection.to].map(|end| self.anchor_name(end));
            numbers.of(format!("connection {from}-{to}"))
        });
        names.last().unwrap_or_default()
    }

    fn anchor_name(&self, anchor: &Anchor) -> &str {
        match anchor {
            Anchor::Carrier => CARRIER,
            Anchor::Nodes { part, .. } => self.parts.get(*part).map_or("", |part| &part.name),
        }
    }
}

/// Number of uses of each name.
#[derive(Default)]
struct Numbers {
    given: HashMap<String, usize>,
}

impl Numbers {
    /// The name, with a number from its second use on.
    fn of(&mut self, name: String) -> String {
        let count = self.given.entry(name.clone()).or_default();
        *count += 1;
        if *count == 1 { name } else { format!("{name} {count}") }
    }
}
