use std::path::Path;

use quasirigid::elements::{Assembly, Carrier, ElementKind, Motion, Point};
use quasirigid::model::Support;

use super::Diagnostic;
use super::cavity::{self, CavityTable};
use super::diagnostic::Problems;
use super::ellipsoid::{ELLIPSOID, ellipsoid};
use super::force::{self, ForceTable};
use super::hinged::{HINGED, hinged};
use super::material::Materials;
use super::names::Names;
use super::part::{CONNECTION, NETWORK, PartTables, Sources, connection, network, reduction};
use super::ranges::Ranges;
use super::rotor::{ROTOR, rotor};
use super::section::Sections;
use super::spans::{NetworkSpans, Spans};
use super::spring::{SPRING, spring};
use super::support;
use super::surface::{SURFACE, surface};
use super::table::{Keys, Table};
use super::value::Value;
use super::wheel::{WHEEL, wheel};
use crate::units::Dimension;

const CARRIER: Keys = Keys { known: &["mass", "center_of_mass", "inertia"] };
const POINT: Keys = Keys { known: &["name", "mass", "position", "motion"] };
const MOTION: Keys = Keys { known: &["line", "plane"] };

/// Points of a body without a carrier, at least: fewer have no inertia about some axis.
const FEWEST_POINTS: usize = 3;

/// What a file says of the body.
pub(super) struct Body<'a> {
    /// Names of its parts.
    pub(super) names: Names<'a>,
    /// Its parts, if nothing is wrong with them.
    pub(super) parts: Option<Parts>,
}

/// The parts of the body.
pub(super) struct Parts {
    pub(super) assembly: Assembly,
    /// The same with every rheology at its least and at its greatest, if the file gives ranges.
    pub(super) extremes: Option<Box<[Assembly; 2]>>,
    /// Where they stand in the file.
    pub(super) spans: Spans,
}

impl Body<'_> {
    /// The body, if nothing is wrong with its parts.
    pub(super) fn assembly(&self) -> Option<&Assembly> {
        self.parts.as_ref().map(|parts| &parts.assembly)
    }
}

/// Reads everything that describes the body, what it stands on, and what acts on it; what is merely suspect goes into
/// `notes`.
pub(super) fn body<'a>(
    file: &Table<'a>,
    folder: &Path,
    problems: &'a Problems<'a>,
    notes: &mut Vec<String>,
) -> Body<'a> {
    let carrier_table = file.table("carrier", "[carrier]", &CARRIER);
    let absent = |key| file.get(key).is_none_or(|value| value.is_empty());
    const BODIES: [&str; 8] =
        ["ellipsoid", "surface", "beam", "panel", "solid", "matrices", "modes", "network"];
    let points = file.get("point").and_then(|value| value.items()).map_or(0, |items| items.len());
    if file.get("carrier").is_none() && points < FEWEST_POINTS && BODIES.iter().all(|key| absent(key)) {
        report_missing_body(problems);
    }
    let has_support = file.get("support").is_some();
    let support = support::table(file);
    let materials = Materials::new(file);
    let ellipsoid_tables = file.tables("ellipsoid", "[[ellipsoid]]", &ELLIPSOID);
    let surface_tables = file.tables("surface", "[[surface]]", &SURFACE);
    let sections = Sections::new(file);
    let part_tables = PartTables::new(file);
    let connection_tables = file.tables("connection", "[[connection]]", &CONNECTION);
    let network_tables = file.tables("network", "[[network]]", &NETWORK);
    let reduction = reduction(file);
    let point_tables = file.tables("point", "[[point]]", &POINT);
    let spring_tables = file.tables("spring", "[[spring]]", &SPRING);
    let hinged_tables = file.tables("hinged", "[[hinged]]", &HINGED);
    let rotor_tables = file.tables("rotor", "[[rotor]]", &ROTOR);
    let wheel_tables = file.tables("wheel", "[[wheel]]", &WHEEL);
    let cavity_tables = cavity::tables(file);
    let force_tables = force::tables(file);
    let mut names = Names::new(
        [&point_tables, &spring_tables, &hinged_tables],
        [&ellipsoid_tables, &surface_tables, &network_tables],
        (&rotor_tables, &wheel_tables, &cavity_tables),
        &part_tables,
        &force_tables,
        problems,
    );

    let mut spans = Spans::default();
    spans.note(ElementKind::Carrier, carrier_table.iter().map(Table::spans));
    spans.note(ElementKind::Point, point_tables.iter().map(Table::spans));
    spans.note(ElementKind::Spring, spring_tables.iter().map(Table::spans));
    spans.note(ElementKind::Hinged, hinged_tables.iter().map(Table::spans));
    spans.note(ElementKind::Ellipsoid, ellipsoid_tables.iter().map(|table| materials.spans(table)));
    spans.note(ElementKind::Surface, surface_tables.iter().map(|table| materials.spans(table)));
    spans.note(ElementKind::Part, part_tables.spans(&materials));
    spans.note(ElementKind::Connection, connection_tables.iter().map(Table::spans));
    spans.note(ElementKind::Rotor, rotor_tables.iter().map(Table::spans));
    spans.note(ElementKind::Wheel, wheel_tables.iter().map(Table::spans));
    spans.note(ElementKind::Cavity, cavity_tables.iter().map(CavityTable::spans));
    spans.note(ElementKind::Support, support.iter().map(|(table, _)| table.spans()));
    spans.note(ElementKind::Force, force_tables.iter().map(ForceTable::spans));
    let carrier = match &carrier_table {
        Some(table) => carrier(table).map(Some),
        None => file.get("carrier").is_none().then_some(None),
    };
    let ellipsoids = ellipsoid_tables.iter().zip(&names.ellipsoids);
    let ellipsoids = every(ellipsoids.map(|(table, name)| ellipsoid(table, name, &materials)));
    let surfaces = surface_tables.iter().zip(&names.surfaces);
    let surfaces = every(surfaces.map(|(table, name)| surface(table, name, &materials, folder)));
    let sources = Sources { materials: &materials, sections: &sections, folder };
    let read = part_tables.read(&names.flexible, sources);
    names.nodes = read.iter().flatten().map(|read| read.nodes.clone()).collect();
    let read_hinged: Vec<_> =
        hinged_tables.iter().zip(&names.hinged).map(|(table, name)| hinged(table, name)).collect();
    names.note_places(read_hinged.iter().map(|read| read.as_ref().map(|(hinged, _)| hinged)));
    let names = names;
    let connections = every(connection_tables.iter().map(|table| connection(table, &names)));
    notes.extend(materials.unused());
    let points = every(point_tables.iter().zip(&names.points).map(|(table, name)| point(table, name)));
    let networks =
        every(network_tables.iter().zip(&names.networks).map(|(table, name)| network(table, name)));
    let springs = spring_tables.iter().zip(&names.springs);
    let springs = every(springs.map(|(table, name)| spring(table, name, &names)));
    let hinged = every(read_hinged.into_iter());
    let rotors = every(rotor_tables.iter().zip(&names.rotors).map(|(table, name)| rotor(table, name)));
    let wheels = every(wheel_tables.iter().zip(&names.wheels).map(|(table, name)| wheel(table, name)));
    let cavities =
        every(cavity_tables.iter().zip(&names.cavities).map(|(table, name)| table.cavity(name, folder)));
    let support = match support {
        Some((table, kind)) => (kind.read)(&table),
        None => (!has_support).then(Support::default),
    };
    let forces = every(force_tables.iter().zip(&names.forces).map(|(table, name)| table.force(name, &names)));
    let parts = || {
        let mut ranges = Ranges::default();
        let ellipsoids = ranges.note(ElementKind::Ellipsoid, ellipsoids?);
        let surfaces = ranges.note(ElementKind::Surface, surfaces?);
        let mut springs = ranges.note(ElementKind::Spring, springs?);
        let hinged = ranges.note(ElementKind::Hinged, hinged?);
        let connections = ranges.note(ElementKind::Connection, connections?);
        let parts =
            ranges.note_several(ElementKind::Part, read?.into_iter().map(|read| (read.part, read.extremes)));
        let (carrier, mut points, support, forces) = (carrier?, points?, support?, forces?);
        for ((network, extremes), table) in networks?.into_iter().zip(&network_tables) {
            let (more_points, more_springs) = network.parts(points.len());
            if more_points.len() < FEWEST_POINTS {
                return too_few(table, more_points.len());
            }
            spans.networks.push(NetworkSpans {
                points: points.len()..points.len() + more_points.len(),
                springs: springs.len()..springs.len() + more_springs.len(),
                table: table.spans(),
            });
            for spring in springs.len()..springs.len() + more_springs.len() {
                ranges.set(ElementKind::Spring.at(spring), vec![extremes.clone()]);
            }
            points.extend(more_points);
            springs.extend(more_springs);
        }
        let assembly = Assembly {
            carrier,
            ellipsoids,
            surfaces,
            parts,
            connections,
            reduction: reduction?,
            points,
            springs,
            hinged,
            rotors: rotors?,
            wheels: wheels?,
            cavities: cavities?,
            support,
            forces,
        };
        Some(Parts { extremes: ranges.ends(&assembly), assembly, spans })
    };
    Body { parts: parts(), names }
}

fn too_few<T>(network: &Table<'_>, count: usize) -> Option<T> {
    let message = format!("{count} points fit into this ellipsoid, and {FEWEST_POINTS} are needed");
    let help = "narrow the spacing: a network stands for a body by many points";
    network.get("spacing")?.refuse(message, "too few points", Some(help.to_owned()))
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

fn report_missing_body(problems: &Problems<'_>) {
    let message = "the file has no [carrier] and no part that is elastic throughout";
    let help = "add [carrier] with mass, center_of_mass and inertia: the rigid body that carries everything else; \
                or a body that is elastic throughout: [[ellipsoid]], [[surface]], [[beam]], [[panel]], [[solid]]";
    problems.report(Diagnostic::new(0..0, message, "no body in this file").help(help));
}
