//! Shapes of the modes about a steady spin: rotation of the body and displacements, as complex vectors.

use quasirigid::modes::{SpinMode, SpinModes};
use quasirigid_io::record::ShapeRecord;
use quasirigid_io::visible::one_line;

/// Most modes of a scene.
pub(super) const MAX_MODES: usize = 12;

/// Shapes of the first modes that oscillate or grow, over the coordinates kept.
pub(super) fn shapes(modes: &SpinModes, kept: &[usize]) -> Vec<ShapeRecord> {
    let shape = |mode: &SpinMode| {
        Some(ShapeRecord {
            name: one_line(&mode.name),
            frequency: mode.frequency,
            rate: -mode.decay_rate,
            rotation: modes.rotation(mode)?,
            q: kept.iter().map(|j| mode.shape[*j]).collect(),
        })
    };
    modes.modes.iter().filter(|mode| !mode.overdamped()).take(MAX_MODES).filter_map(shape).collect()
}
