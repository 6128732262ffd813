//! Network reader: `[[network]]`, random points in an ellipsoid and springs between near ones.
//! A network becomes points and springs at once, so errors of those point back to this table; the expected number of points is
//! limited before any is drawn.

use quasirigid_elements::{ElementKind, Network};
use quasirigid_math::memory;

use super::super::body::FEWEST_POINTS;
use super::super::key::{COUNT, Keys, key, quantity, vector};
use super::super::names::Part;
use super::super::reader::{Draft, Entry, Keyed, NAME, Naming, Reader};
use super::super::rheology::{Extremes, RHEOLOGY, Scale, rheology};
use super::super::spans::NetworkSpans;
use super::super::table::Table;
use crate::units::Dimension;

pub(in crate::model) const READER: Reader = Reader {
    key: "network",
    title: "[[network]]",
    meaning: "random points and springs",
    keys: Keyed::All(&NETWORK),
    kind: None,
    naming: Naming::Numbered("network"),
    names: |_| Part::Throughout,
    aliases: &[],
    nested: &[],
    is_body: true,
    read: |entry, draft| {
        let (network, range) = network(entry.table, entry.name)?;
        draft.network(entry, &network, &range)
    },
};

const NETWORK: Keys = Keys {
    known: &[
        NAME,
        key("mass", quantity("kg"), ""),
        key("semi_axes", vector("m"), "of the ellipsoid"),
        key("center", vector("m").or("0"), ""),
        key("spacing", quantity("m"), "least distance of masses"),
        key("reach", quantity("m").or("2.3 `spacing`"), "longest spring"),
        key("stiffness", quantity("N/m"), "of each spring"),
        RHEOLOGY,
        key("seed", COUNT.or("1"), ""),
    ],
};

/// Most points that a network may be expected to have.
const MOST_POINTS: f64 = 1e5;
/// Most springs that a network may be expected to have.
const MAX_SPRINGS: f64 = 1e7;
/// Memory of a spring while the file is read (bytes), as measured, with the growth of lists.
const BYTES_PER_SPRING: f64 = 400.0;
/// Reach of the springs over the least distance of points, unless the file gives the reach.
const USUAL_REACH: f64 = 2.3;
/// Longest springs over the least distance of points.
const MAX_REACH: f64 = 10.0;

/// Reads a `[[network]]` of random points and springs.
pub(in crate::model) fn network(table: &Table<'_>, name: &str) -> Option<(Network, Extremes)> {
    let mass = table.read("mass", "mass = 1.0", |value| value.positive(Dimension::MASS));
    let semi_axes: Option<[f64; 3]> =
        table.read("semi_axes", "semi_axes = [\"230 m\", \"120 m\", \"95 m\"]", |value| {
            value.array("numbers", |axis| axis.positive(Dimension::LENGTH))
        });
    let center = table.vector_or_zero("center", Dimension::LENGTH);
    let spacing = table.read("spacing", "spacing = \"20 m\"", |value| value.positive(Dimension::LENGTH));
    let reach = table.get("reach").map(|value| (value, value.positive(Dimension::LENGTH)));
    let stiffness = table.read("stiffness", "stiffness = 0.08", |value| value.positive(Dimension::STIFFNESS));
    let seed = table.read_or("seed", 1, |value| value.integer(0..=usize::MAX >> 12));
    let known = rheology(table, Scale::OF_SPRING);
    let spacing = spacing?;
    let reach = match reach {
        None => USUAL_REACH * spacing,
        Some((value, reach)) => {
            let reach = reach?;
            if !(spacing..=MAX_REACH * spacing).contains(&reach) {
                let message =
                    format!("springs of {reach} m do not fit points that are {spacing} m apart or more");
                let help = format!(
                    "write a reach of 1 to {MAX_REACH} times the spacing; {USUAL_REACH} times is usual"
                );
                return value.refuse(message, "too short or too long", help);
            }
            reach
        }
    };
    let (known, mass, semi_axes, center) = (known?, mass?, semi_axes?, center?);
    let network = Network {
        name: name.to_owned(),
        mass,
        semi_axes,
        center,
        spacing,
        reach,
        stiffness: stiffness?,
        rheology: known.rheology,
        seed: seed? as u64,
    };
    if network.expected() > MOST_POINTS {
        let message = format!("about {:.1e} points fit into this ellipsoid", network.expected());
        let help = format!("widen the spacing: a network has {MOST_POINTS:e} points or fewer");
        return table.get("spacing")?.refuse(message, "too many points", help);
    }
    let springs = network.expected_springs();
    let problem = match memory::ask(BYTES_PER_SPRING * springs) {
        _ if springs > MAX_SPRINGS => Some(format!("a network has {MAX_SPRINGS:e} springs or fewer")),
        Err(cause) => Some(cause.to_string()),
        Ok(()) => None,
    };
    if let Some(problem) = problem {
        let message = format!("about {springs:.1e} springs join these points: {problem}");
        let help =
            format!("widen the spacing or shorten the reach: {USUAL_REACH} times the spacing is usual");
        return table.get("spacing")?.refuse(message, "too many springs", help);
    }
    Some((network, known.extremes))
}

impl<'a> Draft<'_, 'a> {
    /// Adds the points and springs of a network.
    fn network(&mut self, entry: &Entry<'_, 'a>, network: &Network, range: &Extremes) -> Option<()> {
        let (first_point, first_spring) = (self.assembly.points.len(), self.assembly.springs.len());
        let (points, springs) = network.parts(first_point);
        if points.len() < FEWEST_POINTS {
            return too_few(entry.table, points.len());
        }
        let springs_of = first_spring..first_spring + springs.len();
        springs_of
            .clone()
            .for_each(|spring| self.ranges.set(ElementKind::Spring.at(spring), vec![range.clone()]));
        self.networks.push(NetworkSpans {
            points: first_point..first_point + points.len(),
            springs: springs_of,
            table: entry.table.spans(),
        });
        self.assembly.points.extend(points);
        self.assembly.springs.extend(springs);
        Some(())
    }
}

fn too_few(table: &Table<'_>, count: usize) -> Option<()> {
    let message = format!("{count} points fit into this ellipsoid, and {FEWEST_POINTS} are needed");
    let help = "narrow the spacing: a network stands for a body by many points";
    table.get("spacing")?.refuse(message, "too few points", help)
}
