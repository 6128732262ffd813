//! Progress and cancellation of long work that has no partial result: assembling, factoring, reducing.
//!
//! The work runs on a thread of its own and reports its stage now and then; the observer is asked on the thread that waits, ten times
//! a second, however often the work reports. Cancelled work unwinds from its next report, so that no function between has an
//! error of cancellation to hand on. Work without an observer costs a look at a variable of its thread.

use std::any::Any;
use std::cell::RefCell;
use std::io;
use std::ops::ControlFlow;
use std::panic::{self, AssertUnwindSafe};
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::sync::{Arc, Mutex, PoisonError, mpsc};
use std::thread::{self, Builder};
use std::time::Duration;

use thiserror::Error;

use crate::threads;

/// The work was told to end.
#[derive(Clone, Copy, Debug, Error, PartialEq, Eq)]
#[error("interrupted")]
pub struct Cancelled;

/// Time between two questions to the observer.
const PERIOD: Duration = Duration::from_millis(100);
/// Stack of a thread that works (bytes): as much as a main thread has.
pub const STACK: usize = 8 << 20;

/// State of a work, shared by its thread and the one that waits.
#[derive(Default)]
struct Place {
    stage: Mutex<&'static str>,
    share: AtomicU64,
    cancelled: Arc<AtomicBool>,
}

thread_local! {
    static PLACE: RefCell<Option<Arc<Place>>> = const { RefCell::new(None) };
}

/// Does work and tells `watch` its stage and the share done, from 0 to 1; the work ends early where `watch` breaks.
///
/// # Errors
/// [`Cancelled`].
///
/// # Panics
/// As the work does.
pub fn watched<T: Send>(
    watch: &mut dyn FnMut(&str, f64) -> ControlFlow<()>,
    work: impl FnOnce() -> T + Send,
) -> Result<T, Cancelled> {
    let place = Arc::new(Place::default());
    let (done, waiting) = mpsc::channel();
    let given = Arc::clone(&place);
    let limit = threads::limit();
    let watched = move || {
        PLACE.with_borrow_mut(|place| *place = Some(given));
        let found = panic::catch_unwind(AssertUnwindSafe(|| threads::within(limit, work)));
        let _ = done.send(());
        found
    };
    let found = thread::scope(|scope| -> io::Result<_> {
        let worker = Builder::new().stack_size(STACK).spawn_scoped(scope, watched)?;
        while waiting.recv_timeout(PERIOD) == Err(mpsc::RecvTimeoutError::Timeout) {
            let stage = *place.stage.lock().unwrap_or_else(PoisonError::into_inner);
            let share = f64::from_bits(place.share.load(Ordering::Relaxed));
            if watch(stage, share).is_break() {
                place.cancelled.store(true, Ordering::Relaxed);
            }
        }
        Ok(worker.join().unwrap_or_else(Err))
    });
    settled(found.unwrap_or_else(|cause| Err(Box::new(cause))))
}

/// Does work on this thread, which ends early once `cancelled` is set.
///
/// # Errors
/// [`Cancelled`].
///
/// # Panics
/// As the work does.
pub fn cancellable<T>(cancelled: &Arc<AtomicBool>, work: impl FnOnce() -> T) -> Result<T, Cancelled> {
    let place = Place { cancelled: Arc::clone(cancelled), ..Place::default() };
    let before = PLACE.with_borrow_mut(|current| current.replace(Arc::new(place)));
    let found = panic::catch_unwind(AssertUnwindSafe(work));
    PLACE.with_borrow_mut(|current| *current = before);
    settled(found)
}

/// Watch of a thread, handed to others that work for it.
pub(crate) struct Handed(Option<Arc<Place>>);

impl Handed {
    pub fn of_this_thread() -> Self {
        Self(PLACE.with_borrow(Option::clone))
    }

    /// Does work that reports to this watch.
    pub fn watches<T>(&self, work: impl FnOnce() -> T) -> T {
        struct Before(Option<Arc<Place>>);
        impl Drop for Before {
            fn drop(&mut self) {
                PLACE.with_borrow_mut(|place| *place = self.0.take());
            }
        }
        let _before = Before(PLACE.with_borrow_mut(|place| std::mem::replace(place, self.0.clone())));
        work()
    }
}

fn settled<T>(found: Result<T, Box<dyn Any + Send>>) -> Result<T, Cancelled> {
    found.or_else(|cause| if cause.is::<Cancelled>() { Err(Cancelled) } else { panic::resume_unwind(cause) })
}

/// Reports the stage of the work of this thread.
pub fn stage(name: &'static str) {
    reached(Some(name), 0.0);
}

/// Reports the share of the stage that the work of this thread has done, from 0 to 1.
pub fn progress(share: f64) {
    reached(None, share);
}

/// Ends the work of this thread here if it is cancelled: for loops that do not know their progress.
pub fn ask() {
    look(|_| {});
}

fn reached(stage: Option<&'static str>, share: f64) {
    look(|place| {
        if let Some(name) = stage {
            *place.stage.lock().unwrap_or_else(PoisonError::into_inner) = name;
        }
        place.share.store(share.to_bits(), Ordering::Relaxed);
    });
}

fn look(say: impl FnOnce(&Place)) {
    let cancelled = PLACE.with_borrow(|place| {
        place.as_ref().is_some_and(|place| {
            say(place);
            place.cancelled.load(Ordering::Relaxed)
        })
    });
    if cancelled {
        panic::resume_unwind(Box::new(Cancelled));
    }
}

#[cfg(test)]
mod tests {
    use std::time::Instant;

    use super::*;

    #[test]
    fn work_that_nobody_watches_goes_on_to_its_end() {
        stage("alone");
        progress(0.5);
        assert_eq!(watched(&mut |_, _| ControlFlow::Continue(()), || 7), Ok(7));
    }

    #[test]
    fn the_watch_sees_stages_and_shares_by_time() {
        let mut seen = Vec::new();
        let work = || {
            for step in 0..40 {
                if step == 20 {
                    stage("second");
                }
                progress(f64::from(step) / 40.0);
                thread::sleep(Duration::from_millis(20));
            }
        };
        let watch = &mut |name: &str, share: f64| {
            seen.push((name.to_owned(), share));
            ControlFlow::Continue(())
        };
        let start = Instant::now();
        watched(watch, work).unwrap();
        // one look at once, one a period, one at the end
        let most = 2 + start.elapsed().as_millis() / PERIOD.as_millis();
        assert!(seen.len() >= 3 && seen.len() as u128 <= most, "{} of {most}: {seen:?}", seen.len());
        assert!(
            seen[0].0.is_empty() && seen.iter().any(|(name, share)| name == "second" && *share > 0.4),
            "{seen:?}"
        );
    }

    #[test]
    fn cancelled_work_ends_where_it_says_so_next() {
        let work = || {
            for step in 0.. {
                progress(f64::from(step));
                thread::sleep(Duration::from_millis(1));
            }
        };
        assert_eq!(watched(&mut |_, _| ControlFlow::Break(()), work), Err(Cancelled));
    }

    #[test]
    fn cancellable_work_ends_on_its_own_thread_and_leaves_none_behind() {
        let cancelled = Arc::new(AtomicBool::new(false));
        let work = |last: u32| {
            (0..).find(|step| {
                progress(f64::from(*step));
                cancelled.store(*step == 3, Ordering::Relaxed);
                *step == last
            })
        };
        assert_eq!(cancellable(&cancelled, || work(2)), Ok(Some(2)));
        assert_eq!(cancellable(&cancelled, || work(9)), Err(Cancelled));
        progress(0.0); // the thread is free again
    }

    #[test]
    fn a_panic_of_the_work_is_one_of_the_caller() {
        let ran = panic::catch_unwind(|| {
            watched(&mut |_, _| ControlFlow::Continue(()), || panic::resume_unwind(Box::new("why")))
        });
        assert_eq!(ran.unwrap_err().downcast_ref::<&str>(), Some(&"why"));
    }
}
