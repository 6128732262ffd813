//! Colour of the verdict: on a terminal, or where it is forced; never in a file.

use crate::support::{Ran, folder_of, program};

fn first_line(example: &str, variables: &[(&str, &str)]) -> String {
    let folder = folder_of(example);
    let line = "run model.toml --duration 1 --samples 11 -o spin";
    let mut command = program(folder.path());
    command.args(line.split_whitespace()).envs(variables.iter().copied());
    let ran: Ran = command.output().unwrap().into();
    ran.stdout.lines().next().unwrap().to_owned()
}

#[test]
fn verdict_is_coloured_only_where_it_is_wanted() {
    let plain = first_line("boom-satellite", &[]);
    assert!(!plain.contains('\u{1b}'), "{plain}");
    let forced = [("CLICOLOR_FORCE", "1")];
    assert_eq!(first_line("boom-satellite", &forced), format!("\u{1b}[1;32m{plain}\u{1b}[0m"));
    assert!(
        first_line("explorer1", &forced)
            .starts_with("\u{1b}[1;31mExplorer 1: The reduced equations DO NOT HOLD")
    );
    assert_eq!(first_line("boom-satellite", &[("CLICOLOR_FORCE", "1"), ("NO_COLOR", "1")]), plain);
}
