//! `modes --effective-masses` and appendages from a sheet: tables, JSON, warnings, refusals.

use serde_json::Value;

use crate::support::{MODEL, numbers, one_line, ran_with};

/// A hub with a wing known by its sheet alone.
const WING: &str = r#"
[carrier]
mass = 300.0
center_of_mass = [0.0, 0.0, 0.0]
inertia = [60.0, 80.0, 90.0]

[[appendage]]
name = "wing"
at = [0.6, 0.0, 0.2]
mass = "22 kg"
center_of_mass = [2.4, 0.0, 0.0]
inertia = [9.0, 41.0, 50.0]
normal = [0, 0, 1]
modes = [{ frequency = "0.31 Hz", damping_ratio = 0.005, translation = [0, 0, 3.6], rotation = [0, -12.2, 0] }]

[initial]
angular_velocity = [0.0, 0.01, 0.06]
"#;

fn masses(model: &str, options: &str) -> Value {
    ran_with(model, &format!("modes model.toml --effective-masses --json {options}")).json()
}

#[test]
fn a_sheet_comes_back_as_it_was_given() {
    let found = masses(WING, "--about 0.6,0,0.2");
    for (found, expected) in numbers(&found["parts"]["center_of_mass"]).iter().zip([3.0, 0.0, 0.2]) {
        assert!((found - expected).abs() < 1e-12, "{found} {expected}");
    }
    let [t, r] = ["delta_t", "delta_r"].map(|key| numbers(&found[key][0]));
    let sign = t[2].signum();
    let expected = [0.0, 0.0, 3.6, 0.0, -12.2, 0.0];
    for (found, expected) in t.iter().chain(&r).zip(expected) {
        assert!((sign * found - expected).abs() < 1e-12, "{found} {expected}");
    }
    let mode = &found["cantilever"][0];
    assert_eq!(mode["name"], "\"wing\" mode 1");
    assert!((mode["damping_ratio"].as_f64().unwrap() - 0.005).abs() < 1e-15);
    // 3.6² of 22 kg, 12.2² of 41 + 22·2.4² kg m²
    assert!((numbers(&mode["cumulative_mass"])[2] - 12.96 / 22.0).abs() < 1e-12);
    assert!((numbers(&mode["cumulative_inertia"])[1] - 148.84 / 167.72).abs() < 1e-12);
    assert!((numbers(&found["residual_mass"])[2] - 9.04).abs() < 1e-9);
}

#[test]
fn tables_keep_to_the_terminal() {
    let text = ran_with(MODEL, "modes model.toml --effective-masses").stdout;
    assert!(text.lines().all(|line| line.chars().count() < 80), "{text}");
    insta::assert_snapshot!(text, @r#"
    model: With the carrier held, 3 cantilever modes carry 100.0, 100.0 and 100.0 %
      of the parts' mass, 1.000 kg, along x, y and z.
      rotations about (0.0195122, 0.104878, 0.0121951) m

                 rad/s           Hz      zeta  mode
        1       24.495       3.8985     0.612  "tip" x
        2       24.495       3.8985     0.612  "tip" y
        3       24.495       3.8985     0.612  "tip" z

      participation factors: translations (kg^1/2), rotations (kg^1/2 m)
                    x          y          z          x          y          z
        1       1.000          0          0          0     0.4878    -0.1951
        2           0      1.000          0    -0.4878          0     0.7805
        3           0          0      1.000     0.1951    -0.7805          0

      effective masses (kg) and inertias (kg m^2)
                    x          y          z          x          y          z
        1       1.000          0          0          0     0.2380    0.03807
        2           0      1.000          0     0.2380          0     0.6092
        3           0          0      1.000    0.03807     0.6092          0

      mass and inertia of the parts that no mode carries
                    x          y          z          x          y          z
        -           0          0          0          0          0          0

      carried up to each mode, % of the parts
                    x          y          z          x          y          z
        1       100.0          0          0          0      28.09      5.882
        2       100.0      100.0          0      86.21      28.09      100.0
        3       100.0      100.0      100.0      100.0      100.0      100.0

      free at rest: 24.799, 25.600, 25.701 rad/s
    "#);
    insta::assert_snapshot!(ran_with(MODEL, "modes model.toml --effective-masses --about 1,2").refusal().trim(), @"quasirigid: a point has three coordinates, not 2: --about 0.6,0,0.2");
    assert!(ran_with(MODEL, "modes model.toml --about 1,2,3").refusal().contains("--effective-masses"));
}

#[test]
fn an_answer_that_a_sheet_may_not_hold_says_so_first() {
    let slow = ran_with(WING, "modes model.toml --axis greatest");
    assert!(
        one_line(&slow.stderr).contains("the spin at the start is 3.12 % of its lowest frequency"),
        "{}",
        slow.stderr
    );
    assert!(!slow.stdout.contains("MAY NOT HOLD"), "{}", slow.stdout);
    let fast = ran_with(WING, "modes model.toml --spin 0,0,0.9");
    assert!(
        one_line(&fast.stdout).contains("MAY NOT HOLD, since the spin is 46.2 % of the lowest"),
        "{}",
        fast.stdout
    );
    let fast = WING.replace("0.01, 0.06", "0.01, 0.6");
    assert!(one_line(&ran_with(&fast, "check model.toml").stderr).contains("note: MAY NOT HOLD: The sheet"));
    let unknown = ran_with(&WING.replace("normal = [0, 0, 1]\n", ""), "check model.toml");
    assert!(one_line(&unknown.stderr).contains("complete to order 0"), "{}", unknown.stderr);
}

#[test]
fn a_body_without_a_carrier_has_nothing_to_hold() {
    let stone = "[[ellipsoid]]\nsemi_axes = [3, 2, 1]\nmaterial = \"rock\"\n[material.rock]\ndensity = 2500\nyoung = \"1 GPa\"\npoisson = 0.25\n";
    insta::assert_snapshot!(one_line(ran_with(stone, "modes model.toml --effective-masses").refusal()), @"quasirigid: the body has no carrier that could be held: it has free modes alone, those of `modes`");
}
