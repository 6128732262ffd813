//! The five programs of the examples: short, and with their output in their last comment.

#[path = "../../examples/asteroid.rs"]
mod asteroid;
#[path = "../../examples/full_against_reduced.rs"]
mod full_against_reduced;
#[path = "../../examples/parts_and_hinge.rs"]
mod parts_and_hinge;
#[path = "../../examples/sampled_history.rs"]
mod sampled_history;
#[path = "../../examples/stiffness_scan.rs"]
mod stiffness_scan;

/// Most lines of a program that a newcomer reads.
const LINES: usize = 15;

/// Compares the output of a program with the comment at its end, and counts the lines of its statements.
fn check(source: &str, printed: Result<String, quasirigid::Error>) {
    let printed = printed.unwrap();
    let (code, comment) = source.split_once("// Prints:\n").unwrap();
    let expected: String =
        comment.lines().map(|line| format!("{}\n", line.trim_start_matches("// "))).collect();
    assert_eq!(printed, expected, "{printed}");
    let (_, program) = code.split_once("pub fn program").unwrap();
    let lines = program.lines().skip(1).take_while(|line| *line != "}").count();
    assert!(lines <= LINES, "{lines} lines");
}

#[test]
fn parts_and_a_hinge_to_order_four() {
    check(include_str!("../../examples/parts_and_hinge.rs"), parts_and_hinge::program());
}

#[test]
fn a_sampled_history() {
    check(include_str!("../../examples/sampled_history.rs"), sampled_history::program());
}

#[test]
fn two_hundred_stiffnesses_in_parallel() {
    check(include_str!("../../examples/stiffness_scan.rs"), stiffness_scan::program());
}

#[test]
fn ten_billion_years_of_an_asteroid() {
    check(include_str!("../../examples/asteroid.rs"), asteroid::program());
}

#[test]
fn full_against_reduced_equations() {
    check(include_str!("../../examples/full_against_reduced.rs"), full_against_reduced::program());
}
