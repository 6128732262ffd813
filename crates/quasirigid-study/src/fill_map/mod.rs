//! Map of the time constants of a body over the fill of its tanks and its spin: the worst fill of each spin, and the slosh that meets the
//! nutation there. Each point is the model with that fill and that spin; the worst points and the dips are looked for between the points of
//! the map, too. Equations (U15) and (U16), docs/theory/21-slosh.md.

mod body;
mod held;
mod row;
mod table;
mod text;

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};

use quasirigid_io::record::{FillMapRecord, FillPointRecord};
use rayon::prelude::*;

use crate::error::StudyError;
use crate::study::Study;
use crate::watch::{Flagging, Watch, watched, whole_pool};
use body::FilledBody;
use row::Refined;

pub use table::csv;
pub use text::text;

/// Most fills, and most spins.
const MOST: usize = 200;
/// Least and greatest spin of a map over that of the start.
const REACH: [f64; 2] = [0.5, 2.0];

/// Tanks, fills and spins of a map.
#[derive(Clone, Debug, PartialEq)]
pub struct FillMapSettings {
    /// Names of the tanks that are filled, all alike; none for every tank of revolution.
    pub tanks: Vec<String>,
    /// First and last fill, more than 0 and less than 1.
    pub fills: [f64; 2],
    /// First and last spin (rad/s), the same for one alone; none for half to twice that of the start.
    pub spins: Option<[f64; 2]>,
    /// Number of fills, evenly spaced, and of spins, in geometric progression.
    pub counts: [usize; 2],
}

impl Default for FillMapSettings {
    fn default() -> Self {
        Self { tanks: Vec::new(), fills: [0.05, 0.95], spins: None, counts: [20, 20] }
    }
}

impl Study {
    /// Time constants of the nutation and of the slowest other motion over fill and spin, about the axis of the start, with the worst fill of
    /// each spin. Where the forces of the model are what presses a liquid, its acceleration follows the mass.
    ///
    /// # Errors
    /// [`StudyError::FillMap`] for a model without such a tank or without a spin, and for fills and spins that are none;
    /// [`StudyError::Interrupted`].
    pub fn fill_map(
        &self,
        asked: &FillMapSettings,
        watch: &mut dyn Watch,
    ) -> Result<FillMapRecord, StudyError> {
        let body = FilledBody::new(self, &asked.tanks)?;
        let (fills, spins) = axes(asked, body.spin)?;
        let cancelled: Arc<AtomicBool> = Arc::default();
        let done = AtomicUsize::new(0);
        let share = || (done.load(Ordering::Relaxed) as f64 / spins.len() as f64).min(1.0);
        let mut observer =
            Flagging { watch, cancelled: &cancelled, stage: "varying fill and spin", share: &share };
        let rows = watched(&mut observer, || {
            let of_spin = |spin: &f64| {
                let row = Refined::new(&body, *spin, &fills, &cancelled);
                done.fetch_add(1, Ordering::Relaxed);
                row
            };
            Ok(whole_pool()?.install(|| spins.par_iter().map(of_spin).collect::<Option<Vec<Refined>>>()))
        })?;
        let rows = rows.ok_or(StudyError::Interrupted)?;
        let mut record = FillMapRecord {
            name: self.model.name.clone(),
            sentence: String::new(),
            holds: false,
            tanks: body.names(),
            points: rows.iter().flat_map(|row| row.points.iter().cloned()).collect(),
            worst: rows.iter().filter_map(|row| row.worst.clone()).collect(),
            dips: rows.iter().flat_map(|row| row.dips.iter().cloned()).collect(),
        };
        let answered = |point: &FillPointRecord| point.status != FillPointRecord::REFUSED;
        let firm = |point: &FillPointRecord| point.status == FillPointRecord::ANSWERED;
        record.holds = record.points.iter().all(answered) && text::worst(&record).is_some_and(firm);
        record.sentence = text::sentence(&record);
        Ok(record)
    }
}

/// Fills and spins (rad/s) of a map.
fn axes(asked: &FillMapSettings, of_start: f64) -> Result<(Vec<f64>, Vec<f64>), StudyError> {
    let refused = |problem: String| Err(StudyError::FillMap { problem });
    let [count, spin_count] = asked.counts;
    let [first, last] = asked.fills;
    if !(first > 0.0 && first < last && last < 1.0) {
        return refused(format!(
            "fills from {first} to {last}: a tank that is partly full is filled to more than 0 and less than 1, the first less than the last"
        ));
    }
    let [slow, fast] = asked.spins.unwrap_or(REACH.map(|reach| reach * of_start));
    if !(slow > 0.0 && slow <= fast && fast.is_finite()) {
        return refused(format!(
            "spins from {slow} to {fast} rad/s: they are positive, the first not more than the last"
        ));
    }
    let spin_count = if slow == fast { 1 } else { spin_count };
    let known = |count: usize, least: usize| (least..=MOST).contains(&count);
    if !known(count, 3) || !known(spin_count, if slow == fast { 1 } else { 2 }) {
        return refused(format!(
            "{count} fills and {spin_count} spins: a map has 3 to {MOST} fills and 2 to {MOST} spins, or one spin alone"
        ));
    }
    let step = |number: usize, count: usize| number as f64 / (count - 1).max(1) as f64;
    let fills = (0..count).map(|number| first + (last - first) * step(number, count));
    let spins = (0..spin_count).map(|number| slow * (fast / slow).powf(step(number, spin_count)));
    Ok((fills.collect(), spins.collect()))
}
