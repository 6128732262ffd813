//! The README and the guide are sound: their TOML parses, their commands name what exists.

use crate::finding::Finding;
use crate::markdown::{Block, blocks};
use crate::tree::Tree;

const README: &str = "README.md";

/// The script that a fresh checkout must pass.
const CI: &str = ".ci/run";

/// The line of the script with the command of the tests.
const TEST_COMMAND: &str = "test_command=";

/// Options whose value is a path that the command makes.
const OUTPUTS: [&str; 2] = ["-o", "--out"];

/// The workspace's manifest.
const MANIFEST: &str = "Cargo.toml";

/// Blocks of TOML that do not parse, example paths that do not exist, a README without the test command, and one whose `cargo run` finds no one
/// program.
pub fn check(tree: &Tree) -> Vec<Finding> {
    let readme = tree.text(README);
    let pages = readme.map(|text| (README, text)).into_iter().chain(tree.files("docs/guide", ".md"));
    let mut findings: Vec<Finding> = pages
        .flat_map(|(file, text)| blocks(text).into_iter().map(move |block| (file, block)))
        .flat_map(|(file, block)| match block.language.as_str() {
            "toml" => bad_toml(file, &block).into_iter().collect(),
            "sh" | "console" => missing_examples(tree, file, &block),
            _ => Vec::new(),
        })
        .collect();
    findings.extend(readme.and_then(|text| without_test_command(tree, text)));
    findings.extend(readme.and_then(|text| without_one_program(tree, text)));
    findings
}

fn bad_toml(file: &str, block: &Block) -> Option<Finding> {
    let error = block.text.parse::<toml::Table>().err()?;
    let before = error.span().map_or("", |span| &block.text[..span.start]);
    let line = block.line + before.matches('\n').count();
    Some(Finding::error(file, line, format!("TOML: {}", error.message())))
}

fn missing_examples(tree: &Tree, file: &str, block: &Block) -> Vec<Finding> {
    commands(block)
        .flat_map(|(line, command)| examples(command).map(move |path| (line, path)))
        .filter(|(_, path)| !tree.exists(path))
        .map(|(line, path)| Finding::error(file, line, format!("{path} does not exist")))
        .collect()
}

/// Commands of a block: in `console` the lines after the prompt, in `sh` every line.
fn commands(block: &Block) -> impl Iterator<Item = (usize, &str)> {
    let bare = block.language == "sh";
    (block.line..).zip(block.text.lines()).filter_map(move |(line, text)| {
        let text = text.trim();
        let command = text.strip_prefix("$ ").or(bare.then_some(text))?;
        Some((line, command))
    })
}

/// Words of a command that are paths of examples it reads.
fn examples(command: &str) -> impl Iterator<Item = &str> {
    let options = std::iter::once("").chain(command.split_whitespace());
    options
        .zip(command.split_whitespace())
        .filter(|(option, _)| !OUTPUTS.contains(option))
        .map(|(_, word)| word.trim_start_matches("./").trim_end_matches('/'))
        .filter(|word| word.starts_with("examples/"))
}

fn without_test_command(tree: &Tree, readme: &str) -> Option<Finding> {
    let mut script = tree.text(CI)?.lines();
    let Some(wanted) = script.find_map(|line| line.strip_prefix(TEST_COMMAND)) else {
        return Some(Finding::error(CI, 1, format!("no line starts with {TEST_COMMAND}")));
    };
    let wanted = wanted.trim_matches(['"', '\'']);
    let blocks = blocks(readme);
    let mut shown =
        blocks.iter().filter(|block| ["sh", "console"].contains(&block.language.as_str())).flat_map(commands);
    let message = format!("no block shows the command `{wanted}` that {CI} runs");
    (!shown.any(|(_, command)| command == wanted)).then(|| Finding::error(README, 1, message))
}

/// A `cargo run` that names no package needs one program among the default members.
fn without_one_program(tree: &Tree, readme: &str) -> Option<Finding> {
    let blocks = blocks(readme);
    let mut shown = blocks.iter().flat_map(commands);
    let (line, _) = shown.find(|(_, command)| {
        command.starts_with("cargo run ") && !command.contains(" -p ") && !command.contains(" --bin ")
    })?;
    let manifest: toml::Table = tree.text(MANIFEST)?.parse().ok()?;
    let members = manifest.get("workspace")?.get("default-members")?.as_array()?;
    let members = members.iter().filter_map(toml::Value::as_str);
    let programs = members.filter(|member| tree.exists(&format!("{member}/src/main.rs"))).count();
    let message = format!(
        "`cargo run` needs one program among the default members of {MANIFEST}; there are {programs}"
    );
    (programs != 1).then(|| Finding::error(README, line, message))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::tree::sample;

    const SCRIPT: (&str, &str) = (".ci/run", "#!/bin/bash\ntest_command=\"cargo test --workspace\"\n");
    const EXAMPLE: (&str, &str) = ("examples/boom/model.toml", "");
    const GOOD: &str = "```sh\ncargo test --workspace\n```\n```toml\n[run]\norder = 3\n```\n\
                        ```console\n$ quasirigid run examples/boom/model.toml -o examples/boom/out\nexamples/none\n```\n";

    fn found(readme: &str) -> Vec<String> {
        let tree = sample(&[SCRIPT, EXAMPLE, ("README.md", readme)]);
        check(&tree).iter().map(ToString::to_string).collect()
    }

    #[test]
    fn a_sound_page_passes() {
        assert_eq!(found(GOOD), [""; 0]);
    }

    #[test]
    fn toml_that_does_not_parse_is_found_on_its_line() {
        let findings = found(&GOOD.replace("order = 3", "order = "));
        assert_eq!(findings.len(), 1);
        assert!(findings[0].starts_with("README.md:6: TOML: "), "{findings:?}");
    }

    #[test]
    fn an_example_that_does_not_exist_is_found() {
        assert_eq!(
            found(&GOOD.replace("run examples/boom/model.toml", "run ./examples/bom/")),
            ["README.md:9: examples/bom does not exist"]
        );
        let guide = sample(&[("docs/guide/1.md", "```sh\nquasirigid run examples/bom.toml\n```\n")]);
        assert_eq!(check(&guide), [Finding::error("docs/guide/1.md", 2, "examples/bom.toml does not exist")]);
    }

    #[test]
    fn the_readme_shows_exactly_the_test_command() {
        let message = "README.md:1: no block shows the command `cargo test --workspace` that .ci/run runs";
        for other in ["cargo test", "cargo test --workspace --release"] {
            assert_eq!(found(&GOOD.replace("cargo test --workspace", other)), [message]);
        }
        let tree = sample(&[("README.md", GOOD), EXAMPLE, (".ci/run", "cargo test\n")]);
        assert_eq!(check(&tree), [Finding::error(".ci/run", 1, "no line starts with test_command=")]);
    }

    #[test]
    fn cargo_run_finds_one_program() {
        let readme = GOOD.replace("quasirigid run", "cargo run --release -- run");
        let with = |members: &str| {
            let manifest = format!("[workspace]\ndefault-members = [{members}]\n");
            let program = |name| (name, "fn main() {}\n");
            let programs = [program("crates/door/src/main.rs"), program("crates/fuzz/src/main.rs")];
            let tree = sample(&[
                SCRIPT,
                EXAMPLE,
                ("README.md", &readme),
                ("Cargo.toml", &manifest),
                programs[0],
                programs[1],
            ]);
            check(&tree).iter().map(ToString::to_string).collect::<Vec<_>>()
        };
        assert_eq!(with("\"crates/door\", \"crates/body\""), [""; 0]);
        for (members, programs) in [("\"crates/door\", \"crates/fuzz\"", 2), ("\"crates/body\"", 0)] {
            let message = format!(
                "README.md:9: `cargo run` needs one program among the default members of Cargo.toml; there are {programs}"
            );
            assert_eq!(with(members), [message]);
        }
    }

    #[test]
    fn without_a_readme_there_is_nothing_to_check() {
        assert_eq!(check(&sample(&[SCRIPT])), []);
    }
}
