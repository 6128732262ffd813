//! Evolutions: powers and times that are published, ends, powers, ranges, shares, and torques over ages.

use std::f64::consts::FRAC_PI_2;
use std::time::{Duration, Instant};

use quasirigid_io::model::{BodyKind, EvolveMethod, Power, System, Target};
use quasirigid_io::record::EvolutionRecord;
use quasirigid_study::Study;
use quasirigid_study::evolution;
use quasirigid_study::settings::{PartialEvolve, PartialRun};

use crate::support::{
    MODEL, carrier, close, column, ellipsoid, evolve, evolved, example, finished, gravity, one_line, point,
    published, spinning, study, study_of, target, try_evolve, wobbling,
};

/// The ellipsoid of `data/published/ellipsoid`, with |K| = I3 * 1e-4, of a rheology.
fn asteroid(rheology: &str) -> String {
    ellipsoid("[2300, 1200, 950]", [2500.0, 0.25], "young = 1e9", rheology)
        + &wobbling("20 deg", "1e-4 rad/s", "short-axis")
}

const KELVIN_VOIGT: &str = "kind = \"kelvin-voigt\", time = 100";

#[test]
fn powers_and_times_are_the_published_ones() {
    let (I2, I3) = (3.400_613_826_285_618e19, 3.695_782_164_053_647e19);
    let study = study(&asteroid(KELVIN_VOIGT));
    let between = |from: f64, to: f64| {
        let [from, until] = [from, to].map(|ratio| Some(Target::Ratio(ratio)));
        evolved(&study, |asked| (asked.start, asked.until) = (from, until)).record
    };
    for [ratio, power] in published("ellipsoid/kelvin_voigt.csv", ["D_over_I3", "power"]) {
        let found = between(ratio, 0.999);
        close(found.power, power, 1e-9);
        let crosses = ratio <= I2 / I3;
        let start = if crosses { "long-axis" } else { "short-axis" };
        assert_eq!((&*found.mode_start, &*found.mode_end), (start, "short-axis"));
        assert_eq!(found.separatrix_time.is_some(), crosses);
    }
    for [from, to, time] in published("ellipsoid/times.csv", ["D0", "D1", "time"]) {
        close(between(from / I3, to / I3).time, time, 1e-6);
    }
}

/// By default the power is that of the reduced equations, whose small frequencies the harmonics correct.
#[test]
fn power_is_that_of_the_source_asked_for() {
    let with = |study: &Study, power| evolved(study, |asked| asked.power = power);
    let of = study(&asteroid(KELVIN_VOIGT));
    let [own, polynomial, harmonics] =
        [None, Some(Power::Polynomial), Some(Power::Harmonics)].map(|power| with(&of, power).record.power);
    assert!(own == polynomial && harmonics != polynomial);
    close(harmonics, polynomial, 1e-3);
    let other = study(&asteroid("kind = \"quality-factor\", Q = 100"));
    let none = with(&other, Some(Power::Polynomial));
    assert!(
        evolution::text("a", BodyKind::Spacecraft, &none.record).contains("Nothing is dissipated"),
        "{none:?}"
    );
    let said = none.notes.join(" ") + &none.record.message;
    assert!(said.contains("take it from the harmonics"), "{said}");
}

/// A time in between: the state after it is where the time to it ends.
#[test]
fn duration_ends_the_evolution() {
    let study = study(&asteroid(KELVIN_VOIGT));
    let half = evolved(&study, |asked| asked.duration = Some(1e14)).record;
    close(half.time, 1e14, 1e-9);
    let back = evolved(&study, |asked| asked.until = Some(Target::Ratio(half.ratio_end))).record;
    close(back.time, 1e14, 1e-6);
}

#[test]
fn uncertain_material_gives_a_range() {
    let found = evolve(&asteroid("kind = \"quality-factor\", Q = 100, range = [10, 1000]"));
    let [least, greatest] = found.time_range.unwrap();
    // constant loss: the time goes with Q + 1/Q
    close(least / found.time, 10.1 / 100.01, 1e-9);
    close(greatest / found.time, 1000.001 / 100.01, 1e-9);
}

/// A drag takes angular momentum too; a force whose torque has no average is refused by name.
#[test]
fn slow_torques_are_averaged_and_others_refused() {
    let drag = "[[force]]\nkind = \"spin-drag\"\ncoefficient = 1e3\n";
    let dragged = study(&(asteroid(KELVIN_VOIGT) + drag));
    let found = evolved(&dragged, |asked| asked.duration = Some(1e13)).record;
    let angular_momentum = column(&found.columns, "momentum");
    assert!(angular_momentum.is_sorted_by(|a, b| a > b), "{angular_momentum:?}");
    assert!(try_evolve(&dragged, |_| {}).unwrap_err().contains("need not reach any target"));
    let pushed = "[[force]]\nname = \"push\"\nkind = \"torque\"\ntorque = [0, 0, 1e3]\naxes = \"inertial\"\n";
    let refused = try_evolve(&study(&(asteroid(KELVIN_VOIGT) + pushed)), |_| {}).unwrap_err();
    assert!(refused.contains("the force \"push\" cannot be averaged over free rotations"), "{refused}");
}

/// Uniform gravity has no torque about the center of mass: the same answer without it, and no torque that needs a duration.
#[test]
fn a_free_body_evolves_in_uniform_gravity_as_without() {
    let still = study(&asteroid(KELVIN_VOIGT));
    let falling = study(&(asteroid(KELVIN_VOIGT) + &gravity([0.0, 0.0, -1.0])));
    let [still, falling] = [still, falling].map(|study| evolved(&study, |_| {}).record.time);
    assert_eq!(still, falling);
}

/// The object and the record have the same shares; a body with one dissipator has one.
#[test]
fn shares_of_dissipators_sum_to_one() {
    let study = study_of("friction-wheel");
    for power in [Power::Polynomial, Power::Harmonics] {
        let shares = evolved(&study, |asked| asked.power = Some(power)).record.dissipation;
        assert!(shares.keys().eq(["damper wheel", "spring instrument-carrier"]), "{shares:?}");
        close(shares.values().sum(), 1.0, 1e-12);
        assert!(shares["damper wheel"] > 0.99, "{shares:?}");
    }
    let one = evolve(&asteroid(KELVIN_VOIGT));
    assert!(one.dissipation.iter().eq([(&"rock".to_owned(), &1.0)]), "{:?}", one.dissipation);
    assert!(!evolution::text("asteroid", BodyKind::Spacecraft, &one).contains("dissipation shares"));
}

/// The wobble at the start and at the end is the same by every method: a long-axis and a short-axis mode. The remaining differences are
/// of the second order in the deformation, and of the polhode that stands for the level.
#[test]
fn run_and_evolve_tell_the_same_wobble() {
    for (name, tolerance) in [("boom-satellite", 5e-3), ("three-masses", 2e-3)] {
        let study = study_of(name);
        let told = evolved(&study, |asked| asked.duration = Some(600.0)).record;
        let lasting = PartialRun { duration: Some(600.0), ..PartialRun::default() };
        let run = study.run(&lasting, &mut ()).unwrap().record;
        let reduced = run.histories.iter().find(|history| history.system == "reduced").unwrap();
        let [least, greatest] = ["nutation_min", "nutation_max"].map(|name| column(&reduced.columns, name));
        let (start, end) = (told.start.unwrap(), told.end.unwrap());
        close(least[0], start.nutation_least, tolerance);
        close(greatest[0], start.nutation_greatest, tolerance);
        close(*least.last().unwrap(), end.nutation_least, tolerance);
        close(*greatest.last().unwrap(), end.nutation_greatest, tolerance);
    }
}

/// A target wobble that is lost in rounding is called too small, not a separatrix.
#[test]
fn a_wobble_lost_in_rounding_is_called_too_small() {
    let said = match try_evolve(&study_of("boom-satellite"), |asked| asked.until = target("1e-6 deg")) {
        Ok(found) => found.record.message,
        Err(refused) => refused,
    };
    assert!(said.contains("is too small to be followed") && !said.contains("separatrix"), "{said}");
}

/// The separatrix is passed at one time, however few rows are asked for.
#[test]
fn rows_do_not_move_the_separatrix() {
    let study = study_of("boom-satellite");
    let [few, many] = [2, 40].map(|samples| evolved(&study, |asked| asked.samples = Some(samples)).record);
    assert_eq!(few.separatrix_time, many.separatrix_time);
    let crossed = few.separatrix_time.unwrap() / few.time;
    assert!(0.3 < crossed && crossed < 0.32, "{crossed}");
}

/// A satellite whose mast changes the difference of its greatest moments is followed along levels of the slow energy: the ratios of a record
/// are those of its rows, and tell what the full system loses.
#[test]
fn ratios_on_levels_are_those_of_the_energy() {
    let mast = carrier(305.52, [96.998, 52.585, 54.064]).replace("[0, 0, 0]", "[0.0172, 0.0123, -0.0065]")
        + &point("tip", 3.5303, [-0.1582, 1.8961, 1.0941], [9220.4, 2.006])
        + &wobbling("20.145 deg", "3.626 rad/s", "short-axis");
    let study = study(&mast);
    let record = evolved(&study, |asked| asked.duration = Some(260.0)).record;
    assert_eq!(record.road, "levels");
    close(record.ratio_start, record.start.unwrap().energy_ratio.recip(), 1e-14);
    close(record.ratio_end, record.end.unwrap().energy_ratio.recip(), 1e-14);
    let full = finished(&study, System::Full, &[0.0, 260.0]).run.last;
    let start = full.energy + full.dissipated;
    close(start * (1.0 - record.ratio_start / record.ratio_end), full.dissipated, 5e-3);
}

/// Seconds of a thousand years.
const KYR: f64 = 31_557_600e3;

/// An ellipsoid like Apophis, with a torque fixed in the body.
fn driven(torque: f64) -> Study {
    study(
        &(ellipsoid(
            "[\"219.1 m\", \"151.2 m\", \"142.7 m\"]",
            [2000.0, 0.25],
            "shear = \"0.5 GPa\"",
            "kind = \"quality-factor\", Q = 1000",
        ) + "[initial]\nperiods = { rotation = \"263 h\", precession = \"27.38 h\", mode = \"short-axis\" }\n"
            + &format!("[[force]]\nkind = \"torque\"\ntorque = [0.0, 0.0, {torque:?}]\n")),
    )
}

/// The record, after a look at its words for people and at its last row.
fn told(study: &Study, set: impl Fn(&mut PartialEvolve), status: &str) -> EvolutionRecord {
    let start = Instant::now();
    let record = evolved(study, set).record;
    assert!(start.elapsed() < Duration::from_secs(60), "{:?}", start.elapsed());
    let message = &record.message;
    assert_eq!(record.status, status, "{message}");
    assert!(message.ends_with('.') && message.len() > 20, "{message}");
    if status != "finished" {
        let text = evolution::text("A", BodyKind::Spacecraft, &record);
        let (_, told) = text.split_once(": ").unwrap();
        assert!(one_line(told).starts_with(message), "{text}");
    }
    close(*column(&record.columns, "t").last().unwrap(), record.time, 1e-12);
    record
}

/// Value of a record; the end is located exactly, whatever the rows.
fn located(study: &Study, set: impl Fn(&mut PartialEvolve), value: fn(&EvolutionRecord) -> f64) -> f64 {
    let [few, many] = [21, 2001].map(|samples| {
        value(
            &evolved(study, |asked| {
                set(asked);
                asked.samples = Some(samples);
            })
            .record,
        )
    });
    assert!((few / many - 1.0).abs() < 1e-9 && few > 0.0, "{few} {many}");
    few
}

/// Adversary 02: it never ended, and took no Ctrl-C.
#[test]
fn drag_ends_at_rest() {
    let drag = "\n[[force]]\nkind = \"spin-drag\"\ncoefficient = 1e-4\n";
    let study = study(&(example("boom-satellite") + drag));
    let long = |asked: &mut PartialEvolve| asked.duration = Some(0.01 * KYR);
    let record = told(&study, long, "rest");
    assert!(record.message.contains("has fallen to 1e-9 of its start"), "{}", record.message);
    located(&study, long, |record| record.time);
}

/// Planetary B2: "held", an undocumented word, at the time of some row.
#[test]
fn a_torque_against_the_spin_turns_the_body_over_and_spins_it_up() {
    let (study, long) = (driven(-1e-3), |asked: &mut PartialEvolve| asked.duration = Some(1e4 * KYR));
    let sentence = told(&study, long, "finished").sentence;
    assert!(sentence.contains("turns over") && sentence.contains("passes the separatrix"), "{sentence}");
    let crossed = located(&study, long, |record| record.separatrix_time.unwrap()) / KYR;
    assert!(crossed > 200.0 && crossed < 220.0, "{crossed} kyr"); // seen between rows at 200 and 210 kyr
}

#[test]
fn a_torque_along_the_spin_ends_at_the_slowest_elastic_frequency() {
    let study = driven(1.0);
    let long = |asked: &mut PartialEvolve| asked.duration = Some(1e6 * KYR);
    let record = told(&study, long, "spun-up");
    assert!(record.message.contains("slowest elastic frequency"), "{}", record.message);
    located(&study, long, |record| record.time);
    told(&study, |asked| asked.duration = Some(1e3 * KYR), "finished");
    let to = |asked: &mut PartialEvolve| (asked.duration, asked.until) = (Some(1e3 * KYR), target("5 deg"));
    let record = told(&study, to, "finished");
    assert!(record.message.starts_with("The target was reached after"), "{}", record.message);
    located(&study, to, |record| record.time);
}

/// A steady spin evolves under a torque; without one it stays, and a body at rest has no axis.
#[test]
fn steady_spins_and_rest_are_told_apart() {
    let with = |omega: &str| study(&MODEL.replace("[0.12, 0.035, 0.02]", omega));
    let refusal = try_evolve(&with("[0.0, 0.0, 0.0]"), |_| {}).unwrap_err();
    assert!(refusal.contains("the body does not turn"), "{refusal}");
    let refusal = try_evolve(&with("[1e200, 2e200, 0]"), |_| {}).unwrap_err();
    assert!(!refusal.contains("principal axis"), "{refusal}");
    let tiny = evolved(&study(MODEL), |asked| asked.until = target("1e-6 deg"));
    let text = one_line(&evolution::text("model", BodyKind::Spacecraft, &tiny.record));
    assert!(tiny.holds() && text.contains("nutation of 1.00e-6 degrees"), "{text}");
}

/// Planetary B7: "the body spins about a principal axis".
#[test]
fn a_wobble_needs_its_axis() {
    let of = |mode: &str| {
        let rheology = "kind = \"quality-factor\", Q = 1000";
        study(
            &(ellipsoid("[200.0, 150.0, 150.0]", [2000.0, 0.25], "shear = \"0.5 GPa\"", rheology)
                + &wobbling("20 deg", "2 rev/d", mode)),
        )
    };
    let refusal = try_evolve(&of("short-axis"), |_| {}).unwrap_err();
    assert!(refusal.contains("no axis of greatest inertia for a wobble"), "{refusal}");
    assert!(refusal.contains("mode = \"long-axis\""), "{refusal}");
    let long = of("long-axis");
    assert!(evolved(&long, |asked| asked.until = target("0.9")).holds());
    let to = try_evolve(&long, |asked| asked.until = target("5 deg")).unwrap_err();
    assert!(to.contains("two greatest moments are equal"), "{to}");
    let second = crate::support::of_order(MODEL, 2);
    let loss = evolved(&second, |asked| {
        (asked.power, asked.method) = (Some(Power::Polynomial), Some(EvolveMethod::Average));
    });
    let text = one_line(&evolution::text("model", BodyKind::Spacecraft, &loss.record));
    assert!(text.contains("though the body loses energy"), "{text}");
}

/// Adversary 08: two bodies on a tether, whose inertia is 1e7 times less about the tether; the quadrature recursed for ever.
#[test]
fn slender_bodies_are_answered() {
    for (length, power) in
        [(2000.0, Some(Power::Harmonics)), (3000.0, None), (3000.0, Some(Power::Harmonics))]
    {
        let study = study(
            &(carrier(100.0, [10.0, 12.0, 15.0])
                + &point("tip", 20.0, [0.0, 0.0, length], [50.0, 5.0])
                + &spinning([0.01, 0.001, 0.01])),
        );
        let start = Instant::now();
        let found = evolved(&study, |asked| asked.power = power);
        assert!(start.elapsed() < Duration::from_secs(60), "{:?}", start.elapsed());
        if found.holds() {
            // Both sources of the power agree.
            close(found.record.time, (length / 3000.0_f64).powi(2) * 7.0562e17, 1e-3);
        } else {
            let text = evolution::text("model", BodyKind::Spacecraft, &found.record);
            assert!(text.contains("NO ANSWER"), "{length} {power:?}: {text}");
        }
    }
}

/// A boom along the axis of a body of revolution, whose wobble comes to the plane of the transverse spins.
const REVOLUTION: &str = r#"
[carrier]
mass = 10.0
center_of_mass = [0, 0, 0]
inertia = [1.0, 4.0, 4.0]
[material.metal]
density = 2700
young = "70 GPa"
poisson = 0.33
rheology = { kind = "kelvin-voigt", time = "5 ms" }
[section.rod]
shape = "circle"
radius = "10 mm"
[[beam]]
name = "boom"
nodes = { root = [0.3, 0, 0], tip = [3, 0, 0] }
lines = [["root", "tip"]]
section = "rod"
material = "metal"
elements = 2
attach = "root"
[initial]
angular_velocity = [0.2, 0.0, 1.0]
"#;

/// The load on the boom nearly cancels there, so that averages along the frozen polhode are off by several per cent; the power of the full
/// system is that of the level curves, whichever way the wobble comes to them.
#[test]
fn wobbles_beside_a_plane_of_steady_spins_are_answered_by_level_curves() {
    let study = study(REVOLUTION);
    let before = Instant::now();
    let found = evolved(&study, |_| ()).record;
    assert!(before.elapsed() < Duration::from_secs(60), "unasked");
    assert_eq!(found.road, "levels");
    assert!(found.verdict.contains("Two moments of inertia are equal"), "{}", found.verdict);
    let history = finished(&study, System::Full, &[0.0, 400.0, 800.0]);
    let lost = column(&history.columns, "dissipated");
    close(found.power, (lost[2] - lost[1]) / 400.0, 2e-3);
    for start in ["[0.19, 0.0, 1.0]", "[0.3, 0.1, 1.0]", "[1.0, 0.0, 1.0]", "[1.0, 0.0, 0.3]"] {
        let other = crate::support::study(&REVOLUTION.replace("[0.2, 0.0, 1.0]", start));
        let found = evolved(&other, |asked| asked.method = Some(EvolveMethod::Levels));
        assert_eq!(found.record.status, "finished", "{start}: {}", found.record.message);
        let widest = column(&found.record.columns, "nutation_max").to_vec();
        assert!(widest.iter().all(|angle| *angle < FRAC_PI_2), "{start}: {widest:?}");
    }
}

/// Softer than level curves follow: the full system is not begun, since the way is long, though the modes about the far axis change fast.
#[test]
fn a_long_way_beside_a_plane_of_steady_spins_is_not_begun_unasked() {
    let before = Instant::now();
    let found = evolved(&study(&REVOLUTION.replace("10 mm", "4 mm")), |_| ()).record;
    assert!(before.elapsed() < Duration::from_secs(60), "unasked");
    assert_eq!(found.status, "refused");
    assert!(found.message.contains("would take about"), "{}", found.message);
}

/// An evolution is a mean over revolutions: a duration within the first one is refused; one in which the wobble changes by no digit says so;
/// one whose revolutions no number counts is answered.
#[test]
fn durations_of_nothing_and_of_everything_are_answered_as_a_person_would() {
    let study = study_of("boom-satellite");
    let told = |duration: f64| try_evolve(&study, |asked| asked.duration = Some(duration));
    for duration in [1e-300, 1e-9, 3.0] {
        let refused = told(duration).unwrap_err();
        assert!(refused.contains("ends within the first revolution, 5.001 s"), "{refused}");
    }
    let short = evolved(&study_of("toutatis"), |asked| asked.duration = Some(1e6)).record.sentence;
    assert!(short.contains("changes by less than its last digit from"), "{short}");
    let long = told(3.15576e307 * 1.7).unwrap().record;
    assert!(
        long.sentence.contains("that is in the steady spin, in") && !long.sentence.contains("inf"),
        "{long:?}"
    );
}
