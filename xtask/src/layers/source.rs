//! Source files of a crate with their modules, found from the root along `mod` items as the compiler finds them.
//! A listing of the folder would count files that no module names, and would not know which are tests.

use syn::{Attribute, Item};

use crate::finding::Finding;
use crate::tree::Tree;

/// A source file of a crate, with its place in the tree of modules.
pub struct Source {
    /// Path relative to the workspace root.
    pub path: String,
    /// Names of the modules from the crate root to this file; empty for the root.
    pub module: Vec<String>,
    /// The parsed file.
    pub syntax: syn::File,
}

/// Source files of a crate, found as the compiler finds them: from the root along `mod` items, leaving out tests and what is hidden from
/// the documentation. The findings name files that could not be parsed or found.
pub fn of_crate(tree: &Tree, package: &str) -> (Vec<Source>, Vec<Finding>) {
    let (mut sources, mut findings) = (Vec::new(), Vec::new());
    for root in ["lib.rs", "main.rs"] {
        let path = format!("crates/{package}/src/{root}");
        if tree.exists(&path) {
            follow(tree, path, Vec::new(), &mut sources, &mut findings);
        }
    }
    (sources, findings)
}

fn follow(
    tree: &Tree,
    path: String,
    module: Vec<String>,
    sources: &mut Vec<Source>,
    findings: &mut Vec<Finding>,
) {
    let syntax = match syn::parse_file(tree.text(&path).unwrap_or_default()) {
        Ok(syntax) => syntax,
        Err(error) => {
            findings.push(Finding::error(&path, error.span().start().line, error.to_string()));
            return;
        }
    };
    let folder = folder_of_children(&path);
    for item in &syntax.items {
        let Item::Mod(child) = item else { continue };
        if child.content.is_some() || is_test(&child.attrs) || is_hidden(&child.attrs) {
            continue;
        }
        let name = child.ident.to_string();
        let places = [format!("{folder}/{name}.rs"), format!("{folder}/{name}/mod.rs")];
        match places.into_iter().find(|place| tree.exists(place)) {
            Some(place) => follow(tree, place, [module.as_slice(), &[name]].concat(), sources, findings),
            None => {
                let message = format!("module `{name}` has no file in {folder}");
                findings.push(Finding::error(&path, child.ident.span().start().line, message));
            }
        }
    }
    sources.push(Source { path, module, syntax });
}

fn folder_of_children(path: &str) -> &str {
    let (folder, name) = path.rsplit_once('/').unwrap_or_default();
    match name {
        "lib.rs" | "main.rs" | "mod.rs" => folder,
        _ => path.trim_end_matches(".rs"),
    }
}

/// Whether an item is left out of the library: `#[cfg(test)]` or `#[test]`.
pub fn is_test(attributes: &[Attribute]) -> bool {
    attributes.iter().any(|attribute| {
        let of_tests = || attribute.parse_args::<syn::Ident>().is_ok_and(|condition| condition == "test");
        attribute.path().is_ident("test") || (attribute.path().is_ident("cfg") && of_tests())
    })
}

/// Whether an item is for our own crates alone: `#[doc(hidden)]`.
pub fn is_hidden(attributes: &[Attribute]) -> bool {
    attributes.iter().any(|attribute| {
        let hidden = || attribute.parse_args::<syn::Ident>().is_ok_and(|word| word == "hidden");
        attribute.path().is_ident("doc") && hidden()
    })
}

/// Attributes of the items that tests are made of.
pub fn attributes(item: &Item) -> &[Attribute] {
    match item {
        Item::Const(item) => &item.attrs,
        Item::Fn(item) => &item.attrs,
        Item::Impl(item) => &item.attrs,
        Item::Mod(item) => &item.attrs,
        Item::Struct(item) => &item.attrs,
        Item::Use(item) => &item.attrs,
        _ => &[],
    }
}
