//! Angular velocities from many starts in one call: blocks of starts on every core, eight trajectories at a time on each.

use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};

use quasirigid::dynamics::Rounding;
use quasirigid_study::histories::room;
use quasirigid_study::settings::PartialRun;
use quasirigid_study::spins::Spins;
use quasirigid_study::{Study, StudyError};
use rayon::prelude::*;

use crate::ensemble::{Histories, RowWatch, on_pool};
use crate::failure::Failure;
use crate::watching::Shared;

/// Starts that one thread takes at a time: a few for each lane.
const BLOCK: usize = 64;

/// Angular velocities from each start at the output times (s).
pub fn spins(
    study: &Arc<Study>,
    starts: &[[f64; 3]],
    times: &[f64],
    asked: &PartialRun,
    rounding: Rounding,
    shared: &Arc<Shared>,
) -> Result<Histories, Failure> {
    // Rows and the array made of them stand in memory together.
    room(times.len(), 2 * starts.len(), 0)?;
    let (settings, samples) = (asked.clone(), times.len());
    let (study, own, times, starts) =
        (Arc::clone(study), Arc::clone(shared), times.to_vec(), starts.to_vec());
    let found = on_pool(shared, move || {
        let asked = study.spins(&times, &settings, rounding)?;
        let (done, count) = (AtomicUsize::new(0), starts.len());
        let blocks = starts.par_chunks(BLOCK).map(|block| {
            let mut watch = RowWatch { shared: &own, remarks: Vec::new() };
            let found = catch_unwind(AssertUnwindSafe(|| asked.from(block, &mut watch)));
            let done = done.fetch_add(block.len(), Ordering::Relaxed) + block.len();
            own.tell("rows", done as f64 / count as f64);
            match found {
                Ok(found) => found.map_err(Failure::from),
                Err(cause) => Err(Failure::panicked(&*cause)),
            }
        });
        blocks.collect::<Result<Vec<_>, Failure>>()
    })??;
    Ok(rows(found.into_iter().flatten().collect(), samples))
}

/// Paths as rows: for each start, for each time, three components; NaN behind the end.
fn rows(found: Vec<Result<Spins, StudyError>>, samples: usize) -> Histories {
    let mut paths = Histories::new(Vec::new(), Vec::new(), [found.len(), samples, 3]);
    let width = 3 * samples;
    for (i, row) in found.into_iter().enumerate() {
        match row {
            Ok(spins) => {
                let place = &mut paths.values[i * width..(i + 1) * width];
                for (place, omega) in place.chunks_mut(3).zip(&spins.omega) {
                    place.copy_from_slice(omega);
                }
                let message = spins.reason().unwrap_or(&spins.message).to_owned();
                paths.tell(spins.holds(), spins.status, message, spins.notes);
            }
            Err(error) => paths.tell(false, "error", Failure::from(error).text(), Vec::new()),
        }
    }
    paths
}
