//! The list of unsafe code in `docs/reliability.md` is true: every file with such code has a row, with the number of its unsafe blocks and
//! implementations.

use std::collections::BTreeMap;

use syn::visit::{self, Visit};
use syn::{ExprUnsafe, ItemForeignMod, ItemImpl};

use crate::finding::Finding;
use crate::tree::Tree;

const LIST: &str = "docs/reliability.md";

/// Rows of the list that the code does not have, and code that has no row.
pub fn check(tree: &Tree) -> Vec<Finding> {
    let Some(text) = tree.text(LIST) else { return Vec::new() };
    let mut findings = Vec::new();
    let mut found: BTreeMap<&str, Places> = BTreeMap::new();
    for (path, source) in ["crates", "fuzz", "xtask"].iter().flat_map(|folder| tree.files(folder, ".rs")) {
        if !source.contains("unsafe") {
            continue;
        }
        match syn::parse_file(source) {
            Ok(syntax) => {
                let mut places = Places::default();
                places.visit_file(&syntax);
                if places.count > 0 {
                    found.insert(path, places);
                }
            }
            Err(error) => findings.push(Finding::error(path, error.span().start().line, error.to_string())),
        }
    }
    for (line, path, listed) in rows(text) {
        match found.remove(path) {
            Some(Places { count, .. }) if count == listed => {}
            Some(Places { count, .. }) => {
                findings.push(Finding::error(
                    LIST,
                    line,
                    format!("{path} has {count} unsafe places, not {listed}"),
                ));
            }
            None => findings.push(Finding::error(LIST, line, format!("{path} has no unsafe code"))),
        }
    }
    let unlisted = found.iter().map(|(path, places)| {
        Finding::error(path, places.first, format!("unsafe code without a row in {LIST}"))
    });
    findings.extend(unlisted);
    findings
}

/// Rows ``| `crates/a/src/b.rs` | 2 | reason |`` of the list, with their lines.
fn rows(text: &str) -> impl Iterator<Item = (usize, &str, usize)> {
    (1..).zip(text.lines()).filter_map(|(line, row)| {
        let mut cells = row.strip_prefix("| `")?.split('|');
        let path = cells.next()?.trim().strip_suffix('`')?;
        Some((line, path, cells.next()?.trim().parse().ok()?))
    })
}

/// Unsafe blocks and implementations of a file.
#[derive(Default)]
struct Places {
    count: usize,
    /// Line of the first.
    first: usize,
}

impl Places {
    fn add(&mut self, line: usize) {
        self.count += 1;
        if self.first == 0 {
            self.first = line;
        }
    }
}

impl<'ast> Visit<'ast> for Places {
    fn visit_expr_unsafe(&mut self, block: &'ast ExprUnsafe) {
        self.add(block.unsafe_token.span.start().line);
        visit::visit_expr_unsafe(self, block);
    }

    fn visit_item_impl(&mut self, item: &'ast ItemImpl) {
        if let Some(token) = &item.unsafety {
            self.add(token.span.start().line);
        }
        visit::visit_item_impl(self, item);
    }

    fn visit_item_foreign_mod(&mut self, item: &'ast ItemForeignMod) {
        if let Some(token) = &item.unsafety {
            self.add(token.span.start().line);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::check;
    use crate::tree::sample;

    const CODE: &str = "// unsafe in words\nunsafe impl Send for A {}\nfn f() {\n    unsafe { g() }\n}\n";

    fn found(list: &str) -> Vec<String> {
        let safe = ("crates/a/src/safe.rs", "fn unsafe_name() { \"unsafe {}\"; }");
        let tree = sample(&[("crates/a/tests/b.rs", CODE), safe, ("docs/reliability.md", list)]);
        check(&tree).iter().map(ToString::to_string).collect()
    }

    #[test]
    fn a_true_list_passes() {
        assert_eq!(found("| file | places |\n|---|---|\n| `crates/a/tests/b.rs` | 2 | reason |\n"), [""; 0]);
    }

    #[test]
    fn code_without_a_row_is_found() {
        assert_eq!(found(""), ["crates/a/tests/b.rs:2: unsafe code without a row in docs/reliability.md"]);
    }

    #[test]
    fn a_row_with_another_number_or_without_code_is_found() {
        assert_eq!(
            found("| `crates/a/tests/b.rs` | 1 | x |\n\n| `crates/a/src/safe.rs` | 1 | x |\n"),
            [
                "docs/reliability.md:1: crates/a/tests/b.rs has 2 unsafe places, not 1",
                "docs/reliability.md:3: crates/a/src/safe.rs has no unsafe code",
            ]
        );
    }
}
