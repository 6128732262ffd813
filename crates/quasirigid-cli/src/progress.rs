//! Progress on a terminal: a bar for each stage that takes over a second, remarks, and Ctrl-C.
//! Bars go to standard error and only to a terminal, so that tables and JSON on standard output stay clean.

use std::io::{IsTerminal, stderr};
use std::ops::ControlFlow;
use std::time::{Duration, Instant};

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use quasirigid::OPTIMIZED;
use quasirigid_study::Watch;

use crate::interrupt::Interrupt;
use crate::message::remark;

/// Observer on a terminal: a progress bar for each stage once a second has passed, and Ctrl-C.
pub struct Terminal<'i> {
    /// None where Ctrl-C ends the program at once, since the work has no partial result.
    interrupt: Option<&'i Interrupt>,
    quiet: bool,
    bar: Option<(String, ProgressBar)>,
    start: Instant,
    /// Plan that is told once the work has taken long, where no terminal shows its progress.
    plan: Option<String>,
    /// Whether the reader knows why it takes long, or need not.
    explained: bool,
}

/// Marks of a full progress bar.
const MARKS: u64 = 1000;
/// Time before a progress bar appears.
const PATIENCE: Duration = Duration::from_secs(1);
/// Explanation of long work in a program that was built to be built soon.
const UNOPTIMIZED: &str = "This program was built without optimisation, and computes some ten times slower than one that \
                           `cargo install --path crates/quasirigid-cli --all-features` or `cargo run --release` builds";
/// Time before a plan is told where no terminal shows the progress, and long work is explained.
const SILENCE: Duration = Duration::from_secs(10);

impl<'i> Terminal<'i> {
    pub fn new(interrupt: &'i Interrupt, quiet: bool) -> Self {
        let mut terminal = Self::of_whole(quiet);
        terminal.interrupt = Some(interrupt);
        terminal
    }

    /// Observer of work that has no partial result.
    pub fn of_whole(quiet: bool) -> Self {
        Self { interrupt: None, quiet, bar: None, start: Instant::now(), plan: None, explained: OPTIMIZED }
    }

    fn bar(&self, stage: &str) -> ProgressBar {
        let bar = ProgressBar::new(MARKS);
        let hidden = self.quiet || !stderr().is_terminal();
        bar.set_draw_target(if hidden {
            ProgressDrawTarget::hidden()
        } else {
            ProgressDrawTarget::stderr_with_hz(5)
        });
        if let Ok(style) = ProgressStyle::with_template("{msg} [{bar:30}] {percent} %, {eta} left") {
            bar.set_style(style);
        }
        bar.set_message(stage.to_owned());
        bar
    }

    fn clear(&mut self) {
        if let Some((_, bar)) = self.bar.take() {
            bar.finish_and_clear();
        }
    }
}

impl Watch for Terminal<'_> {
    fn at(&mut self, stage: &str, share: f64) -> ControlFlow<()> {
        if self.start.elapsed() > SILENCE {
            if let Some(plan) = self.plan.take() {
                self.remark(&plan);
            }
            if !std::mem::replace(&mut self.explained, true) {
                self.remark(UNOPTIMIZED);
            }
        }
        if self.bar.as_ref().is_none_or(|(shown, _)| shown != stage) {
            self.clear();
            self.bar = Some((stage.to_owned(), self.bar(stage)));
        }
        if let Some((_, bar)) = &self.bar
            && bar.elapsed() > PATIENCE
        {
            bar.set_position((MARKS as f64 * share) as u64);
        }
        let pressed = self.interrupt.is_some_and(Interrupt::pressed);
        if pressed { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
    }

    fn remark(&mut self, sentence: &str) {
        if !self.quiet {
            self.clear();
            remark(sentence);
        }
    }

    fn plan(&mut self, sentence: &str) {
        if stderr().is_terminal() {
            self.remark(sentence);
        } else {
            self.plan = Some(sentence.to_owned());
        }
    }
}

impl Drop for Terminal<'_> {
    fn drop(&mut self) {
        self.clear();
    }
}
