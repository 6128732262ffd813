//! Lexer for the comments of a Rust source, docstrings included, with their line numbers.
//! Only literals and comments are told apart, which needs no parser: `syn` drops ordinary comments, and labels stand in those too.

/// Comments of a Rust source, docstrings among them, line by line: number of the line, and text after the slashes.
///
/// Strings and characters are passed over, so a `//` inside them is no comment.
pub fn comments(source: &str) -> Vec<(usize, &str)> {
    let mut found = Vec::new();
    let (mut at, mut line) = (0, 1);
    while let Some(c) = source[at..].chars().next() {
        let rest = &source[at..];
        let length = if rest.starts_with("//") {
            rest.find('\n').unwrap_or(rest.len())
        } else if rest.starts_with("/*") {
            block_comment(rest)
        } else if let Some(length) = literal(rest) {
            length
        } else {
            c.len_utf8()
        };
        let text = &rest[..length];
        if text.starts_with("//") || text.starts_with("/*") {
            let bare = text.lines().map(|text| text.trim_start_matches(['/', '*', '!']).trim());
            found.extend((line..).zip(bare));
        }
        line += text.matches('\n').count();
        at += length;
    }
    found
}

/// Length of the block comment that `text` starts with; block comments nest.
fn block_comment(text: &str) -> usize {
    let mut depth = 0usize;
    let mut at = 0;
    while at < text.len() {
        let rest = &text.as_bytes()[at..];
        if rest.starts_with(b"/*") {
            (depth, at) = (depth + 1, at + 2);
        } else if rest.starts_with(b"*/") {
            (depth, at) = (depth - 1, at + 2);
            if depth == 0 {
                return at;
            }
        } else {
            at += 1;
        }
    }
    text.len()
}

/// Length of the string or character that `text` starts with, if it starts with one.
fn literal(text: &str) -> Option<usize> {
    if let Some(after) = text.strip_prefix('"') {
        return Some(1 + closing(after, '"'));
    }
    if let Some(after) = text.strip_prefix('\'') {
        let mut next = after.chars();
        let (first, second) = (next.next()?, next.next()?);
        let is_character = first == '\\' || second == '\''; // otherwise a lifetime
        return is_character.then(|| 1 + closing(after, '\''));
    }
    let hashes = text.strip_prefix('r')?.bytes().take_while(|&c| c == b'#').count();
    let body = text[1 + hashes..].strip_prefix('"')?;
    let end = format!("\"{}", "#".repeat(hashes));
    Some(body.find(&end).map_or(text.len(), |at| 2 + hashes + at + end.len()))
}

/// Length of `text` up to and with the first `quote` that no backslash escapes.
fn closing(text: &str, quote: char) -> usize {
    let mut escaped = false;
    for (at, c) in text.char_indices() {
        if c == quote && !escaped {
            return at + 1;
        }
        escaped = c == '\\' && !escaped;
    }
    text.len()
}

#[cfg(test)]
mod tests {
    use super::comments;

    #[test]
    fn comments_of_every_kind_are_found_with_their_lines() {
        let source = "//! a\n/// b\nfn f() {} // c\n/* d\n e /* f */\n*/ fn g() {} //\u{e9}";
        assert_eq!(
            comments(source),
            [(1, "a"), (2, "b"), (3, "c"), (4, "d"), (5, "e /* f */"), (6, ""), (6, "\u{e9}")]
        );
    }

    #[test]
    fn literals_are_no_comments() {
        for code in [
            r#"f("// no", '"', "\"// no") "#,
            r##"f(r#"" // no"#, b'/', '\'', br"\")"##,
            "fn f<'a>(x: &'a str) -> char { '\u{3a9}' } ",
            "let r = for_r(\"/* no\");\n",
            "let r#type = '\"'; ",
        ] {
            let source = format!("{code}// yes");
            let line = 1 + code.matches('\n').count();
            assert_eq!(comments(&source), [(line, "yes")], "{source}");
        }
    }
}
