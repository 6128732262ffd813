use std::collections::HashMap;
use std::ops::Range;

use quasirigid::elements::End;

use super::Diagnostic;
use super::diagnostic::Problems;
use super::table::Table;
use super::value::Value;
use crate::nearest::nearest;

/// The carrier's name where springs say what they are fixed to.
const CARRIER: &str = "carrier";
/// Most names listed in a message.
const MOST_LISTED: usize = 10;

/// Names of the points and appendages of a file.
pub(super) struct Names<'a> {
    /// Names of the points, in the order of the file.
    pub(super) points: Vec<String>,
    /// Names of the hinged appendages, in the order of the file.
    pub(super) hinged: Vec<String>,
    owners: HashMap<String, (Owner, Range<usize>)>,
    problems: &'a Problems<'a>,
}

#[derive(Clone, Copy)]
enum Owner {
    Point(usize),
    Hinged,
}

impl<'a> Names<'a> {
    /// Reads the names, and makes one from its number for an element without: `point 1`, `appendage 1`.
    pub(super) fn new(points: &[Table<'_>], hinged: &[Table<'_>], problems: &'a Problems<'a>) -> Self {
        let mut names = Self { points: Vec::new(), hinged: Vec::new(), owners: HashMap::new(), problems };
        for (index, table) in points.iter().enumerate() {
            let name = names.enter(table, format!("point {}", index + 1), Owner::Point(index));
            names.points.push(name);
        }
        for (index, table) in hinged.iter().enumerate() {
            let name = names.enter(table, format!("appendage {}", index + 1), Owner::Hinged);
            names.hinged.push(name);
        }
        names
    }

    /// What an end of a spring is fixed to.
    pub(super) fn end(&self, value: &Value<'_>) -> Option<End> {
        let name = value.text()?;
        if name == CARRIER {
            return Some(End::Carrier);
        }
        match self.owners.get(name) {
            Some((Owner::Point(index), _)) => Some(End::Point(*index)),
            Some((Owner::Hinged, _)) => {
                let message =
                    format!("{name:?} is a hinged appendage, but a spring joins points and the carrier");
                value.refuse(
                    message,
                    "not a point",
                    Some("give the hinge its own `stiffness` instead".to_owned()),
                )
            }
            None if self.problems.full() => None,
            None => value.refuse(
                format!("there is no point {name:?}"),
                "unknown point",
                Some(self.suggestion(name)),
            ),
        }
    }

    fn enter(&mut self, table: &Table<'_>, number: String, owner: Owner) -> String {
        let given = table.get("name");
        let span = given.map_or_else(|| table.header(), |value| value.span());
        let name = given.and_then(|value| value.text()).map_or(number, str::to_owned);
        if name == CARRIER {
            let message = format!("the name {CARRIER:?} is that of the carrier");
            self.problems.report(Diagnostic::new(span, message, "taken").help("choose another name"));
        } else if let Some((_, first)) = self.owners.get(&name) {
            let line = self.problems.line(first.clone());
            let message = format!("the name {name:?} is used twice; it stands first in line {line}");
            self.problems
                .report(Diagnostic::new(span, message, "used before").help("give each element its own name"));
        } else {
            self.owners.insert(name.clone(), (owner, span));
        }
        name
    }

    fn suggestion(&self, name: &str) -> String {
        if self.points.is_empty() {
            return "the file has no [[point]]; a spring joins points and the carrier".to_owned();
        }
        let names = || [CARRIER].into_iter().chain(self.points.iter().map(String::as_str));
        let mut listed: Vec<&str> = names().take(MOST_LISTED).collect();
        if self.points.len() >= MOST_LISTED {
            listed.push("…");
        }
        let list = format!("there are {}", listed.join(", "));
        match nearest(name, names()) {
            Some(known) => format!("did you mean {known:?}? {list}"),
            None => list,
        }
    }
}
