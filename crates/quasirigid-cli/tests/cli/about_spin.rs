//! Reduced equations about the spin: the verdicts of `derive` and `simulate` first, their refusals in words.

use crate::support::{MODEL, Ran, Table, one_line, ran, ran_with};

const EXPLORER: &str = "examples/explorer1/model.toml";

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

#[test]
fn a_history_that_leaves_the_range_says_so_first() {
    let ran = ran(&format!("simulate {EXPLORER} --system spin-manifold --times 0,5,30"));
    assert_eq!(ran.code, Some(1));
    assert!(ran.stderr.starts_with("quasirigid: The history LEFT THE RANGE"), "{}", ran.stderr);
    assert_eq!(Table::of(&ran.stdout).rows.len(), 3);
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
    let apophis = ran("derive examples/apophis/model.toml --about spin");
    assert!(one_line(apophis.refusal()).contains("has no equations of motion of its own"), "{apophis:?}");
    let cases: [(&str, &str, &str); 10] = [
        (&forced, "derive model.toml --about spin", "without external forces (push)"),
        (&forced, "simulate model.toml --system spin-manifold", "follow it with --system full"),
        (&driven, "derive model.toml --about spin", "without external forces"),
        (&sphere, "derive model.toml --about spin", "in no mode about this spin does"),
        (MODEL, "derive model.toml --about spin --degree 12", "lies from 1 to 11"),
        (
            MODEL,
            "derive model.toml --about spin --masters 1e3",
            "no mode about this spin beside the nutation",
        ),
        (MODEL, "derive model.toml --about spin --masters 1,2,3,4", "names no masters"),
        (MODEL, "derive model.toml --about spin --axis middle", "take --axis least or greatest"),
        (&stop, "simulate model.toml --system spin-manifold", "support no events"),
        (MODEL, "derive model.toml --degree 3", "add --about spin"),
    ];
    for (model, line, message) in cases {
        let ran: Ran = ran_with(model, line);
        assert!(one_line(ran.refusal()).contains(message), "{line}: {ran:?}");
    }
}
