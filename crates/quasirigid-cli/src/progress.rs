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
    samples: Vec<Sample>,
    /// Energy (J) that each dissipator took.
    budget: Vec<(String, f64)>,
    /// Internal coordinates and their rates, one list per sample, if they are kept.
    coordinates: Option<Vec<Vec<f64>>>,
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
        let bar = Bar::new(what, quiet);
        Self {
            samples: Vec::new(),
            budget: Vec::new(),
            coordinates: None,
            interrupt: interrupt.clone(),
            bar,
            duration,
        }
    }

    /// Energy (J) that each dissipator took, by name, once a propagation has ended.
    pub fn budget(&self) -> &[(String, f64)] {
        &self.budget
    }

    /// Keeps the internal coordinates and their rates too.
    pub fn keep_coordinates(&mut self) {
        self.coordinates = Some(Vec::new());
    }

    /// The samples, and the coordinates that were kept; the progress bar is cleared away.
    pub fn finish(self) -> (Vec<Sample>, Vec<Vec<f64>>) {
        self.bar.clear();
        (self.samples, self.coordinates.unwrap_or_default())
    }
}

impl Observer for Collector {
    fn sample(&mut self, sample: &Sample) {
        self.samples.push(*sample);
    }

    fn keeps_coordinates(&self) -> bool {
        self.coordinates.is_some()
    }

    fn coordinates(&mut self, q: &[f64], rate: &[f64]) {
        if let Some(kept) = &mut self.coordinates {
            kept.push([q, rate].concat());
        }
    }

    fn budget(&mut self, energies: &[(String, f64)]) {
        self.budget = energies.to_vec();
    }

    fn progress(&mut self, t: f64) -> ControlFlow<()> {
        if self.interrupt.pressed() {
            return ControlFlow::Break(());
        }
        self.bar.show(t / self.duration);
        ControlFlow::Continue(())
    }
}
