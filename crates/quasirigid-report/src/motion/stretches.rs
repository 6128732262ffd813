//! Stretches of a history that a moving picture shows, one after the other, and the frames in them.
//! Thousands of revolutions cannot be seen in a quarter of a minute: a few are shown at each of some times, all at one speed.

use std::f64::consts::TAU;

use quasirigid_io::record::{Column, HistoryRecord};

use super::attitude::{Pose, Quaternion, between};
use crate::columns::{column, norm, vectors};

/// Revolutions up to which a history is shown as a whole.
const WHOLE_REVOLUTIONS: f64 = 12.0;
/// Stretches of a longer one, revolutions of the first stretch, and those over which its path is drawn.
const STRETCHES: usize = 7;
const REVOLUTIONS: f64 = 2.5;
const DRAWN: f64 = 6.0;
/// Frames of a revolution, between which the picture moves along straight lines.
const FRAMES: f64 = 24.0;
/// Angle (rad) from row to row beyond which the rows do not tell the motion between them.
const COARSEST: f64 = 1.3;
/// Deviation of a squared norm from one that an attitude may have.
const UNIT: f64 = 1e-3;

/// A stretch of a history.
pub struct Stretch {
    /// First row, last row, and last row of the path that is drawn.
    pub rows: [usize; 3],
    /// Frames: the time and the attitude of each.
    pub frames: Vec<(f64, Quaternion)>,
}

/// The stretches, each with the same number of frames; none of a history without attitudes, of one at rest, and of one whose rows are too
/// far apart.
pub fn stretches(history: &HistoryRecord, most: usize) -> Option<Vec<Stretch>> {
    let poses = poses(&history.columns)?;
    let (first, last) = (poses.first()?.t, poses.last()?.t);
    let angles = angles(&poses);
    let whole = *angles.last()?;
    let usual = (last - first) / (poses.len() - 1) as f64;
    if !(history.is_whole() && whole > 0.0 && usual > 0.0) {
        return None;
    }
    let (count, [length, drawn]) = if whole <= WHOLE_REVOLUTIONS * TAU {
        (1, [poses.len() - 1; 2])
    } else {
        let rows =
            |revolutions: f64| angles.partition_point(|angle| *angle < revolutions * TAU * (1.0 - 1e-9));
        (STRETCHES, [REVOLUTIONS, DRAWN].map(|revolutions| rows(revolutions).clamp(1, poses.len() - 1)))
    };
    let wanted = (FRAMES * angles[length] / TAU).ceil() as usize;
    let step = Step::new(length, wanted.min((most / count).saturating_sub(1)).max(1));
    let room = poses.len() - 1 - drawn;
    let starts = (0..count).map(|i| if count > 1 { i * room / (count - 1) } else { 0 });
    starts.map(|start| stretch(&poses[start..=start + length], start, drawn, step)).collect()
}

/// Steps from frame to frame: so many rows, or parts of a row, so that frames meet rows.
#[derive(Clone, Copy)]
struct Step {
    rows: usize,
    parts: usize,
}

impl Step {
    /// The step that makes about so many of a number of rows.
    fn new(rows: usize, wanted: usize) -> Self {
        if wanted >= rows {
            Self { rows: 1, parts: wanted / rows }
        } else {
            Self { rows: rows.div_ceil(wanted), parts: 1 }
        }
    }
}

fn stretch(poses: &[Pose], start: usize, drawn: usize, step: Step) -> Option<Stretch> {
    if poses.windows(2).any(|pair| !(norm(pair[0].omega) * (pair[1].t - pair[0].t) <= COARSEST)) {
        return None;
    }
    let last = (poses.len() - 1) / step.rows * step.rows;
    let between_rows = |row: usize| {
        let (from, to) = (&poses[row], &poses[row + 1]);
        (0..step.parts).map(move |part| {
            let part = part as f64 / step.parts as f64;
            (from.t + part * (to.t - from.t), between(from, to, part))
        })
    };
    let end = [(poses[last].t, poses[last].attitude)];
    let frames = (0..last).step_by(step.rows).flat_map(between_rows).chain(end).collect();
    Some(Stretch { rows: [start, start + last, start + drawn], frames })
}

fn poses(columns: &[Column]) -> Option<Vec<Pose>> {
    let names = ["qw", "qx", "qy", "qz"].map(|name| column(columns, name));
    let [w, x, y, z] = names;
    let (t, [w, x, y, z]) = (&column(columns, "t")?.values, [w?, x?, y?, z?].map(|column| &column.values));
    let omegas = vectors(columns, ["wx", "wy", "wz"])?;
    let pose = |i: usize| Pose { t: t[i], attitude: [w[i], x[i], y[i], z[i]], omega: omegas[i] };
    let poses: Vec<Pose> = (0..omegas.len().min(t.len())).map(pose).collect();
    // of a damaged table, attitudes may be none, and times in any order
    let is_known = |pose: &Pose| {
        let size: f64 = pose.attitude.iter().map(|part| part * part).sum();
        (size - 1.0).abs() < UNIT && pose.omega.iter().chain([&pose.t]).all(|number| number.is_finite())
    };
    let ascend = poses.is_sorted_by(|before, after| before.t < after.t);
    (poses.len() > 1 && ascend && poses.iter().all(is_known)).then_some(poses)
}

/// Angles turned up to each row.
fn angles(poses: &[Pose]) -> Vec<f64> {
    let mut angle = 0.0;
    let next = |pair: &[Pose]| {
        angle += 0.5 * (norm(pair[0].omega) + norm(pair[1].omega)) * (pair[1].t - pair[0].t);
        angle
    };
    [0.0].into_iter().chain(poses.windows(2).map(next)).collect()
}
