//! Motion of a body at rest on which nothing acts: it stays at rest.

use super::run::{Observer, Outcome, Run, Sample, Scan, Start};
use crate::math::ode::Work;
use crate::math::rotation;
use crate::math::vec3::{add, scale};
use crate::model::ReducedBody;

/// The motion of a free body without an angular velocity: every equation of (P1) has the rate zero there, wheels or not.
pub(super) fn stays_at_rest(
    body: &ReducedBody,
    initial: Start,
    times: &[f64],
    observer: &mut dyn Observer,
) -> Run {
    let still = [0.0; 3];
    let offset = rotation::to_inertial(initial.attitude, body.pole.vector(still));
    let at = |t: f64| {
        let place = add(initial.place, scale(t, initial.velocity));
        Sample {
            t,
            attitude: initial.attitude,
            angular_momentum: body.angular_momentum(still),
            place,
            velocity: initial.velocity,
            pole: add(place, offset),
            ..Sample::default()
        }
    };
    let first = observer.resumes().and_then(|mut checkpoint| checkpoint.load_count()).unwrap_or_default();
    for t in times.iter().skip(usize::try_from(first).unwrap_or(usize::MAX)) {
        if observer.keeps_coordinates() {
            observer.coordinates(&body.q.value(still), &body.rate.value(still));
        }
        observer.sample(&at(*t));
    }
    let names = body.power_shares.iter().map(|(name, _)| (name.clone(), 0.0));
    observer.budget(&names.collect::<Vec<_>>());
    Run {
        outcome: Outcome::Finished,
        last: at(times.last().copied().unwrap_or_default()),
        work: Work::default(),
        scan: Scan::default(),
        left_out: 0.0,
        load_ratio: 0.0,
        ringing: None,
    }
}
