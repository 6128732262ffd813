//! Columns of a spin history, with their units: samples, nutation, internal coordinates and displacements.

use quasirigid::dynamics::{Checkpoint, Nutation, Nutations, Sample};
use quasirigid::model::control::Controls;
use quasirigid::model::{Coordinate, Marker, Principal, ReducedBody, Support};
use quasirigid_io::record::Column;
use quasirigid_io::visible::one_line;
use quasirigid_math::vec3::{dot, norm};

use crate::words::plain;

/// Numbers of a sample that every table has: names, units and values.
type Entry = (&'static str, &'static str, fn(&Sample) -> f64);

const MOTION: [Entry; 14] = [
    ("t", "s", |s| s.t),
    ("wx", "rad/s", |s| s.omega[0]),
    ("wy", "rad/s", |s| s.omega[1]),
    ("wz", "rad/s", |s| s.omega[2]),
    ("qw", "1", |s| s.attitude[0]),
    ("qx", "1", |s| s.attitude[1]),
    ("qy", "1", |s| s.attitude[2]),
    ("qz", "1", |s| s.attitude[3]),
    ("energy", "J", |s| s.energy),
    ("momentum", "N m s", |s| norm(s.angular_momentum)),
    ("dissipated", "J", |s| s.dissipated),
    ("work", "J", |s| s.work),
    ("energy_drift", "J", |s| s.energy_drift),
    ("momentum_drift", "1", |s| s.momentum_drift),
];

const NUTATION: [(&str, &str); 3] = [("circled_axis", "1"), ("nutation_min", "rad"), ("nutation_max", "rad")];

/// Places of a body that can move away.
const PLACE: [Entry; 6] = [
    ("x", "m", |s| s.place[0]),
    ("y", "m", |s| s.place[1]),
    ("z", "m", |s| s.place[2]),
    ("vx", "m/s", |s| s.velocity[0]),
    ("vy", "m/s", |s| s.velocity[1]),
    ("vz", "m/s", |s| s.velocity[2]),
];

/// Places of the pole of a free body.
const POLE: [Entry; 3] =
    [("R0x", "m", |s| s.pole[0]), ("R0y", "m", |s| s.pole[1]), ("R0z", "m", |s| s.pole[2])];

/// Rows of the table of a history: nutation only with a body to count it by, places only of a body that can move away.
#[derive(Clone, Debug)]
pub struct HistoryTable<'b> {
    nutations: Option<(Nutations<'b>, [[f64; 3]; 3])>,
    after: Vec<Entry>,
    /// Names and units of what controllers command and hold.
    controls: Vec<(String, &'static str)>,
}

impl<'b> HistoryTable<'b> {
    pub fn new(support: &Support, nutating: Option<&'b ReducedBody>) -> Self {
        let after = match support {
            Support::FixedPoint { .. } => Vec::new(),
            Support::Prescribed { .. } => PLACE.to_vec(),
            Support::Free => PLACE.iter().chain(&POLE).copied().collect(),
        };
        let nutations = nutating.map(|body| (Nutations::new(body), Principal::compute(body.J).axes));
        Self { nutations, after, controls: Vec::new() }
    }

    /// The table with the columns of controllers.
    pub fn under(self, controls: &Controls) -> Self {
        Self { controls: controls.channels(), ..self }
    }

    /// Whether it has columns of controllers.
    pub fn is_controlled(&self) -> bool {
        !self.controls.is_empty()
    }

    /// The columns, without values.
    pub fn columns(&self) -> Vec<Column> {
        let nutation = if self.nutations.is_some() { &NUTATION[..] } else { &[] };
        let head =
            |(name, unit): (&str, &str)| Column { name: name.into(), unit: unit.into(), values: Vec::new() };
        let named = |(name, unit, _): &Entry| (*name, *unit);
        let all = MOTION.iter().map(named).chain(nutation.iter().copied());
        let of_controls = self.controls.iter().map(|(name, unit)| (one_line(name), *unit));
        let of_motion: Vec<Column> = all.chain(self.after.iter().map(named)).map(head).collect();
        of_motion.into_iter().chain(of_controls.map(|(name, unit)| head((&name, unit)))).collect()
    }

    /// Fills the row of a sample, which follows those before, with the numbers of the controllers.
    pub fn fill(&mut self, sample: &Sample, controls: &[f64], row: &mut Vec<f64>) {
        row.clear();
        row.extend(MOTION.iter().map(|(.., value)| value(sample)));
        if let Some((nutations, axes)) = &mut self.nutations {
            row.extend(nutation(nutations.at(sample.angular_momentum), axes));
        }
        row.extend(self.after.iter().map(|(.., value)| value(sample)));
        row.extend(controls);
    }

    /// Saves what the next rows depend on.
    pub fn save(&self, checkpoint: &mut Checkpoint) {
        self.nutations.iter().for_each(|(nutations, _)| nutations.save(checkpoint));
    }

    /// Loads what was saved.
    pub fn load(&mut self, checkpoint: &mut Checkpoint) -> Option<()> {
        self.nutations.iter_mut().try_for_each(|(nutations, _)| nutations.load(checkpoint))
    }
}

/// The principal axis next to the circled one, from 1 for the least inertia, and the least and the greatest nutation angle; not a number
/// where there is no nutation. (P8)
fn nutation(found: Option<Nutation>, axes: &[[f64; 3]; 3]) -> [f64; 3] {
    let Some(nutation) = found else { return [f64::NAN; 3] };
    let along = |axis: &usize| dot(axes[*axis], nutation.axis).abs();
    let circled =
        (0..3).max_by(|a, b| along(a).total_cmp(&along(b))).map_or(f64::NAN, |axis| (axis + 1) as f64);
    [circled, nutation.least, nutation.greatest]
}

/// Columns of internal coordinates and their rates, and of the displacements of watched places, that a table has on request.
#[derive(Clone, Copy, Debug, Default)]
pub struct Internal<'b> {
    /// Watched places whose displacements have columns: exact on appendages, of second order on parts.
    pub markers: &'b [Marker],
    /// Coordinates, and the number of those with a value; the rates of all have columns.
    pub coordinates: Option<(&'b [Coordinate], usize)>,
}

impl Internal<'_> {
    /// Whether no such columns are asked for.
    pub fn is_empty(&self) -> bool {
        self.markers.is_empty() && self.coordinates.is_none()
    }

    /// The columns, without values.
    pub fn columns(&self) -> Vec<Column> {
        let column = |name: String, unit: String| Column { name, unit, values: Vec::new() };
        let plain = |name: &str| one_line(&plain(name));
        let along = |marker: &Marker| {
            ["x", "y", "z"].map(|axis| column(format!("{} along {axis}", plain(&marker.name)), "m".into()))
        };
        let (coordinates, valued) = self.coordinates.unwrap_or_default();
        let values = coordinates[..valued].iter().map(|each| column(plain(&each.name), each.unit.to_owned()));
        let rates = coordinates
            .iter()
            .map(|each| column(format!("{} rate", plain(&each.name)), format!("{}/s", each.unit)));
        self.markers.iter().flat_map(along).chain(values).chain(rates).collect()
    }

    /// Appends the numbers of a row.
    pub fn fill(&self, q: &[f64], rate: &[f64], row: &mut Vec<f64>) {
        row.extend(self.markers.iter().flat_map(|marker| marker.displacement(q)));
        if let Some((_, valued)) = self.coordinates {
            row.extend(q[..valued].iter().chain(rate));
        }
    }
}
