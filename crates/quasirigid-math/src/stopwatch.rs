//! Stopwatch of work: what it takes on a machine that does nothing else.
//! The time of the processor leaves out that of other programs, the wall clock the work of other threads: the smaller of the two is nearest.

use std::time::{Duration, Instant};

/// Stopwatch that runs since its start.
#[derive(Clone, Copy, Debug)]
pub struct Stopwatch {
    wall: Instant,
    processor: Option<Duration>,
}

impl Stopwatch {
    /// Stopwatch that starts now.
    #[must_use]
    pub fn start() -> Self {
        Self { wall: Instant::now(), processor: processor_time() }
    }

    /// Time since the start (s), that of waiting for other programs included.
    #[must_use]
    pub fn waited(&self) -> f64 {
        self.wall.elapsed().as_secs_f64()
    }

    /// Time of the work since the start (s).
    #[must_use]
    pub fn seconds(&self) -> f64 {
        let wall = self.wall.elapsed();
        let processor = processor_time().zip(self.processor).map(|(now, start)| now.saturating_sub(start));
        processor.map_or(wall, |processor| processor.min(wall)).as_secs_f64()
    }
}

/// Time of the processor that this process has taken; none where the system does not tell.
#[cfg(any(target_vendor = "apple", target_os = "linux"))]
fn processor_time() -> Option<Duration> {
    rustix::time::clock_gettime(rustix::time::ClockId::ProcessCPUTime).try_into().ok()
}

#[cfg(not(any(target_vendor = "apple", target_os = "linux")))]
fn processor_time() -> Option<Duration> {
    None
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn work_takes_time_and_waiting_none() {
        let watch = Stopwatch::start();
        let mut sum = 0.0_f64;
        while watch.seconds() < 1e-3 {
            sum += sum.cos();
        }
        assert!(sum > 0.0 && watch.seconds() <= watch.waited());
    }
}
