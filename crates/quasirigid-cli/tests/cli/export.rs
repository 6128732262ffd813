//! `export`: source that is compiled and run where its language is, against the library; refusals; files.
//! The numbers that each file checks itself by are the library's, from the linear equation (R22) by Cramer's rule.

use std::fs;
use std::path::Path;
use std::process::{Command, Stdio};

use tempfile::TempDir;

use crate::support::{MODEL, ROOT, Ran, folder_with, names, one_line, ran_in, ran_with};

/// Bodies with springs, hinges, a rotor, a liquid; the spin of one is beyond its range.
const BODIES: [&str; 6] = [
    "three-masses",
    "explorer1-stiff",
    "friction-wheel",
    "boom-satellite",
    "nutation-damper",
    "spherical-tank",
];
const ORDERS: [usize; 3] = [1, 3, 5];

/// Whether a program is there; a test without it is skipped with a message.
fn is_there(program: &str) -> bool {
    let found = Command::new(program).arg("--version").stdout(Stdio::null()).stderr(Stdio::null()).status();
    let found = found.is_ok_and(|status| status.success());
    if !found {
        println!("skipped: there is no {program}");
    }
    found
}

/// What a program printed that ended well.
#[track_caller]
fn said(folder: &Path, program: &str, arguments: &[&str]) -> String {
    let ran: Ran = Command::new(program).args(arguments).current_dir(folder).output().unwrap().into();
    assert_eq!(ran.code, Some(0), "{program} {arguments:?}: {}{}", ran.stdout, ran.stderr);
    ran.stdout
}

/// Text of an example; its liquid is so viscous, and its spin so slow, that it follows the spin.
fn model_of(example: &str) -> String {
    let text = fs::read_to_string(format!("{ROOT}/examples/{example}/model.toml")).unwrap();
    if example == "spherical-tank" {
        text.replace("0.97 mPa s", "0.97 Pa s").replace("30 rpm", "0.1 rpm")
    } else {
        text
    }
}

/// Exports an example, whatever its range.
#[track_caller]
fn exported(folder: &Path, example: &str, order: usize, rest: &str) {
    fs::write(folder.join("model.toml"), model_of(example)).unwrap();
    let ran = ran_in(folder, &format!("export model.toml --quiet --order {order} {rest}"));
    assert!(matches!(ran.code, Some(0 | 1)) && ran.stdout.is_empty(), "{}", ran.stderr);
}

const STRICT: [&str; 5] = ["-std=c99", "-Wall", "-Wextra", "-Werror", "-pedantic"];
const SANITIZED: [&str; 2] = ["-fsanitize=address,undefined", "-fno-sanitize-recover=all"];

#[test]
fn c_compiles_strictly_and_is_the_library() {
    if !is_there("cc") {
        return;
    }
    let folder = TempDir::new().unwrap();
    for example in BODIES {
        for order in ORDERS {
            let body = format!("b{order}{}", example.replace('-', ""));
            exported(folder.path(), example, order, &format!("--to c -o {body}"));
            let within = folder.path().join(&body);
            let source = format!("{body}.c");
            let sanitized = if order == 3 { &SANITIZED[..] } else { &[] };
            let files = ["-o", "test", &source, "self-test.c", "-lm"];
            said(&within, "cc", &[&STRICT[..], sanitized, &files].concat());
            said(&within, "./test", &[]);
            let readme = fs::read_to_string(within.join("README.md")).unwrap();
            assert!(readme.contains("rad/s") && readme.contains("SHA-256"), "{readme}");
        }
    }
}

/// Steps of the run, of a fixed length (s).
const STEPS: usize = 40_000;
const STEP: f64 = 1e-3;

#[test]
fn steps_of_c_are_the_history_of_simulate() {
    if !is_there("cc") {
        return;
    }
    let main = "#include \"body.h\"\n#include <stdio.h>\nint main(void)\n{\n    static const double none[3] = {0.0, 0.0, 0.0};\n    \
                double y[7];\n    body_motion motion;\n    int i;\n    for (i = 0; i < 7; i++) y[i] = body_start[i];\n    \
                for (i = 0; i < STEPS; i++) if (body_step(y, none, STEP) > BODY_MARGINAL) return 1;\n    body_motion_at(y, none, &motion);\n    \
                printf(\"[%.17g,%.17g,%.17g,%.17g]\", motion.omega[0], motion.omega[1], motion.omega[2], body_energy(y));\n    return 0;\n}\n";
    for example in ["three-masses", "friction-wheel", "spherical-tank"] {
        let folder = TempDir::new().unwrap();
        let (steps, step) = (format!("-DSTEPS={STEPS}"), format!("-DSTEP={STEP}"));
        exported(folder.path(), example, 3, "--to c -o body");
        let within = folder.path().join("body");
        fs::write(within.join("main.c"), main).unwrap();
        said(&within, "cc", &["-O2", &steps, &step, "-o", "main", "body.c", "main.c", "-lm"]);
        let found: Vec<f64> = serde_json::from_str(&said(&within, "./main", &[])).unwrap();
        let end = STEPS as f64 * STEP;
        let line = format!("simulate model.toml --order 3 --times 0,{end} --tolerance 1e-12");
        let table = ran_in(folder.path(), &line).stdout;
        let column = |name: &str| {
            let mut lines = table.lines().filter(|line| !line.starts_with('#'));
            let place = lines.next().unwrap().split(',').position(|head| head == name).unwrap();
            lines.next_back().unwrap().split(',').nth(place).unwrap().parse::<f64>().unwrap()
        };
        for (found, name) in found.iter().zip(["wx", "wy", "wz", "energy"]) {
            let wanted = column(name);
            assert!(
                (found - wanted).abs() < 1e-9 * wanted.abs().max(0.1),
                "{example} {name}: {found}, {wanted}"
            );
        }
    }
}

#[test]
fn rust_needs_no_standard_library_and_is_the_library() {
    if !is_there("rustc") {
        return;
    }
    let folder = TempDir::new().unwrap();
    let main = "mod body;\nfn main() {\n    assert!(body::self_test() < 1e-12, \"{}\", body::self_test());\n    let mut y = body::START;\n    \
                let energy = |y: [f64; 7]| body::energy([y[0], y[1], y[2]]);\n    for _ in 0..500 {\n        let before = energy(y);\n        \
                body::step(&mut y, [0.0; 3], 0.02);\n        assert!(energy(y) <= before * (1.0 + 4e-15));\n    }\n    \
                assert_ne!(body::status(y, [0.0; 3]), body::Status::NotFinite);\n}\n";
    fs::write(folder.path().join("main.rs"), main).unwrap();
    fs::write(folder.path().join("lib.rs"), "#![no_std]\npub mod body;\n").unwrap();
    for order in ORDERS {
        exported(folder.path(), "friction-wheel", order, "--to rust -o body.rs --overwrite");
        said(folder.path(), "rustc", &["--edition=2021", "-Awarnings", "main.rs"]);
        said(folder.path(), "./main", &[]);
        said(folder.path(), "rustc", &["--edition=2021", "-Dwarnings", "--crate-type=lib", "lib.rs"]);
    }
}

#[test]
fn octave_runs_the_class_of_matlab() {
    if !is_there("octave-cli") {
        return;
    }
    let folder = TempDir::new().unwrap();
    for (order, example) in ORDERS.into_iter().zip(["axial-mass", "friction-wheel", "three-masses"]) {
        exported(folder.path(), example, order, "--to matlab -o body.m --overwrite");
        let script = "y = body.start(); w = body.motion(y(1:3), [0;0;0]); K = body.momentum_of(w); \
                      assert(body.self_test() < 1e-12); assert(norm(K - y(1:3)) < 1e-11 * norm(K)); \
                      assert(body.status(y, [0;0;0]) == 0 && numel(body.rates(y, [0;0;1])) == 7); disp('same');";
        assert!(said(folder.path(), "octave-cli", &["--eval", script]).contains("same"));
    }
}

#[test]
fn displays_have_every_polynomial() {
    let folder = TempDir::new().unwrap();
    exported(folder.path(), "friction-wheel", 3, "--to latex -o body.tex");
    let text = fs::read_to_string(folder.path().join("body.tex")).unwrap();
    assert!(text.starts_with("% gyrostat with a friction wheel: reduced equations of a free body"), "{text}");
    for symbol in ["E_{2}", "E_{5}", "c_{1,z}", "T_{0,xx}", "K_x^{2}"] {
        assert!(text.contains(symbol), "{symbol}: {text}");
    }
    for environment in ["gather*", "align*"] {
        let [begun, ended] =
            ["begin", "end"].map(|side| text.matches(&format!("\\{side}{{{environment}}}")).count());
        assert!(begun == ended && begun > 0);
    }
    assert!(!text.contains("\\omega_x"));
}

#[test]
fn what_the_equations_leave_out_is_refused() {
    let pushed = format!("{MODEL}\n[[force]]\nname = \"thrust\"\nkind = \"torque\"\ntorque = [0, 0, 1]\n");
    let wheel = MODEL.replace(
        "[initial]",
        "[[wheel]]\naxis = [0, 0, 1]\ninertia = 0.1\nspeed.formula = \"1 + t\"\n[initial]",
    );
    let held = MODEL.replace("[initial]", "[support]\nkind = \"fixed-point\"\npoint = [0, 0, 0]\n[initial]");
    for (model, said) in [
        (&pushed, "have no external forces (thrust), but take a torque: leave the forces out of the model"),
        (&wheel, "have wheels of constant speed alone"),
        (&held, "this one has a support: leave the support out"),
    ] {
        let folder = folder_with(model);
        let refused = ran_in(folder.path(), "export model.toml --to c -o body");
        assert!(one_line(refused.refusal()).contains(said), "{}", refused.stderr);
        assert!(!folder.path().join("body").exists());
    }
    for (line, said) in [
        ("export model.toml --to fortran -o body", "invalid value 'fortran' for '--to <TARGET>'"),
        ("export model.toml --to c -o -", "a folder is written"),
        ("export model.toml --to matlab -o my-body.m", "has the name of the file; name it my_body"),
    ] {
        let refused = ran_with(MODEL, line);
        assert!(one_line(refused.refusal()).contains(said), "{}", refused.stderr);
    }
}

#[test]
fn files_that_are_there_stay() {
    let folder = folder_with(MODEL);
    let first = ran_in(folder.path(), "export model.toml --to rust -o body.rs");
    assert!(
        first.code == Some(0) && first.stdout.starts_with("Wrote body.rs. Order 3; the equations hold below"),
        "{first:?}"
    );
    let before = fs::read(folder.path().join("body.rs")).unwrap();
    let again = ran_in(folder.path(), "export model.toml --to rust -o body.rs --order 5");
    assert!(again.refusal().contains("already exists"), "{}", again.stderr);
    assert_eq!(fs::read(folder.path().join("body.rs")).unwrap(), before);
    let json =
        ran_in(folder.path(), "export model.toml --to rust -o body.rs --order 5 --overwrite --json").json();
    assert_eq!((&json["order"], &json["holds"]), (&5.into(), &true.into()));
    let printed = ran_in(folder.path(), "export model.toml --to rust -o - --order 5").stdout;
    assert!(printed.contains("pub fn step"), "{printed}");
    ran_in(folder.path(), "export model.toml --to c -o body");
    assert!(ran_in(folder.path(), "export model.toml --to c -o body").refusal().contains("never replaced"));
}

#[test]
fn files_of_a_body_have_names_of_their_own() {
    let still = MODEL.replace("[0.12, 0.035, 0.02]", "[0.0, 0.0, 0.0]");
    let folder = folder_with(&still);
    for (name, target) in [("fmi2.fmu", "fmu2"), ("fmu.fmu", "fmu3"), ("self_test", "c")] {
        let ran = ran_in(folder.path(), &format!("export model.toml --to {target} -o {name}"));
        assert_eq!(
            (ran.code, ran.stderr.contains("No angular momentum")),
            (Some(0), false),
            "{}",
            ran.stderr
        );
    }
    assert_eq!(
        names(folder.path().join("self_test")),
        ["README.md", "self-test.c", "self_test.c", "self_test.h"]
    );
    let bytes = ["fmi2.fmu", "fmu.fmu"].map(|file| fs::read(folder.path().join(file)).unwrap());
    assert!(bytes.iter().all(|bytes| bytes.starts_with(b"PK")));
    let again = ran_in(folder.path(), "export model.toml --to fmu3 -o fmu.fmu --overwrite");
    assert_eq!((again.code, fs::read(folder.path().join("fmu.fmu")).unwrap() == bytes[1]), (Some(0), true));
}

#[test]
fn equations_that_do_not_hold_say_so_first() {
    let fast = MODEL.replace("[0.12, 0.035, 0.02]", "[12.0, 35.0, 20.0]");
    let folder = folder_with(&fast);
    let ran = ran_in(folder.path(), "export model.toml --to python -o body.py");
    assert_eq!(ran.code, Some(1), "{}", ran.stderr);
    assert!(one_line(&ran.stderr).contains("DO NOT HOLD at this spin"), "{}", ran.stderr);
    let text = fs::read_to_string(folder.path().join("body.py")).unwrap();
    let second = text.lines().nth(1).unwrap();
    assert!(second.contains("The reduced equations DO NOT HOLD"), "{second}");
}

#[test]
fn momentum_wheels_and_names_travel() {
    let model = MODEL.replace(
        "[initial]",
        "[[wheel]]\naxis = [0.6, 0, 0.8]\ninertia = 0.1\nspeed = \"300 rpm\"\n[body]\nname = \"a */ b \\\\ %\"\n[initial]",
    );
    if !is_there("cc") {
        return;
    }
    let folder = folder_with(&model);
    let ran = ran_in(folder.path(), "export model.toml --to c -o wheel");
    assert_eq!(ran.code, Some(0), "{}", ran.stderr);
    let within = folder.path().join("wheel");
    said(
        &within,
        "cc",
        &[&STRICT[..], &SANITIZED, &["-o", "test", "wheel.c", "self-test.c", "-lm"]].concat(),
    );
    let printed = said(&within, "./test", &[]);
    assert!(printed.contains("angular momentum of an angular velocity"), "{printed}");
}
