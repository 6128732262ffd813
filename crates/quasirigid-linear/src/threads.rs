//! Threads of one large piece of work: how many it may take, and tasks shared among them.
//! Work is cut into tasks by the sizes of the problem alone, each task is done by one thread, and results are taken in the order of the
//! tasks: every number has the same bits for any number of threads.

use std::cell::Cell;
use std::env;
use std::num::NonZeroUsize;
use std::thread;

use rayon::prelude::*;
use rayon::{ThreadPool, ThreadPoolBuilder};

use crate::watch;

thread_local! {
    static LIMIT: Cell<Option<NonZeroUsize>> = const { Cell::new(None) };
}

/// Does work that takes at most so many threads, this one counted.
pub fn limited<T>(count: NonZeroUsize, work: impl FnOnce() -> T) -> T {
    within(Some(count), work)
}

/// Limit that the caller set on this thread, to be handed to threads that work for it.
pub(crate) fn limit() -> Option<NonZeroUsize> {
    LIMIT.get()
}

/// Does work under the limit of another thread.
pub(crate) fn within<T>(limit: Option<NonZeroUsize>, work: impl FnOnce() -> T) -> T {
    struct Before(Option<NonZeroUsize>);
    impl Drop for Before {
        fn drop(&mut self) {
            LIMIT.set(self.0);
        }
    }
    let _before = Before(LIMIT.replace(limit));
    work()
}

/// Threads that work on this thread may take: the limit of [`limited`]; one where the thread is one of several that share the cores; else
/// what the environment variable `RAYON_NUM_THREADS` says, or as many as there are cores.
#[must_use]
pub fn count() -> usize {
    if let Some(limit) = LIMIT.get() {
        return limit.get();
    }
    if rayon::current_thread_index().is_some() {
        return 1;
    }
    let said = env::var("RAYON_NUM_THREADS").ok().and_then(|text| text.trim().parse::<usize>().ok());
    said.filter(|count| *count > 0).unwrap_or_else(|| thread::available_parallelism().map_or(1, Into::into))
}

/// Threads that share tasks, until it is dropped.
pub struct Team {
    /// None where the caller works alone.
    pool: Option<ThreadPool>,
}

impl Team {
    /// As many threads as [`count`] allows; the caller's alone where the system grants no more.
    #[must_use]
    pub fn new() -> Self {
        match count() {
            1 => Self::alone(),
            count => {
                let pool = ThreadPoolBuilder::new().num_threads(count).stack_size(watch::STACK).build();
                Self { pool: pool.ok() }
            }
        }
    }

    /// The caller's thread.
    #[must_use]
    pub fn alone() -> Self {
        Self { pool: None }
    }

    /// Number of threads.
    #[must_use]
    pub fn size(&self) -> usize {
        self.pool.as_ref().map_or(1, ThreadPool::current_num_threads)
    }

    /// Results of tasks, in their order. The threads report to the watch of the caller, and end where it is cancelled.
    ///
    /// # Panics
    /// As a task does.
    pub fn map<T: Send, R: Send>(&self, tasks: Vec<T>, work: impl Fn(T) -> R + Sync) -> Vec<R> {
        match &self.pool {
            Some(pool) if tasks.len() > 1 => {
                let watch = watch::Handed::of_this_thread();
                pool.install(|| {
                    let shared = tasks.into_par_iter().with_max_len(1);
                    shared.map(|task| watch.watches(|| work(task))).collect()
                })
            }
            _ => tasks.into_iter().map(work).collect(),
        }
    }
}

impl Default for Team {
    fn default() -> Self {
        Self::new()
    }
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;
    use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};

    use super::*;
    use crate::watch::Cancelled;

    fn of(count: usize) -> NonZeroUsize {
        NonZeroUsize::new(count).unwrap()
    }

    #[test]
    fn results_come_in_the_order_of_the_tasks() {
        for count in [1, 2, 4] {
            let team = limited(of(count), Team::new);
            assert_eq!(team.size(), count);
            let found = team.map((0..100).collect(), |task: usize| task * task);
            assert_eq!(found, (0..100).map(|task| task * task).collect::<Vec<_>>());
        }
    }

    #[test]
    fn a_limit_ends_with_its_work_and_goes_with_watched_work() {
        let watched = || watch::watched(&mut |_, _| std::ops::ControlFlow::Continue(()), count).unwrap();
        assert_eq!(limited(of(3), || (count(), watched())), (3, 3));
        assert_eq!(limit(), None);
    }

    #[test]
    fn threads_that_share_the_cores_start_no_others() {
        let pool = ThreadPoolBuilder::new().num_threads(2).build().unwrap();
        assert_eq!(pool.install(count), 1);
        assert_eq!(pool.install(|| limited(of(2), count)), 2);
    }

    #[test]
    fn cancelled_work_ends_on_every_thread() {
        let (cancelled, done) = (Arc::new(AtomicBool::new(false)), AtomicUsize::new(0));
        let work = || {
            limited(of(2), Team::new).map((0..1000).collect(), |task: usize| {
                watch::ask();
                done.fetch_add(1, Ordering::Relaxed);
                cancelled.store(task == 0, Ordering::Relaxed);
                while !cancelled.load(Ordering::Relaxed) {
                    thread::yield_now();
                }
            })
        };
        assert_eq!(watch::cancellable(&cancelled, work), Err(Cancelled));
        assert!(done.load(Ordering::Relaxed) < 1000);
    }
}
