//! Table of readers' cases: every test that it names exists.

use crate::finding::Finding;
use crate::tree::Tree;

const TABLE: &str = "benchmarks/cases/README.md";
/// Column of the tests.
const TESTS: usize = 5;

/// Finds rows without a test, and names of tests that no file has.
pub fn check(tree: &Tree) -> Vec<Finding> {
    let text = tree.text(TABLE).unwrap_or_default();
    let numbered = text.lines().enumerate().map(|(at, line)| (at + 1, line));
    let rows = numbered.filter(|(_, line)| line.starts_with("| ") && line.contains('/'));
    rows.flat_map(|(at, line)| {
        of_row(tree, line).into_iter().map(move |what| Finding::error(TABLE, at, what))
    })
    .collect()
}

/// What is wrong with the tests of a row.
fn of_row(tree: &Tree, line: &str) -> Vec<String> {
    let column = line.replace("\\|", " ").split('|').nth(TESTS).unwrap_or_default().to_owned();
    let tests: Vec<&str> = column.split('`').filter(|name| name.contains("::")).collect();
    if tests.is_empty() {
        return vec!["no test keeps this case: name one as `path::function`".to_owned()];
    }
    tests.into_iter().filter_map(|test| missing(tree, test)).collect()
}

/// Says that a test is missing.
fn missing(tree: &Tree, test: &str) -> Option<String> {
    let (file, function) = test.split_once("::")?;
    let path = format!("crates/{file}");
    let named = |text: &str| ["fn", "def"].iter().any(|word| text.contains(&format!("{word} {function}(")));
    let found = tree.text(&path).is_some_and(named);
    (!found).then(|| format!("{path} has no test {function}"))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::tree::sample;

    #[test]
    fn tests_that_are_not_there_are_found() {
        let row = |tests: &str| format!("| a/01 | modes | \\|K\\| | 1 | {tests} |\n");
        let table = row("`c/t.rs::one`; `c/p.py::test_two`") + &row("`c/t.rs::two`") + &row("NONE");
        let tree = sample(&[
            (TABLE, &table),
            ("crates/c/t.rs", "fn one() {}"),
            ("crates/c/p.py", "def test_two(x):"),
        ]);
        let found: Vec<(usize, String)> =
            check(&tree).into_iter().map(|one| (one.line, one.message)).collect();
        assert_eq!(found.len(), 2, "{found:?}");
        assert!(found[0].0 == 2 && found[0].1.contains("crates/c/t.rs has no test two"), "{found:?}");
        assert!(found[1].0 == 3 && found[1].1.contains("no test keeps this case"), "{found:?}");
    }
}
