//! Imports of a source file: every path that it names outside its tests, resolved to the crate root.
//! `use` items are not enough: paths stand in types, expressions and macros too, whose tokens `syn` leaves unparsed.

use proc_macro2::{TokenStream, TokenTree};
use syn::visit::{self, Visit};
use syn::{Item, ItemMod, ItemUse, Macro, Path, UseTree};

use super::source::{Source, attributes, is_test};

/// A path that a source file names.
pub struct Import {
    /// Segments of the path; a path in our own crate starts with the crate's name.
    pub path: Vec<String>,
    /// Line, from 1.
    pub line: usize,
}

/// Every path the file names outside its tests: in `use` items however nested, in types and expressions, in macros.
///
/// `krate` is the crate's name in paths; `crate`, `self` and `super` are resolved to it.
pub fn of(source: &Source, krate: &str) -> Vec<Import> {
    let mut names = Names { krate, module: source.module.clone(), found: Vec::new() };
    names.visit_file(&source.syntax);
    names.found
}

struct Names<'a> {
    krate: &'a str,
    module: Vec<String>,
    found: Vec<Import>,
}

impl Names<'_> {
    fn note(&mut self, segments: &[String], line: usize) {
        let path = self.resolved(segments);
        self.found.push(Import { path, line });
    }

    fn resolved(&self, segments: &[String]) -> Vec<String> {
        let ours = |depth: usize, rest: &[String]| {
            let here = self.module[..depth].iter().cloned();
            std::iter::once(self.krate.to_owned()).chain(here).chain(rest.iter().cloned()).collect()
        };
        let local = segments.first().is_some_and(|first| first == "self");
        let rest = &segments[usize::from(local)..];
        let up = rest.iter().take_while(|segment| *segment == "super").count();
        match rest.first() {
            Some(first) if first == "crate" => ours(0, &rest[1..]),
            _ if local || up > 0 => ours(self.module.len().saturating_sub(up), &rest[up..]),
            _ => rest.to_vec(),
        }
    }

    fn note_use(&mut self, tree: &UseTree, prefix: &[String]) {
        match tree {
            UseTree::Path(path) => {
                self.note_use(&path.tree, &[prefix, &[path.ident.to_string()]].concat());
            }
            UseTree::Group(group) => {
                group.items.iter().for_each(|item| self.note_use(item, prefix));
            }
            UseTree::Name(leaf) => self.note_leaf(prefix, &leaf.ident),
            UseTree::Rename(leaf) => self.note_leaf(prefix, &leaf.ident),
            UseTree::Glob(glob) => {
                let line = glob.star_token.spans[0].start().line;
                self.note(&[prefix, &["*".to_owned()]].concat(), line);
            }
        }
    }

    fn note_leaf(&mut self, prefix: &[String], leaf: &syn::Ident) {
        let name = leaf.to_string();
        let line = leaf.span().start().line;
        if prefix.is_empty() {
            self.note(&[name, "self".to_owned()], line); // `use faer;` takes all of it
        } else {
            self.note(&[prefix, &[name]].concat(), line);
        }
    }

    /// Paths among the tokens of a macro, which `syn` does not parse.
    fn note_tokens(&mut self, tokens: TokenStream) {
        let mut run: Vec<String> = Vec::new();
        let (mut line, mut colons) = (0, 0);
        for token in tokens {
            match token {
                TokenTree::Punct(mark) if mark.as_char() == ':' => colons += 1,
                TokenTree::Ident(name) if colons == 2 && !run.is_empty() => {
                    run.push(name.to_string());
                    colons = 0;
                }
                other => {
                    self.note(&std::mem::take(&mut run), line);
                    colons = 0;
                    match other {
                        TokenTree::Ident(name) => {
                            line = name.span().start().line;
                            run.push(name.to_string());
                        }
                        TokenTree::Group(group) => self.note_tokens(group.stream()),
                        _ => {}
                    }
                }
            }
        }
        self.note(&run, line);
    }
}

impl<'ast> Visit<'ast> for Names<'_> {
    fn visit_item(&mut self, item: &'ast Item) {
        if !is_test(attributes(item)) {
            visit::visit_item(self, item);
        }
    }

    fn visit_item_mod(&mut self, item: &'ast ItemMod) {
        self.module.push(item.ident.to_string());
        visit::visit_item_mod(self, item);
        self.module.pop();
    }

    fn visit_item_use(&mut self, item: &'ast ItemUse) {
        self.note_use(&item.tree, &[]);
    }

    fn visit_path(&mut self, path: &'ast Path) {
        let segments: Vec<String> = path.segments.iter().map(|part| part.ident.to_string()).collect();
        let line = path.segments.first().map_or(0, |first| first.ident.span().start().line);
        self.note(&segments, line);
        visit::visit_path(self, path);
    }

    fn visit_macro(&mut self, call: &'ast Macro) {
        visit::visit_macro(self, call);
        self.note_tokens(call.tokens.clone());
    }
}
