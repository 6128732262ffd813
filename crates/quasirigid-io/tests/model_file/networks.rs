//! Random networks of points and springs.

use insta::assert_snapshot;
use quasirigid::elements::{End, Law, Motion};
use quasirigid::model::Rheology;

use super::{CARRIER, POINT, read, refusal, verdict};

/// A network that floats, with these further lines, which start in line 7.
fn rubble(lines: &str) -> String {
    format!(
        "[[network]]\nname = \"rubble\"\nmass = \"3 t\"\nsemi_axes = [\"120 cm\", 0.9, 0.7]\nspacing = 0.5\n\
         stiffness = \"2 kN/m\"\n{lines}"
    )
}

#[test]
fn a_network_is_read_as_points_and_springs() {
    let lines =
        "center = [0, 2, \"10 cm\"]\nrheology = { kind = \"kelvin-voigt\", time = \"3 ms\" }\nseed = 4\n";
    let assembly = read(&format!("{}{POINT}", rubble(lines))).assembly;
    let (own, points) = assembly.points.split_first().expect("points");
    assert_eq!(
        (own.name.as_str(), points[0].name.as_str(), points[1].name.as_str()),
        ("tip", "rubble 1", "rubble 2")
    );
    let mass: f64 = points.iter().map(|point| point.mass).sum();
    assert!((mass / 3000.0 - 1.0).abs() < 1e-14 && points.len() > 5, "{mass} {}", points.len());
    for point in points {
        let axes = [1.2, 0.9, 0.7];
        let center = [0.0, 2.0, 0.1];
        let inside: f64 =
            (0..3).map(|axis| ((point.position[axis] - center[axis]) / axes[axis]).powi(2)).sum();
        assert!(inside <= 1.0 && point.motion == Motion::Free);
    }
    for spring in &assembly.springs {
        let (End::Point(from), End::Point(to)) = (spring.from, spring.to) else { panic!("between points") };
        let apart = |axis: usize| assembly.points[from].position[axis] - assembly.points[to].position[axis];
        let distance = (0..3).map(|axis| apart(axis).powi(2)).sum::<f64>().sqrt();
        assert!(from >= 1 && from < to && distance > 0.5 && distance < 2.3 * 0.5, "{distance}");
        assert_eq!(spring.law, Law::Axial { stiffness: 2000.0, damping: 0.0, anchor: None });
        assert_eq!(spring.rheology, Rheology::KelvinVoigt { time: 3e-3 });
    }
}

#[test]
fn reach_and_seed_have_defaults() {
    assert_eq!(read(&rubble("")).assembly, read(&rubble("reach = 1.15\nseed = 1\n")).assembly);
    assert_ne!(read(&rubble("")).assembly, read(&rubble("seed = 2\n")).assembly);
}

/// The same numbers, larger: a network does not know the unit of length.
#[test]
fn a_network_grows_with_its_lengths() {
    let large = rubble("")
        .replace("120 cm", "120 m")
        .replace("0.9, 0.7", "90, 70")
        .replace("spacing = 0.5", "spacing = 50");
    let (small, large) = (read(&rubble("")).assembly, read(&large).assembly);
    assert_eq!(small.springs, large.springs);
    for (small, large) in small.points.iter().zip(&large.points) {
        let off = (0..3)
            .map(|axis| (100.0 * small.position[axis] - large.position[axis]).abs())
            .fold(0.0, f64::max);
        assert!(off < 1e-12, "{off}");
    }
}

/// Least and greatest loss go to every spring.
#[test]
fn a_range_goes_to_all_springs() {
    let model = read(&rubble("rheology = { kind = \"quality-factor\", Q = 100, range = [30, 300] }\n"));
    let [least, greatest] = &**model.extremes.as_ref().expect("ranges");
    let all = |assembly: &quasirigid::elements::Assembly, factor: f64| {
        assembly.springs.iter().all(|spring| spring.rheology == Rheology::QualityFactor { factor })
    };
    assert!(all(least, 30.0) && all(greatest, 300.0) && all(&model.assembly, 100.0));
}

#[test]
fn a_network_that_cannot_be_is_refused() {
    assert_snapshot!(refusal("[[network]]\n"), @"");
    assert_snapshot!(refusal(&rubble("reach = 0.4\n")), @"");
    assert_snapshot!(refusal(&rubble("reach = \"6 m\"\n")), @"");
    assert_snapshot!(refusal(&rubble("").replace("spacing = 0.5", "spacing = \"1 cm\"")), @"");
    assert_snapshot!(refusal(&rubble("").replace("3 t", "-3 t")), @"");
    assert_snapshot!(refusal(&rubble("").replace("[\"120 cm\", 0.9, 0.7]", "[1.2, 0.9]")), @"");
    assert_snapshot!(refusal(&rubble("seed = 1.5\nfriction = 0.1\n")), @"");
}

#[test]
fn a_network_that_falls_apart_is_refused() {
    assert_snapshot!(verdict(&rubble("").replace("spacing = 0.5", "spacing = 1.1\nreach = 1.1")), @"");
    assert_snapshot!(verdict(&rubble("").replace("spacing = 0.5", "spacing = 5")), @"");
    assert_snapshot!(verdict(&format!("{CARRIER}{}", rubble(""))), @"");
    assert_snapshot!(verdict(&format!("{}{}", rubble(""), rubble("seed = 2\n"))), @"");
}
