//! Reduced equations about a spin as a part of a run record.

use quasirigid::submanifold::{BackbonePoint, Style};
use quasirigid_io::record::{AboutSpinRecord, Column, MasterRecord};
use quasirigid_io::visible::one_line;

use super::AboutSpin;
use crate::words::{plain, shares};

/// Number of a point of the backbone: name, unit and value.
type Entry = (&'static str, &'static str, fn(&BackbonePoint) -> f64);

const POINT: [Entry; 6] = [
    ("amplitude", "rad", |point| point.amplitude),
    ("nutation", "rad", |point| point.nutation),
    ("decay_rate", "1/s", |point| point.decay_rate),
    ("frequency", "rad/s", |point| point.frequency),
    ("power", "W", |point| point.power.iter().map(|(_, power)| power).sum()),
    ("defect", "1", |point| point.defect.largest()),
];

impl AboutSpin<'_> {
    /// Columns of the backbone: those of every body, then the share of each dissipator, with the names of these.
    #[must_use]
    pub fn columns(&self) -> (Vec<Column>, Vec<String>) {
        let points = &self.backbone.points;
        let column = |name: &str, unit: &str, value: &dyn Fn(&BackbonePoint) -> f64| Column {
            name: name.into(),
            unit: unit.into(),
            values: points.iter().map(value).collect(),
        };
        let mut columns: Vec<Column> =
            POINT.iter().map(|(name, unit, value)| column(name, unit, value)).collect();
        let mut names = Vec::new();
        for name in points.last().map(|point| shares(&point.power)).unwrap_or_default().into_keys() {
            let plain = one_line(&plain(&name));
            let share = |point: &BackbonePoint| shares(&point.power).get(&name).copied().unwrap_or(f64::NAN);
            columns.push(column(&format!("share of {plain}"), "1", &share));
            names.push(plain.to_string());
        }
        (columns, names)
    }

    /// As a part of a run record.
    #[must_use]
    pub fn record(&self) -> AboutSpinRecord {
        let (columns, dissipators) = self.columns();
        let manifold = &self.manifold;
        let master = |master: &quasirigid::submanifold::MasterMode| MasterRecord {
            name: master.name.clone(),
            decay_rate: master.decay_rate,
            frequency: master.frequency,
        };
        AboutSpinRecord {
            sentence: self.sentence(),
            holds: self.holds(),
            axis: self.name.into(),
            spin: manifold.spin.omega,
            angular_momentum: manifold.spin.angular_momentum,
            degree: manifold.degree(),
            style: match manifold.style {
                Style::NormalForm => "normal-form".into(),
                Style::Graph => "graph".into(),
            },
            masters: manifold.masters.iter().map(master).collect(),
            range: self.range.nutation,
            share: self.range.share,
            start: self.start.as_ref().map(|start| start.nutation),
            resonances: self.resonances(),
            dissipators,
            columns,
        }
    }
}
