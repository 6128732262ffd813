use quasirigid::averaging::{Evolution, Response, RotationState};
use quasirigid_io::record::ApproachRecord;

use super::record::FAINT;

/// Relative distance within which a harmonic is near a vibration.
const NEAR_RESONANCE: f64 = 0.1;

/// The harmonic of the polhode that comes nearest to a vibration at an end of the way; none if none comes near.
///
/// The frequency of the polhode rises from the separatrix to either axis, so that a vibration that is not passed is nearest at an end.
pub fn approach(
    response: &Response,
    evolution: &Evolution,
    ends: [RotationState; 2],
) -> Option<ApproachRecord> {
    response.frequencies().next()?; // harmonics may cost much, and meet nothing in a body that does not vibrate
    let near = ends.into_iter().flat_map(|rotation_state| {
        let motion = evolution.motion(rotation_state);
        let powers: Vec<(f64, f64)> = response.harmonic_powers(&motion).collect();
        let sum: f64 = powers.iter().map(|(_, power)| power).sum();
        let ratio = motion.ratio();
        let significant = powers.into_iter().zip(1..).filter(move |((_, power), _)| *power > FAINT * sum);
        significant.flat_map(move |((harmonic, _), number)| {
            response.frequencies().map(move |(frequency, coordinate)| ApproachRecord {
                harmonic: number,
                frequency,
                coordinate: coordinate.into(),
                distance: harmonic / frequency - 1.0,
                ratio,
            })
        })
    });
    let nearest = near.min_by(|a, b| a.distance.abs().total_cmp(&b.distance.abs()))?;
    (nearest.distance.abs() < NEAR_RESONANCE).then_some(nearest)
}
