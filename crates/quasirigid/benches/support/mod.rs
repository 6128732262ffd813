//! Timing of work whose length varies with what else the machine does.

use std::hint::black_box;
use std::time::Instant;

/// Shortest time of some runs (s).
pub fn shortest<T>(repeats: usize, work: impl Fn() -> T) -> f64 {
    let times = (0..repeats).map(|_| {
        let start = Instant::now();
        black_box(work());
        start.elapsed().as_secs_f64()
    });
    times.fold(f64::INFINITY, f64::min)
}
