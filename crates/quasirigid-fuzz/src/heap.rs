//! Allocator that counts the memory in use, so that an execution can be judged by its peak.
#![allow(unsafe_code)]

use std::alloc::{GlobalAlloc, Layout, System};
use std::sync::atomic::{AtomicUsize, Ordering::Relaxed};

static LIVE: AtomicUsize = AtomicUsize::new(0);
static PEAK: AtomicUsize = AtomicUsize::new(0);

/// The allocator of the system with counters.
#[derive(Debug)]
pub struct Counted;

// SAFETY: every call is passed on to the allocator of the system unchanged; the counters touch no memory of the caller.
unsafe impl GlobalAlloc for Counted {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        // SAFETY: the caller keeps the contract of `alloc`.
        let pointer = unsafe { System.alloc(layout) };
        grown(pointer, 0, layout.size());
        pointer
    }

    unsafe fn alloc_zeroed(&self, layout: Layout) -> *mut u8 {
        // SAFETY: the caller keeps the contract of `alloc_zeroed`.
        let pointer = unsafe { System.alloc_zeroed(layout) };
        grown(pointer, 0, layout.size());
        pointer
    }

    unsafe fn dealloc(&self, pointer: *mut u8, layout: Layout) {
        // SAFETY: the caller keeps the contract of `dealloc`.
        unsafe { System.dealloc(pointer, layout) };
        LIVE.fetch_sub(layout.size(), Relaxed);
    }

    unsafe fn realloc(&self, pointer: *mut u8, layout: Layout, size: usize) -> *mut u8 {
        // SAFETY: the caller keeps the contract of `realloc`.
        let moved = unsafe { System.realloc(pointer, layout, size) };
        grown(moved, layout.size(), size);
        moved
    }
}

fn grown(pointer: *mut u8, before: usize, after: usize) {
    if !pointer.is_null() {
        let live =
            LIVE.fetch_add(after.wrapping_sub(before), Relaxed).wrapping_add(after.wrapping_sub(before));
        PEAK.fetch_max(live, Relaxed);
    }
}

/// Starts a new peak at the memory now in use (bytes), and returns that memory.
pub fn begin() -> usize {
    let live = LIVE.load(Relaxed);
    PEAK.store(live, Relaxed);
    live
}

/// The most memory in use since [`begin`] (bytes); zero where another allocator serves the process.
#[must_use]
pub fn peak() -> usize {
    PEAK.load(Relaxed)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[global_allocator]
    static COUNTED: Counted = Counted;

    /// Other threads may take and give back memory meanwhile, far less than the slack.
    #[test]
    fn peak_is_that_of_the_work_and_ends_with_it() {
        const SIZE: usize = 1 << 24;
        const SLACK: usize = SIZE / 2;
        let before = begin();
        let mut grown = vec![1_u8; SIZE];
        grown.extend(vec![0_u8; SIZE]);
        grown.shrink_to_fit();
        assert!(begin() + SLACK >= before + 2 * SIZE);
        drop(grown);
        assert!(peak() + SLACK >= before + 2 * SIZE);
        assert!(begin() < before + SLACK);
    }
}
