//! Figures of a record by name, for its page, for pictures of papers and for the comparison of runs.

pub mod about_spin;
pub mod campbell;
mod curve;
pub mod evolution;
pub mod fill_map;
pub mod fit;
pub mod history;
pub mod light_curve;
pub mod tornado;
pub mod verification;
pub mod yorp;

use quasirigid_io::record::RunRecord;

use crate::columns::main_history;
use crate::figure::Figure;
use crate::motion::motion_picture;
use crate::sphere::sphere_picture;

/// Name of the figure of the angular momentum on its sphere.
const SPHERE: &str = "sphere";
/// Name of the moving picture.
const MOTION: &str = "motion";

/// Every figure that a record has something to draw in.
pub fn all(record: &RunRecord) -> Vec<Figure> {
    let kind = record.body.kind;
    let mut figures = Vec::new();
    if let Some(history) = main_history(record) {
        figures.push(history::spin(history));
        figures.extend(history::first_revolutions(history));
        figures.push(history::energy(history));
        figures.push(history::nutation(record, history));
        figures.extend(history::difference(record));
    }
    figures.extend(record.campbell.iter().map(|found| campbell::campbell(kind, found)));
    if let Some(about) = &record.about_spin {
        figures.extend([
            about_spin::time_constant(kind, about),
            about_spin::frequency(kind, about),
            about_spin::dissipation(kind, about),
        ]);
    }
    if let Some(secular) = &record.evolution {
        figures.extend([
            evolution::nutation(kind, secular),
            evolution::power(kind, secular),
            evolution::map(kind, secular),
            evolution::harmonics(kind, secular),
        ]);
    }
    figures.extend(record.verification.iter().map(|found| verification::convergence(&found.orders)));
    figures.retain(Figure::has_curves);
    figures
}

/// Names of the figures of a record that [`picture`] draws.
pub fn figure_names(record: &RunRecord) -> Vec<&'static str> {
    let sphere = sphere_picture(record).map(|_| SPHERE);
    let motion = motion_picture(record).map(|_| MOTION);
    all(record).iter().map(|figure| figure.id).chain(sphere).chain(motion).collect()
}

/// A figure of a record as an SVG file of its own, for a paper or a slide; none if the record has nothing to draw in a figure of that name.
pub fn picture(record: &RunRecord, name: &str) -> Option<String> {
    match name {
        SPHERE => return sphere_picture(record),
        MOTION => return motion_picture(record),
        _ => {}
    }
    all(record).iter().find(|figure| figure.id == name)?.picture()
}
