//! Progress and cancellation of long work.

use std::any::Any;
use std::ops::ControlFlow;
use std::sync::atomic::{AtomicBool, Ordering};

use quasirigid_math::watch;
use rayon::{ThreadPool, ThreadPoolBuilder};

/// Stack of a thread that works (bytes).
pub const STACK: usize = watch::STACK;

use crate::error::StudyError;

/// Observer of long work: shows the progress, and may end the work.
pub trait Watch {
    /// Receives now and then the share of a stage that is done, from 0 to 1. Work that is told to break ends with its partial result.
    fn at(&mut self, stage: &str, share: f64) -> ControlFlow<()>;

    /// Receives a sentence that cannot wait for the end of the work.
    fn remark(&mut self, _sentence: &str) {}

    /// Receives what long work will do and how long it may take, for a person who waits. It depends on the machine and its load, so it is no part
    /// of a result.
    fn plan(&mut self, _sentence: &str) {}
}

/// Does work that has no partial result, such as opening a study, checking it or finding its modes, under a watch.
///
/// The watch is asked ten times a second on this thread, the work runs on another. A factorisation of a matrix is one step of it.
///
/// ```
/// use quasirigid_study::{Study, watched};
///
/// # fn main() -> Result<(), quasirigid_study::StudyError> {
/// # let model = concat!(env!("CARGO_MANIFEST_DIR"), "/../../examples/axial-mass/model.toml");
/// let study = watched(&mut (), || Study::open(model, None))?;
/// # assert!(study.order > 0);
/// # Ok(())
/// # }
/// ```
///
/// # Errors
/// Those of the work, and [`StudyError::Interrupted`] where the watch ended it.
pub fn watched<T: Send>(
    watch: &mut dyn Watch,
    work: impl FnOnce() -> Result<T, StudyError> + Send,
) -> Result<T, StudyError> {
    let mut at = |stage: &str, share: f64| watch.at(stage, share);
    watch::watched(&mut at, work).unwrap_or(Err(StudyError::Interrupted))
}

/// Observer of work that asks a flag whether it is to end: names the stage, tells the share that is done, and sets the flag.
pub(crate) struct Flagging<'s> {
    pub watch: &'s mut dyn Watch,
    pub cancelled: &'s AtomicBool,
    pub stage: &'static str,
    pub share: &'s dyn Fn() -> f64,
}

impl Watch for Flagging<'_> {
    fn at(&mut self, _: &str, _: f64) -> ControlFlow<()> {
        let asked = self.watch.at(self.stage, (self.share)());
        self.cancelled.fetch_or(asked.is_break(), Ordering::Relaxed);
        asked
    }
}

/// Pool of threads with the stack that work needs, or the reason of the system why there is none.
pub(crate) fn pool(threads: usize) -> Result<ThreadPool, String> {
    let pool = ThreadPoolBuilder::new().num_threads(threads.max(1)).stack_size(STACK).build();
    pool.map_err(|cause| cause.to_string())
}

/// Pool of as many threads as the machine has.
pub(crate) fn whole_pool() -> Result<ThreadPool, StudyError> {
    let threads = std::thread::available_parallelism().map_or(1, Into::into);
    pool(threads).map_err(|cause| StudyError::Threads { threads, cause })
}

/// Message of a panic.
#[must_use]
pub fn panic_message(panic: &(dyn Any + Send)) -> String {
    let text = panic.downcast_ref::<&str>().map(|text| (*text).to_owned());
    text.or_else(|| panic.downcast_ref::<String>().cloned()).unwrap_or_else(|| "a panic".to_owned())
}

/// Absent observer: the work goes on to its end.
impl Watch for () {
    fn at(&mut self, _: &str, _: f64) -> ControlFlow<()> {
        ControlFlow::Continue(())
    }
}

#[cfg(test)]
mod tests {
    use std::path::Path;

    use super::*;
    use crate::Study;

    /// Panels that take seconds to assemble and factor.
    const PANEL: &str = include_str!("../../../examples/solar-panels/model.toml");

    struct Stopped(Vec<String>);

    impl Watch for Stopped {
        fn at(&mut self, stage: &str, _: f64) -> ControlFlow<()> {
            self.0.push(stage.to_owned());
            if stage == "assembling the elements" {
                ControlFlow::Break(())
            } else {
                ControlFlow::Continue(())
            }
        }
    }

    #[test]
    fn a_study_that_takes_long_to_open_is_cancelled() {
        let at = PANEL.find("cells = [").unwrap();
        let end = at + PANEL[at..].find(']').unwrap();
        let text = format!("{}cells = [90, 90{}", &PANEL[..at], &PANEL[end..]);
        let mut watch = Stopped(Vec::new());
        let opened = watched(&mut watch, || Study::read_from(Path::new("panels"), text.as_bytes(), None));
        assert!(matches!(opened, Err(StudyError::Interrupted)), "{:?}", watch.0);
        assert_eq!(watch.0.last().map(String::as_str), Some("assembling the elements"));
    }
}
