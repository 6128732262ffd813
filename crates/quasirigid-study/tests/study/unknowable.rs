//! What no equations tell is said first: chaos under forces, vibrations of a start, and starts on a steady spin in whatever axes.
//! (E10), (B2), (Q2)

use quasirigid_io::model::System;
use quasirigid_math::rotation::{normalized, to_inertial};
use quasirigid_math::vec3::norm;
use quasirigid_study::settings::PartialRun;

use crate::support::{
    SPIN, carrier, column, evolve, follow, point, spinning, study, table, told_history, try_evolve,
};

/// Moments of inertia with the ratios of Hyperion's, on an orbit; in s and m.
fn on_an_orbit(inertia: [f64; 3], eccentricity: f64, parts: &str) -> String {
    carrier(100.0, inertia)
        + parts
        + "[[force]]\nkind = \"central-gravity\"\n"
        + &format!("orbit = {{ body = \"Earth\", semi_major_axis = 1e7, eccentricity = {eccentricity} }}\n")
        + &spinning([1e-4, 2e-4, 6e-4])
}

/// Time (s) from which a doubt says that the motion is not known.
fn unknown_from(said: &str) -> Option<f64> {
    let behind = said.split("THE MOTION IS NOT KNOWN from about t = ").nth(1)?;
    behind.split(' ').next()?.parse().ok()
}

/// A body as Hyperion tumbles chaotically (Wisdom, Peale & Mignard 1984). Before the time that is told two tolerances agree, well behind it they do
/// not; a body of revolution in a circular orbit and one far from the planet have no chaos.
#[test]
fn a_chaotic_motion_is_told_with_the_time_from_which_it_is_unknown() {
    let tip = point("tip", 1.0, [0.5, 0.4, 0.3], [1.0, 0.01]);
    for (parts, system) in [("", System::Rigid), (&*tip, System::Reduced)] {
        let model = study(&on_an_orbit([10.0, 14.5, 17.0], 0.2, parts));
        let spins = |tolerance: f64, end: f64| {
            let run = PartialRun { tolerance: Some(tolerance), ..PartialRun::default() };
            let (found, said) = told_history(&model, &table(system, &[0.0, end]), run);
            (SPIN.map(|name| column(&found.columns, name)[1]), said)
        };
        let (_, said) = spins(1e-12, 540_000.0);
        let from = unknown_from(&said).unwrap_or_else(|| panic!("{said}"));
        assert!((100_000.0..540_000.0).contains(&from), "{from}");
        if system == System::Rigid {
            let gap = |end: f64| {
                let [a, b] = [1e-12, 3e-13].map(|tolerance| spins(tolerance, end).0);
                norm([a[0] - b[0], a[1] - b[1], a[2] - b[2]]) / norm(a)
            };
            assert!(
                gap(0.5 * from) < 1e-2 && gap(2.5 * from) > 1e-2,
                "{} {}",
                gap(0.5 * from),
                gap(2.5 * from)
            );
        }
        let (_, said) = spins(1e-12, 0.3 * from);
        assert!(unknown_from(&said).is_none(), "{said}");
    }
    for regular in [on_an_orbit([12.0, 12.0, 17.0], 0.0, ""), on_an_orbit([16.99, 17.0, 17.01], 0.01, "")] {
        let (_, said) =
            told_history(&study(&regular), &table(System::Rigid, &[0.0, 5e5]), PartialRun::default());
        assert!(unknown_from(&said).is_none(), "{said}");
    }
}

/// A magnet that tumbles along its orbit is chaotic, with hysteresis rods or without; what coils bring to rest in the same field is not.
#[test]
fn under_controllers_and_rods_a_chaotic_motion_is_told() {
    let body = |acting: &str| {
        carrier(3.0, [0.02, 0.022, 0.006])
            + "[magnetic_field]\ndipole = [1.0e15, 0.8e15, -7.6e15]\n\
               orbit = { body = \"Earth\", semi_major_axis = \"6978 km\", inclination = \"65 deg\" }\n"
            + acting
            + &spinning([0.087, 0.052, 0.035])
    };
    let magnet = "[[force]]\nkind = \"magnetic-dipole\"\nmoment = [0, 0, 0.3]\n";
    let rod = "[[rod]]\naxis = [1, 0, 0]\nlength = \"95 mm\"\ndiameter = \"1 mm\"\nsaturation = \"0.74 T\"\n\
               remanence = \"0.35 T\"\ncoercivity = \"1.59 A/m\"\n";
    let coils = "[[controller]]\nkind = \"b-dot\"\ngain = 2e4\nsaturation = 0.2\nperiod = 1.0\n";
    let told = |acting: &str, end: f64| {
        let asked = table(System::Rigid, &[0.0, end]);
        unknown_from(&told_history(&study(&body(acting)), &asked, PartialRun::default()).1)
    };
    for acting in [magnet.to_owned(), magnet.to_owned() + rod] {
        let from = told(&acting, 43_200.0).unwrap_or(f64::INFINITY);
        assert!((1_000.0..43_200.0).contains(&from), "{from}");
    }
    assert_eq!(told(coils, 5_400.0), None);
}

/// A start without displacements leaves a vibration about those on which the body settles, under a torque from the first moment on and in a spin:
/// what the full system dissipates more than the reduced equations is less than the energy told, and half of it or more.
#[test]
fn vibrations_of_a_start_are_told() {
    let whole = |start: [f64; 3], torque: &str| {
        carrier(100.0, [10.0, 13.0, 17.0])
            + &point("tip", 1.0, [1.0, 0.5, 0.3], [100.0, 8.0])
            + torque
            + &spinning(start)
            + "displacements = \"rest\"\n"
    };
    let torque = "[[force]]\nkind = \"torque\"\ntorque = [0.0, 0.0, 2.0]\n";
    for model in [whole([0.0; 3], torque), whole([0.25, 0.15, 1.0], "")] {
        let study = study(&model);
        let times = [0.0, 10.0];
        let (reduced, said) = told_history(&study, &table(System::Reduced, &times), PartialRun::default());
        let full = follow(&study, System::Full, &times);
        let [more, told] = [full.run.last.dissipated - reduced.run.last.dissipated, reduced.run.left_out];
        assert!(more < 1.05 * told && more > 0.5 * told, "{more} {told}");
        assert!(said.contains("THE DISSIPATED ENERGY MAY BE WRONG"), "{said}");
    }
    let settled = whole([0.25, 0.15, 1.0], "").replace("displacements = \"rest\"\n", "");
    assert_eq!(follow(&self::study(&settled), System::Reduced, &[0.0, 10.0]).run.left_out, 0.0);
}

/// Axes off those of the file.
fn turned(vector: [f64; 3]) -> [f64; 3] {
    to_inertial(normalized([0.3, -0.5, 0.7, 0.2]), vector)
}

/// Carrier with principal moments along turned axes.
fn turned_carrier(mass: f64, moments: [f64; 3]) -> String {
    let axes: [[f64; 3]; 3] =
        std::array::from_fn(|k| turned(std::array::from_fn(|n| f64::from(u8::from(n == k)))));
    let inertia: [[f64; 3]; 3] = std::array::from_fn(|i| {
        std::array::from_fn(|j| (0..3).map(|k| moments[k] * axes[k][i] * axes[k][j]).sum())
    });
    format!("[carrier]\nmass = {mass:?}\ncenter_of_mass = [0, 0, 0]\ninertia = {inertia:?}\n")
}

/// A body that starts along an axis of its inertia, the middle one among them, with moments apart, nearly equal and equal; told in two frames of
/// axes. Beside the axis the wobble is followed.
#[test]
fn a_start_on_an_axis_is_steady_in_any_axes() {
    for (second, stiffness) in [(12.0, 1e4), (12.0 + 1e-6, 1e4), (14.0, 1e4), (14.0, 1e9)] {
        let moments = [12.0, second, 18.0];
        for axis in 0..3 {
            let along: [f64; 3] = std::array::from_fn(|n| if n == axis { 1.3 } else { 0.0 });
            let told = [(carrier(50.0, moments), along), (turned_carrier(50.0, moments), turned(along))];
            for (carrier, spin) in told {
                let tip = point("tip", 0.5, [0.0; 3], [stiffness, 3.0]);
                let said = try_evolve(&study(&(carrier + &tip + &spinning(spin))), |_| {});
                let said = said.map_or_else(|why| why, |found| found.record.message);
                assert!(said.contains("starts in a steady spin"), "{second} {axis} {said}");
            }
        }
    }
    let beside = carrier(50.0, [12.0, 14.0, 18.0]) + &point("tip", 0.5, [0.1, 0.5, 0.9], [1e4, 3.0]);
    assert!(try_evolve(&study(&(beside + &spinning([1e-4, 1e-4, 1.3]))), |_| {}).is_ok());
}

/// Beside two moments that differ by 5e-10 the polynomial of the power is the rounding of zeros in turned axes: the same body has the same time in any.
#[test]
fn nearly_equal_moments_have_the_same_time_in_any_axes() {
    let moments = [20.587_261_197_559_222, 20.587_261_213_021_65, 10.293_630_602_902_926];
    let time = |carrier: String, place: [f64; 3], start: [f64; 3]| {
        evolve(&(carrier + &point("tip", 0.775, place, [19710.0, 0.44]) + &spinning(start))).time
    };
    let (place, start) = ([0.0, 0.0, 0.5], [5.0, 3.0, 1e-4]);
    let own = time(carrier(77.5, moments), place, start);
    let other = time(turned_carrier(77.5, moments), turned(place), turned(start));
    assert!((other / own - 1.0).abs() < 1e-2, "{own:e} {other:e}");
}

/// A rigid body with a momentum wheel, which loses nothing.
#[test]
fn a_gyrostat_without_dissipation_stays_as_it_is() {
    let wheel = "[[wheel]]\nname = \"bias\"\naxis = [1.0, 0.3, 0.5]\nmomentum = 6.0\n";
    let model = carrier(50.0, [10.0, 14.0, 18.0]) + wheel + &spinning([0.4, 0.3, 1.0]);
    let said = try_evolve(&study(&model), |_| {});
    let said = said.map_or_else(|why| why, |found| found.record.message);
    assert!(said.contains("nothing in the body dissipates"), "{said}");
}
