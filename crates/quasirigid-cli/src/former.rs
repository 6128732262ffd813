//! Former names on the command line: accepted for one version, each with a note that says the name of today.

use std::ffi::OsString;

use clap::{Arg, CommandFactory};
use quasirigid_io::model::former_name;

use crate::args::Arguments;

/// Notes on the former names of flags and words among the arguments of the program.
pub fn notes(arguments: impl IntoIterator<Item = OsString>) -> Vec<String> {
    let words: Vec<String> =
        arguments.into_iter().skip(1).map(|word| word.to_string_lossy().into_owned()).collect();
    let program = Arguments::command();
    let Some(command) = words.first().and_then(|word| program.find_subcommand(word)) else {
        return Vec::new();
    };
    let mut notes = Vec::new();
    for (at, word) in words.iter().enumerate().skip(1).take_while(|(_, word)| *word != "--") {
        let (flag, value) = match word.split_once('=') {
            Some((flag, value)) => (flag, Some(value)),
            None => (word.as_str(), words.get(at + 1).map(String::as_str)),
        };
        let Some(flag) = flag.strip_prefix("--") else { continue };
        for arg in command.get_arguments() {
            let Some(long) = arg.get_long() else { continue };
            let is_former = arg.get_all_aliases().unwrap_or_default().contains(&flag);
            if is_former {
                notes.push(former_name(&format!("--{flag}"), &format!("--{long}")));
            }
            if is_former || long == flag {
                notes.extend(value.and_then(|value| of_value(arg, long, value)));
            }
        }
    }
    notes
}

/// Note on the former name of a value of a flag; none for a name of today.
fn of_value(arg: &Arg, long: &str, value: &str) -> Option<String> {
    let possible = arg.get_possible_values();
    let known =
        possible.iter().find(|known| known.get_name_and_aliases().skip(1).any(|name| name == value))?;
    Some(former_name(&format!("--{long} {value}"), known.get_name()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn former_names_are_noted_with_those_of_today() {
        let of = |line: &str| notes(line.split(' ').map(OsString::from));
        let version = "this version takes the former name for the last time";
        assert_eq!(
            of("quasirigid evolve m.toml --from 0.9 --to=5deg --method direct"),
            [
                format!("--from is now called --start; {version}"),
                format!("--to is now called --until; {version}"),
                format!("--method direct is now called full; {version}"),
            ]
        );
        assert_eq!(
            of("quasirigid simulate m.toml --method implicit --form=paper --system manifold"),
            [
                format!("--method is now called --integrator; {version}"),
                format!("--form paper is now called angular-velocity; {version}"),
                format!("--system manifold is now called spin-manifold; {version}"),
            ]
        );
        assert_eq!(of("quasirigid evolve m.toml --start 0.9 --method full").len(), 0);
        assert_eq!(of("quasirigid verify m.toml --rotations 3").len(), 1);
        assert_eq!(of("quasirigid evolve --samples-of-uncertainty 9 -- --to").len(), 1);
    }
}
