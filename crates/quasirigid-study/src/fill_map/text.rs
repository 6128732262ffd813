//! Maps of fill and spin in words and for a terminal of 80 columns.

use std::collections::BTreeMap;

use quasirigid_io::record::{FillMapRecord, FillPointRecord};
use quasirigid_io::visible::one_line;

use crate::layout::paragraph;
use crate::steady::fate;
use crate::words::{MAY_NOT_HOLD, significant, time};

/// Difference of a slosh frequency from the rate of the nutation within which they meet, relative.
const MEETS: f64 = 0.1;
/// Dips that are listed.
const LISTED: usize = 10;

/// The worst point of all spins.
pub(super) fn worst(record: &FillMapRecord) -> Option<&FillPointRecord> {
    let rate = |point: &&FillPointRecord| point.decay_rate().unwrap_or(f64::INFINITY);
    record.worst.iter().min_by(|a, b| rate(a).total_cmp(&rate(b)))
}

/// The result in words, what may not hold and what is unstable first.
pub(super) fn sentence(record: &FillMapRecord) -> String {
    let worst = worst(record);
    let parts = [not_answered(record), worst.and_then(doubted), unstable(record)];
    let told = match worst {
        None if record.points.iter().all(|point| point.status == FillPointRecord::REFUSED) => String::new(),
        None => "No point of the map has a nutation.".to_owned(),
        Some(point) => {
            let nutation = fate(point.decay_rate().unwrap_or(0.0));
            format!("The worst fill is {}: the nutation {nutation}.{}", place(point), met(point))
        }
    };
    parts.into_iter().flatten().chain([told]).filter(|part| !part.is_empty()).collect::<Vec<_>>().join(" ")
}

/// Fill and spin of a point.
fn place(point: &FillPointRecord) -> String {
    format!("{} at {} rad/s", significant(point.fill, 3), significant(point.spin, 4))
}

/// Points without an answer, among which the worst may be, with the reason of most of them.
fn not_answered(record: &FillMapRecord) -> Option<String> {
    let refused = record.points.iter().filter(|point| point.status == FillPointRecord::REFUSED);
    let mut reasons: BTreeMap<&str, usize> = BTreeMap::new();
    let reasons_of_points = refused.filter_map(|point| point.reason.as_deref());
    reasons_of_points.for_each(|reason| *reasons.entry(reason).or_default() += 1);
    let count: usize = reasons.values().sum();
    let (reason, _) = reasons.into_iter().max_by_key(|(_, count)| *count)?;
    if count == record.points.len() {
        return Some(format!("NO ANSWER at any of the {count} points: {}.", reason.trim_end_matches('.')));
    }
    Some(format!(
        "{MAY_NOT_HOLD}, since {count} of {} points are not answered, and the worst may be among them: {}.",
        record.points.len(),
        reason.trim_end_matches('.')
    ))
}

/// Why the worst point may not hold.
fn doubted(point: &FillPointRecord) -> Option<String> {
    let reason = point.reason.as_deref().filter(|_| point.status == FillPointRecord::DOUBTFUL)?;
    Some(format!("{MAY_NOT_HOLD} at the worst fill: {reason}"))
}

/// Motions beside the nutation that grow.
fn unstable(record: &FillMapRecord) -> Option<String> {
    let growing: Vec<_> = (record.points.iter())
        .filter_map(|point| Some((point, point.slowest.as_ref().filter(|motion| motion.decay_rate < 0.0)?)))
        .collect();
    let (point, motion) = growing.iter().min_by(|a, b| a.1.decay_rate.total_cmp(&b.1.decay_rate))?;
    Some(format!(
        "UNSTABLE at {} of {} points: a motion of {} {}, the fastest, at a fill of {}.",
        growing.len(),
        record.points.len(),
        motion.name,
        fate(motion.decay_rate),
        place(point)
    ))
}

/// Slosh that meets the nutation at a point, or the nearest.
fn met(point: &FillPointRecord) -> String {
    let (Some(nearest), Some(rate)) = (&point.nearest, point.rigid_rate) else { return String::new() };
    let slosh = format!("slosh {} of {:?}", nearest.mode, nearest.tank);
    let [ratio, rate] = [(nearest.ratio, 3), (rate, 4)].map(|(value, digits)| significant(value, digits));
    if (nearest.ratio - 1.0).abs() <= MEETS {
        format!(" There {slosh} meets it, at {ratio} times its rate with the liquid held, {rate} rad/s.")
    } else {
        format!(
            " No slosh is within {} % of its rate there, {rate} rad/s with the liquid held; the nearest, {slosh}, is at {ratio} times that.",
            significant(100.0 * MEETS, 2)
        )
    }
}

/// A map for a terminal of 80 columns.
#[must_use]
pub fn text(record: &FillMapRecord) -> String {
    let head = format!("{}: {}", one_line(&record.name), record.sentence);
    let mut text = format!("{}\n", paragraph(&head, "", "  "));
    if !record.worst.is_empty() {
        text.push_str("\n  worst fill of each spin\n");
        text.push_str(&list(&record.worst, usize::MAX));
    }
    if !record.dips.is_empty() {
        text.push_str("\n  fills at which the time constant dips\n");
        text.push_str(&list(&record.dips, LISTED));
    }
    text
}

fn list(points: &[FillPointRecord], most: usize) -> String {
    let mut text = "  spin (rad/s)      fill          e-fold  nearest slosh, times the nutation\n".to_owned();
    for point in points.iter().take(most) {
        let fold = match point.nutation.as_ref().and_then(|nutation| nutation.time_constant) {
            None => "never".into(),
            Some(constant) if constant < 0.0 => format!("GROWS {}", time(-constant)),
            Some(constant) => time(constant),
        };
        let nearest = point.nearest.as_ref().map_or_else(String::new, |slosh| {
            format!("{} of {:?}, {}", slosh.mode, slosh.tank, significant(slosh.ratio, 3))
        });
        let doubt = if point.status == FillPointRecord::DOUBTFUL { " ?" } else { "" };
        let [spin, fill] =
            [(point.spin, 5), (point.fill, 4)].map(|(value, digits)| significant(value, digits));
        text.push_str(&format!("  {spin:>12}  {fill:>8}  {fold:>14}  {nearest}{doubt}\n"));
    }
    if points.len() > most {
        text.push_str(&format!("  and {} more (--json lists them)\n", points.len() - most));
    }
    text
}
