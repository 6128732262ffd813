//! `derive`: orders, formats, refusals.

use insta::assert_snapshot;

use crate::support::{MODEL, ran, ran_with};

#[test]
fn order_of_the_file_holds_unless_the_command_gives_one() {
    let model = MODEL.replace("[run]", "[run]\norder = 2");
    assert_eq!(ran_with(&model, "derive model.toml --json").json()["order"], 2);
    assert_eq!(ran_with(&model, "derive model.toml --json --order 4").json()["order"], 4);
}

#[test]
fn formats_are_printed_as_the_library_writes_them() {
    let latex = ran("derive examples/three-masses/model.toml --format latex");
    assert_eq!((latex.code, &*latex.stderr), (Some(0), ""));
    assert!(latex.stdout.starts_with('%') && latex.stdout.ends_with('\n'), "{}", latex.stdout);
    let [option, format] = ["--json", "--format json"]
        .map(|option| ran(&format!("derive examples/axial-mass/model.toml {option}")).stdout);
    assert_eq!(option, format);
}

#[test]
fn order_out_of_range_is_refused() {
    let refused = ran("derive examples/axial-mass/model.toml --order 13");
    assert_snapshot!(refused.refusal(), @"quasirigid: order 13 is not available; choose 0 (rigid) to 12, 3 is the paper's");
    for order in ["-1", "2.5", "three"] {
        let refused = ran(&format!("derive examples/axial-mass/model.toml --order {order}"));
        assert!(refused.refusal().contains(&format!("invalid value '{order}' for '--order <P>'")));
    }
}
