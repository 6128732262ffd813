use std::collections::HashMap;
use std::ops::Range;

use quasirigid::elements::{End, Hinged, NodeRef, PlaceRef};

use super::Diagnostic;
use super::cavity::CavityTable;
use super::diagnostic::Problems;
use super::force::ForceTable;
use super::part::{Nodes, PartTables};
use super::table::{Keys, Table};
use super::value::Value;
use crate::nearest::nearest;

/// The carrier's name where springs and forces say what they are fixed to.
const CARRIER: &str = "carrier";
/// Most names listed in a message.
const MOST_LISTED: usize = 10;

/// Names of the points, springs, appendages, ellipsoids, surfaces, networks, rotors, wheels, cavities, parts and forces of a file.
pub(super) struct Names<'a> {
    /// Names of the points, in the order of the file.
    pub(super) points: Vec<String>,
    /// Names of the springs, in the order of the file; empty for those without.
    pub(super) springs: Vec<String>,
    /// Names of the hinged appendages, in the order of the file.
    pub(super) hinged: Vec<String>,
    /// Names of the ellipsoids, in the order of the file.
    pub(super) ellipsoids: Vec<String>,
    /// Names of the surfaces, in the order of the file.
    pub(super) surfaces: Vec<String>,
    /// Names of the networks, which begin those of their points, in the order of the file.
    pub(super) networks: Vec<String>,
    /// Names of the rotors, in the order of the file.
    pub(super) rotors: Vec<String>,
    /// Names of the momentum wheels, in the order of the file.
    pub(super) wheels: Vec<String>,
    /// Names of the cavities, in the order of the file.
    pub(super) cavities: Vec<String>,
    /// Names of the parts of finite elements, in their order.
    pub(super) flexible: Vec<String>,
    /// How their nodes are named, once they have been read.
    pub(super) nodes: Vec<Nodes>,
    /// Names of the places on each appendage, once they have been read.
    pub(super) places: Vec<Vec<String>>,
    /// Names of the forces, in the order of the file.
    pub(super) forces: Vec<String>,
    parts: Register<'a, Part>,
}

/// A part of the body with a name; one that moves by its index in the list of its kind.
#[derive(Clone, Copy)]
pub(super) enum Part {
    Point(usize),
    Spring,
    Hinged(usize),
    Flexible(usize),
    Throughout,
    Inside,
}

/// A node of a part, or several, where something is fixed to them.
const NODES: Keys = Keys { known: &["part", "node", "set"] };

/// What says which point it is fixed to.
#[derive(Clone, Copy)]
pub(super) enum Fixed {
    Spring,
    Force,
}

impl Fixed {
    fn rule(self) -> &'static str {
        match self {
            Self::Spring => "a spring joins points, nodes of parts, places on appendages and the carrier",
            Self::Force => {
                "a force acts on a point, on a node of a part, on a place of an appendage or on the carrier"
            }
        }
    }
}

impl<'a> Names<'a> {
    /// Reads the names, and makes one from its number for an element without: `point 1`, `appendage 1`,
    /// `ellipsoid 1`, `surface 1`, `network 1`, `beam 1`, `panel 1`, `solid 1`, `force 1`.
    pub(super) fn new(
        [points, springs, hinged]: [&[Table<'_>]; 3],
        [ellipsoids, surfaces, networks]: [&[Table<'_>]; 3],
        (rotors, wheels, cavities): (&[Table<'_>], &[Table<'_>], &[CavityTable<'_>]),
        flexible: &PartTables<'_>,
        forces: &[ForceTable<'_>],
        problems: &'a Problems<'a>,
    ) -> Self {
        let mut parts = Register { owners: HashMap::new(), problems };
        let mut named = |tables: &[&Table<'_>], word: &str, part: fn(usize) -> Part| -> Vec<String> {
            let tables = tables.iter().enumerate();
            let enter =
                |(i, table): (usize, &&Table<'_>)| parts.enter(table, format!("{word} {}", i + 1), part(i));
            tables.map(enter).collect()
        };
        let points = named(&every(points), "point", Part::Point);
        let hinged = named(&every(hinged), "appendage", Part::Hinged);
        let ellipsoids = named(&every(ellipsoids), "ellipsoid", |_| Part::Throughout);
        let surfaces = named(&every(surfaces), "surface", |_| Part::Throughout);
        let networks = named(&every(networks), "network", |_| Part::Throughout);
        let rotors = named(&every(rotors), "rotor", |_| Part::Inside);
        let wheels = named(&every(wheels), "wheel", |_| Part::Inside);
        let liquids: Vec<&Table<'_>> = cavities.iter().map(|cavity| &cavity.table).collect();
        let cavities = named(&liquids, "cavity", |_| Part::Inside);
        let flexible = flexible.iter().enumerate();
        let flexible = flexible
            .map(|(index, (word, number, table))| {
                parts.enter(table, format!("{word} {number}"), Part::Flexible(index))
            })
            .collect();
        let springs = springs.iter().map(|table| parts.enter_named(table, Part::Spring).unwrap_or_default());
        let springs = springs.collect();
        let mut register = Register { owners: HashMap::new(), problems };
        let forces = forces.iter().enumerate();
        let forces = forces
            .map(|(index, force)| register.enter(&force.table, format!("force {}", index + 1), ()))
            .collect();
        Self {
            points,
            springs,
            hinged,
            ellipsoids,
            surfaces,
            networks,
            rotors,
            wheels,
            cavities,
            flexible,
            nodes: Vec::new(),
            places: Vec::new(),
            forces,
            parts,
        }
    }

    /// What a spring or force is fixed to.
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
                    Some("name one node".to_owned()),
                ),
            };
        }
        let name = value.text()?;
        if name == CARRIER {
            return Some(End::Carrier);
        }
        match self.parts.owner(name) {
            Some(Part::Point(index)) => Some(End::Point(index)),
            Some(Part::Spring) => value.refuse(
                format!("{name:?} is a spring, but {}", what.rule()),
                "not a point",
                Some("name what one of its ends is fixed to".to_owned()),
            ),
            Some(Part::Hinged(_)) => value.refuse(
                format!("{name:?} is a hinged appendage, but {}", what.rule()),
                "which place?",
                Some(format!(
                    "give it places = {{ tip = [...] }} and write {{ part = {name:?}, node = \"tip\" }}"
                )),
            ),
            Some(Part::Flexible(_)) => value.refuse(
                format!("{name:?} has many nodes; {}", what.rule()),
                "which node?",
                Some(format!("write {{ part = {name:?}, node = ... }}")),
            ),
            Some(Part::Throughout) => value.refuse(
                format!("{name:?} is elastic throughout, but {}", what.rule()),
                "not a point",
                Some("it is a whole body; nothing is fixed to it".to_owned()),
            ),
            Some(Part::Inside) => value.refuse(
                format!("{name:?} turns inside the carrier, but {}", what.rule()),
                "not a point",
                Some(format!("write {CARRIER:?}")),
            ),
            None if self.parts.problems.full() => None,
            None if self.points.is_empty() => value.refuse(
                format!("there is no point {name:?}"),
                "unknown point",
                Some(format!("the file has no [[point]]; {}", what.rule())),
            ),
            None => {
                let names = || [CARRIER].into_iter().chain(self.points.iter().map(String::as_str));
                let count = self.points.len() + 1;
                let help = suggestion(name, names, count);
                value.refuse(format!("there is no point {name:?}"), "unknown point", Some(help))
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
            let places = self.places.get(hinged)?;
            if let Some(place) = places.iter().position(|place| place == name) {
                return Some(End::Hinged(PlaceRef { hinged, place }));
            }
            let names = || places.iter().map(String::as_str);
            let help = match places.len() {
                0 => format!("add places = {{ {name} = [...] }} to its [[hinged]]"),
                count => suggestion(name, names, count),
            };
            let message = format!("there is no place {name:?} on {:?}", self.hinged[hinged]);
            node.refuse(message, "unknown place", Some(help))
        };
        Some(read())
    }

    /// Notes the places on appendages.
    pub(super) fn note_places<'h>(&mut self, hinged: impl Iterator<Item = Option<&'h Hinged>>) {
        let names = |hinged: &Hinged| hinged.places.iter().map(|(name, _)| name.clone()).collect();
        self.places = hinged.map(|hinged| hinged.map(names).unwrap_or_default()).collect();
    }

    /// The nodes that a table such as `{ part = "boom", node = "tip" }` names, with the index of their part.
    pub(super) fn nodes(&self, value: &Value<'_>) -> Option<(usize, Vec<usize>)> {
        let table = value.table("the place on a part", &NODES)?;
        let name = table.required("part", "part = \"boom\"")?;
        let part = match self.parts.owner(name.text()?) {
            Some(Part::Flexible(index)) => index,
            _ => {
                let names = || self.flexible.iter().map(String::as_str);
                let help = match self.flexible.len() {
                    0 => "the file has no [[beam]], [[panel]] or [[solid]]".to_owned(),
                    count => suggestion(name.text()?, names, count),
                };
                let message = format!("there is no part {:?} with nodes", name.text()?);
                return name.refuse(message, "unknown part", Some(help));
            }
        };
        let nodes = self.nodes.get(part)?;
        match (table.get("node"), table.get("set")) {
            (Some(node), None) => nodes.single(&node).map(|node| (part, vec![node])),
            (None, Some(set)) => nodes.named(&set).map(|nodes| (part, nodes)),
            _ => value.refuse(
                "a place on a part needs either a node or a set of them".to_owned(),
                "a node or a set",
                Some("write { part = \"boom\", node = \"tip\" }".to_owned()),
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
        let names = || self.points.iter().chain(&self.hinged).map(String::as_str);
        let help = match self.points.len() + self.hinged.len() {
            0 => "the file has no [[point]] and no [[hinged]]".to_owned(),
            _ if name == CARRIER => "the rest of the body is displaced from the carrier".to_owned(),
            count => suggestion(name, names, count),
        };
        value.refuse_at(key, format!("there is no point or appendage {name:?}"), "unknown name", Some(help))
    }
}

fn every<'t, 'f>(tables: &'t [Table<'f>]) -> Vec<&'t Table<'f>> {
    tables.iter().collect()
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

    /// The name that a table gives, or else the one made from its number.
    fn enter(&mut self, table: &Table<'_>, number: String, owner: T) -> String {
        let given = table.get("name");
        let span = given.map_or_else(|| table.header(), |value| value.span());
        let name = given.and_then(|value| value.text()).map_or(number, str::to_owned);
        self.claim(&name, span, owner);
        name
    }

    /// The name that a table gives, if it gives one.
    fn enter_named(&mut self, table: &Table<'_>, owner: T) -> Option<String> {
        let given = table.get("name")?;
        let name = given.text()?.to_owned();
        self.claim(&name, given.span(), owner);
        Some(name)
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
