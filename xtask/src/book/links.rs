use super::{is_outward, resolved};
use crate::finding::Finding;
use crate::markdown::{Kind, anchors, pieces, targets};
use crate::tree::Tree;

/// Links of Markdown files to a path or an anchor that does not exist.
pub fn check(tree: &Tree) -> Vec<Finding> {
    tree.files("", ".md").flat_map(|(file, text)| broken(tree, file, text)).collect()
}

fn broken(tree: &Tree, file: &str, text: &str) -> Vec<Finding> {
    let prose = pieces(text).into_iter().filter(|piece| piece.kind == Kind::Prose);
    let links = prose.flat_map(|piece| {
        targets(piece.text).into_iter().map(move |target| {
            (piece.line + piece.text[..target.start].matches('\n').count(), &piece.text[target])
        })
    });
    links
        .filter(|(_, target)| !is_outward(target) && !leads_somewhere(tree, file, target))
        .map(|(line, target)| Finding::error(file, line, format!("the link {target} leads nowhere")))
        .collect()
}

fn leads_somewhere(tree: &Tree, file: &str, target: &str) -> bool {
    let path = resolved(file, target);
    match target.split_once('#') {
        Some((_, anchor)) => {
            tree.text(&path).is_some_and(|text| anchors(text).iter().any(|name| name == anchor))
        }
        None => tree.exists(&path),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::tree::sample;

    #[test]
    fn links_that_lead_nowhere_are_found() {
        let text = "[a](b.md), [c](../d), [e](https://f.org), [g](#h) and [i](b.md#j)\n\n# H\n\n`[k](l.md)` $[m](n)$\n";
        let tree = sample(&[("docs/a.md", text), ("docs/b.md", "## J\n"), ("d/x", "")]);
        assert_eq!(check(&tree), []);
        let tree = sample(&[("docs/a.md", text), ("docs/b.md", "")]);
        let found: Vec<String> = check(&tree).iter().map(ToString::to_string).collect();
        assert_eq!(
            found,
            ["docs/a.md:1: the link ../d leads nowhere", "docs/a.md:1: the link b.md#j leads nowhere"]
        );
    }
}
