//! YORP: the rates of spin and obliquity by the obliquity.

use quasirigid_io::record::Column;

use crate::columns::column;
use crate::figure::{Figure, Quantity, Series};

/// Mean torques along the spin and across it by the obliquity, as an SVG file of its own; none of a table without rows.
#[must_use]
pub fn yorp_picture(columns: &[Column]) -> Option<String> {
    figure(columns)?.picture()
}

fn figure(columns: &[Column]) -> Option<Figure> {
    let obliquity: Vec<f64> =
        column(columns, "obliquity")?.values.iter().map(|angle| angle.to_degrees()).collect();
    let curve = |name: &str, label: &str, class: &'static str| {
        Some(Series::line(label, class, obliquity.clone(), column(columns, name)?.values.clone()))
    };
    let ends = [obliquity.first(), obliquity.last()].into_iter().flatten().copied().collect::<Vec<f64>>();
    let zero = Series::line("", "s3 dashed", ends.clone(), vec![0.0; ends.len()]);
    let series = vec![
        curve("spin_torque", "along the spin", "s1")?,
        curve("obliquity_torque", "towards more obliquity", "s2")?,
        zero,
    ];
    let quantity = |name: &'static str, unit: &str| Quantity { name, unit: unit.to_owned(), log: false };
    Some(Figure {
        id: "yorp",
        title: "YORP".into(),
        caption: "Mean torque of sunlight over the rotation and the orbit.".to_owned(),
        series,
        ..Figure::new(quantity("obliquity", "deg"), quantity("torque", "N m"))
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn both_torques_are_drawn_over_degrees() {
        let column = |name: &str, values: [f64; 3]| Column {
            name: name.into(),
            unit: String::new(),
            values: values.to_vec(),
        };
        let columns = [
            column("obliquity", [0.0, 1.0, std::f64::consts::PI]),
            column("spin_torque", [1.0, -1.0, 1.0]),
            column("obliquity_torque", [0.0, 2.0, 0.0]),
        ];
        let drawn = figure(&columns).unwrap();
        let [spin, obliquity, zero] = &drawn.series[..] else { panic!() };
        assert_eq!((spin.x[2], spin.y[1], obliquity.y[1], zero.y.len()), (180.0, -1.0, 2.0, 2));
        assert!(yorp_picture(&columns).unwrap().contains("along the spin") && yorp_picture(&[]).is_none());
    }
}
