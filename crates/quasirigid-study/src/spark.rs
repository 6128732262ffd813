//! Spark-line: a curve in a row of characters.

/// Characters of a line.
const WIDTH: usize = 40;
/// Blocks from an eighth of the height to the whole.
const BLOCKS: [char; 8] = ['▁', '▂', '▃', '▄', '▅', '▆', '▇', '█'];
/// Share of the greatest value by which a curve must change to be drawn.
const CHANGE: f64 = 0.125;

/// Curve of values that are not negative, against times that ascend: the greatest one of each of some equal intervals of time, over the
/// greatest of all. None for a curve that hardly changes.
pub fn spark(times: &[f64], values: &[f64]) -> Option<String> {
    let finite = || values.iter().copied().filter(|value| value.is_finite());
    let (least, greatest) = (finite().fold(f64::INFINITY, f64::min), finite().fold(0.0, f64::max));
    let (first, last) = (*times.first()?, *times.last()?);
    if !(greatest - least > CHANGE * greatest && last > first) {
        return None;
    }
    let column = |t: f64| ((WIDTH as f64 * (t - first) / (last - first)) as usize).min(WIDTH - 1);
    let mut tops = [f64::NAN; WIDTH];
    for (t, value) in times.iter().zip(values) {
        let top = &mut tops[column(*t)];
        *top = top.max(*value);
    }
    let mut before = tops.iter().copied().find(|top| top.is_finite())?;
    let block = |top: &f64| {
        if top.is_finite() {
            before = *top;
        }
        BLOCKS[((8.0 * before / greatest).ceil() as usize).clamp(1, 8) - 1]
    };
    Some(tops.iter().map(block).collect())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn curves_fall_from_the_full_height_to_the_ground() {
        let times: Vec<f64> = (0..=400).map(f64::from).collect();
        let falling: Vec<f64> = times.iter().map(|t| 1.0 - t / 400.0).collect();
        let line = spark(&times, &falling).unwrap();
        assert_eq!(line.chars().count(), WIDTH);
        assert_eq!((line.chars().next(), line.chars().next_back()), (Some('█'), Some('▁')));
        assert!(line.chars().zip(line.chars().skip(1)).all(|(left, right)| left >= right), "{line}");
        // a few rows: what lies between two of them is that of the earlier one
        assert_eq!(spark(&[0.0, 1.0, 10.0], &[2.0, 1.0, 0.0]).unwrap(), format!("████{}▁", "▄".repeat(35)));
    }

    #[test]
    fn what_does_not_change_is_not_drawn() {
        assert_eq!(spark(&[0.0, 1.0], &[1.0, 1.1]), None);
        assert_eq!(spark(&[0.0, 1.0], &[f64::NAN, f64::NAN]), None);
        assert_eq!(spark(&[], &[]), None);
        assert_eq!(spark(&[1.0, 1.0], &[0.0, 2.0]), None);
    }
}
