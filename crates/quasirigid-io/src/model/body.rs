use quasirigid::elements::{Assembly, Carrier, Motion, Point};
use quasirigid::model::Support;

use super::Diagnostic;
use super::diagnostic::Problems;
use super::hinged::{HINGED, hinged};
use super::names::Names;
use super::spans::Spans;
use super::spring::{SPRING, spring};
use super::table::{Keys, Table};
use super::value::Value;
use crate::units::Dimension;

const CARRIER: Keys = Keys { known: &["mass", "center_of_mass", "inertia"], later: &[] };
const POINT: Keys = Keys { known: &["name", "mass", "position", "motion"], later: &[] };
const MOTION: Keys = Keys { known: &["line", "plane"], later: &[] };
const SUPPORT: Keys = Keys { known: &["kind", "point"], later: &[] };

/// Reads everything that describes the body, and where it stands.
pub(super) fn assembly(file: &Table<'_>, problems: &Problems<'_>) -> Option<(Assembly, Spans)> {
    let carrier_table = file.table("carrier", "[carrier]", &CARRIER);
    if file.get("carrier").is_none() {
        report_missing_carrier(problems);
    }
    let support_table = file.table("support", "[support]", &SUPPORT);
    let point_tables = file.tables("point", "[[point]]", &POINT);
    let spring_tables = file.tables("spring", "[[spring]]", &SPRING);
    let hinged_tables = file.tables("hinged", "[[hinged]]", &HINGED);
    let names = Names::new(&point_tables, &hinged_tables, problems);

    let carrier = carrier_table.as_ref().and_then(carrier);
    let support = support_table.as_ref().map_or_else(|| Some(Support::default()), support);
    let points = every(point_tables.iter().zip(&names.points).map(|(table, name)| point(table, name)));
    let springs = every(spring_tables.iter().map(|table| spring(table, &names)));
    let hinged = every(hinged_tables.iter().zip(&names.hinged).map(|(table, name)| hinged(table, name)));
    let spans = Spans {
        carrier: carrier_table.as_ref().map(Table::spans).unwrap_or_default(),
        points: point_tables.iter().map(Table::spans).collect(),
        springs: spring_tables.iter().map(Table::spans).collect(),
        hinged: hinged_tables.iter().map(Table::spans).collect(),
        support: support_table.as_ref().map(Table::spans).unwrap_or_default(),
    };
    let assembly = Assembly {
        carrier: carrier?,
        points: points?,
        springs: springs?,
        hinged: hinged?,
        support: support?,
        forces: Vec::new(),
    };
    Some((assembly, spans))
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

fn support(table: &Table<'_>) -> Option<Support> {
    #[derive(Clone, Copy, PartialEq)]
    enum Kind {
        Free,
        FixedPoint,
    }
    let kinds = [("free", Some(Kind::Free)), ("fixed-point", Some(Kind::FixedPoint)), ("prescribed", None)];
    let kind = table.required("kind", "kind = \"free\"").and_then(|value| value.choice(&kinds));
    match (kind?, table.get("point")) {
        (Kind::Free, None) => Some(Support::Free),
        (Kind::Free, Some(point)) => point.refuse(
            "a free body has no fixed `point`".to_owned(),
            "not for a free body",
            Some("leave it out, or write kind = \"fixed-point\"".to_owned()),
        ),
        (Kind::FixedPoint, _) => {
            let point = table.required("point", "point = [0.0, 0.0, 0.0]")?.vector(Dimension::LENGTH)?;
            Some(Support::FixedPoint { point })
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
