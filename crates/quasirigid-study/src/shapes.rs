//! Files of shapes with the mass of what they bound, and doubts about their size: a wrong unit shows.

use std::f64::consts::TAU;

use quasirigid::averaging::spin_barrier;
use quasirigid_io::record::ShapeFileRecord;
use quasirigid_math::vec3::norm;

use crate::study::Study;
use crate::words::{significant, time};

/// Side (m) of a body below which asteroids turn within minutes, and a period (s) that none of them has.
const SMALL: f64 = 20.0;
const LONG: f64 = 3600.0;
/// Side (m) above which asteroids do not spin beyond the barrier.
const LOOSE: f64 = 200.0;
/// Side (m) that no asteroid has.
const LARGEST: f64 = 1.2e6;

/// The files, with masses and densities, and doubts.
pub fn records(study: &Study) -> Vec<ShapeFileRecord> {
    let assembly = &study.model.assembly;
    let spin = study.initial().map_or(0.0, |start| norm(start.omega));
    let of = |file: &ShapeFileRecord| {
        let solid = assembly.surfaces.iter().find(|surface| surface.name == file.name);
        let liquid = assembly.cavities.iter().find(|cavity| cavity.name == file.name);
        let density = solid.map(|solid| solid.material.density).or(liquid.map(|liquid| liquid.density));
        let mass = density.map(|density| density * file.volume);
        let warnings =
            solid.and_then(|solid| doubt(file, solid.material.density, spin)).into_iter().collect();
        ShapeFileRecord { density, mass, warnings, ..file.clone() }
    };
    study.model.shapes.iter().map(of).collect()
}

/// Doubt about the size of a body of a density (kg/m³) that turns at a rate (rad/s).
fn doubt(file: &ShapeFileRecord, density: f64, spin: f64) -> Option<String> {
    let side = file.size.into_iter().fold(0.0, f64::max);
    let (told, period) = (significant(side, 3), time(TAU / spin));
    if side < SMALL && spin > 0.0 && TAU / spin > LONG {
        Some(format!(
            "a body of {told} m that turns once in {period}: asteroids so small turn within minutes; is the unit of the file larger, as km?"
        ))
    } else if side > LARGEST {
        Some(format!("a body of {told} m is larger than any asteroid; is the unit of the file smaller?"))
    } else if side > LOOSE && spin > spin_barrier(density) {
        Some(format!(
            "a body of {told} m that turns once in {period}, faster than gravity holds loose material at its equator; is the unit of the \
             file smaller?"
        ))
    } else {
        None
    }
}

/// Sentences on each file, doubts last.
pub fn sentences(study: &Study) -> Vec<String> {
    let told = |file: &ShapeFileRecord| {
        let ShapeFileRecord { name, file: from, vertices, triangles, unit, volume, repaired, .. } = file;
        let [x, y, z] = file.size.map(|side| significant(side, 4));
        let mut told = vec![format!("{name:?}: {x} by {y} by {z} m, {} m^3", significant(*volume, 5))];
        if let (Some(mass), Some(density)) = (file.mass, file.density) {
            told.push(format!("{} kg at {} kg/m^3", significant(mass, 5), significant(density, 5)));
        }
        told.push(format!(
            "{vertices} vertices and {triangles} triangles of {from:?}, in units of {} m",
            significant(*unit, 4)
        ));
        if !repaired.is_empty() {
            told.push(format!("repaired: {repaired}"));
        }
        told.extend(file.remarks.iter().cloned());
        let mut told = told.join("; ");
        told.push('.');
        file.warnings.iter().for_each(|warning| told.push_str(&format!(" WARNING: {warning}")));
        told
    };
    records(study).iter().map(told).collect()
}
