use quasirigid::elements::{Assembly, Carrier, Motion, Point};
use quasirigid::model::Support;

use super::Diagnostic;
use super::diagnostic::Problems;
use super::force::{self, ForceTable};
use super::hinged::{HINGED, hinged};
use super::names::Names;
use super::spans::Spans;
use super::spring::{SPRING, spring};
use super::support;
use super::table::{Keys, Table};
use super::value::Value;
use crate::units::Dimension;

const CARRIER: Keys = Keys { known: &["mass", "center_of_mass", "inertia"], later: &[] };
const POINT: Keys = Keys { known: &["name", "mass", "position", "motion"], later: &[] };
const MOTION: Keys = Keys { known: &["line", "plane"], later: &[] };

/// What a file says of the body.
pub(super) struct Body<'a> {
    /// Names of its parts.
    pub(super) names: Names<'a>,
    /// The body and where its parts stand in the file, if nothing is wrong with them.
    pub(super) content: Option<(Assembly, Spans)>,
}

impl Body<'_> {
    /// The body, if nothing is wrong with its parts.
    pub(super) fn assembly(&self) -> Option<&Assembly> {
        self.content.as_ref().map(|(assembly, _)| assembly)
    }
}

/// Reads everything that describes the body, what it stands on, and what acts on it.
pub(super) fn body<'a>(file: &Table<'a>, problems: &'a Problems<'a>) -> Body<'a> {
    let carrier_table = file.table("carrier", "[carrier]", &CARRIER);
    if file.get("carrier").is_none() {
        report_missing_carrier(problems);
    }
    let has_support = file.get("support").is_some();
    let support = support::table(file);
    let point_tables = file.tables("point", "[[point]]", &POINT);
    let spring_tables = file.tables("spring", "[[spring]]", &SPRING);
    let hinged_tables = file.tables("hinged", "[[hinged]]", &HINGED);
    let force_tables = force::tables(file);
    let names = Names::new(&point_tables, &hinged_tables, &force_tables, problems);

    let spans = Spans {
        carrier: carrier_table.as_ref().map(Table::spans).unwrap_or_default(),
        points: point_tables.iter().map(Table::spans).collect(),
        springs: spring_tables.iter().map(Table::spans).collect(),
        hinged: hinged_tables.iter().map(Table::spans).collect(),
        ellipsoids: Vec::new(),
        support: support.as_ref().map(|(table, _)| table.spans()).unwrap_or_default(),
        forces: force_tables.iter().map(ForceTable::spans).collect(),
    };
    let carrier = carrier_table.as_ref().and_then(carrier);
    let points = every(point_tables.iter().zip(&names.points).map(|(table, name)| point(table, name)));
    let springs = every(spring_tables.iter().map(|table| spring(table, &names)));
    let hinged = every(hinged_tables.iter().zip(&names.hinged).map(|(table, name)| hinged(table, name)));
    let support = match support {
        Some((table, kind)) => (kind.read)(&table),
        None => (!has_support).then(Support::default),
    };
    let forces = every(force_tables.iter().zip(&names.forces).map(|(table, name)| table.force(name, &names)));
    let assembly = || {
        Some(Assembly {
            carrier: Some(carrier?),
            ellipsoids: Vec::new(),
            points: points?,
            springs: springs?,
            hinged: hinged?,
            support: support?,
            forces: forces?,
        })
    };
    Body { content: assembly().map(|assembly| (assembly, spans)), names }
}

/// Reads the inertia tensor of an element: three principal values in the file's axes, or a matrix.
pub(super) fn inertia(value: &Value<'_>) -> Option<[[f64; 3]; 3]> {
    let items = value.items().unwrap_or_default();
    if items.len() != 3 {
        let help = "write [Jx, Jy, Jz] in kg m^2, or three rows of a symmetric matrix";
        return value.mismatch("3 principal values or a 3x3 matrix", help);
    }
    if items.iter().any(Value::is_array) {
        return value.matrix(Dimension::INERTIA);
    }
    let [x, y, z] = value.vector(Dimension::INERTIA)?;
    Some([[x, 0.0, 0.0], [0.0, y, 0.0], [0.0, 0.0, z]])
}

fn carrier(table: &Table<'_>) -> Option<Carrier> {
    let mass = table.required("mass", "mass = 40.0").and_then(|value| value.positive(Dimension::MASS));
    let center_of_mass = table
        .required("center_of_mass", "center_of_mass = [0.0, 0.0, 0.0]")
        .and_then(|value| value.vector(Dimension::LENGTH));
    let inertia = table.required("inertia", "inertia = [9.0, 13.0, 16.0]").and_then(|value| inertia(&value));
    Some(Carrier { mass: mass?, center_of_mass: center_of_mass?, inertia: inertia? })
}

fn point(table: &Table<'_>, name: &str) -> Option<Point> {
    let mass = table.required("mass", "mass = 1.0").and_then(|value| value.positive(Dimension::MASS));
    let position = table
        .required("position", "position = [0.8, 0.3, 0.5]")
        .and_then(|value| value.vector(Dimension::LENGTH));
    let motion = table.get("motion").map_or(Some(Motion::Free), |value| motion(&value));
    Some(Point { name: name.to_owned(), mass: mass?, position: position?, motion: motion? })
}

fn motion(value: &Value<'_>) -> Option<Motion> {
    if value.is_word("free") {
        return Some(Motion::Free);
    }
    let help = "write \"free\", { line = [1, 0, 0] } or { plane = [0, 0, 1] }";
    if !value.is_table() {
        return value.mismatch("\"free\", a line or a plane", help);
    }
    let table = value.table("`motion`", &MOTION)?;
    let direction = |value: Value<'_>| value.vector(Dimension::NUMBER);
    match (table.get("line"), table.get("plane")) {
        (Some(line), None) => direction(line).map(Motion::Line),
        (None, Some(plane)) => direction(plane).map(Motion::Plane),
        _ => {
            let message = "`motion` needs either a line or a plane".to_owned();
            value.refuse(message, "a line or a plane", Some(help.to_owned()))
        }
    }
}

/// Reads every element, also those after a wrong one, so that each is checked.
fn every<T>(elements: impl Iterator<Item = Option<T>>) -> Option<Vec<T>> {
    let elements: Vec<Option<T>> = elements.collect();
    elements.into_iter().collect()
}

fn report_missing_carrier(problems: &Problems<'_>) {
    let help =
        "add [carrier] with mass, center_of_mass and inertia: the rigid body that carries everything else";
    problems
        .report(Diagnostic::new(0..0, "the file has no [carrier]", "no [carrier] in this file").help(help));
}
