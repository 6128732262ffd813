/// A fenced block of a Markdown file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Block {
    /// First word after the fence; empty if there is none.
    pub language: String,
    /// Line of the first line of its text, from 1.
    pub line: usize,
    /// Text between the fences.
    pub text: String,
}

/// Fenced blocks of a Markdown text, in order. A fence left open runs to the end.
pub fn blocks(markdown: &str) -> Vec<Block> {
    let mut blocks = Vec::new();
    let mut open: Option<(usize, Block)> = None;
    for (line, text) in (1..).zip(markdown.lines()) {
        let ticks = text.trim_start().chars().take_while(|&c| c == '`').count();
        let rest = text.trim_start()[ticks..].trim();
        match &mut open {
            None if ticks >= 3 && !rest.contains('`') => {
                let language = rest.split_whitespace().next().unwrap_or_default().to_owned();
                open = Some((ticks, Block { language, line: line + 1, text: String::new() }));
            }
            None => {}
            Some((fence, _)) if ticks >= *fence && rest.is_empty() => {
                blocks.extend(open.take().map(|(_, block)| block));
            }
            Some((_, block)) => {
                block.text.push_str(text);
                block.text.push('\n');
            }
        }
    }
    blocks.extend(open.map(|(_, block)| block));
    blocks
}

/// Texts between backticks outside the fenced blocks, with their lines.
pub fn code_spans(markdown: &str) -> Vec<(usize, String)> {
    let fenced: Vec<_> = blocks(markdown)
        .iter()
        .map(|block| block.line - 1..=block.line + block.text.lines().count())
        .collect();
    (1..)
        .zip(markdown.lines())
        .filter(|(line, _)| !fenced.iter().any(|range| range.contains(line)))
        .flat_map(|(line, text)| text.split('`').skip(1).step_by(2).map(move |span| (line, span.to_owned())))
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    const TEXT: &str = "a `b` c\n```toml\nx = 1\n```\n`d/e`\n````md\n```sh\n```\n````\n``` `no` fence\n";

    #[test]
    fn blocks_know_their_language_and_line() {
        let toml = Block { language: "toml".into(), line: 3, text: "x = 1\n".into() };
        let md = Block { language: "md".into(), line: 7, text: "```sh\n```\n".into() };
        assert_eq!(blocks(TEXT), [toml, md]);
    }

    #[test]
    fn code_spans_leave_out_fenced_blocks() {
        let spans = code_spans("a `b` `c/d`\n```\n`e`\n```\n`f`\n");
        assert_eq!(spans, [(1, "b".into()), (1, "c/d".into()), (5, "f".into())]);
    }
}
