//! Ring baffles: the drag of plates in an oscillating flow, by the mode's own velocity at the wall. Equation (U17), docs/theory/21-slosh.md.

use std::f64::consts::PI;

use super::settled::Settled;
use super::{BAFFLES, Tank, TankError, WAVE_AMPLITUDE};
use crate::error::Field;
use crate::flow::revolution::SloshMode;

/// Flat ring at the wall of a tank, across its axis.
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RingBaffle {
    /// Height along the axis of the tank, from its centre (m).
    pub height: f64,
    /// Width from the wall to the free edge (m).
    pub width: f64,
}

/// Greatest width over the radius of the wall there.
const WIDEST: f64 = 0.25;
/// Greatest amplitude of the wave over the radius of the surface.
const HIGHEST: f64 = 0.2;
/// Coefficient of drag of a plate at the Keulegan–Carpenter number 1, which falls with its root.
const DRAG: f64 = 15.0;

/// A baffle in the flow of a mode.
struct Drowned {
    /// Area for each radian around the axis (m²).
    area: f64,
    /// Width (m).
    width: f64,
    /// Amplitude of the velocity across the baffle over that of the surface at the wall.
    velocity: f64,
}

impl Tank {
    /// Damping ratio of the baffles under the liquid, in a wave of the given amplitude, and their Keulegan–Carpenter numbers. (U17)
    pub(super) fn baffled(
        &self,
        settled: &Settled,
        mode: &SloshMode,
    ) -> Result<(f64, Vec<f64>), (Field, TankError)> {
        let Some(amplitude) = self.wave_amplitude else {
            return if self.baffles.is_empty() {
                Ok((0.0, Vec::new()))
            } else {
                Err((WAVE_AMPLITUDE, TankError::NoWave))
            };
        };
        let [_, [radius, _]] = settled.wall.ends();
        if !(amplitude <= HIGHEST * radius) {
            return Err((WAVE_AMPLITUDE, TankError::HighWave { amplitude, most: HIGHEST * radius }));
        }
        let (mut ratio, mut numbers) = (0.0, Vec::new());
        for baffle in &self.baffles {
            let Some(Drowned { area, width, velocity }) = drowned(settled, mode, *baffle, amplitude)? else {
                continue;
            };
            let number = PI * amplitude * velocity / width; // over twice the width, by the image in the wall
            if number > 0.0 {
                ratio += 16.0 / (9.0 * PI) * DRAG / number.sqrt() * area * amplitude * velocity.powi(3)
                    / mode.inertia;
                numbers.push(number);
            }
        }
        Ok((ratio, numbers))
    }
}

/// A baffle in the flow of a mode; none where it is above the liquid.
fn drowned(
    settled: &Settled,
    mode: &SloshMode,
    baffle: RingBaffle,
    amplitude: f64,
) -> Result<Option<Drowned>, (Field, TankError)> {
    let RingBaffle { height, width } = baffle;
    let [low, high] = settled.heights;
    if !(height > low && height < high) {
        return Err((BAFFLES, TankError::BaffleOutside { height, low, high }));
    }
    let [[_, bottom], [_, level]] = settled.wall.ends();
    let place = settled.sense * height;
    let depth = level - place;
    if depth.abs() < amplitude {
        return Err((BAFFLES, TankError::BaffleUncovered { depth, amplitude }));
    }
    if depth < 0.0 || place <= bottom {
        return Ok(None);
    }
    let [radius, velocity] = at_wall(&mode.rise, place);
    if !(width <= WIDEST * radius) {
        return Err((BAFFLES, TankError::WideBaffle { width, most: WIDEST * radius }));
    }
    Ok(Some(Drowned { area: width * (radius - 0.5 * width), width, velocity: velocity.abs() }))
}

/// Rows of the wall through which a polynomial is laid: the velocity falls from the surface as an exponential.
const THROUGH: usize = 4;

/// Distance of the wall from the axis and velocity there, at a height within the wall, by the polynomial through the rows about it.
fn at_wall(rise: &[[f64; 3]], place: f64) -> [f64; 2] {
    let mut rows: Vec<[f64; 3]> = rise.iter().rev().copied().collect();
    rows.dedup_by(|next, kept| kept[1] - next[1] <= f64::EPSILON * kept[1].abs());
    rows.reverse();
    let count = THROUGH.min(rows.len());
    let above = rows.partition_point(|[_, z, _]| *z <= place);
    let first = above.saturating_sub(count / 2).min(rows.len() - count);
    let near = &rows[first..first + count];
    let place = place.clamp(near[0][1], near[count - 1][1]);
    near.iter().enumerate().fold([0.0; 2], |[radius, velocity], (i, [r, z, v])| {
        let others = near.iter().enumerate().filter(|(k, _)| *k != i);
        let weight: f64 = others.map(|(_, [_, other, _])| (place - other) / (z - other)).product();
        [radius + weight * r, velocity + weight * v]
    })
}
