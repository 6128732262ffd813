//! Foreign types in public signatures: functions, fields, aliases and constants that show `nalgebra` or `faer`.
//! Names are followed through the imports of the file alone; the commonest types are known by name, however a file came by them.

use std::collections::BTreeSet;

use syn::visit::{self, Visit};
use syn::{
    Field, ImplItem, Item, ItemImpl, ItemTrait, Path, Signature, TraitItem, Type, UseTree, Visibility,
};

use super::source::{Source, attributes, is_hidden, is_test};
use crate::finding::Finding;

/// Libraries whose types stay inside.
const LIBRARIES: [&str; 2] = ["nalgebra", "faer"];

/// Types of these libraries that are known by name, however a file came by the name.
const TYPES: [&str; 5] = ["Vector3", "Matrix3", "UnitQuaternion", "Mat", "DMatrix"];

/// Public functions, fields, types and constants that show a foreign type.
pub fn check(source: &Source) -> Vec<Finding> {
    let mut shown = Shown {
        foreign: TYPES.iter().map(|&name| name.to_owned()).collect(),
        hidden: BTreeSet::new(),
        found: Vec::new(),
    };
    shown.learn(&source.syntax.items);
    shown.visit_file(&source.syntax);
    let message = |name| format!("`{name}` is a foreign type in a public signature");
    shown.found.into_iter().map(|(name, line)| Finding::error(&source.path, line, message(name))).collect()
}

/// Foreign types that the public items of a file show.
struct Shown {
    /// Names that stand for foreign types in this file.
    foreign: BTreeSet<String>,
    /// Types of this file that are not public, whose methods and fields are not public either.
    hidden: BTreeSet<String>,
    found: Vec<(String, usize)>,
}

impl Shown {
    fn learn(&mut self, items: &[Item]) {
        for item in items {
            match item {
                Item::Use(item) => self.learn_import(&item.tree, false),
                Item::Struct(item) if !is_public(&item.vis) => {
                    self.hidden.insert(item.ident.to_string());
                }
                Item::Enum(item) if !is_public(&item.vis) => {
                    self.hidden.insert(item.ident.to_string());
                }
                Item::Mod(item) => {
                    self.learn(item.content.as_ref().map_or(&[], |(_, items)| items));
                }
                _ => {}
            }
        }
    }

    fn learn_import(&mut self, tree: &UseTree, foreign: bool) {
        match tree {
            UseTree::Path(path) => {
                let entered = foreign || LIBRARIES.iter().any(|library| path.ident == library);
                self.learn_import(&path.tree, entered);
            }
            UseTree::Group(group) => {
                group.items.iter().for_each(|item| self.learn_import(item, foreign));
            }
            UseTree::Name(leaf) if foreign => {
                self.foreign.insert(leaf.ident.to_string());
            }
            UseTree::Rename(leaf) if foreign => {
                self.foreign.insert(leaf.rename.to_string());
            }
            _ => {}
        }
    }

    fn signature(&mut self, visibility: &Visibility, signature: &Signature) {
        if is_public(visibility) {
            Paths(self).visit_signature(signature);
        }
    }

    fn type_(&mut self, visibility: &Visibility, type_: &Type) {
        if is_public(visibility) {
            Paths(self).visit_type(type_);
        }
    }

    fn fields<'f>(&mut self, fields: impl IntoIterator<Item = &'f Field>) {
        fields.into_iter().for_each(|field| self.type_(&field.vis, &field.ty));
    }

    fn is_private(&self, item: &ItemImpl) -> bool {
        let Type::Path(of) = item.self_ty.as_ref() else { return false };
        of.path.segments.last().is_some_and(|name| self.hidden.contains(&name.ident.to_string()))
    }
}

impl<'ast> Visit<'ast> for Shown {
    fn visit_item(&mut self, item: &'ast Item) {
        if is_test(attributes(item)) || is_hidden(attributes(item)) {
            return;
        }
        match item {
            Item::Fn(item) => self.signature(&item.vis, &item.sig),
            Item::Struct(item) if is_public(&item.vis) => self.fields(&item.fields),
            Item::Enum(item) if is_public(&item.vis) => {
                let fields = item.variants.iter().flat_map(|variant| &variant.fields);
                fields.for_each(|field| self.type_(&item.vis, &field.ty));
            }
            Item::Type(item) => self.type_(&item.vis, &item.ty),
            Item::Const(item) => self.type_(&item.vis, &item.ty),
            Item::Static(item) => self.type_(&item.vis, &item.ty),
            _ => visit::visit_item(self, item),
        }
    }

    fn visit_item_impl(&mut self, item: &'ast ItemImpl) {
        if self.is_private(item) {
            return;
        }
        for member in &item.items {
            match member {
                ImplItem::Fn(member) if is_hidden(&member.attrs) => {}
                ImplItem::Fn(member) => self.signature(&member.vis, &member.sig),
                ImplItem::Const(member) => self.type_(&member.vis, &member.ty),
                _ => {}
            }
        }
    }

    fn visit_item_trait(&mut self, item: &'ast ItemTrait) {
        for member in &item.items {
            if let TraitItem::Fn(member) = member {
                self.signature(&item.vis, &member.sig);
            }
        }
    }
}

/// Notes the foreign names in a signature or type.
struct Paths<'a>(&'a mut Shown);

impl<'ast> Visit<'ast> for Paths<'_> {
    fn visit_path(&mut self, path: &'ast Path) {
        let foreign = path.segments.iter().find(|segment| {
            let name = segment.ident.to_string();
            LIBRARIES.contains(&name.as_str()) || self.0.foreign.contains(&name)
        });
        if let Some(segment) = foreign {
            self.0.found.push((segment.ident.to_string(), segment.ident.span().start().line));
        }
        visit::visit_path(self, path);
    }
}

fn is_public(visibility: &Visibility) -> bool {
    matches!(visibility, Visibility::Public(_))
}
