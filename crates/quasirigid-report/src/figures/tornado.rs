//! Tornado: how much an answer changes with each number of a model, the largest effect on top.

use crate::figure::{Drawn, MORE_AND_LESS, Row, tornado};
use crate::number::tidy;

/// Change (%) of an answer for one per cent more of each key, the largest first, as an SVG file of its own; none without keys.
#[must_use]
pub fn tornado_picture(answer: &str, effects: &[(&str, f64)]) -> Option<String> {
    let [more, less] = MORE_AND_LESS;
    let row = |(key, effect): &(&str, f64)| Row {
        name: (*key).to_owned(),
        drawn: Drawn::Bars(vec![(*effect, more), (-effect, less)], format!("{} %", tidy(effect.abs(), 3))),
    };
    let rows: Vec<Row> = effects.iter().map(row).collect();
    tornado(answer, &rows)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_key_has_its_bars() {
        let drawn = tornado_picture("modes.nutation.time_constant", &[("a", -2.0), ("b", 0.5)]).unwrap();
        assert!(drawn.contains("2 %") && drawn.contains("0.5 %") && drawn.contains("1 % more"));
        assert!(tornado_picture("check.T1", &[]).is_none());
    }
}
