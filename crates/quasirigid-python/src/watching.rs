//! Long work beside Python: the interpreter lock released, Ctrl-C obeyed, progress shown.
//! The work runs on a thread of the study, and the calling thread asks Python ten times a second for signals: only the thread that
//! called may handle them. What a signal or an observer raises ends the work, and is what the caller sees.

use std::ops::ControlFlow;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::sync::{Arc, Mutex, PoisonError};

use pyo3::prelude::*;
use quasirigid_study::{StudyError, Watch, watched};

use crate::failure::Failure;

/// State that the work and the calling thread share.
#[derive(Default)]
pub struct Shared {
    stopped: AtomicBool,
    stage: Mutex<String>,
    share: AtomicU64,
    remarks: Mutex<Vec<String>>,
}

impl Shared {
    /// Whether the work is to end.
    pub fn stopped(&self) -> bool {
        self.stopped.load(Ordering::Relaxed)
    }

    /// Tells the stage of the work and the share of it that is done, from 0 to 1.
    pub fn tell(&self, stage: &str, share: f64) {
        let mut told = self.stage.lock().unwrap_or_else(PoisonError::into_inner);
        if *told != stage {
            stage.clone_into(&mut told);
        }
        self.share.store(share.to_bits(), Ordering::Relaxed);
    }

    /// Remarks of the work so far.
    pub fn remarks(&self) -> Vec<String> {
        self.remarks.lock().unwrap_or_else(PoisonError::into_inner).clone()
    }
}

/// The watch of one piece of work.
impl Watch for &Shared {
    fn at(&mut self, stage: &str, share: f64) -> ControlFlow<()> {
        self.tell(stage, share);
        if self.stopped() { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
    }

    fn remark(&mut self, sentence: &str) {
        self.remarks.lock().unwrap_or_else(PoisonError::into_inner).push(sentence.to_owned());
    }
}

/// The calling thread, which asks Python for signals and shows the progress.
struct Caller<'a> {
    shared: &'a Shared,
    /// Called with the stage and the share done; the work ends where the answer is false.
    observer: Option<&'a Py<PyAny>>,
    raised: Option<PyErr>,
}

impl Watch for Caller<'_> {
    fn at(&mut self, stage: &str, share: f64) -> ControlFlow<()> {
        let asked = Python::attach(|py| {
            py.check_signals()?;
            let Some(observer) = self.observer else { return Ok(true) };
            let told = self.shared.stage.lock().unwrap_or_else(PoisonError::into_inner).clone();
            let (stage, share) = if told.is_empty() {
                (stage, share)
            } else {
                (told.as_str(), f64::from_bits(self.shared.share.load(Ordering::Relaxed)))
            };
            let answer = observer.call1(py, (stage, share.clamp(0.0, 1.0)))?;
            Ok(answer.is_none(py) || answer.is_truthy(py)?)
        });
        match asked {
            Ok(true) => return ControlFlow::Continue(()),
            Ok(false) => {}
            Err(error) => self.raised = Some(error),
        }
        self.shared.stopped.store(true, Ordering::Relaxed);
        ControlFlow::Break(())
    }
}

/// Does work without the interpreter lock. Interrupted work leaves nothing behind.
pub fn interruptible<T: Send>(
    py: Python<'_>,
    observer: Option<&Py<PyAny>>,
    work: impl FnOnce(&Arc<Shared>) -> Result<T, Failure> + Send,
) -> Result<T, Failure> {
    let shared = Arc::new(Shared::default());
    let mut caller = Caller { shared: &shared, observer, raised: None };
    // The study's watch hands on its own errors alone, so that the answer stands beside.
    let mut answer = None;
    let found = py.detach(|| {
        catch_unwind(AssertUnwindSafe(|| {
            watched(&mut caller, || {
                answer = Some(work(&shared));
                Ok(())
            })
        }))
    });
    if let Some(raised) = caller.raised {
        return Err(Failure::Raised(raised));
    }
    match found {
        Err(cause) => Err(Failure::panicked(&*cause)),
        Ok(Err(error)) => Err(error.into()),
        Ok(Ok(())) if shared.stopped() => Err(StudyError::Interrupted.into()),
        Ok(Ok(())) => answer.unwrap_or(Err(StudyError::Interrupted.into())),
    }
}
