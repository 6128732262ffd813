//! The threads of ensembles.
//! A pool belongs to the process that made it: after `fork` a child has the memory of the pool without its threads, and would wait for
//! them for ever. A child therefore makes a pool of its own, and forgets the one it inherited.

use std::mem;
use std::process;
use std::sync::{Arc, Mutex, PoisonError};

use quasirigid_study::STACK;
use rayon::{ThreadPool, ThreadPoolBuilder};

use crate::failure::Failure;

/// The pool, with the process that made it.
static POOL: Mutex<Option<(u32, Arc<ThreadPool>)>> = Mutex::new(None);

/// The pool of this process: as many threads as there are cores, or as the environment variable `RAYON_NUM_THREADS` says.
pub fn pool() -> Result<Arc<ThreadPool>, Failure> {
    let mut kept = POOL.lock().unwrap_or_else(PoisonError::into_inner);
    let process = process::id();
    if let Some((owner, pool)) = &*kept
        && *owner == process
    {
        return Ok(Arc::clone(pool));
    }
    let pool = ThreadPoolBuilder::new().stack_size(STACK).build();
    let pool = pool.map_err(|error| Failure::Input(format!("no threads for the rows: {error}")))?;
    let pool = Arc::new(pool);
    mem::forget(kept.replace((process, Arc::clone(&pool))));
    Ok(pool)
}
