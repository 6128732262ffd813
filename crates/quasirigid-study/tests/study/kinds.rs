//! One word for one thing: the angle is a nutation of a spacecraft and a wobble of a small body, in every output, and nothing else differs.

use std::path::Path;

use quasirigid_io::model::{BodyKind, Model, Target};
use quasirigid_report::{Compared, comparison_page, page};
use quasirigid_study::modes::SteadySpinSettings;
use quasirigid_study::settings::{PartialEvolve, PartialRun, PartialSpinManifold};
use quasirigid_study::{Study, evolution, summary};

use crate::support::{carrier, ellipsoid, example, one_line, point, rotor, spinning};

/// Outputs with their names.
type Told = Vec<(&'static str, String)>;

/// Study of a text, with a kind in place of the one that the text has.
fn of_kind(model: &str, kind: BodyKind) -> Study {
    let mut model =
        Model::parse(Path::new("model.toml"), model).unwrap_or_else(|error| panic!("{error}\n{model}"));
    model.kind = kind;
    Study::new(model, None).unwrap_or_else(|error| panic!("{error}"))
}

/// Words of a page that a browser shows.
fn shown(page: &str) -> String {
    let without = |page: String, name: &str| {
        let (start, end) = (format!("<{name}"), format!("</{name}>"));
        let outside = |part: &'_ str| part.split_once(&end).map_or(part, |(_, rest)| rest).to_owned();
        page.split(&start).map(outside).collect::<String>()
    };
    let page = ["script", "style"].iter().fold(page.to_owned(), |page, name| without(page, name));
    page.split('<').filter_map(|part| Some(part.split_once('>')?.1)).collect::<Vec<_>>().join(" ")
}

/// Every output of a body.
fn told(model: &str, kind: BodyKind) -> Told {
    let study = of_kind(model, kind);
    let failed = |error: quasirigid_study::StudyError| error.to_string();
    let mut told = vec![
        ("notes", study.model.notes.join("\n")),
        ("check", study.check().map_or_else(failed, |found| found.text())),
        (
            "modes",
            study.modes(SteadySpinSettings::default()).map_or_else(failed, |found| found.text("body", true)),
        ),
        (
            "equations about the spin",
            study.about_spin(PartialSpinManifold::default(), None).map_or_else(failed, |found| found.text()),
        ),
    ];
    // one end that is reached, and one behind the start, which is refused
    for until in [None, Some(Target::Wobble(0.002)), Some(Target::Wobble(1.5))] {
        let found = study.evolve(PartialEvolve { until, ..PartialEvolve::default() }, &mut ());
        told.push(match found {
            Ok(found) => {
                let text = evolution::text("body", kind, &found.record);
                ("evolution", [text, found.record.message, found.notes.join("\n")].join("\n"))
            }
            Err(error) => ("refusal", error.to_string()),
        });
    }
    let run = study.run(&PartialRun::default(), &mut ()).unwrap_or_else(|error| panic!("{error}")).record;
    told.extend([("run", summary::answer(&run)), ("report", shown(&page(&run)))]);
    let compared = [Compared { label: "one", record: &run }, Compared { label: "other", record: &run }];
    told.push(("comparison", shown(&comparison_page(&compared))));
    told
}

/// Bodies of every method, and bodies that a method refuses.
fn bodies() -> Vec<(&'static str, String)> {
    let run = "[run]\nduration = \"3 s\"\nsystems = [\"full\", \"reduced\"]\nevolve = { until = \"0.2 deg\" }\n\
               verify = { revolutions = 1, orders = [1], halvings = 2 }\nspin_manifold = { degree = 3 }\n";
    let damper = example("nutation-damper").replace("nutation damper", "probe");
    let damper = damper[..damper.find("[initial]").unwrap()].to_owned() + &spinning([0.2, 0.0, 6.0]) + run;
    let rock =
        ellipsoid("[170, 130, 100]", [2000.0, 0.25], "shear = 1e9", "kind = \"quality-factor\", Q = 100");
    let tumbling = spinning([1e-4, 2e-5, 3e-5]) + "[run]\nevolve = {}\nsystems = [\"rigid\"]\n";
    let wheel = "[[wheel]]\nname = \"bias\"\naxis = [0.0, 0.3, 1.0]\nmomentum = 0.4\n";
    let sprung = carrier(10.0, [1.0, 1.3, 1.6]) + &point("mass", 0.1, [0.3, 0.1, 0.4], [40.0, 0.5]);
    vec![
        ("probe", damper),
        ("rock", rock + &tumbling),
        (
            "biased",
            sprung.clone()
                + wheel
                + &spinning([0.05, 0.02, 1.0])
                + "[run]\nduration = \"3 s\"\nevolve = {}\n",
        ),
        (
            "friction",
            sprung
                + &rotor("flywheel", [0.0, 0.0, 1.0], 0.02, 1e-3)
                + &spinning([0.3, 0.02, 1.0])
                + "[run]\nduration = \"3 s\"\nevolve = {}\n",
        ),
    ]
}

/// Text without the names of columns, which are the same for both.
fn without_columns(text: &str) -> String {
    text.replace("nutation_min", "").replace("nutation_max", "")
}

#[test]
fn outputs_of_both_kinds_differ_by_the_word_alone() {
    let words = |kind: BodyKind| [kind.nutation(), kind.title()];
    let ([nutation, a], [wobble, b]) = (words(BodyKind::Spacecraft), words(BodyKind::SmallBody));
    let mut heard = 0;
    for (name, model) in bodies() {
        let [spacecraft, small] = [BodyKind::Spacecraft, BodyKind::SmallBody].map(|kind| told(&model, kind));
        for ((output, one), (_, other)) in spacecraft.iter().zip(&small) {
            let [one, other] = [one, other].map(|text| without_columns(&one_line(text)));
            assert!(!one.to_lowercase().contains("wobbl"), "{name}, {output}: {one}");
            assert!(!other.to_lowercase().contains("nutation"), "{name}, {output}: {other}");
            assert_eq!(one.replace(nutation, wobble).replace(a, b), other, "{name}, {output}");
            heard += usize::from(one != other);
        }
    }
    assert!(heard > 20, "{heard} outputs have the word");
}

/// A body that its file makes a small body or a spacecraft, by its parts or by a word.
#[test]
fn the_kind_is_that_of_the_parts_unless_it_is_given() {
    let sprung = carrier(10.0, [1.0, 1.3, 1.6]);
    let rock =
        ellipsoid("[170, 130, 100]", [2000.0, 0.25], "shear = 1e9", "kind = \"quality-factor\", Q = 100");
    let kind = |text: &str| Model::parse(Path::new("model.toml"), text).map(|model| model.kind);
    assert_eq!(kind(&sprung).unwrap(), BodyKind::Spacecraft);
    assert_eq!(kind(&rock).unwrap(), BodyKind::SmallBody);
    let given = |word: &str| format!("[body]\nkind = \"{word}\"\n");
    assert_eq!(kind(&(given("small-body") + &sprung)).unwrap(), BodyKind::SmallBody);
    assert_eq!(kind(&(given("spacecraft") + &rock)).unwrap(), BodyKind::Spacecraft);
    let refused = kind(&(given("small body") + &sprung)).unwrap_err().to_string();
    assert!(
        refused.contains("did you mean \"small-body\"? write \"spacecraft\" or \"small-body\""),
        "{refused}"
    );
}
