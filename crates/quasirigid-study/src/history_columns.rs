//! Columns of a spin history, with their units: samples, nutation, internal coordinates and displacements.

use quasirigid::dynamics::{Nutation, Nutations, Sample};
use quasirigid::model::{Coordinate, Marker, Principal, ReducedBody, Support};
use quasirigid_io::record::Column;
use quasirigid_math::vec3::{dot, norm};

use crate::visible::one_line;

/// The columns of a table of samples: nutation only with a body to count it by, places only of a body that can move away.
pub fn columns(support: &Support, samples: &[Sample], nutating: Option<&ReducedBody>) -> Vec<Column> {
    let column = |name: &str, unit: &str, value: &dyn Fn(&Sample) -> f64| Column {
        name: name.into(),
        unit: unit.into(),
        values: samples.iter().map(value).collect(),
    };
    let mut columns = vec![
        column("t", "s", &|s| s.t),
        column("wx", "rad/s", &|s| s.omega[0]),
        column("wy", "rad/s", &|s| s.omega[1]),
        column("wz", "rad/s", &|s| s.omega[2]),
        column("qw", "1", &|s| s.attitude[0]),
        column("qx", "1", &|s| s.attitude[1]),
        column("qy", "1", &|s| s.attitude[2]),
        column("qz", "1", &|s| s.attitude[3]),
        column("energy", "J", &|s| s.energy),
        column("momentum", "N m s", &|s| norm(s.angular_momentum)),
        column("dissipated", "J", &|s| s.dissipated),
        column("work", "J", &|s| s.work),
        column("energy_drift", "J", &|s| s.energy_drift),
        column("momentum_drift", "1", &|s| s.momentum_drift),
    ];
    if let Some(body) = nutating {
        columns.extend(nutation_columns(body, samples));
    }
    if matches!(support, Support::FixedPoint { .. }) {
        return columns;
    }
    for (axis, name) in ["x", "y", "z"].iter().enumerate() {
        columns.push(column(name, "m", &|s| s.place[axis]));
    }
    for (axis, name) in ["vx", "vy", "vz"].iter().enumerate() {
        columns.push(column(name, "m/s", &|s| s.velocity[axis]));
    }
    if matches!(support, Support::Free) {
        for (axis, name) in ["R0x", "R0y", "R0z"].iter().enumerate() {
            columns.push(column(name, "m", &|s| s.pole[axis]));
        }
    }
    columns
}

/// The principal axis next to the circled one, from 1 for the least inertia, and the least and the greatest nutation angle at each
/// sample; not a number where there is no nutation. (P8)
fn nutation_columns(body: &ReducedBody, samples: &[Sample]) -> [Column; 3] {
    let mut nutations = Nutations::new(body);
    let found: Vec<Option<Nutation>> =
        samples.iter().map(|sample| nutations.at(sample.angular_momentum)).collect();
    let axes = Principal::compute(body.J).axes;
    let circled = |nutation: &Nutation| {
        let along = |axis: &usize| dot(axes[*axis], nutation.axis).abs();
        (0..3).max_by(|a, b| along(a).total_cmp(&along(b))).map_or(f64::NAN, |axis| (axis + 1) as f64)
    };
    let column = |name: &str, unit: &str, value: &dyn Fn(&Nutation) -> f64| Column {
        name: name.into(),
        unit: unit.into(),
        values: found.iter().map(|nutation| nutation.as_ref().map_or(f64::NAN, value)).collect(),
    };
    [
        column("circled_axis", "1", &circled),
        column("nutation_min", "rad", &|nutation| nutation.least),
        column("nutation_max", "rad", &|nutation| nutation.greatest),
    ]
}

/// Columns of the first `valued` internal coordinates, then of the rates of all, from one list of both per row.
pub fn coordinate_columns(coordinates: &[Coordinate], valued: usize, rows: &[Vec<f64>]) -> Vec<Column> {
    let column = |i: usize, name: String, unit: String| Column {
        name,
        unit,
        values: rows.iter().map(|row| row[i]).collect(),
    };
    let name = |coordinate: &Coordinate| one_line(&coordinate.name.replace('"', ""));
    let values = coordinates.iter().enumerate().take(valued);
    let values = values.map(|(i, each)| column(i, name(each), each.unit.to_owned()));
    let rates = coordinates.iter().enumerate().map(|(i, each)| {
        column(coordinates.len() + i, format!("{} rate", name(each)), format!("{}/s", each.unit))
    });
    values.chain(rates).collect()
}

/// Columns of the displacements of watched places, to the first order, from one list of internal coordinates per row.
pub fn displacement_columns(markers: &[Marker], rows: &[Vec<f64>]) -> Vec<Column> {
    let column = |marker: &Marker, axis: usize| {
        let displacement =
            |row: &Vec<f64>| marker.shapes.iter().map(|(j, shape)| row[*j] * shape[axis]).sum::<f64>();
        let name = format!("{} along {}", one_line(&marker.name.replace('"', "")), ["x", "y", "z"][axis]);
        Column { name, unit: "m".to_owned(), values: rows.iter().map(displacement).collect() }
    };
    let axes = |marker| [0, 1, 2].map(|axis| column(marker, axis));
    markers.iter().flat_map(axes).collect()
}
