//! The energy form of the reduced equations of a free body as source of other languages.
//! One template a language, in which the polynomials `E`, `∇E`, `c`, `T` and the numbers of the body have their places.
//! Equations (R16), (R17), (R22), docs/theory/03-reduction.md.

mod fmi_description;
mod fmu;
mod horner;
mod language;
mod languages;
mod latex;
mod vectors;

use std::collections::BTreeMap;

use quasirigid_body::{Principal, ReducedBody};
use quasirigid_math::polynomial::Series;

use crate::visible::one_line;
use horner::{broken, expression, number};
use language::{FileName, Language, filled};
use vectors::test_vectors;

pub use fmu::{Fmi, Fmu};
pub use vectors::momentum_of;

/// Language or tool that equations are exported to.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Target {
    /// C99, a folder: no allocation, `math.h` alone.
    C,
    /// A module of Python with NumPy.
    Python,
    /// A class of static functions of MATLAB and Octave.
    Matlab,
    /// A module of Rust without the standard library.
    Rust,
    /// Symbolic expressions of SymPy, a module of Python.
    Sympy,
    /// Displays for a document that loads amsmath.
    Latex,
    /// Expressions of heyoka, a module of Python.
    Heyoka,
    /// A model of Modelica.
    Modelica,
    /// A functional mock-up unit: FMI 2.0 or 3.0, model exchange and co-simulation.
    Fmu(Fmi),
}

impl Target {
    /// Targets with their names and meanings.
    pub const ALL: [(Self, &'static str, &'static str); 10] = [
        (Self::C, "c", "C99, a folder: no allocation, math.h alone"),
        (Self::Python, "python", "A module of Python with NumPy"),
        (Self::Matlab, "matlab", "A class of static functions of MATLAB and Octave"),
        (Self::Rust, "rust", "A module of Rust without the standard library"),
        (Self::Sympy, "sympy", "Symbolic expressions of SymPy, a module of Python"),
        (Self::Latex, "latex", "Displays for a document that loads amsmath"),
        (Self::Heyoka, "heyoka", "Expressions of heyoka, a module of Python"),
        (Self::Modelica, "modelica", "A model of Modelica"),
        (Self::Fmu(Fmi::Two), "fmu2", "A functional mock-up unit, FMI 2.0: model exchange and co-simulation"),
        (Self::Fmu(Fmi::Three), "fmu3", "The same for FMI 3.0"),
    ];

    /// The target of a name.
    #[must_use]
    pub fn named(name: &str) -> Option<Self> {
        Self::ALL.iter().find(|(_, known, _)| *known == name).map(|(target, ..)| *target)
    }

    /// Whether the target is a folder of files.
    #[must_use]
    pub fn is_folder(self) -> bool {
        self.language().is_some_and(|language| language.files.len() > 1)
    }

    /// Whether the source must have the name of its file.
    #[must_use]
    pub fn names_its_file(self) -> bool {
        matches!(self, Self::Matlab | Self::Modelica)
    }

    fn language(self) -> Option<Language> {
        match self {
            Self::C => Some(languages::C),
            Self::Python => Some(languages::PYTHON),
            Self::Matlab => Some(languages::MATLAB),
            Self::Rust => Some(languages::RUST),
            Self::Sympy => Some(languages::SYMPY),
            Self::Latex | Self::Fmu(_) => None,
            Self::Heyoka => Some(languages::HEYOKA),
            Self::Modelica => Some(languages::MODELICA),
        }
    }
}

/// A free body whose reduced equations are exported, with what a reader of them must know.
#[derive(Clone, Copy, Debug)]
pub struct FreeBody<'a> {
    /// Title of the model.
    pub title: &'a str,
    /// Name in source, an [`identifier`].
    pub name: &'a str,
    /// The reduced equations.
    pub reduced: &'a ReducedBody,
    /// Angular momentum (N·m·s, body axes) and attitude of the start.
    pub start: ([f64; 3], [f64; 4]),
    /// Position and velocity of the centre of mass at the start (m, m/s), inertial axes.
    pub place: [[f64; 3]; 2],
    /// Axis that the angular momentum circles at the start, body axes.
    pub axis: [f64; 3],
    /// Spins (rad/s) below which the equations hold, and from which they fail; infinite where nothing bounds them.
    pub range: [f64; 2],
    /// What is to be read before the numbers, the gravest first.
    pub notes: &'a [String],
    /// Origin: the program, the files with their hashes.
    pub origin: &'a [String],
}

/// One file of source.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct SourceFile {
    /// Name of the file.
    pub name: String,
    /// Text of the file.
    pub text: String,
}

/// Exported equations.
#[derive(Clone, Debug)]
pub enum Exported {
    /// Files of source.
    Source(Vec<SourceFile>),
    /// A functional mock-up unit.
    Unit(Fmu),
}

/// Rows of a symmetric tensor.
const TENSOR: [&str; 6] = ["T_xx", "T_yy", "T_zz", "T_yz", "T_zx", "T_xy"];
const GRADIENT: [&str; 3] = ["gradient_x", "gradient_y", "gradient_z"];
const C: [&str; 3] = ["c_x", "c_y", "c_z"];

/// Indentation of the lines of an expression.
const INDENT: &str = "        ";
/// Columns of the lines of a comment.
const COLUMNS: usize = 88;
/// Largest number that stands for no bound.
const BOUNDLESS: f64 = 1e150;

impl FreeBody<'_> {
    /// The equations for a target.
    #[must_use]
    pub fn exported(&self, target: Target) -> Exported {
        match (target, target.language()) {
            (Target::Fmu(version), _) => Exported::Unit(self.fmu(version)),
            (_, Some(language)) => Exported::Source(self.sources(&language, "")),
            (_, None) => {
                let text = self.energy_form_latex();
                Exported::Source(vec![SourceFile { name: format!("{}.tex", self.name), text }])
            }
        }
    }

    /// The files of a language; a token of the whole may stand in them.
    fn sources(&self, language: &Language, token: &str) -> Vec<SourceFile> {
        let mut parts = self.parts(language);
        parts.insert("token", token.to_owned());
        let file = |(named, template): &(FileName, &str)| SourceFile {
            name: match named {
                FileName::Ending(ending) => format!("{}{ending}", self.name),
                FileName::Whole(whole) => (*whole).to_owned(),
            },
            text: filled(template, &parts),
        };
        language.files.iter().map(file).collect()
    }

    fn parts(&self, language: &Language) -> BTreeMap<&'static str, String> {
        let Self { title, name, reduced, start: (momentum, attitude), range, .. } = *self;
        let row =
            |numbers: &[f64]| language.row(&numbers.iter().map(|value| number(*value)).collect::<Vec<_>>());
        let vectors = test_vectors(self);
        let rows: Vec<_> = vectors.iter().map(|vector| row(vector)).collect();
        let [holds, fails] = range.map(|spin| spin.min(BOUNDLESS));
        let mut parts = BTreeMap::from([
            ("name", name.to_owned()),
            ("NAME", name.to_uppercase()),
            ("title", plain(title)),
            ("order", reduced.order.to_string()),
            ("heading", language.commented(&self.heading())),
            ("readme", self.heading().join("\n")),
            ("inertia", row(&reduced.J)),
            ("wheels", row(&reduced.wheels())),
            ("start", row(&[momentum.as_slice(), &attitude].concat())),
            ("start_momentum", row(&momentum)),
            ("start_attitude", row(&attitude)),
            ("place", row(&self.place.concat())),
            ("axis", row(&self.axis)),
            ("mass", number(reduced.mass)),
            ("spin_holds", number(holds)),
            ("spin_fails", number(fails)),
            ("least_moment", number(Principal::compute(reduced.J).moments[0])),
            ("tests", language.list(&rows)),
            ("test_count", vectors.len().to_string()),
        ]);
        let gradient = reduced.energy_of_momentum.gradient();
        let mut add = |keys: &[&'static str], map: &Series| {
            for (row, key) in keys.iter().enumerate() {
                let text = expression(map, row, language.variables);
                parts.insert(*key, broken(&text, INDENT, language.continued));
            }
        };
        add(&["energy"], &reduced.energy_of_momentum);
        add(&GRADIENT, &gradient);
        add(&C, &reduced.c);
        add(&TENSOR, &reduced.T);
        parts
    }

    /// What every file says first, line by line.
    fn heading(&self) -> Vec<String> {
        let [holds, fails] = self.range;
        let range = if fails.is_finite() {
            format!(
                "Range: they hold at spins below {holds:.4} rad/s and fail from {fails:.4} rad/s on, in the direction of the start. \
                 A torque M must be slow beside the vibrations, with |M| over the least moment of inertia below the square of these \
                 numbers; how it bends the body itself is left out."
            )
        } else {
            "Range: nothing bounds the spin.".to_owned()
        };
        let title = format!(
            "{}: reduced equations of a free body in the energy form, order {}",
            plain(self.title),
            self.reduced.order
        );
        let equations = "K' = K x w + M,  w = grad E - K' x c + T K',  dE/dt = w.M - K'.T K';  without a torque |K| is \
                         constant and E never rises, at any spin and any order.";
        let state = "State: angular momentum K (N m s), body axes, about the centre of mass; unit quaternion, scalar first, that \
                     takes components in body axes to inertial ones. M (N m) acts on the carrier, body axes. SI units throughout.";
        let paragraphs = std::iter::once(title.as_str())
            .chain(self.notes.iter().map(String::as_str))
            .chain([equations, state, &range])
            .chain(self.origin.iter().map(String::as_str));
        paragraphs.flat_map(|paragraph| wrapped(&plain(paragraph))).collect()
    }
}

/// A text without the letters that end or continue a comment or a string in some language.
fn plain(text: &str) -> String {
    let harmless =
        |letter: char| if matches!(letter, '"' | '\\' | '#' | '{' | '}' | '`') { '\'' } else { letter };
    let said = one_line(text).replace(" %", " percent").replace('%', " percent");
    said.chars().map(harmless).collect::<String>().replace("*/", "* /").replace("/*", "/ *")
}

/// The lines of a paragraph.
fn wrapped(text: &str) -> Vec<String> {
    let mut lines = vec![String::new()];
    for word in text.split_whitespace() {
        match lines.last_mut() {
            Some(line) if line.is_empty() => line.push_str(word),
            Some(line) if line.len() + word.len() < COLUMNS => {
                line.push(' ');
                line.push_str(word);
            }
            _ => lines.push(word.to_owned()),
        }
    }
    lines
}

/// Longest name of a body in its equations.
const LONGEST: usize = 40;

/// A name for source of every language: of the letters and digits of a title.
#[must_use]
pub fn identifier(title: &str) -> String {
    let letters = title.chars().map(|letter| if letter.is_ascii_alphanumeric() { letter } else { ' ' });
    let words = letters.collect::<String>();
    let name = words.split_whitespace().collect::<Vec<_>>().join("_");
    let name: String = name.chars().take(LONGEST).collect();
    if name.starts_with(|first: char| first.is_ascii_alphabetic()) { name } else { format!("body_{name}") }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_and_comments_stay_what_they_are_in_every_language() {
        assert_eq!(identifier("Boom satellite, 2nd"), "Boom_satellite_2nd");
        assert_eq!(identifier("3 masses"), "body_3_masses");
        assert_eq!(identifier("спутник"), "body_");
        assert_eq!(plain("off by 6.5 %, or 7%"), "off by 6.5 percent, or 7 percent");
        assert_eq!(plain("a */ b /* \"c\\\n{d}"), "a * / b / * 'c'\\u000a'd'".replace("'\\u", "''u"));
    }
}
