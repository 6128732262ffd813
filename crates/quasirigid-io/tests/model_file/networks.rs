//! Random networks of points and springs.

use insta::assert_snapshot;
use quasirigid::elements::{End, PointMotion, SpringLaw};
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
        assert!(inside <= 1.0 && point.motion == PointMotion::Free);
    }
    for spring in &assembly.springs {
        let (End::Point(from), End::Point(to)) = (spring.from, spring.to) else { panic!("between points") };
        let apart = |axis: usize| assembly.points[from].position[axis] - assembly.points[to].position[axis];
        let distance = (0..3).map(|axis| apart(axis).powi(2)).sum::<f64>().sqrt();
        assert!(from >= 1 && from < to && distance > 0.5 && distance < 2.3 * 0.5, "{distance}");
        assert_eq!(
            spring.law,
            SpringLaw::Axial {
                stiffness: 2000.0,
                damping: 0.0,
                anchor: None,
                prestress: quasirigid::elements::Prestress::Relaxed
            }
        );
        assert_eq!(spring.rheology, Rheology::KelvinVoigt { time: 3e-3 });
    }
}

#[test]
fn reach_and_seed_have_defaults() {
    assert_eq!(read(&rubble("")).assembly, read(&rubble("reach = 1.15\nseed = 1\n")).assembly);
    assert_ne!(read(&rubble("")).assembly, read(&rubble("seed = 2\n")).assembly);
}

/// A network scales with its lengths, so their unit does not matter.
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
    assert_snapshot!(refusal("[[network]]\n"), @r#"
    model.toml:1:1: [[network]] has no `mass`
      add a line such as: mass = 1.0
    model.toml:1:1: [[network]] has no `semi_axes`
      add a line such as: semi_axes = ["230 m", "120 m", "95 m"]
    model.toml:1:1: [[network]] has no `spacing`
      add a line such as: spacing = "20 m"
    model.toml:1:1: [[network]] has no `stiffness`
      add a line such as: stiffness = 0.08
    "#);
    assert_snapshot!(refusal(&rubble("reach = 0.4\n")), @"
    model.toml:7:9: springs of 0.4 m do not fit points that are 0.5 m apart or more
      write a reach of 1 to 10 times the spacing; 2.3 times is usual
    ");
    assert_snapshot!(refusal(&rubble("reach = \"6 m\"\n")), @"
    model.toml:7:9: springs of 6 m do not fit points that are 0.5 m apart or more
      write a reach of 1 to 10 times the spacing; 2.3 times is usual
    ");
    assert_snapshot!(refusal(&rubble("").replace("spacing = 0.5", "spacing = \"1 cm\"")), @"
    model.toml:5:11: about 2.5e6 points fit into this ellipsoid
      widen the spacing: a network has 1e5 points or fewer
    ");
    let long = "spacing = 0.04\nreach = 0.4";
    assert_snapshot!(refusal(&rubble("").replace("spacing = 0.5", long)), @"
    model.toml:5:11: about 6.6e7 springs join these points: a network has 1e7 springs or fewer
      widen the spacing or shorten the reach: 2.3 times the spacing is usual
    ");
    assert_snapshot!(refusal(&rubble("").replace("3 t", "-3 t")), @r#"
    model.toml:3:8: `mass` is -3000 kg, but must be positive
      write a number in kg, or a text with its unit such as "12 lb"
    "#);
    assert_snapshot!(refusal(&rubble("").replace("[\"120 cm\", 0.9, 0.7]", "[1.2, 0.9]")), @"
    model.toml:4:13: `semi_axes`: found an array of 2 values, expected an array of 3 numbers
      write 3 numbers in brackets, with commas between them
    ");
    assert_snapshot!(refusal(&rubble("seed = 1.5\nfriction = 0.1\n")), @r#"
    model.toml:7:8: `seed`: found a decimal number, expected an integer from 0 to 4503599627370495
      write an integer from 0 to 4503599627370495
    model.toml:8:1: unknown key "friction" in [[network]]
      the keys are name, mass, semi_axes, center, spacing, reach, stiffness, rheology, seed
    "#);
}

#[test]
fn a_network_that_falls_apart_is_refused() {
    assert_snapshot!(verdict(&rubble("").replace("spacing = 0.5", "spacing = 1.1\nreach = 1.1")), @r#"
    model.toml:7:13: a mechanism: no spring resists some motion of "rubble 1" x, "rubble 1" y, "rubble 1" z, "rubble 2" x, "rubble 2" y, "rubble 2" z, 3 more
      add a spring that resists it, or leave the point less freedom: motion = { line = [x, y, z] }
    "#);
    assert_snapshot!(verdict(&rubble("").replace("spacing = 0.5", "spacing = 5")), @"
    model.toml:5:11: 1 points fit into this ellipsoid, and 3 are needed
      narrow the spacing: a network stands for a body by many points
    ");
    assert_snapshot!(verdict(&format!("{CARRIER}{}", rubble(""))), @r#"
    model.toml:10:13: a mechanism: no spring resists some motion of "rubble 1" x, "rubble 1" y, "rubble 1" z, "rubble 2" x, "rubble 2" y, "rubble 2" z and 63 more
      add a spring that resists it, or leave the point less freedom: motion = { line = [x, y, z] }
    "#);
    assert_snapshot!(verdict(&format!("{}{}", rubble(""), rubble("seed = 2\n"))), @r#"
    model.toml:8:8: the name "rubble" is used twice; it stands first in line 2
      give each element its own name
    "#);
    let own = POINT.replace("tip", "rubble 1");
    assert_snapshot!(verdict(&format!("{own}{}", rubble(""))), @r#"
    model.toml:6:8: `name` of point "rubble 1": the name "rubble 1" is used twice
      give each element its own name
    "#);
}
