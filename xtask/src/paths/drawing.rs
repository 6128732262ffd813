use crate::markdown::Block;

/// Characters that draw the branches of a tree.
const BRANCHES: [char; 5] = ['│', '├', '└', '─', ' '];

/// Paths in the drawing of a tree, with their lines; none if the block is no such drawing.
///
/// The first line is the root. Below it one name stands on each line; words after the name describe it.
pub fn paths(block: &Block) -> Vec<(usize, String)> {
    let is_drawing = block.text.contains("├─") || block.text.contains("└─");
    let root = block.text.lines().position(|line| !line.trim().is_empty());
    let Some(root) = root.filter(|_| is_drawing) else { return Vec::new() };
    let mut above: Vec<(usize, &str)> = Vec::new();
    let mut found = Vec::new();
    for (line, text) in (block.line..).zip(block.text.lines()).skip(root + 1) {
        let Some(name) = text.trim_start_matches(BRANCHES).split_whitespace().next() else { continue };
        let column = text.chars().take_while(|c| BRANCHES.contains(c)).count();
        above.retain(|&(other, _)| other < column);
        above.push((column, name.trim_end_matches('/')));
        let parts: Vec<&str> = above.iter().map(|&(_, name)| name).collect();
        found.push((line, parts.join("/")));
    }
    found
}

#[cfg(test)]
mod tests {
    use super::*;

    fn drawn(text: &str) -> Vec<(usize, String)> {
        paths(&Block { language: "text".into(), line: 10, text: text.into() })
    }

    #[test]
    fn names_hang_below_the_folder_they_are_drawn_under() {
        let tree = "root/\n├── a/       first\n│   ├── b.rs\n│   └── c/\n│       └── d.rs  last\n│\n└── e/f\n    └── g\n";
        let expected = [(11, "a"), (12, "a/b.rs"), (13, "a/c"), (14, "a/c/d.rs"), (16, "e/f"), (17, "e/f/g")];
        assert_eq!(drawn(tree), expected.map(|(line, path)| (line, path.to_owned())));
    }

    #[test]
    fn other_blocks_are_no_drawings() {
        assert_eq!(drawn("a ──► b\nc\n"), []);
    }
}
