//! Coordinates that a scene keeps: all of a few, else those that displace the body most, until the displacements fill the room of a page.

use std::collections::BTreeSet;

use quasirigid::elements::Visual;
use quasirigid::model::FlexibleBody;
use quasirigid::modes::SpinModes;
use quasirigid_io::record::{EquationsRecord, TermRecord};
use quasirigid_math::vec3::norm;

use super::merged::pieces_of;
use super::track::Frames;

/// Most vectors of displacement in a scene: a megabyte of page.
const MOST_VECTORS: usize = 60_000;
/// Most coordinates of a scene: the frames hold each.
const MOST_COORDINATES: usize = 48;

/// Coordinates kept, ascending.
pub(super) struct Kept {
    pub coordinates: Vec<usize>,
}

impl Kept {
    /// Of the elastic coordinates of a body.
    pub fn new(
        body: &FlexibleBody,
        visuals: &[Visual],
        frames: Option<&Frames>,
        modes: Option<&SpinModes>,
    ) -> Self {
        let reach = reaches(body.elastic(), visuals);
        let moved = |q: &dyn Fn(usize) -> f64| -> Vec<f64> {
            let sizes: Vec<f64> = reach.iter().enumerate().map(|(j, (reach, _))| reach * q(j)).collect();
            let most = sizes.iter().copied().fold(0.0, f64::max);
            sizes.iter().map(|size| if most > 0.0 { size / most } else { 0.0 }).collect()
        };
        let mut motions: Vec<Vec<f64>> = Vec::new();
        motions.extend(frames.map(|frames| moved(&|j| frames.largest(j))));
        let shapes = modes.into_iter().flat_map(|modes| modes.modes.iter().take(super::modes::MAX_MODES));
        motions.extend(shapes.map(|mode| moved(&|j| mode.shape[j][0].hypot(mode.shape[j][1]))));
        let weight = |j: usize| motions.iter().map(|sizes| sizes[j]).fold(0.0, f64::max);
        let mut order: Vec<usize> = (0..reach.len()).collect();
        order.sort_by(|a, b| weight(*b).total_cmp(&weight(*a)));
        let mut room = MOST_VECTORS;
        let mut coordinates = Vec::new();
        for j in order {
            if coordinates.len() < MOST_COORDINATES && reach[j].1 <= room {
                room -= reach[j].1;
                coordinates.push(j);
            }
        }
        coordinates.sort_unstable();
        Self { coordinates }
    }

    /// Place of a coordinate among those kept.
    pub fn place(&self, coordinate: usize) -> Option<usize> {
        self.coordinates.binary_search(&coordinate).ok()
    }

    /// Equations with the rows of the displacements that are kept.
    pub fn of(&self, equations: EquationsRecord) -> EquationsRecord {
        let rows = |term: TermRecord| TermRecord {
            values: self.coordinates.iter().map(|j| term.values[*j].clone()).collect(),
            ..term
        };
        let displacements = equations.displacements.into_iter().map(rows).collect();
        EquationsRecord { displacements, ..equations }
    }
}

/// Largest displacement (m) per unit of each coordinate, and the number of vectors that it takes: one for each vertex of the pieces that
/// it displaces.
fn reaches(elastic: usize, visuals: &[Visual]) -> Vec<(f64, usize)> {
    let mut found = vec![(0.0, 0); elastic];
    for piece in pieces_of(visuals) {
        let vertices: usize = piece.iter().map(|visual| visual.vertices.len()).sum();
        let mut displaced = BTreeSet::new();
        for (coordinate, vectors) in piece.iter().flat_map(|visual| &visual.shapes) {
            if let Some((reach, count)) = found.get_mut(*coordinate) {
                *reach = vectors.iter().map(|vector| norm(*vector)).fold(*reach, f64::max);
                *count += if displaced.insert(*coordinate) { vertices } else { 0 };
            }
        }
    }
    found
}
