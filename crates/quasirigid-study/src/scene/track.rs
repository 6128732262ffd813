//! Frames of a history, evenly among its rows: what a viewer moves the body by.

use quasirigid::dynamics::Sample;
use quasirigid_io::record::{Packed, TrackRecord};

/// Most frames of a scene.
const MOST_FRAMES: usize = 2_000;

/// Most coordinates and rates in all frames together: what a picture may take of the memory.
const MOST_NUMBERS: usize = 20_000_000;

/// Frames of the main history.
pub(crate) struct Frames {
    pub system: String,
    pub samples: Vec<Sample>,
    /// Internal coordinates and their rates, frame by frame.
    pub coordinates: Vec<Vec<f64>>,
    /// Number of coordinates.
    pub count: usize,
}

impl Frames {
    /// Rows between frames of a history with so many rows, of a body with so many coordinates.
    pub fn stride(rows: usize, coordinates: usize) -> usize {
        let room = MOST_NUMBERS / (2 * coordinates).max(1);
        let frames = room.clamp(2, MOST_FRAMES);
        rows.saturating_sub(1).div_ceil(frames - 1).max(1)
    }

    /// Largest size of a coordinate.
    pub fn largest(&self, coordinate: usize) -> f64 {
        self.coordinates.iter().map(|q| q[coordinate].abs()).fold(0.0, f64::max)
    }

    /// The record, with the coordinates kept and the angles of the rotors.
    pub fn record(&self, kept: &[usize], rotors: &[usize]) -> TrackRecord {
        let vectors = |of: &dyn Fn(&Sample) -> Vec<f64>| packed(self.samples.iter().flat_map(of));
        let q = self.coordinates.iter().flat_map(|q| kept.iter().map(|j| q[*j]));
        TrackRecord {
            system: self.system.clone(),
            t: Packed(self.samples.iter().map(|sample| sample.t).collect()),
            attitude: vectors(&|sample| sample.attitude.to_vec()),
            omega: vectors(&|sample| sample.omega.to_vec()),
            momentum: vectors(&|sample| sample.angular_momentum.to_vec()),
            q: (!kept.is_empty()).then(|| packed(q)),
            rotors: (!rotors.is_empty()).then(|| self.angles(rotors)),
            dissipated: Packed(self.samples.iter().map(|sample| sample.dissipated).collect()),
        }
    }

    /// Angles of rotors, from their rates by the trapezoidal rule: of a sparse history a picture of their sense and pace.
    fn angles(&self, rotors: &[usize]) -> Packed<f32> {
        let mut angles = vec![0.0; rotors.len()];
        let mut all = Vec::with_capacity(self.samples.len() * rotors.len());
        for frame in 0..self.samples.len() {
            if frame > 0 {
                let step = self.samples[frame].t - self.samples[frame - 1].t;
                for (angle, rotor) in angles.iter_mut().zip(rotors) {
                    let rate = |frame: usize| self.coordinates[frame][self.count + rotor];
                    *angle += 0.5 * step * (rate(frame - 1) + rate(frame));
                }
            }
            all.extend(angles.iter().map(|angle| angle.rem_euclid(std::f64::consts::TAU)));
        }
        packed(all.into_iter())
    }
}

fn packed(numbers: impl Iterator<Item = f64>) -> Packed<f32> {
    Packed(numbers.map(|number| number as f32).collect())
}
