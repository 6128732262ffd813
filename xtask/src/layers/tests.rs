//! Tests of the layers on small workspaces: sideways imports in every spelling, foreign types.
//! Each forbidden form is a separate text, since one that is missed would open a way round the whole table.

use crate::tree::sample;

/// Findings in a crate whose `dynamics/form.rs` is `form`, as `line: message`.
fn in_dynamics(form: &str) -> Vec<String> {
    found(&[
        ("crates/quasirigid-dynamics/src/lib.rs", "pub mod dynamics;\npub use dynamics::form;\n"),
        ("crates/quasirigid-dynamics/src/dynamics/mod.rs", "pub mod form;\n"),
        ("crates/quasirigid-dynamics/src/dynamics/form.rs", form),
    ])
}

fn found(files: &[(&str, &str)]) -> Vec<String> {
    let findings = super::check(&sample(files));
    findings.iter().map(|finding| format!("{}: {}", finding.line, finding.message)).collect()
}

const SIDEWAYS: &str = "`dynamics` may not use `reduction`; it may use `math`, `model`";

#[test]
fn a_module_may_use_itself_and_what_the_table_allows() {
    let form = "use crate::{math::Sym, model::{self, Inertia}};\nuse super::form as own;\nuse std::fmt;\n\
                pub(crate) fn f(x: crate::dynamics::form::X) -> f64 { crate::math::g(self::h()) }\n\
                mod inner { use super::super::reduction; }\n";
    assert_eq!(in_dynamics(form), Vec::<String>::new());
}

#[test]
fn a_sideways_import_is_found_however_it_is_written() {
    for form in [
        "\nuse crate::reduction::reduce;",
        "use crate::{math::Sym,\n  reduction::{self, reduce}};",
        "\nuse super::super::reduction;",
        "\nfn f() { crate::reduction::reduce() }",
        "\nfn f(x: &[crate::reduction::Reduced]) {}",
        "\nfn f() -> String { format!(\"{}\", 2.0 * crate::reduction::X) }",
        "mod inner {\n  use super::super::super::reduction::X; }",
        "\nimpl crate::reduction::Law for f64 {}",
        "\nfn f(x: Vec<crate::reduction::Reduced>) {}",
        "\nfn f() { print!(\"{}\", (crate::reduction::X)) }",
        "mod inner {}\nuse super::super::reduction;",
    ] {
        let mut findings = in_dynamics(form);
        findings.dedup();
        assert_eq!(findings, [format!("2: {SIDEWAYS}")], "{form}");
    }
}

#[test]
fn the_modules_form_a_star() {
    const WORKERS: [&str; 4] = ["reduction", "dynamics", "averaging", "modes"];
    let uses = |user: &str, used: &str| {
        let root = format!("mod {user};");
        let text = format!("use crate::{used}::X;");
        let path = format!("crates/quasirigid-dynamics/src/{user}.rs");
        found(&[("crates/quasirigid-dynamics/src/lib.rs", &root), (&path, &text)]).is_empty()
    };
    for worker in WORKERS {
        assert!(uses(worker, "math") && uses(worker, "model"), "{worker}");
        assert!(uses("verification", worker) && !uses(worker, "verification"), "{worker}");
        assert!(WORKERS.iter().all(|other| uses(worker, other) == (worker == *other)), "{worker}");
    }
}

#[test]
fn what_elements_are_computed_with_knows_no_element() {
    let flow = |text| {
        let root = ("crates/quasirigid-elements/src/lib.rs", "mod flow;\nmod kinds;");
        found(&[
            root,
            ("crates/quasirigid-elements/src/flow.rs", text),
            ("crates/quasirigid-elements/src/kinds.rs", "use crate::Point;"),
        ])
    };
    assert_eq!(flow("use crate::finite::Block; use quasirigid_mesh::Mesh;"), [""; 0]);
    assert_eq!(
        flow("use crate::Point;"),
        ["1: `flow` may not use `Point`; it may use `math`, `model`, `finite`"]
    );
}

#[test]
fn the_crate_root_is_no_way_round_the_table() {
    for (form, name) in
        [("use crate::*;", "*"), ("use crate::Reduced;", "Reduced"), ("use crate as q;", "self")]
    {
        let message = format!("1: `dynamics` may not use `{name}`; it may use `math`, `model`");
        assert_eq!(in_dynamics(form), [message], "{form}");
    }
}

#[test]
fn tests_may_use_anything() {
    let form = "#[cfg(test)]\nmod tests { use crate::reduction::reduce; }\n#[cfg(test)]\nmod far;\n\
                #[cfg(test)]\nuse crate::reduction::X;\n#[test]\nfn t() { crate::reduction::reduce() }\n";
    assert_eq!(in_dynamics(form), Vec::<String>::new());
}

#[test]
fn modules_without_a_file_are_found() {
    let findings = found(&[("crates/quasirigid-cli/src/main.rs", "mod lost;")]);
    assert_eq!(findings, ["1: module `lost` has no file in crates/quasirigid-cli/src"]);
}

#[test]
fn foreign_types_in_public_signatures_are_found() {
    for form in [
        "pub fn f() -> nalgebra::DVector<f64> {}",
        "use nalgebra::DVector;\npub fn f(x: Option<&DVector<f64>>) {}",
        "use nalgebra::DVector as V;\npub struct S { pub x: V<f64> }",
        "pub type T = [Matrix3<f64>; 2];",
        "pub enum E { A(Vector3<f64>) }",
        "pub struct S;\nimpl S { pub fn f(&self, q: UnitQuaternion<f64>) {} }",
        "pub trait T { fn f(&self) -> DMatrix<f64>; }",
        "pub const X: Vector3<f64> = Y;",
        "use nalgebra::base::{storage::DVector};\npub fn f(x: DVector<f64>) {}",
        "pub mod inner { use nalgebra::DVector;\npub fn f(x: DVector<f64>) {} }",
    ] {
        let findings = in_dynamics(form);
        assert_eq!(findings.len(), 1, "{form}: {findings:?}");
        assert!(findings[0].ends_with("is a foreign type in a public signature"), "{findings:?}");
    }
}

#[test]
fn foreign_types_behind_the_signature_are_our_own_business() {
    let form = "use nalgebra::{Matrix3, Vector3};\npub struct S(Matrix3<f64>);\n\
                impl S { pub(crate) fn m(&self) -> Matrix3<f64> { self.0 } fn v(&self) -> Vector3<f64> { x } }\n\
                pub(super) struct Piece { pub first: Vector3<f64> }\n\
                impl Piece { pub fn rigid(center: Vector3<f64>) -> Self { Self { first: center } } }\n\
                enum Side { Left }\nimpl Side { pub fn normal(&self) -> Vector3<f64> { x } }\n\
                #[doc(hidden)]\npub fn h(x: Vector3<f64>) {}\n\
                impl Add<Vector3<f64>> for S { fn add(self, x: Vector3<f64>) -> Self { self } }\n\
                pub fn f(x: [f64; 3]) -> [f64; 3] { Vector3::from(x).into() }\n";
    assert_eq!(in_dynamics(form), Vec::<String>::new());
}
