//! Starts at which an assumption fails: the state that is judged is the one that runs, and messages name the cause.

use crate::support::{MODEL, Ran, Table, difference, folder_with, one_line, ran_in, ran_with};

/// The reduced body starts from the spin on which a displaced point settles; `check` judges that one.
#[test]
fn check_judges_the_spin_that_the_reduced_body_starts_from() {
    let displaced = MODEL.replace("[run]", "displacements = { tip = [0, 3, 0] }\n[run]");
    let folder = folder_with(&displaced);
    let row = ran_in(folder.path(), "simulate model.toml --duration 1 --samples 2");
    let omega = Table::of(&row.stdout).vector(["wx", "wy", "wz"], 0);
    let settled = omega.iter().map(|w| w * w).sum::<f64>().sqrt();
    assert!(settled > 1.5 * 0.127, "{settled}: the body shrinks as the point comes in");
    let checked = ran_in(folder.path(), "check model.toml --json").json();
    let T3 = checked["T3"].as_f64().unwrap();
    assert!(difference([T3.recip()], [settled]) < 1e-9, "{} {settled}", T3.recip());
    let text = one_line(&ran_in(folder.path(), "check model.toml").stdout);
    assert!(text.contains("Judged is the spin on which it settles"), "{text}");
    let still = one_line(&ran_with(MODEL, "check model.toml").stdout);
    assert!(!still.contains("Judged is"), "{still}");
}

/// A spin far above that at the start, on which a fast rotor settles.
#[test]
fn check_fails_where_the_start_holds_and_what_follows_does_not() {
    let rotor = "[[rotor]]\nname = \"ball\"\ninertia = 0.2\nfriction = 2.0\nshape = \"sphere\"\nspeed = [0.1, 11326.3, 0.3]\n[initial]";
    let model = MODEL.replace("[initial]", rotor).replace("[0.12, 0.035, 0.02]", "[0.003, 0.001, 0.03]");
    let checked = ran_with(&model, "check model.toml");
    assert_ne!(checked.code, Some(0), "{checked:?}");
    let said = one_line(&format!("{}{}", checked.stdout, checked.stderr)).to_lowercase();
    assert!(said.contains("not hold") && !said.contains("equations hold"), "{said}");
}

#[test]
fn carrier_lost_in_rounding_is_refused_in_words() {
    let with =
        |mass: &str, line: &str| ran_with(&MODEL.replace("mass = 40.0", &format!("mass = {mass}")), line);
    for line in ["simulate model.toml --system full", "verify model.toml"] {
        let said = one_line(with("1e-16", line).refusal());
        assert!(said.contains("is below 1e-13 of the sprung mass"), "{line}: {said}");
    }
    let checked = with("1e-16", "check model.toml"); // a light carrier on a heavy point vibrates fast
    assert!(checked.code == Some(0) && !checked.stdout.contains("inf"), "{checked:?}");
    let light = with("1e-6", "simulate model.toml --system full --duration 1e-3 --samples 2");
    assert_eq!(light.code, Some(0), "{}", light.stderr);
}

#[test]
fn force_without_a_value_at_the_start_is_named() {
    let force = "[[force]]\nkind = \"expression\"\non = \"tip\"\nforce = [\"sqrt(x-100)\", 0, 0]\n";
    for system in ["reduced", "full"] {
        let ran = ran_with(&format!("{MODEL}{force}"), &format!("simulate model.toml --system {system}"));
        let said = one_line(ran.refusal());
        assert!(said.contains("the forces are not finite numbers at the start"), "{system}: {said}");
    }
}

#[test]
fn verification_that_fails_says_so_in_words() {
    let stiff = MODEL.replace("stiffness = 600.0", "stiffness = 1e-30");
    let said = one_line(ran_with(&stiff, "verify model.toml").refusal());
    assert!(
        said.contains("there is no slow manifold to start on at 0.127 rad/s") && !said.contains("Failed("),
        "{said}"
    );
}

#[test]
fn order_zero_is_an_order_of_the_file_too() {
    let file = ran_with(&format!("{MODEL}order = 0\n"), "check model.toml");
    let option = ran_with(MODEL, "check model.toml --order 0");
    assert_eq!((file.code, file.stdout), (option.code, option.stdout));
}

/// Half a degree is more than the wobble of the start.
#[test]
fn target_that_the_start_has_passed_is_told_in_its_own_unit() {
    let calm = MODEL.replace("[0.12, 0.035, 0.02]", "[0.0, 1e-4, 0.2]");
    let said = one_line(ran_with(&calm, "evolve model.toml --until 20deg --method average").refusal());
    assert!(
        said.contains("dissipation only lowers the wobble") && said.contains("target, 20.0 degrees"),
        "{said}"
    );
}

/// A thousand points whose frequencies crowd: three of each, a thousandth apart.
#[test]
fn crowded_frequencies_are_found() {
    let mut model = MODEL.replace("mass = 40.0", "mass = 100.0");
    for i in 0..400 {
        let [x, y, z] = [i % 11, i % 13, i % 17].map(|part| 0.05 * f64::from(part));
        model.push_str(&format!(
            "[[point]]\nname = \"p{i}\"\nmass = 0.01\nposition = [{x}, {y}, {z}]\n[[spring]]\nfrom = \"p{i}\"\nto = \"carrier\"\nstiffness = {}\ndamping = 0.01\n",
            1.0 + 1e-3 * f64::from(i)
        ));
    }
    let checked = ran_with(&model, "check model.toml --json").json();
    let first = checked["frequencies"][0].as_f64().unwrap();
    assert!(difference([first], [10.0]) < 0.01, "{first}");
}

/// A body of the guide whose responses to the spin are so nearly linearly dependent that a mass among them is lost in rounding.
#[test]
fn mass_lost_in_rounding_leaves_the_other_frequencies() {
    let page = format!("{}/docs/guide/10-flexible-parts.md", crate::support::ROOT);
    let page = std::fs::read_to_string(page).unwrap();
    let model = page.split("# complete: array.toml").nth(1).unwrap().split("```").next().unwrap();
    let checked: Ran = ran_with(model, "check model.toml --order 5 --json");
    let frequencies = crate::support::numbers(&checked.json()["frequencies"]);
    assert!(frequencies.len() > 100 && frequencies.iter().all(|each| each.is_finite()), "{frequencies:?}");
    assert!(difference([frequencies[0]], [4.233169]) < 1e-5, "{}", frequencies[0]);
}

/// A rotor too free for the spin starts at rest in the body, or as the file says, and the reduced equations have no start: friction 0.03 N·m·s,
/// inertia 1 kg·m², at 0.5 rad/s, with the angular momentum `Jω`. (Q8)
#[test]
fn a_rotor_too_free_for_the_spin_starts_turning_with_the_body() {
    let rotor = "[[rotor]]\nname = \"wheel\"\naxis = [1, 0, 0]\ninertia = 1.0\nfriction = 0.03\n[initial]";
    let model = MODEL.replace("[initial]", rotor).replace("[0.12, 0.035, 0.02]", "[0.2, 0.2, 0.4]");
    for start in ["", "displacements = \"rest\"\n", "displacements = { tip = [0.001, 0, 0] }\n"] {
        let folder = folder_with(&model.replace("[run]", &format!("{start}[run]")));
        let full = ran_in(folder.path(), "simulate model.toml --system full --times 0 --coordinates");
        let table = Table::of(&full.stdout);
        let rate = table.header.iter().find(|name| name.contains("wheel") && name.ends_with("rate")).unwrap();
        assert!(full.code == Some(0) && table.column(rate)[0].abs() < 1e-12, "{start}: {full:?}"); // rounding of momenta
        assert!((7.0..9.0).contains(&table.column("momentum")[0]), "{start}");
        assert_eq!(full.stderr.contains("start turning with the body"), start.is_empty(), "{}", full.stderr);
        let reduced = one_line(ran_in(folder.path(), "simulate model.toml").refusal());
        assert!(reduced.contains("rotors and liquids do not follow the spin"), "{start}: {reduced}");
        let verified = one_line(ran_in(folder.path(), "verify model.toml").refusal());
        assert!(verified.contains("there is no slow manifold to start on"), "{start}: {verified}");
        assert_eq!(ran_in(folder.path(), "check model.toml").code, Some(1), "{start}");
    }
}

/// `found/third/cubesat/06`: a slosh pendulum without a spring is answered where the spin holds it, and refused by name elsewhere.
#[test]
fn a_pendulum_without_a_spring_is_followed_where_the_spin_holds_it() {
    let body = |hinge: f64, start: &str| {
        format!(
            "[carrier]\nmass = 9\ncenter_of_mass = [0, 0, 0]\ninertia = [90, 110, 150]\n\
             [[hinged]]\nname = \"slosh\"\nmass = 0.3\ncenter_of_mass = [{}, 0, 0]\ninertia = [1e-6, 1e-6, 1e-6]\n\
             hinge = [{hinge}, 0, 0]\naxes = [[0, 0, 1], [0, 1, 0]]\nstiffness = 0\ndamping = 1e-5\n[initial]\n{start}\n",
            hinge + 0.04
        )
    };
    let wobbling = body(0.1, "wobble = { angle = \"3 deg\", rate = \"30 rpm\", mode = \"short-axis\" }");
    let told = ran_with(&wobbling, "modes model.toml --axis greatest --json").json();
    let modes = told["modes"].as_array().unwrap();
    let found = |name: &str| {
        modes.iter().find(|mode| mode["name"] == name).and_then(|mode| mode["frequency"].as_f64()).unwrap()
    };
    let found = [found("\"slosh\" about axis 1"), found("\"slosh\" about axis 2")];
    assert!(difference(found, [4.9620, 5.8712]) < 1e-4, "{found:?}"); // with a stiffness of 1e-9
    let run = ran_with(&wobbling, "simulate model.toml --system full --duration 20 --samples 2");
    assert_eq!(run.code, Some(0), "{}", run.stderr);
    for (model, line) in [
        (&wobbling, "simulate model.toml"),
        (&wobbling, "evolve model.toml"),
        (&body(0.1, "angular_velocity = [0, 0, 0]"), "modes model.toml"),
        (&body(0.0, "angular_velocity = [0, 0, 2]"), "modes model.toml"),
    ] {
        let ran = ran_with(model, line);
        let said = one_line(&format!("{}{}", ran.stdout, ran.stderr));
        assert!(
            ran.code != Some(0) && said.contains("no spring restores \"slosh\" about axis 1"),
            "{line}: {said}"
        );
        assert!(
            said.contains("give its hinge a `stiffness`") || said.contains("give the hinge a `stiffness`"),
            "{said}"
        );
    }
}
