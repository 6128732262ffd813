//! Keys of the JSON output in the guide are those of the structures that are written, with their doc comments.
//! Between `<!-- json: Structure -->` and `<!-- end -->` stands a row for each field; the first paragraph of its doc comment is the meaning.
//! A structure with a marker of its own is not listed inside others; `<!-- json: Structure without key -->` leaves a key out.

use std::collections::BTreeMap;
use std::path::Path;

use syn::{Attribute, Fields, GenericArgument, Item, ItemStruct, Meta, PathArguments, Type};

use crate::finding::Finding;
use crate::tree::Tree;

/// The chapter with the tables.
const PAGE: &str = "docs/guide/13-json.md";
const MARKER: &str = "<!-- json: ";
const END: &str = "<!-- end -->";

/// Fields of a structure, by its name.
type Structures = BTreeMap<String, Vec<Field>>;

/// Field of a structure as it is written.
struct Field {
    /// Key in JSON; none of a field whose own fields stand in its place.
    key: Option<String>,
    meaning: String,
    /// Names in the type.
    types: Vec<String>,
}

/// Tables of the chapter that differ from the doc comments.
pub fn check(tree: &Tree) -> Vec<Finding> {
    let Some(page) = tree.text(PAGE) else { return Vec::new() };
    match filled(page, &structures(tree)) {
        Ok(filled) if filled == page => Vec::new(),
        Ok(filled) => {
            let same = page.lines().zip(filled.lines()).take_while(|(now, then)| now == then).count();
            vec![Finding::error(
                PAGE,
                same + 1,
                "differs from the doc comments; run: cargo xtask json --write",
            )]
        }
        Err((line, message)) => vec![Finding::error(PAGE, line, message)],
    }
}

/// Writes the tables of the chapter anew.
///
/// # Errors
/// A marker that is wrong, or a file that cannot be written.
pub fn write(root: &Path) -> Result<(), String> {
    let tree = Tree::load(root).map_err(|error| error.to_string())?;
    let page = tree.text(PAGE).ok_or_else(|| format!("there is no {PAGE}"))?;
    let filled =
        filled(page, &structures(&tree)).map_err(|(line, message)| format!("{PAGE}:{line}: {message}"))?;
    std::fs::write(root.join(PAGE), filled).map_err(|error| format!("{PAGE}: {error}"))
}

/// Structures of the crates that are written as JSON.
fn structures(tree: &Tree) -> Structures {
    let sources = tree
        .files("crates", ".rs")
        .filter(|(path, text)| path.contains("/src/") && text.contains("Serialize"));
    let items = sources.filter_map(|(_, text)| syn::parse_file(text).ok()).flat_map(|file| file.items);
    let structures = items.filter_map(|item| match item {
        Item::Struct(structure) if derives_serialize(&structure.attrs) => Some(structure),
        _ => None,
    });
    structures.map(|structure| (structure.ident.to_string(), fields(&structure))).collect()
}

fn derives_serialize(attributes: &[Attribute]) -> bool {
    attributes.iter().any(|attribute| match &attribute.meta {
        Meta::List(list) => list.path.is_ident("derive") && list.tokens.to_string().contains("Serialize"),
        _ => false,
    })
}

fn fields(structure: &ItemStruct) -> Vec<Field> {
    let Fields::Named(named) = &structure.fields else { return Vec::new() };
    let field = |field: &syn::Field| {
        let serde = settings(&field.attrs);
        if serde.iter().any(|setting| setting == "skip") {
            return None;
        }
        let renamed = serde.iter().find_map(|setting| setting.strip_prefix("rename = "));
        let own = field.ident.as_ref()?.to_string();
        let key = renamed.map_or(own, |name| name.trim_matches('"').to_owned());
        let flat = serde.iter().any(|setting| setting == "flatten");
        let mut types = Vec::new();
        names(&field.ty, &mut types);
        Some(Field { key: (!flat).then_some(key), meaning: first_paragraph(&field.attrs), types })
    };
    named.named.iter().filter_map(field).collect()
}

/// Settings of serde, such as `skip` and `rename = "turns"`.
fn settings(attributes: &[Attribute]) -> Vec<String> {
    let lists = attributes.iter().filter_map(|attribute| match &attribute.meta {
        Meta::List(list) if list.path.is_ident("serde") => Some(list.tokens.to_string()),
        _ => None,
    });
    lists
        .flat_map(|list| list.split(',').map(|setting| setting.trim().to_owned()).collect::<Vec<_>>())
        .collect()
}

/// First paragraph of a doc comment, in one line.
fn first_paragraph(attributes: &[Attribute]) -> String {
    let lines = attributes.iter().filter_map(|attribute| match &attribute.meta {
        Meta::NameValue(pair) if pair.path.is_ident("doc") => match &pair.value {
            syn::Expr::Lit(syn::ExprLit { lit: syn::Lit::Str(text), .. }) => {
                Some(text.value().trim().to_owned())
            }
            _ => None,
        },
        _ => None,
    });
    let paragraph = lines.take_while(|line| !line.is_empty()).collect::<Vec<_>>().join(" ");
    paragraph.trim_end_matches('.').replace('|', "\\|")
}

/// Names of the types in a type: `Option<Vec<ModeRecord>>` has three.
fn names(of: &Type, found: &mut Vec<String>) {
    match of {
        Type::Reference(reference) => names(&reference.elem, found),
        Type::Slice(slice) => names(&slice.elem, found),
        Type::Array(array) => names(&array.elem, found),
        Type::Path(path) => {
            for segment in &path.path.segments {
                found.push(segment.ident.to_string());
                let PathArguments::AngleBracketed(arguments) = &segment.arguments else { continue };
                for argument in &arguments.args {
                    if let GenericArgument::Type(inner) = argument {
                        names(inner, found);
                    }
                }
            }
        }
        _ => {}
    }
}

/// The page with its tables, or the line of a marker that is wrong.
fn filled(page: &str, structures: &Structures) -> Result<String, (usize, String)> {
    let marked: Vec<&str> = page.lines().filter_map(marker).map(|(name, _)| name).collect();
    let (mut filled, mut inside) = (String::new(), false);
    for (line, text) in (1..).zip(page.lines()) {
        if text == END {
            inside = false;
        }
        if !inside {
            filled += &format!("{text}\n");
        }
        if let Some((name, without)) = marker(text) {
            let fields = structures
                .get(name)
                .ok_or_else(|| (line, format!("no structure {name} is written as JSON")))?;
            filled += "|key|meaning|\n|---|---|\n";
            let fields = fields.iter().filter(|field| field.key.as_deref().is_none_or(|key| key != without));
            rows("", fields, structures, &marked, &mut filled).map_err(|message| (line, message))?;
            inside = true;
        }
    }
    if inside { Err((page.lines().count(), format!("a marker has no {END}"))) } else { Ok(filled) }
}

/// Structure of a marker, and the key that it leaves out; empty if there is none.
fn marker(line: &str) -> Option<(&str, &str)> {
    let words = line.strip_prefix(MARKER)?.strip_suffix(" -->")?;
    Some(words.split_once(" without ").unwrap_or((words, "")))
}

fn rows<'f>(
    path: &str,
    fields: impl IntoIterator<Item = &'f Field>,
    structures: &'f Structures,
    marked: &[&str],
    filled: &mut String,
) -> Result<(), String> {
    for Field { key, meaning, types } in fields {
        let inner =
            types.iter().find(|name| structures.contains_key(*name) && !marked.contains(&name.as_str()));
        let inner = inner.and_then(|name| structures.get(name));
        let Some(key) = key else {
            rows(path, inner.into_iter().flatten(), structures, marked, filled)?;
            continue;
        };
        if meaning.is_empty() {
            return Err(format!("`{path}{key}` has no doc comment"));
        }
        *filled += &format!("|`{path}{key}`|{meaning}|\n");
        rows(&format!("{path}{key}."), inner.into_iter().flatten(), structures, marked, filled)?;
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::tree::sample;

    const SOURCE: &str = "
        /// A run.
        #[derive(Clone, Serialize)]
        pub struct RunRecord {
            /// Turns made,
            /// of the body.
            ///
            /// None in old records.
            #[serde(rename = \"turns\")]
            pub revolutions: f64,
            /// One for each.
            pub modes: Vec<ModeRecord>,
            /// Spins.
            pub spins: Option<SpinRecord>,
            /// In a file of its own.
            #[serde(skip)]
            pub log: f64,
        }
        #[derive(Serialize)]
        struct ModeRecord {
            /// |z|.
            size: f64,
        }
        #[derive(Serialize)]
        struct SpinRecord {
            /// rad/s.
            spin: f64,
        }
    ";
    const PAGE_TEXT: &str = "# JSON\n<!-- json: SpinRecord -->\n|key|meaning|\n|---|---|\n|`spin`|rad/s|\n<!-- end -->\n\
                             <!-- json: RunRecord -->\n|key|meaning|\n|---|---|\n|`turns`|Turns made, of the body|\n\
                             |`modes`|One for each|\n|`modes.size`|\\|z\\||\n|`spins`|Spins|\n<!-- end -->\n";

    fn found(page: &str, source: &str) -> Vec<String> {
        let tree = sample(&[(PAGE, page), ("crates/io/src/record.rs", source)]);
        check(&tree).iter().map(ToString::to_string).collect()
    }

    #[test]
    fn a_page_of_the_doc_comments_passes() {
        assert_eq!(found(PAGE_TEXT, SOURCE), [""; 0]);
    }

    #[test]
    fn a_row_that_differs_is_found_on_its_line() {
        let message = "docs/guide/13-json.md:5: differs from the doc comments; run: cargo xtask json --write";
        assert_eq!(found(PAGE_TEXT, &SOURCE.replace("rad/s", "1/s")), [message]);
        assert_eq!(found(PAGE_TEXT, &SOURCE.replace("spin: f64", "rate: f64")), [message]);
    }

    #[test]
    fn a_marker_without_a_structure_and_a_field_without_a_comment_are_found() {
        let unknown = "docs/guide/13-json.md:2: no structure SpnRecord is written as JSON";
        assert_eq!(found(&PAGE_TEXT.replace("SpinRecord", "SpnRecord"), SOURCE), [unknown]);
        let silent = "docs/guide/13-json.md:7: `modes.size` has no doc comment";
        assert_eq!(found(PAGE_TEXT, &SOURCE.replace("/// |z|.", "")), [silent]);
        let open = "docs/guide/13-json.md:13: a marker has no <!-- end -->";
        assert_eq!(found(PAGE_TEXT.strip_suffix("<!-- end -->\n").unwrap(), SOURCE), [open]);
    }

    #[test]
    fn the_tables_are_written_into_the_page() {
        let root = tempfile::tempdir().expect("a temporary folder");
        let page = root.path().join(PAGE);
        let source = root.path().join("crates/io/src/record.rs");
        for file in [&page, &source] {
            std::fs::create_dir_all(file.parent().expect("a folder")).expect("a new folder");
        }
        std::fs::write(&source, SOURCE).expect("a new file");
        let empty =
            "# JSON\n<!-- json: SpinRecord -->\n<!-- end -->\n<!-- json: RunRecord -->\n<!-- end -->\n";
        std::fs::write(&page, empty).expect("a new file");
        write(root.path()).expect("sound markers");
        assert_eq!(std::fs::read_to_string(&page).expect("the page"), PAGE_TEXT);
    }
}
