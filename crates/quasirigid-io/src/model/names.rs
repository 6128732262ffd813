//! Names in a model file: the elements that have one, and the references to them from springs, forces and initial states.
//! Names are claimed in the order of the file, so that of two equal ones the second is reported; references are resolved against all.

use std::collections::HashMap;
use std::ops::Range;

use quasirigid_elements::{ElementKind, End, NodeRef, PlaceRef};

use super::Diagnostic;
use super::diagnostic::Problems;
use super::key::{COUNTED, Form, Keys, Shape, TEXT, any, key};
use super::part::Nodes;
use super::reader::{Naming, Opened};
use super::value::Value;
use crate::nearest::nearest;

/// Name of the carrier in the ends of springs and the points of application of forces.
const CARRIER: &str = "carrier";
/// Most names listed in a message.
const MOST_LISTED: usize = 10;

/// Names in a file.
pub(super) struct Names<'a> {
    /// Names of the elements, in the order of their tables; empty for elements without a name.
    given: Vec<String>,
    /// Names of the elements by kind.
    of: HashMap<ElementKind, Vec<String>>,
    /// Names of the nodes of parts, by index of the part, once they have been read.
    pub(super) nodes: HashMap<usize, Nodes>,
    /// Names of the places on appendages, by index of the appendage, once they have been read.
    pub(super) places: HashMap<usize, Vec<String>>,
    parts: Register<'a, Part>,
}

/// A part of the body with a name; a part that moves has an index in the list of its kind.
#[derive(Clone, Copy)]
pub(super) enum Part {
    Point(usize),
    /// A spring or the like, by the word for it.
    Link(&'static str),
    Hinged(usize),
    Flexible(usize),
    Throughout,
    Inside,
    /// A liquid that slides along a ring.
    Slug(usize),
    /// An appendage without shapes.
    Modal,
    /// A boom of a prescribed length.
    Boom,
}

/// End of a spring, or place of a force.
pub(super) const END: Form = any(&[Shape::Text, Shape::Shared("node")]);
/// A node, by name or number.
pub(super) const NODE: &[Shape] = &[Shape::Text, COUNTED];

/// Keys of a reference to one node of a part or to several.
pub(super) const NODES: Keys = Keys {
    known: &[
        key("part", TEXT, "name of a part or an appendage"),
        key("node", any(NODE), "name, number in the mesh, corner of a rectangle, or place"),
        key("set", any(&[Shape::Text, COUNTED, Shape::List(&Shape::Any(NODE))]), "several, instead"),
    ],
};

/// Kind of element that refers to a place.
#[derive(Clone, Copy)]
pub(super) enum Fixed {
    /// A spring or the like, by the word for it.
    Link(&'static str),
    Force,
}

impl Fixed {
    fn rule(self) -> String {
        match self {
            Self::Link(word) => {
                format!("a {word} joins points, nodes of parts, places on appendages and the carrier")
            }
            Self::Force => {
                "a force acts on a point, on a node of a part, on a place of an appendage or on the carrier"
                    .to_owned()
            }
        }
    }
}

impl<'a> Names<'a> {
    /// Reads the names of elements; an element without a name gets one from its number, such as `point 1`, where its kind needs names.
    pub(super) fn new(opened: &[Opened<'_>], problems: &'a Problems<'a>) -> Self {
        let given: Vec<String> = opened.iter().map(name).collect();
        let mut of: HashMap<ElementKind, Vec<String>> = HashMap::new();
        for (opened, name) in opened.iter().zip(&given) {
            opened.kind.into_iter().for_each(|kind| of.entry(kind).or_default().push(name.clone()));
        }
        let mut parts = Register { owners: HashMap::new(), problems };
        let mut apart: HashMap<&str, Register<'_, ()>> = HashMap::new();
        let mut in_order: Vec<_> = opened.iter().zip(&given).filter(|(_, name)| !name.is_empty()).collect();
        in_order.sort_by_key(|(opened, _)| opened.table.header().start);
        for (Opened { reader, index, table, .. }, name) in in_order {
            let span = table.get("name").map_or_else(|| table.header(), |value| value.span());
            match reader.naming {
                Naming::Apart(word) => {
                    let register = || Register { owners: HashMap::new(), problems };
                    apart.entry(word).or_insert_with(register).claim(name, span, ());
                }
                _ => parts.claim(name, span, reader.part_of(table, *index)),
            }
        }
        Self { given, of, nodes: HashMap::new(), places: HashMap::new(), parts }
    }

    /// Name of the element of a table, by number of the table.
    pub(super) fn given(&self, table: usize) -> &str {
        &self.given[table]
    }

    /// Names of the elements of a kind.
    fn all(&self, kind: ElementKind) -> &[String] {
        self.of.get(&kind).map_or(&[], Vec::as_slice)
    }

    /// End of a spring, or point of application of a force.
    pub(super) fn end(&self, value: &Value<'_>, what: Fixed) -> Option<End> {
        if value.is_table() {
            if let Some(place) = self.place(value) {
                return place;
            }
            let (part, nodes) = self.nodes(value)?;
            return match nodes.as_slice() {
                [node] => Some(End::Node(NodeRef { part, node: *node })),
                several => value.refuse(
                    format!("{} nodes are named here, but one is needed", several.len()),
                    "several nodes",
                    "name one node",
                ),
            };
        }
        let name = value.text()?;
        if name == CARRIER {
            return Some(End::Carrier);
        }
        match self.parts.owner(name) {
            Some(Part::Point(index)) => Some(End::Point(index)),
            Some(Part::Link(word)) => value.refuse(
                format!("{name:?} is a {word}, but {}", what.rule()),
                "not a point",
                "name what one of its ends is fixed to",
            ),
            Some(Part::Hinged(_)) => value.refuse(
                format!("{name:?} is a hinged appendage, but {}", what.rule()),
                "which place?",
                format!("give it places = {{ tip = [...] }} and write {{ part = {name:?}, node = \"tip\" }}"),
            ),
            Some(Part::Flexible(_)) => value.refuse(
                format!("{name:?} has many nodes; {}", what.rule()),
                "which node?",
                format!("write {{ part = {name:?}, node = ... }}"),
            ),
            Some(Part::Throughout) => value.refuse(
                format!("{name:?} is elastic throughout, but {}", what.rule()),
                "not a point",
                "it is a whole body; nothing is fixed to it",
            ),
            Some(Part::Inside) => value.refuse(
                format!("{name:?} turns inside the carrier, but {}", what.rule()),
                "not a point",
                format!("write {CARRIER:?}"),
            ),
            Some(Part::Slug(_)) => value.refuse(
                format!("{name:?} is a liquid that slides in the carrier, but {}", what.rule()),
                "not a point",
                format!("write {CARRIER:?}"),
            ),
            Some(Part::Modal) => value.refuse(
                format!("{name:?} is known by its modes alone, but {}", what.rule()),
                "no place on it",
                format!("write {CARRIER:?}, with the place of its interface"),
            ),
            Some(Part::Boom) => value.refuse(
                format!("{name:?} is a boom that is run out, but {}", what.rule()),
                "no place on it",
                format!("write {CARRIER:?}, with the place of its root"),
            ),
            None if self.parts.problems.full() => None,
            None if self.all(ElementKind::Point).is_empty() => value.refuse(
                format!("there is no point {name:?}"),
                "unknown point",
                format!("the file has no [[point]]; {}", what.rule()),
            ),
            None => {
                let names =
                    || [CARRIER].into_iter().chain(self.all(ElementKind::Point).iter().map(String::as_str));
                let count = self.all(ElementKind::Point).len() + 1;
                let help = suggestion(name, names, count);
                value.refuse(format!("there is no point {name:?}"), "unknown point", help)
            }
        }
    }

    /// The place on a hinged appendage that a table such as `{ part = "boom", node = "tip" }` names, read or refused; none if the
    /// part is no appendage.
    fn place(&self, value: &Value<'_>) -> Option<Option<End>> {
        let Some(Part::Hinged(hinged)) = self.parts.owner(value.entry("part")?.words()?) else { return None };
        let read = || {
            let table = value.table("the place on an appendage", &NODES)?;
            let node = table.required("node", "node = \"tip\"")?;
            let name = node.text()?;
            let places = self.places.get(&hinged)?;
            if let Some(place) = places.iter().position(|place| place == name) {
                return Some(End::Hinged(PlaceRef { hinged, place }));
            }
            let names = || places.iter().map(String::as_str);
            let help = match places.len() {
                0 => format!("add places = {{ {name} = [...] }} to its [[hinged]]"),
                count => suggestion(name, names, count),
            };
            let message =
                format!("there is no place {name:?} on {:?}", self.all(ElementKind::Hinged)[hinged]);
            node.refuse(message, "unknown place", help)
        };
        Some(read())
    }

    /// The nodes that a table such as `{ part = "boom", node = "tip" }` names, with the index of their part.
    pub(super) fn nodes(&self, value: &Value<'_>) -> Option<(usize, Vec<usize>)> {
        let table = value.table("the place on a part", &NODES)?;
        let name = table.required("part", "part = \"boom\"")?;
        let part = match self.parts.owner(name.text()?) {
            Some(Part::Flexible(index)) => index,
            _ => {
                let names = || self.all(ElementKind::Part).iter().map(String::as_str);
                let help = match self.all(ElementKind::Part).len() {
                    0 => "the file has no [[beam]], [[panel]] or [[solid]]".to_owned(),
                    count => suggestion(name.text()?, names, count),
                };
                let message = format!("there is no part {:?} with nodes", name.text()?);
                return name.refuse(message, "unknown part", help);
            }
        };
        let nodes = self.nodes.get(&part)?;
        match (table.get("node"), table.get("set")) {
            (Some(node), None) => nodes.single(&node).map(|node| (part, vec![node])),
            (None, Some(set)) => nodes.named(&set).map(|nodes| (part, nodes)),
            _ => value.refuse(
                "a place on a part needs either a node or a set of them",
                "a node or a set",
                "write { part = \"boom\", node = \"tip\" }",
            ),
        }
    }

    /// The part with the name under which a value stands, at `key`.
    pub(super) fn part(&self, key: Range<usize>, value: &Value<'_>) -> Option<Part> {
        let name = value.key();
        if let Some(part) = self.parts.owner(name) {
            return Some(part);
        }
        if self.parts.problems.full() {
            return None;
        }
        let moving = [ElementKind::Point, ElementKind::Hinged, ElementKind::Tube].map(|kind| self.all(kind));
        let names = || moving.into_iter().flatten().map(String::as_str);
        let help = match moving.iter().map(|names| names.len()).sum::<usize>() {
            0 => "the file has no [[point]] and no [[hinged]]".to_owned(),
            _ if name == CARRIER => "the rest of the body is displaced from the carrier".to_owned(),
            count => suggestion(name, names, count),
        };
        value.refuse_at(key, format!("there is no point or appendage {name:?}"), "unknown name", help)
    }
}

/// The name that a table gives, or a name made of its number; empty if the kind needs none.
fn name(Opened { reader, number, table, .. }: &Opened<'_>) -> String {
    let made = match reader.naming {
        Naming::Numbered(word) | Naming::Apart(word) => format!("{word} {number}"),
        Naming::Optional => String::new(),
        Naming::Nameless => return String::new(),
    };
    table.get("name").and_then(|value| value.name()).map_or(made, str::to_owned)
}

/// Names that must differ, each with its owner and place.
struct Register<'a, T> {
    owners: HashMap<String, (T, Range<usize>)>,
    problems: &'a Problems<'a>,
}

impl<T: Copy> Register<'_, T> {
    fn owner(&self, name: &str) -> Option<T> {
        self.owners.get(name).map(|(owner, _)| *owner)
    }

    /// Gives a name, which stands in a place, to its owner.
    fn claim(&mut self, name: &str, span: Range<usize>, owner: T) {
        if name == CARRIER {
            let message = format!("the name {CARRIER:?} is that of the carrier");
            self.problems.report(Diagnostic::new(span, message, "taken").help("choose another name"));
        } else if let Some((_, first)) = self.owners.get(name) {
            let line = self.problems.line(first.clone());
            let message = format!("the name {name:?} is used twice; it stands first in line {line}");
            self.problems
                .report(Diagnostic::new(span, message, "used before").help("give each element its own name"));
        } else {
            self.owners.insert(name.to_owned(), (owner, span));
        }
    }
}

/// The name that is probably meant, if one is near, and the first of all `count` names.
pub(super) fn suggestion<'n, I: Iterator<Item = &'n str>>(
    name: &str,
    names: impl Fn() -> I,
    count: usize,
) -> String {
    let mut listed: Vec<&str> = names().take(MOST_LISTED).collect();
    if count > MOST_LISTED {
        listed.push("…");
    }
    let list = format!("there are {}", listed.join(", "));
    match nearest(name, names()) {
        Some(known) => format!("did you mean {known:?}? {list}"),
        None => list,
    }
}
