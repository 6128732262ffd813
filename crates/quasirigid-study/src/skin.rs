//! Limit of the eddy currents whose own field is left out. (F16)

use quasirigid::dynamics::Start;
use quasirigid::model::force::ForceLaw;
use quasirigid_math::vec3::norm;

use crate::error::StudyError;
use crate::study::Study;

/// Share of a torque by which its own field may lower it.
const GREATEST_SHARE: f64 = 0.05;

/// Refuses a start so fast that the field of the eddy currents lowers their torque.
pub fn check(study: &Study, start: Start) -> Result<Start, StudyError> {
    let spin = norm(start.omega);
    for force in &study.forces {
        if let (ForceLaw::EddyCurrent { decay_time, .. }, _) = force.law.timed() {
            let share = (spin * decay_time).powi(2);
            if share > GREATEST_SHARE {
                let fastest = GREATEST_SHARE.sqrt() / decay_time;
                return Err(StudyError::SkinEffect { name: force.name.clone(), spin, share, fastest });
            }
        }
    }
    Ok(start)
}
