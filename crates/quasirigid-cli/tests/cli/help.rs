use crate::support::{EXAMPLES, STUDIES, SUNLIT, ran};

const COMMANDS: [&str; 16] = [
    "run",
    "check",
    "modes",
    "linear",
    "derive",
    "fills",
    "lightcurve",
    "yorp",
    "export",
    "simulate",
    "evolve",
    "verify",
    "cite",
    "sensitivity",
    "infer",
    "sweep",
];

#[test]
fn help_lists_every_command_and_the_exit_codes() {
    let help = ran("--help");
    assert_eq!((help.code, &*help.stderr), (Some(0), ""));
    for command in COMMANDS {
        assert!(
            help.stdout.lines().any(|line| line.starts_with(&format!("  {command} "))),
            "{}",
            help.stdout
        );
    }
    assert!(
        help.stdout.contains("Exit codes: 0 done, 1 done but a requested check failed, 2 could not run."),
        "{}",
        help.stdout
    );
}

#[test]
fn every_command_shows_an_example_of_itself_that_names_a_model_we_ship() {
    for command in COMMANDS {
        let help = ran(&format!("{command} --help"));
        assert_eq!((help.code, &*help.stderr), (Some(0), ""), "{command}");
        let (_, example) = help.stdout.split_once("Example:\n").expect(command);
        let (line, rest) = example.split_once('\n').unwrap();
        assert!(line.starts_with(&format!("  quasirigid {command} examples/")), "{line}");
        let files = EXAMPLES.into_iter().chain(SUNLIT).map(|name| format!("examples/{name}/model.toml"));
        let studies = STUDIES.map(|name| format!("examples/{name}/study.toml"));
        assert!(files.chain(studies).any(|file| line.contains(file.as_str())), "{line}");
        assert_eq!(rest, "", "the example is one line");
    }
}

#[test]
fn examples_of_commands_that_write_nothing_run() {
    for command in ["check", "linear", "derive", "simulate", "evolve"] {
        let help = ran(&format!("{command} --help")).stdout;
        let (_, example) = help.split_once("Example:\n  quasirigid ").unwrap();
        let code = ran(example).code;
        assert!(code == Some(0) || example.contains("explorer1/") && code == Some(1), "{example}: {code:?}");
    }
}

#[test]
fn every_command_takes_order_json_and_quiet() {
    for command in COMMANDS {
        let help = ran(&format!("{command} -h")).stdout;
        for option in ["--json", "-q, --quiet"] {
            assert!(help.contains(option), "{command} lacks {option}");
        }
        // a study varies the order as any other key
        assert_eq!(help.contains("--order <P>"), command != "sweep", "{command}");
    }
}

#[test]
fn version_is_the_package_version() {
    let version = ran("--version");
    assert_eq!(version.stdout, format!("quasirigid {}\n", env!("CARGO_PKG_VERSION")));
    assert_eq!((version.code, &*version.stderr), (Some(0), ""));
}

#[test]
fn nothing_to_do_and_unknown_words_exit_with_2_and_print_no_result() {
    for line in
        ["", "chek examples/axial-mass/model.toml", "check", "check --fast examples/axial-mass/model.toml"]
    {
        let refused = ran(line);
        assert!(refused.refusal().contains("Usage: quasirigid"), "{line}: {}", refused.stderr);
    }
}

#[test]
fn a_mistyped_command_or_option_is_answered_with_the_nearest() {
    assert!(ran("chek model.toml").stderr.contains("'check'"));
    assert!(ran("check --quite model.toml").stderr.contains("'--quiet'"));
}
