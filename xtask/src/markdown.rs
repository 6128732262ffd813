use std::ops::Range;

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

/// Kind of a piece of a Markdown text.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    Prose,
    /// A fenced block with its fences.
    Block,
    /// What stands between the backticks of a line.
    Code,
    /// TeX between single dollars.
    Inline,
    /// TeX between double dollars, or in a fence `math`.
    Display,
}

/// A stretch of a Markdown text.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Piece<'t> {
    pub kind: Kind,
    /// Line of its first character, from 1.
    pub line: usize,
    /// Text; that of code and formulas without the delimiters.
    pub text: &'t str,
}

/// A Markdown text cut where code and formulas begin and end.
pub fn pieces(markdown: &str) -> Vec<Piece<'_>> {
    let starts: Vec<usize> = std::iter::once(0)
        .chain(markdown.match_indices('\n').map(|(at, _)| at + 1))
        .chain([markdown.len()])
        .collect();
    let start = |line: usize| starts.get(line - 1).copied().unwrap_or(markdown.len());
    let (mut pieces, mut line) = (Vec::new(), 1);
    for block in blocks(markdown) {
        let (fence, after) = (block.line - 1, block.line + block.text.lines().count());
        cut(&markdown[start(line)..start(fence)], line, &mut pieces);
        pieces.push(if block.language == "math" {
            Piece { kind: Kind::Display, line: block.line, text: &markdown[start(block.line)..start(after)] }
        } else {
            Piece { kind: Kind::Block, line: fence, text: &markdown[start(fence)..start(after + 1)] }
        });
        line = after + 1;
    }
    cut(&markdown[start(line)..], line, &mut pieces);
    pieces
}

/// Cuts a text without fences.
fn cut<'t>(text: &'t str, line: usize, pieces: &mut Vec<Piece<'t>>) {
    let line_at = |at: usize| line + text[..at].matches('\n').count();
    let (mut prose, mut at) = (0, 0);
    while let Some(c) = text[at..].chars().next() {
        let rest = &text[at..];
        let Some((kind, delimiter, length)) = delimited(rest) else {
            let escaped = if c == '\\' { rest[1..].chars().next().map_or(0, char::len_utf8) } else { 0 };
            // A run of backticks that nothing closes is text as a whole.
            at += rest.find(|other| other != '`').filter(|&run| run > 0).unwrap_or(c.len_utf8() + escaped);
            continue;
        };
        if prose < at {
            pieces.push(Piece { kind: Kind::Prose, line: line_at(prose), text: &text[prose..at] });
        }
        let inside = &rest[delimiter..][..length];
        pieces.push(Piece { kind, line: line_at(at), text: inside });
        at += 2 * delimiter + length;
        prose = at;
    }
    if prose < text.len() {
        pieces.push(Piece { kind: Kind::Prose, line: line_at(prose), text: &text[prose..] });
    }
}

/// Kind, length of the delimiter and length of the inside of the code or formula that a text begins with.
fn delimited(text: &str) -> Option<(Kind, usize, usize)> {
    let mark = text.chars().next().filter(|mark| "`$".contains(*mark))?;
    let run = |text: &str| text.chars().take_while(|&c| c == mark).count();
    let (opening, paragraph) = (run(text), text.split("\n\n").next().unwrap_or(text));
    let kind = match (mark, opening) {
        ('`', _) => Kind::Code,
        (_, 1) => Kind::Inline,
        _ => Kind::Display,
    };
    let mut at = opening;
    while let Some(next) = paragraph.get(at..)?.find(mark) {
        let inside = &paragraph[opening..at + next];
        let closing = run(&paragraph[at + next..]);
        if closing == opening && (kind != Kind::Inline || inside.trim().len() == inside.len()) {
            return Some((kind, opening, inside.len()));
        }
        at += next + closing;
    }
    None
}

/// Texts between backticks outside the fenced blocks, with their lines.
pub fn code_spans(markdown: &str) -> Vec<(usize, String)> {
    let code = pieces(markdown).into_iter().filter(|piece| piece.kind == Kind::Code);
    code.map(|piece| (piece.line, piece.text.trim().to_owned())).collect()
}

/// Where the targets of the links in a prose stand: `a.md#b` of `[text](a.md#b)`.
pub fn targets(prose: &str) -> Vec<Range<usize>> {
    prose
        .match_indices("](")
        .map(|(at, opening)| at + opening.len())
        .filter_map(|start| Some(start..start + prose[start..].find([')', ' ', '\n'])?))
        .collect()
}

/// Anchors of the headings, as forges and mdBook name them.
pub fn anchors(markdown: &str) -> Vec<String> {
    let mut anchors: Vec<String> = Vec::new();
    let fenced: Vec<_> =
        blocks(markdown).iter().map(|block| block.line..block.line + block.text.lines().count()).collect();
    let lines =
        (1..).zip(markdown.lines()).filter(|(line, _)| !fenced.iter().any(|lines| lines.contains(line)));
    for heading in lines.filter_map(|(_, text)| {
        text.trim_start_matches('#').strip_prefix(' ').filter(|_| text.starts_with('#'))
    }) {
        let kept = heading.trim().chars().filter(|&c| c.is_alphanumeric() || " -_".contains(c));
        let slug: String =
            kept.flat_map(char::to_lowercase).map(|c| if c == ' ' { '-' } else { c }).collect();
        let again = (1..).map(|count| format!("{slug}-{count}"));
        let free = std::iter::once(slug.clone()).chain(again).find(|name| !anchors.contains(name));
        anchors.extend(free);
    }
    anchors
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
    fn pieces_are_prose_code_and_formulas() {
        let text = "a $x_1$ costs \\$5,\n`$y$` and $2 or\n$$z$$ ``b`c``.\n```math\nw\n```\n```sh\n$ d\n```\nend `e\n";
        let found: Vec<_> = pieces(text).iter().map(|piece| (piece.kind, piece.line, piece.text)).collect();
        assert_eq!(
            found,
            [
                (Kind::Prose, 1, "a "),
                (Kind::Inline, 1, "x_1"),
                (Kind::Prose, 1, " costs \\$5,\n"),
                (Kind::Code, 2, "$y$"),
                (Kind::Prose, 2, " and $2 or\n"),
                (Kind::Display, 3, "z"),
                (Kind::Prose, 3, " "),
                (Kind::Code, 3, "b`c"),
                (Kind::Prose, 3, ".\n"),
                (Kind::Display, 5, "w\n"),
                (Kind::Block, 7, "```sh\n$ d\n```\n"),
                (Kind::Prose, 10, "end `e\n"),
            ]
        );
    }

    #[test]
    fn dollars_between_spaces_are_no_delimiters() {
        let kinds: Vec<_> =
            pieces("5 $ or 6 $ or $x$").iter().map(|piece| (piece.kind, piece.text)).collect();
        assert_eq!(kinds, [(Kind::Prose, "5 $ or 6 $ or "), (Kind::Inline, "x")]);
    }

    #[test]
    fn targets_are_what_links_point_at() {
        let text = "[a](b.md#c), ![d](e.svg \"f\") and [g] (h)";
        let found: Vec<_> = targets(text).into_iter().map(|range| &text[range]).collect();
        assert_eq!(found, ["b.md#c", "e.svg"]);
    }

    #[test]
    fn anchors_are_those_of_the_forge() {
        let text = "# 9. Évolution: `a --b`\n#no heading\n```sh\n# c\n```\n## Twice_\n### Twice_\n";
        assert_eq!(anchors(text), ["9-évolution-a---b", "twice_", "twice_-1"]);
    }

    #[test]
    fn code_spans_leave_out_fenced_blocks() {
        let spans = code_spans("a `b` `c/d`\n```\n`e`\n```\n`f`\n");
        assert_eq!(spans, [(1, "b".into()), (1, "c/d".into()), (5, "f".into())]);
    }
}
