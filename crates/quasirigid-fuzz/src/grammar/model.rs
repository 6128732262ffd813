//! Model files with every table of the schema.

use arbitrary::Unstructured;

use super::choice::{below, chance, pick};
use super::number::Numbers;
use super::{element, part, setting};

/// A table of a draft.
type Table = fn(&mut Draft<'_, '_>);

/// Tables of elements, the common ones more than once.
const TABLES: [Table; 20] = [
    element::point,
    element::point,
    element::hinged,
    element::hinged,
    element::spring,
    element::rotor,
    element::wheel,
    element::cavity,
    element::bushing,
    element::network,
    element::ellipsoid,
    element::surface,
    part::beam,
    part::beam,
    part::panel,
    part::solid,
    part::matrices,
    part::modes,
    part::connection,
    setting::force,
];

/// A model file in work.
#[derive(Debug)]
pub struct Draft<'u, 'b> {
    /// The text so far.
    pub text: String,
    /// Numbers and choices.
    pub numbers: Numbers<'u, 'b>,
    /// Names that ends and places can refer to.
    pub names: Vec<String>,
    /// Parts with the names of their nodes.
    pub parts: Vec<(String, &'static str)>,
}

/// A model file.
pub fn model(u: &mut Unstructured<'_>) -> String {
    let mut draft =
        Draft { text: String::new(), numbers: Numbers::new(u), names: Vec::new(), parts: Vec::new() };
    let alone = chance(draft.numbers.u, 30);
    if alone {
        element::alone(&mut draft);
    } else {
        element::carrier(&mut draft);
    }
    let count = if alone { 0 } else { below(draft.numbers.u, 6) };
    for _ in 0..count {
        let table = TABLES[below(draft.numbers.u, TABLES.len())];
        table(&mut draft);
    }
    part::shared(&mut draft);
    setting::settings(&mut draft);
    draft.text
}

impl Draft<'_, '_> {
    /// Writes a line.
    pub fn line(&mut self, key: &str, value: &str) {
        self.text += key;
        self.text += " = ";
        self.text += value;
        self.text.push('\n');
    }

    /// Writes a line with a number that is drawn.
    pub fn draw(&mut self, key: &str, number: impl FnOnce(&mut Numbers<'_, '_>) -> String) {
        let value = number(&mut self.numbers);
        self.line(key, &value);
    }

    /// Writes a line with one of several words.
    pub fn word(&mut self, key: &str, words: &[&'static str]) {
        let word = self.pick(words);
        self.line(key, &format!("\"{word}\""));
    }

    /// Writes the head of a table.
    pub fn head(&mut self, head: &str) {
        self.text += head;
        self.text.push('\n');
    }

    /// True so many times in 256.
    pub fn chance(&mut self, share: u8) -> bool {
        chance(self.numbers.u, share)
    }

    /// One of several words.
    pub fn pick(&mut self, words: &[&'static str]) -> &'static str {
        pick(self.numbers.u, words)
    }

    /// A new name, and seldom one that is there.
    pub fn name(&mut self, word: &str) -> String {
        let number = if self.chance(4) { 1 } else { self.names.len() + self.parts.len() + 1 };
        let name = format!("{word}{number}");
        self.line("name", &format!("\"{name}\""));
        name
    }

    /// An end of a spring or a connection.
    pub fn end(&mut self) -> String {
        match below(self.numbers.u, 4) {
            0 => "\"carrier\"".to_owned(),
            1 if !self.parts.is_empty() => self.node(),
            3 => self
                .pick(&["\"nobody\"", "{ part = \"boom\", node = \"root\" }", "\"point1\"", "\"carrier\""])
                .to_owned(),
            _ if self.names.is_empty() => "\"carrier\"".to_owned(),
            _ => {
                let index = below(self.numbers.u, self.names.len());
                format!("\"{}\"", self.names[index])
            }
        }
    }

    /// A node of a part.
    pub fn node(&mut self) -> String {
        let Some((name, node)) = self.parts.get(below(self.numbers.u, self.parts.len())).cloned() else {
            return "{ part = \"none\", node = \"root\" }".to_owned();
        };
        format!("{{ part = \"{name}\", node = {node} }}")
    }

    /// A rheology, seldom with a range.
    pub fn rheology(&mut self) {
        let time = self.numbers.near(10.0);
        let rheology = match below(self.numbers.u, 6) {
            0 => format!("{{ kind = \"kelvin-voigt\", time = {time} }}"),
            1 => format!("{{ kind = \"quality-factor\", Q = {} }}", self.numbers.near(100.0)),
            2 => format!("{{ kind = \"maxwell\", time = {time} }}"),
            3 => format!(
                "{{ kind = \"standard-linear\", time = {time}, strength = {} }}",
                self.numbers.near(0.1)
            ),
            4 => format!(
                "{{ kind = \"andrade\", time = {time}, creep_time = {}, exponent = {} }}",
                self.numbers.near(10.0),
                self.numbers.near(0.3)
            ),
            _ => format!(
                "{{ kind = \"table\", rows = [[{time}, {}, {}], [{}, {}, 0.01]] }}",
                self.numbers.near(1.0),
                self.numbers.near(0.01),
                self.numbers.near(90.0),
                self.numbers.near(2.0)
            ),
        };
        self.line("rheology", &rheology);
    }
}
