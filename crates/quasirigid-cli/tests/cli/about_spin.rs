//! Reduced equations about the spin: `derive`, `simulate`, `check`, `verify` and `evolve`, their verdicts first, their refusals in words.

use serde_json::Value;

use crate::support::{MODEL, ROOT, Ran, Table, numbers, one_line, ran, ran_with};

/// Satellite with a tuned damper on a spring.
const DAMPER: &str = "examples/nutation-damper/model.toml";
const EXPLORER: &str = "examples/explorer1/model.toml";

/// A boom on a spring so soft that the mass falls outwards: the steady spin is unstable, and no slow motion about it lasts.
const BUCKLED: &str = "\
[carrier]
mass = 100.0
center_of_mass = [0.02, -0.05, 0.1]
inertia = [16.1, 19.2, 18.0]
[[point]]
name = \"soft\"
mass = 0.0162
position = [-0.534, 0.061, -0.371]
motion = { line = [0, 0, 1] }
[[spring]]
from = \"soft\"
to = \"carrier\"
stiffness = 0.00097
damping = 6.28e-5
[initial]
wobble = { angle = \"10 deg\", rate = 1, mode = \"short-axis\" }
";

fn example(name: &str) -> String {
    std::fs::read_to_string(format!("{ROOT}/examples/{name}/model.toml")).unwrap()
}

/// Expected growth of the nutation of Explorer 1 at the spin of the model's start: the eigenvalue of (M2), which another solver finds.
fn growth() -> f64 {
    let modes = ran(&format!("modes {EXPLORER} --axis least --json")).json();
    -modes["modes"][0]["decay_rate"].as_f64().unwrap()
}

#[test]
fn explorer_1_as_it_flew_has_equations_about_its_spin() {
    let found = ran(&format!("derive {EXPLORER} --about spin --degree 9 --json"));
    let json = found.json();
    assert_eq!(found.code, Some(0), "{}", json["sentence"]);
    // The rate of a small nutation at this |K|, from an independent linearisation of the satellite, printed to four digits.
    assert!(
        (json["masters"][0]["decay_rate"].as_f64().unwrap() + 0.087_64).abs() < 1e-5,
        "{}",
        json["masters"]
    );
    let range = json["range"]["nutation"].as_f64().unwrap().to_degrees();
    assert!((38.0..42.0).contains(&range), "{range}");
    assert!(json["backbone"].as_array().unwrap().len() > 20);
    let text = ran(&format!("derive {EXPLORER} --about spin --degree 9"));
    assert!(
        one_line(&text.stdout).contains("hold to a nutation of 39.5 degrees within 1 %"),
        "{}",
        text.stdout
    );
}

/// At a low degree the start is outside the range: said first, with exit code 1.
#[test]
fn a_start_outside_the_range_is_told_first() {
    let found = ran(&format!("derive {EXPLORER} --about spin --degree 3"));
    assert_eq!(found.code, Some(1));
    let first = one_line(&found.stdout);
    assert!(
        first.starts_with("Explorer 1: The reduced equations about the spin DO NOT HOLD at the start"),
        "{first}"
    );
}

#[test]
fn check_says_which_reduction_holds() {
    for (model, code, reduction) in [
        ("examples/explorer1-stiff/model.toml", 0, "rest"),
        (DAMPER, 1, "spin"),
        ("examples/duende/model.toml", 0, "rest"),
    ] {
        let found = ran(&format!("check {model} --json"));
        assert_eq!((found.code, &found.json()["reduction"]), (Some(code), &reduction.into()), "{model}");
    }
    let text = one_line(&ran(&format!("check {DAMPER}")).stdout);
    assert!(text.contains("+ The reduced equations about the spin hold to a nutation of"), "{text}");
}

#[test]
fn a_history_on_the_manifold_is_that_of_the_full_system() {
    let last = |system: &str| {
        let found = ran(&format!("simulate {DAMPER} --system {system} --duration 40 --samples 2 --json"));
        assert_eq!(found.code, Some(0), "{}", found.stderr);
        numbers(&found.json()["omega"])
    };
    let (full, reduced) = (last("full"), last("spin-manifold"));
    for (full, reduced) in full.iter().zip(&reduced) {
        assert!((full - reduced).abs() < 1e-4, "{full} {reduced}");
    }
}

#[test]
fn verify_measures_the_order_in_the_amplitude() {
    let found = ran(&format!("verify {DAMPER} --about spin --orders 1,2,3 --json"));
    let json = found.json();
    assert_eq!((found.code, &json["reached"]), (Some(0), &true.into()), "{json}");
    for row in json["orders"].as_array().unwrap() {
        let (order, expected) = (row["order"].as_f64().unwrap(), row["expected"].as_f64().unwrap());
        assert!((order - expected).abs() < 0.35, "{row}");
    }
    let text = ran(&format!("verify {DAMPER} --about spin --orders 2"));
    assert!(text.stdout.contains("Every order is reached."), "{}", text.stdout);
}

/// What exits with 0 is right: the method of its own is that of the full system, and is refused where the spin is unstable.
#[test]
fn evolve_on_the_manifold_agrees_with_the_full_system_or_refuses() {
    let evolved = |method: &str| ran(&format!("evolve {DAMPER} --method {method} --json")).json();
    let (reduced, full) = (evolved("spin-manifold"), evolved("full"));
    assert_eq!((&reduced["road"], &full["road"]), (&"manifold".into(), &"direct".into()));
    let [own, truth] = [&reduced, &full].map(|answer| answer["time"].as_f64().unwrap());
    let error = reduced["time_error"].as_f64().unwrap();
    assert!((own / truth - 1.0).abs() <= error && error < 0.01, "{own} {truth} {error}");
    let refused = ran_with(BUCKLED, "evolve model.toml --method spin-manifold --until 0.9990 --json");
    assert_eq!((refused.code, &refused.json()["status"]), (Some(1), &"refused".into()));
    let told = one_line(&ran_with(BUCKLED, "derive model.toml --about spin").stdout);
    assert!(told.contains("DO NOT HOLD: the steady spin is unstable"), "{told}");
}

#[test]
fn the_verdict_on_explorer_1_comes_first() {
    let ran = ran(&format!("derive {EXPLORER} --about spin"));
    assert_eq!((ran.code, &*ran.stderr), (Some(1), ""), "{ran:?}");
    let lines: Vec<&str> = ran.stdout.lines().collect();
    insta::assert_snapshot!(lines[..13].join("
"), @r"
    Explorer 1: The reduced equations about the spin DO NOT HOLD at the start: its
      nutation is 23.9 degrees, and at degree 5 they hold to 23.1 degrees within
      1 %.

    Steady spin about the axis of least inertia
      angular velocity (0, 0, 85.9663) rad/s
      angular momentum 12.9086 N m s
      nutation of the start 23.9 degrees

    Masters, degree 5, normal form                     e-fold        rad/s
      z1 nutation                               GROWS 11.41 s      83.3876

    Backbone: the nutation by its amplitude, other masters at rest
    ");
}

/// The value of `R` at `z = 0.1` from the printed coefficients is the decay rate and frequency of the backbone.
#[test]
fn json_has_coefficients_that_give_the_backbone() {
    let object = ran(&format!("derive {EXPLORER} --about spin --degree 7 --json")).json();
    let masters = object["masters"].as_array().unwrap();
    assert_eq!((masters.len(), &masters[0]["name"]), (1, &Value::from("nutation")));
    let rate = -masters[0]["decay_rate"].as_f64().unwrap();
    assert!((rate / growth() - 1.0).abs() < 1e-9, "{rate}");
    let backbone = object["backbone"].as_array().unwrap();
    for point in backbone.iter().step_by(8) {
        let of = |name: &str| point[name].as_f64().unwrap();
        let rho = of("amplitude");
        let (mut re, mut im) = (0.0, 0.0);
        for term in object["R"].as_array().unwrap() {
            let [a, b] = [0, 1].map(|k| term["exponents"][k].as_f64().unwrap());
            assert_eq!(
                (&term["master"], a),
                (&Value::from(0), b + 1.0),
                "a normal form keeps z (z z*)^k alone"
            );
            let value = numbers(&term["value"]);
            re += value[0] * rho.powf(a + b - 1.0);
            im += value[1] * rho.powf(a + b - 1.0);
        }
        assert!(
            (re / -of("decay_rate") - 1.0).abs() < 1e-9 && (im / of("frequency") - 1.0).abs() < 1e-12,
            "{point}"
        );
        assert!((of("decay_rate") * of("time_constant") - 1.0).abs() < 1e-12, "{point}");
        let shares: f64 =
            point["dissipation"].as_object().unwrap().values().map(|x| x.as_f64().unwrap()).sum();
        assert!((shares - 1.0).abs() < 1e-12, "{point}");
    }
    let border = object["range"]["amplitude"].as_f64().unwrap();
    assert!((backbone[32]["amplitude"].as_f64().unwrap() / border - 1.0).abs() < 1e-12);
    assert!((backbone[32]["defect"]["power"].as_f64().unwrap() / 0.01 - 1.0).abs() < 0.01);
}

/// `W` at the coordinates of the start has the angular momentum of the steady spin in the printed direction, of unit length.
#[test]
fn json_has_the_manifold() {
    let object = ran(&format!("derive {EXPLORER} --about spin --degree 9 --json")).json();
    let z = numbers(&object["start"]["coordinates"][0]);
    let (rho, theta) = (z[0].hypot(z[1]), z[1].atan2(z[0]));
    let mut direction = [0.0; 3];
    let mut omega = [0.0; 3];
    for term in object["W"].as_array().unwrap() {
        let [a, b] = [0, 1].map(|k| term["exponents"][k].as_f64().unwrap());
        let (size, phase) = (rho.powf(a + b), (a - b) * theta);
        for (name, sum) in [("direction", &mut direction), ("omega", &mut omega)] {
            for axis in 0..3 {
                let value = numbers(&term[name][axis]);
                sum[axis] += size * (value[0] * phase.cos() - value[1] * phase.sin());
            }
        }
        assert_eq!(term["rates"].as_array().unwrap().len(), 8);
        assert_eq!(term["coordinates"].as_array().unwrap().len(), 8);
    }
    let length = direction.iter().map(|x| x * x).sum::<f64>().sqrt();
    assert!((length - 1.0).abs() < 1e-5, "{direction:?}"); // truncated beyond degree 9 at 0.4
    let table =
        Table::of(&ran(&format!("simulate {EXPLORER} --system spin-manifold --degree 9 --times 0")).stdout);
    let start = table.vector(["wx", "wy", "wz"], 0);
    for axis in 0..3 {
        assert!((omega[axis] - start[axis]).abs() < 1e-9 * start[2], "{omega:?} {start:?}");
    }
}

/// The full system after 5 s, 59 revolutions: the nutation has grown by half; phases differ by the vibrations of the start.
#[test]
fn a_history_follows_the_full_system() {
    let columns = |system: &str| {
        let ran = ran(&format!("simulate {EXPLORER} --system {system} --times 0,5 -q"));
        (ran.code, Table::of(&ran.stdout).column("energy"), ran.stderr.clone())
    };
    let (code, full, _) = columns("full");
    let (followed, manifold, told) = columns("spin-manifold --degree 9");
    assert_eq!((code, followed), (Some(0), Some(0)));
    assert!(
        one_line(&told).contains("0.63 % is in vibrations off the manifold, which are left out"),
        "{told}"
    );
    assert!((manifold[1] / full[1] - 1.0).abs() < 2e-3, "{manifold:?} {full:?}"); // 0.6 % of the start's 100 J is left out
    assert!((manifold[1] - manifold[0]).abs() > 80.0);
}

#[test]
fn a_history_that_leaves_the_range_says_so_first() {
    let ran = ran(&format!("simulate {EXPLORER} --system spin-manifold --times 0,5,30"));
    assert_eq!(ran.code, Some(1));
    assert!(ran.stderr.starts_with("quasirigid: The history LEFT THE RANGE"), "{}", ran.stderr);
    assert_eq!(Table::of(&ran.stdout).rows.len(), 3);
    let json =
        crate::support::ran(&format!("simulate {EXPLORER} --system spin-manifold --times 0,5,30 --json -q"));
    assert_eq!((json.code, &json.json()["status"]), (Some(1), &Value::from("left-validity")));
    let manifold = &json.json()["manifold"];
    assert_eq!((&manifold["holds"], &manifold["defect"]["time"]), (&Value::from(false), &Value::from(30.0)));
}

/// A damper too heavy for its spring, which the spin throws out.
#[test]
fn a_history_that_the_motion_leaves_by_itself_says_so_first() {
    let heavy = example("nutation-damper").replace("mass = 0.1\n", "mass = 4.17431\n");
    let told = ran_with(&heavy, "simulate model.toml --system spin-manifold --times 0,25");
    assert_eq!(told.code, Some(1));
    let first = "quasirigid: The history DOES NOT HOLD: a motion of \"damper\" along its line grows e-fold in 0.5459 s";
    assert!(one_line(&told.stderr).starts_with(first), "{}", told.stderr);
}

/// Whips that vibrate much more than the satellite nutates.
#[test]
fn a_history_of_vibrations_says_so_first() {
    let start = "angular_velocity = [0.002, 0.002, \"750 rpm\"]\ndisplacements = { \"whip +x\" = [0, \"5 deg\"], \"whip -x\" = [0, \"5 deg\"] }";
    let model = example("explorer1").replace("angular_velocity = [0.75, 0.75, \"750 rpm\"]", start);
    let told = ran_with(&model, "simulate model.toml --system spin-manifold --times 0,1");
    assert_eq!(told.code, Some(1));
    let told = one_line(&told.stderr);
    assert!(told.starts_with("quasirigid: The history DOES NOT HOLD: the vibrations of the start"), "{told}");
    assert!(told.contains("have 228 times the energy of the motion that they follow"), "{told}");
}

#[test]
fn what_has_no_equations_about_its_spin_is_refused_in_words() {
    let sphere = MODEL.replace("inertia = [9.0, 13.0, 16.0]", "inertia = [9.0, 9.0, 9.0]");
    let sphere = &sphere[..sphere.find("[[point]]").unwrap()];
    let sphere = format!("{sphere}[initial]\nangular_velocity = [0.0, 0.0, 1.0]\n");
    let forced = format!(
        "{MODEL}[[force]]\nname = \"push\"\nkind = \"expression\"\non = \"tip\"\nforce = [\"0\", \"1\", \"0\"]\n"
    );
    let stop = format!("{MODEL}stop = {{ energy = 0.01 }}\n");
    let driven = format!(
        "{MODEL}[support]\nkind = \"prescribed\"\npoint = [0.0, 0.0, 0.0]\nacceleration = [\"0\", \"0\", \"sin(t)\"]\n"
    );
    let cases: [(&str, &str, &str); 11] = [
        (&example("apophis"), "derive model.toml --about spin", "has no equations of motion of its own"),
        (&forced, "derive model.toml --about spin", "without external forces (push)"),
        (&forced, "simulate model.toml --system spin-manifold", "follow it with --system full"),
        (&driven, "derive model.toml --about spin", "without external forces"),
        (&sphere, "derive model.toml --about spin", "no mode about this spin is a nutation"),
        (MODEL, "derive model.toml --about spin --degree 12", "lies from 1 to 11"),
        (
            MODEL,
            "derive model.toml --about spin --masters 1e3",
            "no mode about this spin beside the nutation",
        ),
        (MODEL, "derive model.toml --about spin --masters 1,2,3,4", "names no masters"),
        (MODEL, "derive model.toml --about spin --axis middle", "take --axis least or greatest"),
        (&stop, "simulate model.toml --system spin-manifold", "know no events"),
        (MODEL, "derive model.toml --degree 3", "add --about spin"),
    ];
    for (model, line, message) in cases {
        let ran: Ran = ran_with(model, line);
        assert!(one_line(ran.refusal()).contains(message), "{line}: {ran:?}");
    }
}
