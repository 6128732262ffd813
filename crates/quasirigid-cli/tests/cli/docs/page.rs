//! Markdown pages: fenced blocks, commands with the output shown below them, and lines in which `...` stands for any.
//! Apart from the running of commands, so that the reading of pages is tested on texts of which the truth is known.

/// A fenced block of a Markdown page.
#[derive(Debug, PartialEq)]
pub struct Block {
    /// First word behind the fence.
    pub language: String,
    /// Line of the first line of its text, from 1.
    pub line: usize,
    /// Text between the fences.
    pub text: String,
}

/// A command that a page shows, with the output shown below.
#[derive(Debug, PartialEq)]
pub struct Shown {
    /// Line of the page, from 1.
    pub line: usize,
    /// Command for a shell, `quasirigid` first.
    pub command: String,
    /// Lines shown below it.
    pub output: Vec<String>,
}

/// Fenced blocks of a page, in order.
pub fn blocks(page: &str) -> Vec<Block> {
    let mut blocks = Vec::new();
    let mut open: Option<(String, Block)> = None;
    for (line, text) in (1..).zip(page.lines()) {
        let ticks: String = text.trim_start().chars().take_while(|letter| *letter == '`').collect();
        match &mut open {
            Some((fence, _)) if ticks.len() >= fence.len() && text.trim() == ticks => {
                blocks.extend(open.take().map(|(_, block)| block));
            }
            Some((_, block)) => block.text += &format!("{text}\n"),
            None if ticks.len() >= 3 => {
                let language =
                    text.trim().trim_start_matches('`').split_whitespace().next().unwrap_or_default();
                let block = Block { language: language.into(), line: line + 1, text: String::new() };
                open = Some((ticks, block));
            }
            None => {}
        }
    }
    blocks
}

/// Commands of ours in a `console` block. A line that ends in `\` goes on in the next.
pub fn commands(block: &Block) -> Vec<Shown> {
    let mut shown: Vec<Shown> = Vec::new();
    let mut continued = false;
    for (line, text) in (block.line..).zip(block.text.lines()) {
        let more = text.ends_with('\\');
        if let Some(command) = text.strip_prefix("$ ") {
            shown.push(Shown { line, command: command.trim_end_matches('\\').into(), output: Vec::new() });
            continued = more;
        } else if let Some(last) = shown.last_mut() {
            if continued {
                last.command += text.trim().trim_end_matches('\\');
                continued = more;
            } else {
                last.output.push(text.trim_end().into());
            }
        }
    }
    for each in &mut shown {
        each.command = each.command.replace("cargo run -- ", "quasirigid ");
        while each.output.last().is_some_and(String::is_empty) {
            each.output.pop();
        }
    }
    shown.retain(|each| each.command.starts_with("quasirigid "));
    shown
}

/// Whether lines are the expected ones, among which `...` stands for any number of lines.
pub fn matches(expected: &[&str], lines: &[&str]) -> bool {
    match expected {
        [] => lines.is_empty(),
        [dots, rest @ ..] if dots.trim() == "..." => {
            (0..=lines.len()).any(|skip| matches(rest, &lines[skip..]))
        }
        [first, rest @ ..] => lines.first() == Some(first) && matches(rest, &lines[1..]),
    }
}

#[test]
fn blocks_keep_their_language_place_and_text() {
    let page = "# T\n```toml\na = 1\n```\ntext\n````console x\n$ a\n```\n````\n";
    let block =
        |language: &str, line, text: &str| Block { language: language.into(), line, text: text.into() };
    assert_eq!(blocks(page), [block("toml", 3, "a = 1\n"), block("console", 7, "$ a\n```\n")]);
}

#[test]
fn commands_of_ours_are_found_with_what_they_print() {
    let text =
        "$ cd x\nnot ours\n$ quasirigid check a \\\n    --json | head -1\nout\n\n$ cargo run -- derive b\n";
    let shown = |line, command: &str, output: &[&str]| Shown {
        line,
        command: command.into(),
        output: output.iter().map(|line| (*line).into()).collect(),
    };
    let block = Block { language: "console".into(), line: 10, text: text.into() };
    assert_eq!(
        commands(&block),
        [shown(12, "quasirigid check a --json | head -1", &["out"]), shown(16, "quasirigid derive b", &[])]
    );
}

#[test]
fn dots_stand_for_any_lines_and_nothing_else_does() {
    for (expected, matching) in [
        (&["a", "b", "c"][..], true),
        (&["..."], true),
        (&["a", "..."], true),
        (&["...", "c"], true),
        (&["a", "...", "c", "..."], true),
        (&["a", "b", "...", "b", "c"], false),
        (&["a", "b"], false),
        (&["b", "..."], false),
        (&["a", "b", "c", "d"], false),
        (&[], false),
    ] {
        assert_eq!(matches(expected, &["a", "b", "c"]), matching, "{expected:?}");
    }
}
