use std::io::{IsTerminal, stderr};
use std::ops::ControlFlow;
use std::time::Duration;

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use quasirigid::dynamics::{Observer, Sample};

use crate::interrupt::Interrupt;

/// A progress bar on a terminal, once a second has passed.
pub struct Bar(ProgressBar);

/// Collects samples, shows progress, and ends on Ctrl-C.
pub struct Collector {
    pub samples: Vec<Sample>,
    interrupt: Interrupt,
    bar: Bar,
    duration: f64,
}

/// Marks of a full progress bar.
const MARKS: u64 = 1000;
/// Time before a progress bar appears.
const PATIENCE: Duration = Duration::from_secs(1);

impl Bar {
    pub fn new(what: &str, quiet: bool) -> Self {
        let bar = ProgressBar::new(MARKS);
        let hidden = quiet || !stderr().is_terminal();
        bar.set_draw_target(if hidden {
            ProgressDrawTarget::hidden()
        } else {
            ProgressDrawTarget::stderr_with_hz(5)
        });
        if let Ok(style) = ProgressStyle::with_template("{msg} [{bar:30}] {percent} %, {eta} left") {
            bar.set_style(style);
        }
        bar.set_message(what.to_owned());
        Self(bar)
    }

    /// Shows the share of the work that is done.
    pub fn show(&self, share: f64) {
        if self.0.elapsed() > PATIENCE {
            self.0.set_position((MARKS as f64 * share) as u64);
        }
    }

    pub fn clear(&self) {
        self.0.finish_and_clear();
    }
}

impl Collector {
    pub fn new(interrupt: &Interrupt, what: &str, duration: f64, quiet: bool) -> Self {
        Self { samples: Vec::new(), interrupt: interrupt.clone(), bar: Bar::new(what, quiet), duration }
    }

    /// The samples, and the progress bar cleared away.
    pub fn finish(self) -> Vec<Sample> {
        self.bar.clear();
        self.samples
    }
}

impl Observer for Collector {
    fn sample(&mut self, sample: &Sample) {
        self.samples.push(*sample);
    }

    fn progress(&mut self, t: f64) -> ControlFlow<()> {
        if self.interrupt.pressed() {
            return ControlFlow::Break(());
        }
        self.bar.show(t / self.duration);
        ControlFlow::Continue(())
    }
}
