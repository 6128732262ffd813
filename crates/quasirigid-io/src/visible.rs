//! Text of files on a terminal, on a page and in comments of exported equations: characters that would steer the reader are shown instead.

use std::borrow::Cow;
use std::fmt::{self, Write};

/// A text in which control characters, line breaks and tabs apart, stand as `\u001b`; so do characters that change the direction of
/// writing. JSON keeps its meaning with them.
#[must_use]
pub fn visible(text: &str) -> String {
    escaped(text, |letter| steers(letter) && !matches!(letter, '\n' | '\t'))
}

/// A name made visible likewise, without line breaks.
#[must_use]
pub fn one_line(name: &str) -> String {
    escaped(name, steers)
}

/// A text of equal length in bytes, in which question marks stand for such characters; ends of lines stay.
#[must_use]
pub fn masked(text: &str) -> String {
    let mut out = String::with_capacity(text.len());
    let mut letters = text.chars().peekable();
    while let Some(letter) = letters.next() {
        let ends_line = letter == '\n' || letter == '\r' && letters.peek() == Some(&'\n');
        if !steers(letter) || ends_line || letter == '\t' {
            out.push(letter);
        } else {
            out.extend(std::iter::repeat_n('?', letter.len_utf8()));
        }
    }
    out
}

/// Most characters of a file that a message quotes at a place.
const QUOTED: usize = 120;

/// Excerpt of a file in a message: the beginning of what stands at a place, on one line, cut where it is long. A model may name any file
/// that its user can read, and what is printed may be read by others.
#[derive(Clone, PartialEq, Eq)]
pub struct Excerpt(String);

impl From<&str> for Excerpt {
    fn from(text: &str) -> Self {
        let line = text.lines().next().unwrap_or_default();
        match line.char_indices().nth(QUOTED) {
            Some((end, _)) => Self(format!("{}…", &line[..end])),
            None => Self(line.to_owned()),
        }
    }
}

impl From<String> for Excerpt {
    fn from(text: String) -> Self {
        Self::from(text.as_str())
    }
}

impl From<Cow<'_, str>> for Excerpt {
    fn from(text: Cow<'_, str>) -> Self {
        Self::from(&*text)
    }
}

impl fmt::Display for Excerpt {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.0)
    }
}

impl fmt::Debug for Excerpt {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        fmt::Debug::fmt(&self.0, f)
    }
}

/// Most characters of a message that has something of a file in it.
const MAX_MESSAGE: usize = 700;

/// A message, of whose middle a part is left out where it is long: what a file has is quoted in it, at any length, and the advice stands at
/// its end.
#[must_use]
pub fn shortened(message: &str) -> Cow<'_, str> {
    if message.len() <= MAX_MESSAGE {
        return Cow::Borrowed(message);
    }
    let head = message.floor_char_boundary(MAX_MESSAGE / 2);
    let tail = message.ceil_char_boundary(message.len() - MAX_MESSAGE / 2);
    Cow::Owned(format!("{} … {}", &message[..head], &message[tail..]))
}

fn escaped(text: &str, hidden: impl Fn(char) -> bool) -> String {
    let mut out = String::with_capacity(text.len());
    for letter in text.chars() {
        if hidden(letter) {
            let _ = write!(out, "\\u{:04x}", u32::from(letter)); // a string takes any text
        } else {
            out.push(letter);
        }
    }
    out
}

/// Whether a character steers a terminal or the direction in which it writes, ends a line or a paragraph, or has no place in XML.
fn steers(letter: char) -> bool {
    letter.is_control()
        || matches!(
            letter,
            '\u{61c}' | '\u{200e}' | '\u{200f}' | '\u{2028}'..='\u{202e}' | '\u{2066}'..='\u{2069}' | '\u{fffe}' | '\u{ffff}'
        )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn long_messages_keep_their_ends() {
        assert_eq!(shortened("short é"), "short é");
        let long = format!("{:?} is no number; write 1.5", "é".repeat(1_000_000));
        let short = shortened(&long);
        assert!(short.len() < MAX_MESSAGE + 10 && short.starts_with("\"éé"), "{short}");
        assert!(short.contains(" … ") && short.ends_with("éé\" is no number; write 1.5"), "{short}");
    }

    #[test]
    fn what_steers_a_terminal_is_shown() {
        let text = "a\u{1b}[2J\u{9b}1m\r\u{7}\u{202e}é\n\tb";
        assert_eq!(visible(text), "a\\u001b[2J\\u009b1m\\u000d\\u0007\\u202eé\n\tb");
        assert_eq!(one_line("a\nb\u{1b}"), "a\\u000ab\\u001b");
        let masked = masked("x\u{1b}y\u{9b}z\u{202e}\r\n\r\té");
        assert_eq!(masked, "x?y??z???\r\n?\té");
    }
}
