//! The switch of the mutants. This file becomes a module of the copy of the crate.

use std::fs::{File, OpenOptions};
use std::io::Write;
use std::sync::Mutex;
use std::sync::atomic::{AtomicU32, Ordering::Relaxed};

/// Environment variable with the number of the mutant.
pub const VARIABLE: &str = "QUASIRIGID_MUTANT";
/// Start of a value of the variable that has no mutant; the rest is the path of a file for the numbers of those that are reached.
pub const REACH: &str = "reach:";
/// Largest number of mutants.
pub const MOST: usize = 4096;

const UNREAD: u32 = u32::MAX;
const LISTED: u32 = u32::MAX - 1;
const NONE: u32 = u32::MAX - 2;

static ACTIVE: AtomicU32 = AtomicU32::new(UNREAD);
static REACHED: [AtomicU32; MOST] = [const { AtomicU32::new(0) }; MOST];
static LIST: Mutex<Option<File>> = Mutex::new(None);

/// Whether the variable names the mutant.
#[inline(always)]
#[allow(dead_code)]
pub fn active(mutant: u32) -> bool {
    let active = ACTIVE.load(Relaxed);
    active == mutant || active >= LISTED && looked(mutant)
}

#[cold]
#[allow(clippy::unwrap_used)]
fn looked(mutant: u32) -> bool {
    if ACTIVE.load(Relaxed) == UNREAD {
        let mut list = LIST.lock().unwrap();
        let told = std::env::var(VARIABLE).unwrap_or_default();
        let active = match told.strip_prefix(REACH) {
            Some(path) => {
                *list = Some(OpenOptions::new().create(true).append(true).open(path).unwrap());
                LISTED
            }
            None => told.parse().unwrap_or(NONE),
        };
        ACTIVE.store(active, Relaxed);
    }
    if ACTIVE.load(Relaxed) == LISTED && is_new(mutant) {
        LIST.lock().unwrap().as_mut().unwrap().write_all(format!("{mutant}\n").as_bytes()).unwrap();
    }
    ACTIVE.load(Relaxed) == mutant
}

fn is_new(mutant: u32) -> bool {
    let reached = &REACHED[mutant as usize];
    reached.load(Relaxed) == 0 && reached.swap(1, Relaxed) == 0
}
