//! `check`: the text by snapshots, options, refusals and exit codes.

use insta::assert_snapshot;

use crate::support::{MODEL, folder_with, one_line, ran, ran_in, ran_with};

#[test]
fn explorer_1_fails_and_says_why_in_order_of_the_theory() {
    let checked = ran("check examples/explorer1/model.toml");
    assert_eq!((checked.code, &*checked.stderr), (Some(1), ""));
    let (verdict, _) = checked.stdout.split_once("\n\nTimes").unwrap();
    assert_snapshot!(verdict, @r#"
    Explorer 1: The reduced equations DO NOT HOLD at this spin.
      - The spin, 78.55 rad/s, is 12.6 times the slowest elastic frequency, 6.236
        rad/s ("whip +x" about axis 1).
      - Dashpots delay the springs by up to 2.00 s, which is 157 of the time 1/|w|
        of the spin.
      - Successive terms of the same kind in Omega(K) have the ratio 2.11e9 at
        this spin.
      - The largest displacement, of whip -y, is 178 m: 302 of the size of the
        body.
      - Put into the full equations, the reduced ones leave 0.977 of the load
        unbalanced.
      + The reduced equations about the spin hold to a nutation of 32.9 degrees
        within 1 % at degree 7.
    "#);
    assert!(!checked.stdout.contains("grows e-fold"), "what does not hold is not predicted");
}

#[test]
fn text_names_times_criteria_frequencies_terms_and_steady_spins() {
    let checked = ran("check examples/axial-mass/model.toml");
    assert_snapshot!(checked.stdout, @"
    axial mass: The reduced equations hold at this spin.

    Times
      T1  0.3119 s         period of the slowest vibration
      T2  0.4930 s         decay of the slowest vibration
      T3  0.9285 s         the spin, 1/|w|

    Criteria                          symbol                 value  limit  verdict
      spin against slowest vibration  |w|/Omega_min         0.0535   0.15  holds
      spin against damping            beta |w|              0.0108   0.15  holds
      spin against friction           tau |w|                    0   0.15  holds
      convergence of the series       Omega_d+2/Omega_d    0.00801    0.1  holds
      harmonics near resonance        nome^(n/2)                 0   0.15  holds
      displacement against size       max|r|/max|rho|      0.00155    0.1  holds
      residual of the full equations  |residual|/|load|    0.00574    0.1  holds
      convergence of the power        change of P/P        0.00957    0.1  holds
      rates of small motions          change of rate        0.0112    0.1  holds
      averages along rigid polhodes   max|f4|/max|f2|      3.76e-4    0.1  holds
      decay of initial vibrations     T2/T3                  0.531      1  holds

    Vibrations
      frequencies, attitude fixed (rad/s): 20.14 20.14 20.14
      frequencies, body free (rad/s): 20.14 20.40 20.40
      decay rates (1/s): 2.029 2.029 2.029 2.029 2.029 2.029

    Size of the terms of w' at this spin (rad/s^2)
      f2=2.9e-1   f3=0.0e0   f4=1.1e-4   f5=4.5e-7   f6=5.4e-7   f7=4.6e-9
      f8=2.7e-9   f9=3.3e-11
      terms left out are smallest at order 5 or above; order 3 is judged

    Steady spins at this angular momentum, after the reduced equations
      about the axis of least inertia, 1.0000 kg m^2:     two moments are equal
      about the axis of middle inertia, 1.0000 kg m^2:    two moments are equal
      about the axis of greatest inertia, 1.5000 kg m^2:  decays e-fold in 9.572 d
      now 14.93 degrees from the axis of greatest inertia

    Steady spins at this angular momentum, with the modes about them
      About the axis of greatest inertia the nutation, 0.5172 rad/s in the body,
        decays e-fold in 9.464 d.
      About the axis of least inertia the nutation is neutral to rounding and has
        no time constant, since the spins beside this one are steady too.
    ");
}

#[test]
fn order_of_the_command_stands_above_that_of_the_file() {
    let order = |line: &str| {
        ran(&format!("check examples/axial-mass/model.toml --json{line}")).json()["order"].clone()
    };
    assert_eq!(order(""), 3);
    assert_eq!(order(" --order 5"), 5);
}

#[test]
fn model_without_a_spin_is_told_what_to_add() {
    let model = MODEL.replace("[initial]\nangular_velocity = [0.12, 0.035, 0.02]\n", "");
    let refusals =
        ["check", "simulate", "run"].map(|command| ran_with(&model, &format!("{command} model.toml")));
    assert_snapshot!(refusals[0].refusal(), @r"
    quasirigid: model.toml: the model has no initial spin; add a table such as

        [initial]
        angular_velocity = [0.0, 0.1, 1.0]   # rad/s, body axes
    ");
    assert!(refusals.iter().all(|each| each.refusal() == refusals[0].stderr));
    assert_eq!(ran_with(&model, "derive model.toml").code, Some(0));
}

#[test]
fn zero_spin_is_refused_where_one_is_judged_and_stays_at_rest_elsewhere() {
    let model = MODEL.replace("[0.12, 0.035, 0.02]", "[0, 0, 0]");
    let [checked, simulated, run] = ["check", "simulate", "run"]
        .map(|command| ran_with(&model, &format!("{command} model.toml --json --quiet")));
    assert_snapshot!(checked.refusal(), @r"
    quasirigid: the angular velocity [0.0, 0.0, 0.0] rad/s is not a spin; give a
    finite one that is not zero
    ");
    assert_eq!((simulated.code, run.code), (Some(0), Some(0)), "{} {}", simulated.stderr, run.stderr);
    assert_eq!(simulated.json()["omega"], serde_json::json!([0.0, 0.0, 0.0]));
}

#[test]
fn note_on_the_model_goes_to_standard_error_unless_quiet() {
    let model = MODEL.replace("[initial]", "[initial]\nattitude = [1, 0, 0, 0.001]");
    for command in ["check", "derive", "simulate"] {
        let shown = ran_with(&model, &format!("{command} model.toml"));
        assert!(shown.stderr.starts_with("quasirigid: note: the initial attitude has the norm 1.0000004"));
        let quiet = ran_with(&model, &format!("{command} model.toml --quiet"));
        assert_eq!((quiet.code, &*quiet.stderr), (Some(0), ""), "{command}");
        assert_eq!(quiet.stdout, shown.stdout, "{command}");
    }
}

/// A gyrostat: its steady spins along the wheel and against the wheel differ.
const GYROSTAT: &str = "[carrier]\nmass = 100.0\ncenter_of_mass = [0.0, 0.0, 0.0]\ninertia = [10.0, 20.0, 30.0]\n\
    [[wheel]]\naxis = [0, 0, 1]\nmomentum = MOMENTUM\n[[rotor]]\naxis = [0, 1, 0]\ninertia = 0.5\nfriction = 20.0\n\
    [initial]\nangular_velocity = [0.0, 0.0, 0.1]\n";

#[test]
fn steady_spins_of_a_gyrostat_have_two_senses() {
    let checked = ran_with(&GYROSTAT.replace("MOMENTUM", "2.0"), "check model.toml");
    let (_, spins) = checked.stdout.split_once("Steady spins").unwrap();
    assert_snapshot!(spins, @"
     at this angular momentum, after the reduced equations
      about the axis of least inertia, 10.000 kg m^2:     grows e-fold in 11.11 h
        the other way round:                              grows e-fold in 11.11 h
      about the axis of middle inertia, 20.000 kg m^2:    grows e-fold in 11.55 s
        the other way round:                              grows e-fold in 11.55 s
      about the axis of greatest inertia, 30.000 kg m^2:  decays e-fold in 8.889 h
        the other way round:                              decays e-fold in 13.33 h
      now 0 degrees from the axis of greatest inertia

    Steady spins at this angular momentum, with the modes about them
      About the axis of greatest inertia the nutation, 0.2449 rad/s in the body,
        decays e-fold in 8.889 h.
      About the axis of least inertia the spin is UNSTABLE: the nutation, 0.2828
        rad/s in the body, GROWS e-fold in 11.11 h.
      About the axis of greatest inertia in the opposite sense the nutation,
        0.06667 rad/s in the body, decays e-fold in 13.33 h.
      About the axis of least inertia in the opposite sense the spin is UNSTABLE:
        the nutation, 0.2828 rad/s in the body, GROWS e-fold in 11.11 h.
    ");
    let checked = ran_with(&GYROSTAT.replace("MOMENTUM", "-3.0"), "check model.toml");
    assert!(
        checked.stdout.contains("\nThe angular momentum is zero: internal rotors and liquids take it up.\n"),
        "{}",
        checked.stdout
    );
}

#[test]
fn shares_of_dissipators_stand_where_the_equations_hold() {
    let checked = ran("check examples/three-masses/model.toml");
    let (_, rest) = checked.stdout.split_once("At this spin").unwrap();
    assert_snapshot!(rest, @"
    1.16e-4 W are dissipated; dissipation shares: spring p2-carrier
     70.4 %, spring p1-p2 9.72 %, spring p0-p2 8.38 %, spring p0-carrier 6.83 %,
     spring p0-p1 3.23 %, spring p1-carrier 1.46 %.
    ");
}

/// A shape a thousand times too small, too large, or too fast for its size says so; one that is right does not.
#[test]
fn a_shape_in_a_wrong_unit_says_so() {
    let shape = "v 0 0 0\nv 600 0 0\nv 0 500 0\nv 0 0 400\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n";
    let said = |unit: &str, period: &str| {
        let folder = folder_with(&format!(
            "[material.rock]\ndensity = 2000\nshear = \"0.5 GPa\"\npoisson = 0.25\n[[surface]]\nfile = \"shape.obj\"\nunit = \"{unit}\"\n\
             degree = 1\nmaterial = \"rock\"\n[initial]\nangular_velocity = [0, 0, \"1 rev/{period}\"]\n"
        ));
        std::fs::write(folder.path().join("shape.obj"), shape).unwrap();
        one_line(&ran_in(folder.path(), "check model.toml --quiet").stdout)
    };
    for (unit, period, warning) in [
        ("m", "d", None),
        ("mm", "d", Some("WARNING: a body of 0.600 m that turns once in")),
        ("m", "min", Some("faster than gravity holds loose material")),
    ] {
        let text = said(unit, period);
        assert!(text.contains("kg at 2000.0 kg/m^3") && text.contains("m^3;"), "{text}");
        assert_eq!(text.contains("WARNING"), warning.is_some(), "{unit} {period}: {text}");
        assert!(warning.is_none_or(|warning| text.contains(warning)), "{unit} {period}: {text}");
    }
    assert!(said("5 km", "d").contains("larger than any asteroid"));
}
