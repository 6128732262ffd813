//! The languages, each its template and what it writes otherwise than others.

use super::language::FileName::{Ending, Whole};
use super::language::Language;

pub(super) const C: Language = Language {
    files: &[
        (Ending(".h"), include_str!("templates/body.h")),
        (Ending(".c"), include_str!("templates/body.c")),
        (Whole("self-test.c"), include_str!("templates/self_test.c")),
        (Whole("README.md"), include_str!("templates/README.md")),
    ],
    comment: ["/*\n", " * ", "\n */"],
    variables: ["K[0]", "K[1]", "K[2]"],
    continued: "",
    row: ["{", "}"],
    list: ["{\n    ", ",\n    ", "\n}"],
};

pub(super) const PYTHON: Language = Language {
    files: &[(Ending(".py"), include_str!("templates/body.py"))],
    comment: ["\"\"\"", "", "\n\"\"\""],
    variables: ["x", "y", "z"],
    continued: "",
    row: ["[", "]"],
    list: ["[\n    ", ",\n    ", ",\n]"],
};

pub(super) const SYMPY: Language =
    Language { files: &[(Ending("_sympy.py"), include_str!("templates/sympy.py"))], ..PYTHON };

pub(super) const HEYOKA: Language =
    Language { files: &[(Ending("_heyoka.py"), include_str!("templates/heyoka.py"))], ..PYTHON };

pub(super) const MATLAB: Language = Language {
    files: &[(Ending(".m"), include_str!("templates/body.m"))],
    comment: ["", "% ", ""],
    variables: ["K(1)", "K(2)", "K(3)"],
    continued: " ...",
    row: ["[", "]"],
    list: ["[ ...\n        ", "; ...\n        ", "]"],
};

pub(super) const RUST: Language = Language {
    files: &[(Ending(".rs"), include_str!("templates/body.rs"))],
    comment: ["", "//! ", ""],
    variables: ["K[0]", "K[1]", "K[2]"],
    continued: "",
    row: ["[", "]"],
    list: ["[\n    ", ",\n    ", ",\n]"],
};

pub(super) const MODELICA: Language = Language {
    files: &[(Ending(".mo"), include_str!("templates/body.mo"))],
    comment: ["", "// ", ""],
    variables: ["K[1]", "K[2]", "K[3]"],
    continued: "",
    row: ["{", "}"],
    list: ["{", ", ", "}"],
};
