//! Refusals of `simulate`: tolerances, rows, durations, times and options, each before any file is written.
//! Negative and infinite values reach the program as text, so flags accept hyphens and every range is checked here.

use insta::assert_snapshot;

use crate::support::{MODEL, folder_of, names, one_line, ran, ran_in, ran_with};

const AXIAL: &str = "simulate examples/axial-mass/model.toml";

fn refusal(options: &str) -> String {
    ran(&format!("{AXIAL} {options}")).refusal().to_owned()
}

#[test]
fn tolerance_out_of_range_is_refused() {
    assert_snapshot!(refusal("--tolerance 1"), @"quasirigid: the tolerance 1e0 is out of range; choose one from 1e-15 to 1e-2");
    for tolerance in ["0", "-1e-9", "1e-16", "nan", "inf"] {
        assert!(refusal(&format!("--tolerance {tolerance}")).contains("is out of range"), "{tolerance}");
    }
    assert!(refusal("--tolerance fine").contains("invalid value 'fine' for '--tolerance <X>'"));
}

#[test]
fn too_few_and_too_many_samples_are_refused() {
    assert_snapshot!(refusal("--samples 1"), @"quasirigid: --samples 1 is out of range; give 2 to 10000000");
    assert_snapshot!(refusal("--samples 10000001"), @"quasirigid: --samples 10000001 is out of range; give 2 to 10000000");
    assert!(refusal("--samples -3").contains("'-3'"));
}

#[test]
fn duration_that_is_none_is_refused() {
    assert_snapshot!(refusal("--duration 3kg"), @r#"
    quasirigid: --duration 3kg: "3kg" is a mass, but a time is needed; write for
    example "2 h", or a plain number in s
    "#);
    for (duration, shown) in [("0", "0"), ("-1", "-1"), ("nan", "NaN"), ("1e999", "inf"), ("-2.5h", "-9000")]
    {
        let message = refusal(&format!("--duration={duration}"));
        assert!(
            message.starts_with(&format!("quasirigid: --duration {shown} s is not a duration;")),
            "{message}"
        );
    }
    let message = refusal("--duration -2h"); // without an equals sign too
    assert!(message.contains("--duration -7200 s is not a duration"), "{message}");
    assert!(refusal("--duration soon").starts_with("quasirigid: --duration soon: "));
}

#[test]
fn times_that_descend_or_are_no_times_are_refused() {
    assert_snapshot!(refusal("--times 3,2"), @r"
    quasirigid: the output times must be finite, ascend and not be negative; 2 s
    follows 3 s
    ");
    for (times, shown) in [
        ("-1", "-1 s follows 0 s"),
        ("-1,2", "-1 s follows 0 s"),
        ("0,inf", "inf s follows 0 s"),
        ("nan", "NaN s follows 0 s"),
    ] {
        let message = refusal(&format!("--times {times}")).replace('\n', " ");
        assert!(message.contains(shown), "{times}: {message}");
    }
    assert!(refusal("--times 1,,2").contains("invalid value '' for '--times <A,B,C>'"));
    assert!(refusal("--times 1,soon").contains("invalid value 'soon' for '--times <A,B,C>'"));
}

#[test]
fn options_that_exclude_each_other_are_refused() {
    for (options, other) in
        [("--times 1 --duration 2", "--duration <T>"), ("--samples 3 --times 1", "--samples <N>")]
    {
        let message = refusal(options);
        assert!(message.contains("cannot be used with") && message.contains(other), "{message}");
    }
}

#[test]
fn unknown_choices_are_refused_with_the_known_ones() {
    for (options, known) in [
        ("--system ful", "[possible values: full, reduced, rigid, spin-manifold]"),
        ("--form spin", "[possible values: angular-momentum, angular-velocity]"),
        ("--format xml", "[possible values: csv, parquet, npz, aem, aem1, stk, msopck, basilisk]"),
    ] {
        let said = one_line(&refusal(options));
        assert!(said.contains(known), "{said}");
    }
}

#[test]
fn what_is_refused_leaves_no_file() {
    let folder = folder_of("axial-mass");
    for options in ["--tolerance 1", "--samples 1", "--times 2,1", "--duration 0", "--order 13"] {
        ran_in(folder.path(), &format!("simulate model.toml --out table.csv {options}")).refusal();
        assert_eq!(names(&folder), ["model.toml"], "{options}");
    }
}

/// Beyond a quarter turn there is no small motion about a spin that could be verified.
#[test]
fn amplitudes_that_no_equations_reach_are_refused() {
    for amplitude in ["180", "92", "0", "nan"] {
        let line = format!("verify model.toml --about spin --amplitude {amplitude}");
        let said = one_line(ran_with(MODEL, &line).refusal());
        assert!(said.contains("degrees is out of range; choose more than 0, and up to 91 degrees"), "{said}");
    }
}
