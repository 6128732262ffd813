//! Files of matrices that describe no body.

use insta::assert_snapshot;

use super::located;
use super::matrices::{beside, market};

/// Two nodes on springs, of three displacements each.
fn files() -> Vec<(&'static str, String)> {
    let spring = |i: usize, j: usize| if i == j { 9.0 } else { 0.5 };
    let lumped = |i: usize, j: usize| if i == j { 2.0 } else { 0.0 };
    let of = |entry: &dyn Fn(usize, usize) -> f64| {
        market(&(0..6).map(|i| (0..6).map(|j| entry(i, j)).collect()).collect::<Vec<_>>())
    };
    vec![
        ("nodes.txt", "3 0 0 0\n7 1 0 0.5\n".to_owned()),
        ("K.mtx", of(&spring)),
        ("M.mtx", of(&lumped)),
        ("rows.dof", "3.1\n3.2\n3.3\n7.1\n7.2\n7.3\n".to_owned()),
    ]
}

const KEYS: &str = "nodes = \"nodes.txt\"\nstiffness = \"K.mtx\"\nmass = \"M.mtx\"\n";

/// How these lines, which start in line 6, are refused beside files of which one is replaced; by reading or by the
/// laws of mechanics.
fn with(replaced: (&'static str, &str), lines: &str) -> String {
    let mut files = files();
    files.retain(|(name, _)| *name != replaced.0);
    files.push((replaced.0, replaced.1.to_owned()));
    let model = match beside(&files, lines) {
        Err(error) => return located(&error),
        Ok(model) => model,
    };
    let errors = model.assembly.check();
    if errors.is_empty() {
        located(&model.diagnose(&model.assembly.body().expect_err("a refusal")))
    } else {
        located(&model.diagnose_all(&errors))
    }
}

fn refused(lines: &str) -> String {
    with(("other.txt", ""), lines)
}

/// A matrix that is a number on its diagonal but for some entries, by their rows and columns from 1.
fn diagonal(size: usize, value: f64, others: &[(usize, usize, f64)]) -> String {
    let mut text =
        format!("%%MatrixMarket matrix coordinate real general\n{size} {size} {}\n", size + others.len());
    let changed = |row: usize| others.iter().any(|(i, j, _)| (*i, *j) == (row, row));
    let kept = (1..=size).filter(|row| !changed(*row));
    let entries: Vec<(usize, usize, f64)> =
        kept.map(|row| (row, row, value)).chain(others.iter().copied()).collect();
    text = text.replace(&(size + others.len()).to_string(), &entries.len().to_string());
    entries.iter().for_each(|(i, j, value)| text += &format!("{i} {j} {value}\n"));
    text
}

#[test]
fn a_table_that_lacks_a_file_is_refused() {
    assert_snapshot!(refused("nodes = \"nodes.txt\"\n"), @"");
    assert_snapshot!(refused(&KEYS.replace("K.mtx", "K.sti")), @"");
    assert_snapshot!(refused(&format!("{KEYS}freedoms = \"M.mtx\"\n")), @"");
    assert_snapshot!(refused(&format!("{KEYS}damping = {{ name = \"B\" }}\n")), @"");
    assert_snapshot!(refused(&KEYS.replace("\"K.mtx\"", "{ file = \"K.mtx\", name = \"K\" }")), @"");
    assert_snapshot!(refused(&format!("{KEYS}length_unit = \"kg\"\nmass_unit = \"mm\"\n")), @"");
    assert_snapshot!(refused(&format!("{KEYS}unit = \"mm\"\n")), @"");
    assert_snapshot!(with(("nodes.txt", "3 0 0 0\n7 1 0 0.5\n3 1 1 1\n"), KEYS), @"");
    assert_snapshot!(refused(&format!("{KEYS}attach = [3, 4]\n")), @"");
}

#[test]
fn rows_that_are_about_nothing_are_refused() {
    let wide = "%%MatrixMarket matrix coordinate real general\n6 5 1\n1 1 2.0\n";
    assert_snapshot!(with(("K.mtx", wide), KEYS), @"");
    assert_snapshot!(with(("M.mtx", &diagonal(5, 2.0, &[])), KEYS), @"");
    let listed = format!("{KEYS}freedoms = \"rows.dof\"\n");
    assert_snapshot!(with(("M.mtx", &diagonal(7, 2.0, &[])), &listed), @"");
    assert_snapshot!(with(("rows.dof", "3.1\n3.2\n3.3\n7.1\n7.2\n8.3\n"), &listed), @"");
    assert_snapshot!(with(("rows.dof", "3.1\n3.2\n3.3\n7.1\n7.2\n7.2\n"), &listed), @"");
    let point = "DMIG,M,0,6,2,0\nDMIG,M,3,1,,3,1,2.\nDMIG,M,9,0,,9,0,2.\n";
    assert_snapshot!(with(("M.bdf", point), &KEYS.replace("M.mtx", "M.bdf")), @"");
}

#[test]
fn matrices_of_no_body_are_refused() {
    let attached = format!("{KEYS}attach = 3\n");
    assert_snapshot!(with(("K.mtx", &diagonal(6, 9.0, &[(5, 2, 1.0)])), &attached), @"");
    assert_snapshot!(with(("M.mtx", &diagonal(6, 2.0, &[(4, 4, -2.0)])), &attached), @"");
    assert_snapshot!(with(("M.mtx", &diagonal(6, 0.0, &[])), &attached), @"");
    assert_snapshot!(with(("K.mtx", &diagonal(6, 9.0, &[(6, 6, 0.0)])), &attached), @"");
}

#[test]
fn matrices_that_nothing_holds_are_refused() {
    assert_snapshot!(refused(KEYS), @"");
}
