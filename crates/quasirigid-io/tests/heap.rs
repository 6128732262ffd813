//! Allocator that knows the largest piece of memory that a thread asked for at once, and the most that it held.
#![allow(unsafe_code)]

use std::alloc::{GlobalAlloc, Layout, System};
use std::cell::Cell;

thread_local! {
    /// Largest piece of memory that this thread asked for at once (bytes).
    static LARGEST: Cell<usize> = const { Cell::new(0) };
    /// Memory that this thread holds, and the most that it held (bytes).
    static HELD: Cell<[isize; 2]> = const { Cell::new([0; 2]) };
}

struct Watched;

// SAFETY: every call is passed on to the allocator of the system unchanged; the counter touches no memory of the caller.
unsafe impl GlobalAlloc for Watched {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        LARGEST.set(LARGEST.get().max(layout.size()));
        let [held, most] = HELD.get();
        let held = held + layout.size() as isize;
        HELD.set([held, most.max(held)]);
        // SAFETY: the caller keeps the contract of `alloc`.
        unsafe { System.alloc(layout) }
    }

    unsafe fn dealloc(&self, pointer: *mut u8, layout: Layout) {
        let [held, most] = HELD.get();
        HELD.set([held - layout.size() as isize, most]);
        // SAFETY: the caller keeps the contract of `dealloc`.
        unsafe { System.dealloc(pointer, layout) }
    }
}

#[global_allocator]
static WATCHED: Watched = Watched;

/// What work returns, and the largest piece of memory (bytes) that it asked for at once.
pub fn watched<T>(work: impl FnOnce() -> T) -> (T, usize) {
    LARGEST.set(0);
    let done = work();
    (done, LARGEST.get())
}

/// What work returns, and the most memory (bytes) that it held beyond what was held before.
pub fn most_held<T>(work: impl FnOnce() -> T) -> (T, usize) {
    let [before, _] = HELD.get();
    HELD.set([before; 2]);
    let done = work();
    (done, HELD.get()[1].abs_diff(before))
}
