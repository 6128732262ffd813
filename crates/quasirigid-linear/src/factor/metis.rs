//! Nested dissection by METIS (Karypis & Kumar 1998); the only file with a foreign function.
#![allow(unsafe_code)]

use std::ptr;
use std::sync::{Mutex, PoisonError};

use super::graph::Graph;

/// METIS traps signals and draws random numbers while it runs, both once for the whole process.
static ALONE: Mutex<()> = Mutex::new(());

/// Vertices in the order of elimination; none if METIS finds no memory.
pub(super) fn dissection(graph: &Graph) -> Option<Vec<u32>> {
    let mut size = i32::try_from(graph.size()).ok()?;
    let mut starts = graph.starts.clone();
    let mut neighbours = graph.neighbours.clone();
    let mut weights: Vec<i32> = graph.members.iter().map(|members| members.len() as i32).collect();
    let mut order = vec![0_i32; graph.size()];
    let mut places = vec![0_i32; graph.size()];
    let _alone = ALONE.lock().unwrap_or_else(PoisonError::into_inner);
    // SAFETY: `starts` has one number more than `weights`, `order` and `places`, which have one for each vertex;
    // its last number is the length of `neighbours`, all of whose entries are vertices; edges go both ways and never
    // from a vertex to itself, as `Graph::of` builds them. METIS writes to the last two and keeps no pointer.
    let status = unsafe {
        metis_sys::METIS_NodeND(
            &raw mut size,
            starts.as_mut_ptr(),
            neighbours.as_mut_ptr(),
            weights.as_mut_ptr(),
            ptr::null_mut(),
            order.as_mut_ptr(),
            places.as_mut_ptr(),
        )
    };
    (status == metis_sys::rstatus_et_METIS_OK)
        .then(|| order.into_iter().map(|vertex| vertex as u32).collect())
}
