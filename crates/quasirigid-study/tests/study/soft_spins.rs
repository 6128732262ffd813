//! Bodies so soft that their spin turns its own axis: steady spins with momentum wheels, and wobbles about the axis of the deformed body.
//! Equations (M1), (Q8), (Q15), docs/theory/15-modes.md and 16-methods.md.

use quasirigid_io::model::System;
use quasirigid_math::rotation::{Turn, to_inertial};
use quasirigid_math::vec3::{dot, norm, unit};
use quasirigid_study::modes::PrincipalAxis;

use crate::support::{column, evolve, evolved, finished, modes, modes_about, study, target};

/// Two soft points and a wheel with as much angular momentum as the body, which spins about its middle axis.
const GYROSTAT: &str = r#"
carrier = { mass = 73.939, center_of_mass = [-0.0146, -0.0043, -0.0144], inertia = [8.23439225, 7.61061461, 5.28556938] }
point = [
  { name = "soft", mass = 1.6511, position = [-0.6904, -0.6881, -0.4973] },
  { name = "softer", mass = 0.56795, position = [-0.5925, 0.554, 0.5421] },
]
spring = [
  { from = "soft", to = "carrier", stiffness = [2.1374, 2.621, 5.7743], damping = [0.26633, 0.1788, 0.11706] },
  { from = "softer", to = "carrier", stiffness = [15.208, 6.2226, 8.2142], damping = [0.14477, 0.15166, 0.42063] },
]
wheel = [{ name = "bias", axis = [0.3639, -0.0264, 0.9311], momentum = 10.198 }]
initial = { angular_velocity = [0.036958, 1.5166, 0.036958] }
"#;

/// A prolate carrier with rotors and a point, so soft that its wobble goes another way than that of the frozen body.
const TURNED_OVER: &str = r#"
carrier = { mass = 208.31, center_of_mass = [0.0014, -0.0184, 0.0124], inertia = [39.5271081, 13.3384815, 42.6803321] }
rotor = [
  { name = "rotor0", axis = [-0.6521, -0.1086, 0.7503], inertia = 0.86429, friction = 0.089368 },
  { name = "rotor1", axis = [0.7224, 0.5904, 0.36], inertia = 0.16887, friction = 0.015896 },
]
point = [{ name = "soft", mass = 1.1899, position = [-0.9486, 0.9692, -0.3793] }]
spring = [{ from = "soft", to = "carrier", stiffness = [1.8434, 2.72, 2.6747], damping = [0.22671, 0.10788, 0.69619] }]
wheel = [{ name = "bias", axis = [-0.8894, 0.1204, 0.4409], momentum = 1.0959 }]
initial = { wobble = { angle = "4.684 deg", rate = 0.92998, mode = "short-axis" } }
"#;

/// A point so soft that it moves by 0.7 m and turns the axis of the spin, about which a small wobble is left.
const TILTED: &str = r#"
carrier = { mass = 149.31, center_of_mass = [-0.0158, -0.0024, 0.0021], inertia = [18.085, 22.035, 24.409] }
point = [{ name = "tip", mass = 4.9497, position = [-0.7406, 0.7379, -1.6381] }]
spring = [{ from = "tip", to = "carrier", stiffness = 115.298, damping = 3.3353 }]
initial = { wobble = { angle = "6.242 deg", rate = 2.6453, mode = "short-axis" } }
"#;

/// Angular velocity (rad/s) in which the full system ends.
fn end_of(model: &str, duration: f64) -> [f64; 3] {
    finished(&study(model), System::Full, &[0.0, duration]).run.last.omega
}

/// Relative difference of two vectors.
fn apart(a: [f64; 3], b: [f64; 3]) -> f64 {
    norm(std::array::from_fn(|i| a[i] - b[i])) / norm(b)
}

#[test]
fn the_steady_spin_of_a_soft_gyrostat_is_where_the_full_system_comes_to_rest() {
    let found = &modes(&study(GYROSTAT)).spins[0];
    let settled = end_of(GYROSTAT, 600.0);
    assert!(found.stable && apart(found.spin.unwrap(), settled) < 1e-6, "{:?} {settled:?}", found.spin);
    assert_eq!(evolve(GYROSTAT).status, "finished");
}

#[test]
fn a_wobble_that_soft_parts_lead_to_another_spin_ends_there() {
    let found = evolve(TURNED_OVER);
    assert_eq!(found.status, "finished", "{}", found.message);
    let settled = end_of(TURNED_OVER, 3000.0);
    let momentum = finished(&study(TURNED_OVER), System::Full, &[0.0, 1.0]).run.last.angular_momentum;
    assert!((found.angular_momentum / norm(momentum) - 1.0).abs() < 1e-9);
    assert!(found.sentence.contains("steady spin") && settled[2] < 0.0, "{} {settled:?}", found.sentence);
    let stays = finished(&study(TURNED_OVER), System::Full, &[0.0, found.time]).run.last;
    let close = dot(unit(stays.omega), unit(settled)).acos();
    assert!(close < 0.05, "{close} rad from the steady spin at the end");
}

/// A soft point off the principal axes, whose load tilts the axis of the steady spin by more than the wobble.
fn tilted(angle: f64) -> String {
    format!(
        r#"
carrier = {{ mass = 18.673, center_of_mass = [0.0088, -0.0043, -0.0072], inertia = [0.463167759, 0.709694015, 0.805759331] }}
point = [{{ name = "soft", mass = 0.12557, position = [-0.358, -0.1613, -0.2846] }}]
spring = [{{ from = "soft", to = "carrier", stiffness = [4.0, 5.8, 2.6], damping = [0.023, 0.0086, 0.09] }}]
initial = {{ wobble = {{ angle = {angle}, rate = 2.3549, mode = "short-axis" }} }}
"#
    )
}

#[test]
fn a_wobble_is_of_the_angle_given_about_the_axis_of_the_deformed_body() {
    for angle in [0.03_f64, 0.12] {
        let study = study(&tilted(angle));
        let spin = &modes_about(&study, PrincipalAxis::Greatest).spins[0];
        let nutation = spin.modes.iter().find(|mode| mode.name == "nutation").unwrap();
        let period = std::f64::consts::TAU / nutation.frequency;
        let times: Vec<f64> = (0..=200).map(|i| period * f64::from(i) / 200.0).collect();
        let history = finished(&study, System::Full, &times);
        let axis = unit(spin.angular_momentum.unwrap());
        let last = history.run.last;
        let fixed = to_inertial(last.attitude, unit(last.angular_momentum));
        let attitude = |row: usize| ["qw", "qx", "qy", "qz"].map(|name| column(&history.columns, name)[row]);
        let tilts =
            (0..times.len()).map(|row| dot(Turn::of(attitude(row)).to_body(fixed), axis).abs().acos());
        let greatest = tilts.fold(0.0, f64::max);
        assert!((greatest / angle - 1.0).abs() < 0.04, "{greatest} rad, {angle} given");
        let told = evolve(&tilted(angle)).start.unwrap().nutation_greatest;
        assert!((told / angle - 1.0).abs() < 0.06, "{told} rad told, {angle} given");
    }
}

/// A soft point on a round hub: its vibrations are as slow as a third of the spin.
const SLOWER_THAN_THE_SPIN: &str = r#"
carrier = { mass = 100, center_of_mass = [0, 0, 0], inertia = [20, 24, 30] }
point = [{ name = "tip", mass = 2, position = [0.3, 0.5, 0.4] }]
spring = [{ from = "tip", to = "carrier", stiffness = 4.5, damping = 0.05 }]
initial = { wobble = { angle = "1.556 deg", rate = 1, mode = "short-axis" } }
"#;

/// A point on a boom, whose slowest vibration is hardly faster than the spin.
const HARDLY_FASTER: &str = r#"
carrier = { mass = 354.64, center_of_mass = [0.018, 0.0253, 0.0168], inertia = [105.94, 81.328, 67.854] }
point = [{ name = "tip", mass = 1.4247, position = [-1.928, 0.2605, 0.8432] }]
spring = [{ from = "tip", to = "carrier", stiffness = 29.824, damping = 0.065102 }]
initial = { wobble = { angle = "10.063 deg", rate = 2.4465, mode = "short-axis" } }
"#;

/// The wobble of the file is the one left when the vibrations of the start have died out: the full system, followed back at its own rate from
/// where they have, comes to it. In balance with its spin, a start of this wobble would leave 1.4 and 1.06 times as much.
#[test]
fn a_given_wobble_is_what_slow_parts_leave() {
    let cases = [(SLOWER_THAN_THE_SPIN, 1.556, 520.0, 20_000.0), (HARDLY_FASTER, 10.063, 700.0, 19_000.0)];
    for (model, angle, forgotten, end) in cases {
        let found = evolve(model);
        let first = |name: &str| column(&found.columns, name)[0];
        assert!((first("nutation_max").to_degrees() / angle - 1.0).abs() < 1e-3, "{}", first("nutation_max"));
        let later = 1.3 * forgotten;
        let full = finished(&study(model), System::Full, &[0.0, forgotten, later, end]);
        let energy = column(&full.columns, "energy");
        let [e, f] = [1, 2].map(|row| energy[row] / energy[3] - 1.0);
        let back = e * (e / f).powf(forgotten / (later - forgotten));
        let told = 1.0 / first("D_over_I3") - 1.0;
        assert!((told / back - 1.0).abs() < 0.05, "{model}: {told} {back}");
    }
}

/// Panels on hinges along the axis of the spin: a small wobble loses next to nothing, a wide one loses energy as the fourth power of its angle, and the
/// equations about the spin are followed at its pace and not for thousands of years.
#[test]
fn a_wobble_that_loses_energy_at_higher_order_alone_is_followed_at_its_own_pace() {
    let panel = |side: f64| {
        format!(
            "{{ name = \"panel {side}\", mass = 0.57666, center_of_mass = [0, {}, 0.05], inertia = [0.010758, 0.0058077, 0.016549], \
             hinge = [0, {}, 0.05], axes = [[1, 0, 0]], stiffness = \"0.928609 N m/rad\", damping = \"0.00095987 N m s/rad\" }}",
            side * 0.48239,
            side * 0.24582
        )
    };
    let model = format!(
        "carrier = {{ mass = 20.377, center_of_mass = [0.0002, 0.006, 0.0038], inertia = [1.004, 0.9652, 0.69773] }}\n\
         hinged = [{}, {}]\ninitial = {{ wobble = {{ angle = \"17.682 deg\", rate = 1.8904, mode = \"short-axis\" }} }}\n",
        panel(1.0),
        panel(-1.0)
    );
    let found = evolve(&model);
    assert_eq!((found.status.as_str(), found.road.as_str()), ("finished", "manifold"), "{}", found.message);
    let at = |name: &str, row: usize| column(&found.columns, name)[row];
    let rows = column(&found.columns, "t").len();
    let (early, late) = (rows / 10, rows - 1);
    let slope = (at("power", early) / at("power", late)).ln()
        / (at("nutation_max", early) / at("nutation_max", late)).ln();
    assert!((slope - 4.0).abs() < 0.1, "{slope}");
    let full = finished(&study(&model), System::Full, &[0.0, 600.0, 1200.0]);
    let lost = column(&full.columns, "dissipated");
    assert!(((lost[2] - lost[1]) / 600.0 / found.power - 1.0).abs() < 0.02, "{lost:?} {}", found.power);
}

/// A wobble of the undeformed body that is another one about the spin of the deformed body is told, and that of a stiffer body is not.
#[test]
fn a_wobble_of_the_undeformed_body_is_told() {
    let told = |stiffness: &str, start: Option<&str>| {
        let evolved = evolved(&study(&TILTED.replace("115.298", stiffness)), |asked| {
            asked.start = start.and_then(target);
        });
        let first = column(&evolved.record.columns, "nutation_max")[0].to_degrees();
        let note = evolved
            .notes
            .iter()
            .any(|note| note.contains("nutation, 6.242 degrees, is that of the undeformed body"));
        (first, note)
    };
    let (first, note) = told("115.298", None);
    assert!(first < 1.5 && note, "{first}");
    let (first, note) = told("4000", None);
    assert!((first / 6.242 - 1.0).abs() < 0.05 && !note, "{first}");
    let (first, note) = told("4000", Some("2 deg"));
    assert!(
        (first / 2.0 - 1.0).abs() < 0.05 && !note,
        "a start asked for is not the wobble of the model: {first}"
    );
}
