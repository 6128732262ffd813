//! Maps over fill and spin: points against models with that fill written into them, dips against closed forms, refusals.

use quasirigid_io::record::{FillMapRecord, FillPointRecord};
use quasirigid_study::fill_map::{FillMapSettings, csv, text};

use crate::support::{carrier, close, example, modes, spinning, study};

/// A light ball of 5 cm on the axis of a body, under a thrust along `axis` that gives it an acceleration (m/s²) at half its fill.
fn on_axis(fill: f64, axis: usize) -> String {
    let mass = |fill: f64| 260.0 + fill * CAPACITY;
    let along = |value: f64| {
        let mut vector = [0.0; 3];
        vector[axis] = value;
        format!("{vector:?}")
    };
    let force = WEIGHT * mass(0.5);
    let mut inertia = [150.0; 3];
    inertia[axis] = 220.0;
    let ball = format!(
        "[[tank]]\nname = \"ball\"\nshape = \"sphere\"\nradius = \"5 cm\"\ncenter = {}\nfill = {fill:?}\ndensity = 1000\n\
         damping_ratio = 0.02\nsettled_by = {{ acceleration = {} }}\nmodes = 1\n",
        along(0.3),
        along(-force / mass(fill)),
    );
    let engine = format!(
        "[[force]]\nname = \"engine\"\nkind = \"thrust\"\non = \"carrier\"\nat = {}\nforce = {}\n",
        along(-1.0),
        along(force)
    );
    let mut spin = [0.0; 3];
    spin[axis] = resonant_spin();
    carrier(260.0, inertia) + &ball + &engine + &spinning(spin)
}

const WEIGHT: f64 = 0.5;
/// Mass of the liquid that the ball holds (kg).
const CAPACITY: f64 = 1000.0 * 4.0 / 3.0 * std::f64::consts::PI * 1.25e-4;

/// Spin at which the slosh of the ball, half full, `λR = 1.560 16` [McIver 1989], has the rate of the nutation: in inertial axes a body of
/// revolution nutates at `Ω C/A`, and a bob on its axis swings at its own frequency, whatever the spin.
fn resonant_spin() -> f64 {
    (WEIGHT * 1.56016 / 0.05).sqrt() / (220.0 / 150.0)
}

fn map(model: &str, fills: [f64; 2], spins: Option<[f64; 2]>, counts: [usize; 2]) -> FillMapRecord {
    let asked = FillMapSettings { fills, spins, counts, ..FillMapSettings::default() };
    study(model).fill_map(&asked, &mut ()).unwrap_or_else(|error| panic!("{error}"))
}

fn refusal(model: &str, asked: &FillMapSettings) -> String {
    study(model).fill_map(asked, &mut ()).expect_err("a map that is none").to_string()
}

/// A dip that is narrower than the distance of two fills is found where the closed form has it, with its slosh; half the ball, though the file
/// says 0.3: the acceleration follows the mass.
#[test]
fn a_dip_lies_where_slosh_and_nutation_meet() {
    for axis in [2, 0] {
        let spin = resonant_spin();
        let found = map(&on_axis(0.3, axis), [0.3, 0.7], Some([spin, spin]), [6, 1]);
        let [dip] = &found.dips[..] else { panic!("{:?}", found.dips) };
        close(dip.fill, 0.5, 1e-2); // the bob moves the body, by the share of its mass
        let nearest = dip.nearest.as_ref().unwrap();
        assert_eq!((nearest.tank.as_str(), nearest.mode), ("ball", 1));
        close(nearest.ratio, 1.0, 5e-3);
        let mut sides = found.points.iter().map(|point| point.decay_rate().unwrap());
        assert!(sides.all(|rate| rate < 0.8 * dip.decay_rate().unwrap()), "{found:?}");
    }
}

/// A prolate body grows fastest where its energy sink is strongest, and the worst fill is there.
#[test]
fn the_worst_fill_of_a_prolate_body_is_where_growth_is_fastest() {
    let spin = (WEIGHT * 1.56016 / 0.05).sqrt() / (60.0 / 150.0);
    let model = on_axis(0.4, 2).replace("220.0", "60.0");
    let found = map(&model, [0.3, 0.72], Some([spin, spin]), [6, 1]);
    let worst = &found.worst[0];
    let rates = || found.points.iter().filter_map(FillPointRecord::decay_rate);
    assert!(worst.decay_rate().unwrap() < 0.0 && rates().all(|rate| rate >= worst.decay_rate().unwrap()));
    assert!(found.sentence.contains("GROWS e-fold in"), "{}", found.sentence);
}

/// Each point is the model with that fill and that spin written into it.
#[test]
fn points_are_those_of_models_with_that_fill() {
    let text = example("two-tanks").replace("[0.02, 0.0, \"20 rpm\"]", "[0.0, 0.0, 2.5]");
    let found = map(&text, [0.2, 0.8], Some([1.5, 3.0]), [4, 2]);
    for point in &found.points {
        let changed = text.replace("fill = 0.4", &format!("fill = {:?}", point.fill));
        let changed = changed.replace("[0.0, 0.0, 2.5]", &format!("[0.0, 0.0, {:?}]", point.spin));
        let modes = modes(&study(&changed));
        let known = modes.spins[0].modes.iter().find(|mode| mode.nutation).unwrap();
        let nutation = point.nutation.as_ref().unwrap();
        close(nutation.frequency, known.frequency, 1e-9);
        close(nutation.decay_rate, known.decay_rate, 1e-6);
        assert_eq!(point.status, "doubtful");
        assert!(point.reason.as_deref().unwrap().starts_with("Coriolis forces"), "{point:?}");
    }
    assert!(!found.holds && found.sentence.starts_with("MAY NOT HOLD at the worst fill: Coriolis forces"));
    // spherical tanks on the equator: the liquid is far from the rate of the nutation at any fill
    assert!(found.sentence.contains("No slosh is within 10 %"), "{}", found.sentence);
}

/// A unit of the spin, a single tank of two, and the liquid that it holds.
#[test]
fn one_tank_of_two_is_filled() {
    let study = study(&example("two-tanks"));
    let asked = FillMapSettings {
        tanks: vec!["tank -x".into()],
        fills: [0.3, 0.5],
        spins: Some([2.0, 2.0]),
        counts: [3, 7],
    };
    let found = study.fill_map(&asked, &mut ()).unwrap();
    assert_eq!((found.tanks.as_slice(), found.points.len()), (&["tank -x".to_owned()][..], 3));
    let ball = 1008.0 * 4.0 / 3.0 * std::f64::consts::PI * 0.16f64.powi(3);
    found.points.iter().for_each(|point| close(point.liquid_mass, point.fill * ball, 1e-12));
}

/// Fills that the theory does not know are told, and the worst may be among them.
#[test]
fn points_without_an_answer_are_told_first() {
    let found = map(&on_axis(0.4, 2), [1e-4, 0.9999], Some([1.0, 1.0]), [5, 1]);
    let refused = found.points.iter().filter(|point| point.status == "refused").count();
    assert!(refused > 0 && !found.holds, "{found:?}");
    assert!(
        found.sentence.starts_with(&format!("MAY NOT HOLD, since {refused} of 5 points are not answered"))
    );
    let mut reasons = found
        .points
        .iter()
        .filter(|point| point.status == "refused")
        .filter_map(|point| point.reason.as_deref());
    assert!(
        reasons.any(|reason| found.sentence.contains(reason.trim_end_matches('.'))),
        "{}",
        found.sentence
    );
    assert!(text(&found).contains("MAY NOT HOLD, since"));
}

#[test]
fn tables_have_a_row_for_each_point() {
    let found = map(&example("two-tanks"), [0.3, 0.5], Some([2.0, 2.5]), [3, 2]);
    let table = String::from_utf8(csv(&found)).unwrap();
    assert_eq!(table.lines().count(), 7);
    assert!(table.starts_with(
        "spin [rad/s],fill,liquid_mass [kg],nutation.frequency [rad/s],nutation.decay_rate [1/s]"
    ));
    let row: Vec<&str> = table.lines().nth(1).unwrap().split(',').collect();
    close(row[4].parse::<f64>().unwrap(), found.points[0].decay_rate().unwrap(), 1e-15);
}

#[test]
fn maps_that_are_none_are_refused() {
    let asked = FillMapSettings::default();
    let model = example("two-tanks");
    let bare = carrier(10.0, [1.0, 2.0, 2.5]) + &spinning([0.0, 0.0, 1.0]);
    assert!(refusal(&bare, &asked).contains("no [[tank]] of revolution"));
    let resting = on_axis(0.4, 2).replace(&format!("{:?}", [0.0, 0.0, resonant_spin()]), "[0.0, 0.0, 0.0]");
    assert!(refusal(&resting, &asked).contains("the body does not turn"));
    let other = FillMapSettings { tanks: vec!["oil".into()], ..asked.clone() };
    assert!(refusal(&model, &other).contains("there is no [[tank]] \"oil\""));
    for fills in [[0.0, 0.5], [0.5, 1.0], [0.6, 0.4], [f64::NAN, 0.5]] {
        assert!(refusal(&model, &FillMapSettings { fills, ..asked.clone() }).starts_with("fills from"));
    }
    for spins in [[0.0, 1.0], [2.0, 1.0], [-1.0, 1.0], [1.0, f64::INFINITY]] {
        let asked = FillMapSettings { spins: Some(spins), ..asked.clone() };
        assert!(refusal(&model, &asked).starts_with("spins from"));
    }
    for counts in [[2, 5], [5, 1], [1000, 5]] {
        assert!(
            refusal(&model, &FillMapSettings { counts, ..asked.clone() })
                .contains("a map has 3 to 200 fills")
        );
    }
}
