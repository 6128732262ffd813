//! Tests of labels and keys on small workspaces: undefined, uncited, doubly defined, excused.
//! Strings and function calls that look like labels must not count: `f(R4)` and `"(R4)"` are code.

use super::{judged, labels};
use crate::tree::sample;

const THEORY: (&str, &str) = ("docs/theory/03.md", "**(R4)**\n\nas in (R4) and [@carr1981]\n");
const CODE: (&str, &str) = ("crates/a/src/lib.rs", "fn f() {} // (R4)\n");
const BIB: (&str, &str) = ("docs/references.bib", "% keys\n@book{carr1981,\n  year = {1981}\n}\n");

fn found(files: &[(&str, &str)]) -> Vec<String> {
    super::check(&sample(files)).iter().map(ToString::to_string).collect()
}

#[test]
fn labels_and_keys_that_exist_pass() {
    let more = ("crates/a/tests/laws.rs", "/// (R4)\n///\n/// # References\n/// carr1981, p. 3\nfn f() {}\n");
    assert_eq!(found(&[THEORY, CODE, BIB, more]), [""; 0]);
}

#[test]
fn a_label_without_a_definition_is_found_in_code_and_documents() {
    let code = ("crates/a/src/b.rs", "\n/// (R4) and (V12)\n");
    let test = ("crates/a/tests/b.rs", "// (R3)\n");
    let guide = ("docs/guide/x.md", "(S7)\n");
    let readme = ("README.md", "\n\n(P1)\n");
    assert_eq!(
        found(&[THEORY, CODE, BIB, code, test, guide, readme]),
        [
            "docs/guide/x.md:1: (S7) is not defined in docs/theory",
            "README.md:3: (P1) is not defined in docs/theory",
            "crates/a/src/b.rs:2: (V12) is not defined in docs/theory",
            "crates/a/tests/b.rs:1: (R3) is not defined in docs/theory",
        ]
    );
}

#[test]
fn only_comments_of_sources_and_tests_cite() {
    let strings = ("crates/a/src/b.rs", "const X: &str = \"(R9)\"; fn f(R8: f64) -> f64 { (R8) }\n");
    let bench = ("crates/a/benches/b.rs", "// (R7)\n");
    assert_eq!(found(&[THEORY, CODE, BIB, strings, bench]), [""; 0]);
    let unused = found(&[THEORY, BIB, ("crates/a/src/lib.rs", "const X: &str = \"(R4)\";\n")]);
    assert_eq!(unused, ["docs/theory/03.md:1: (R4) is not cited in code"]);
}

#[test]
fn a_label_defined_twice_is_found() {
    let again = ("docs/theory/04.md", "text\n**(R4)**\n");
    let message = "docs/theory/04.md:2: (R4) is already defined at docs/theory/03.md:1";
    assert_eq!(found(&[THEORY, CODE, BIB, again]), [message]);
}

#[test]
fn a_label_may_be_excused_from_the_code_as_long_as_the_excuse_holds() {
    let excused = [("X1", "a remark")];
    let say =
        |label, is_cited| judged(label, ("a", 1), is_cited, &excused).map(|finding| finding.to_string());
    assert_eq!(say("X1", false).as_deref(), Some("a:1: warning: (X1) is not cited in code: a remark"));
    assert_eq!(say("X1", true).as_deref(), Some("a:1: (X1) is cited in code, so it needs no excuse"));
    assert_eq!(say("X2", false).as_deref(), Some("a:1: (X2) is not cited in code"));
    assert_eq!(say("X2", true), None);
}

#[test]
fn a_key_that_the_bibliography_lacks_is_found() {
    let guide = ("docs/guide/x.md", "[@carr1981; see @odd2001, p. 3] and [a@b2002.org]\n[@Odd:1]\n");
    let code = (
        "crates/a/src/b.rs",
        "/// odd2002\n///\n/// # References\n/// odd2003, odd2004b, dop853\n\n// odd2005 [@odd2006]\n",
    );
    assert_eq!(
        found(&[THEORY, CODE, BIB, guide, code]),
        [
            "docs/guide/x.md:1: odd2001 is not in docs/references.bib",
            "docs/guide/x.md:2: Odd is not in docs/references.bib",
            "crates/a/src/b.rs:4: odd2003 is not in docs/references.bib",
            "crates/a/src/b.rs:4: odd2004b is not in docs/references.bib",
            "crates/a/src/b.rs:6: odd2006 is not in docs/references.bib",
        ]
    );
}

#[test]
fn a_label_is_a_letter_and_digits_in_a_parenthesis_of_its_own() {
    assert_eq!(labels("(R4), **(S12)** and ((V1))"), ["R4", "S12", "V1"]);
    assert_eq!(labels("f(R4) f_(R4) (R123) (u1) (R) (R4, R5) (2.8) (R-1) (R4"), [""; 0]);
}
