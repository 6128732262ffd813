//! Invariants of every report page, whatever the record holds.

use quasirigid_io::record::*;
use quasirigid_report::page;

/// A page holds each of these, in this order.
fn assert_in_order(page: &str, parts: &[&str]) {
    let mut rest = page;
    for part in parts {
        let (_, after) = rest.split_once(part).unwrap_or_else(|| panic!("{part:?} is missing or too early"));
        rest = after;
    }
}

/// Every element that is opened is closed, in its turn.
fn assert_balanced(page: &str) {
    const VOID: [&str; 2] = ["meta", "!DOCTYPE"];
    let (before, after) = page.split_once("<style>").unwrap();
    let (_, after) = after.split_once("</style>").unwrap();
    let (main, after) = after.split_once("<script>").unwrap();
    let (_, after) = after.split_once("</script>").unwrap();
    let mut open = vec![];
    for tag in [before, main, after].concat().split('<').skip(1) {
        let (tag, _) = tag.split_once('>').expect("a tag ends");
        let name = tag.split_whitespace().next().unwrap();
        match name.strip_prefix('/') {
            Some(closed) => assert_eq!(open.pop(), Some(closed.to_owned())),
            None if VOID.contains(&name) => {}
            None => open.push(name.to_owned()),
        }
    }
    assert!(open.is_empty(), "left open: {open:?}");
}

/// Geometry is made of numbers, and labels that are read aloud exist.
fn assert_drawable(page: &str) {
    for attribute in [" d=\"", " x=\"", " y=\"", " x1=\"", " y1=\"", " cx=\"", " cy=\""] {
        for value in page.split(attribute).skip(1).map(|rest| rest.split('"').next().unwrap()) {
            assert!(!value.contains("NaN") && !value.contains("inf"), "{attribute}{value}");
        }
    }
    for id in
        page.split("aria-labelledby=\"").skip(1).flat_map(|rest| rest.split('"').next().unwrap().split(' '))
    {
        assert_eq!(page.matches(&format!("id=\"{id}\"")).count(), 1, "{id}");
    }
}

fn column<'a>(record: &'a mut RunRecord, name: &str) -> &'a mut Vec<f64> {
    &mut record.histories[0].columns.iter_mut().find(|column| column.name == name).unwrap().values
}

#[test]
fn page_answers_from_the_top() {
    let page = page(&crate::support::record(400, 600.0, 1e-4));
    assert_in_order(
        &page,
        &[
            "<h1>Boom satellite</h1>",
            "<strong>Marginal</strong>",
            "has no damping along y",
            "Spin, start → end",
            "1.310",
            "Energy dissipated",
            "Numerical drift of energy",
            "of the dissipation: small",
            "Revolutions",
            "in 10\u{a0}min",
            "What dissipated</caption>",
            "spring tip-carrier",
            "62\u{a0}%",
            "width:62.00%",
            "0.05\u{a0}%",
            "Over many revolutions",
            "Dissipation turns the rotation into a steady spin",
            "It reaches the separatrix after 4.41\u{a0}Gyr: there the angular momentum leaves the axis of least inertia",
            "End reached after",
            "13.8\u{a0}Gyr",
            "4.27\u{a0}Gyr to 371\u{a0}Gyr over the ranges of the materials",
            "about the angular momentum",
            "long-axis → short-axis",
            "Mean power at the start",
            "Nutation over many revolutions",
            "t [Gyr]</text>",
            "separatrix</text>",
            "Mean power dissipated over many revolutions",
            "power [W]</text>",
            "Mean power along the evolution",
            "D/I₃ [1]</text>",
            ">reduced</text>",
            "7 Ωₚ = ",
            "Dissipation shares at the start</caption>",
            "Harmonics of the nutation at the start",
            "Resonances on the way, strongest first",
            "slosh.x",
            "Small nutation about the axis of greatest inertia, decay by e",
            "Time within 1 % of the separatrix",
            "Spin in body axes",
            "Energy, its loss, and numerical drift",
            "Nutation",
            "Angular momentum on its sphere",
            "Criteria",
            "|ω|/Ω₁",
            "Natural frequencies",
            "Relaxations of internal rotors and liquids, attitude fixed",
            "24.53",
            "Dissipation shares at the initial spin</caption>",
            "Degrees of dω/dt",
            "Inertia about the pole",
            "Principal moments, ascending, and axes",
            "glycerine",
            "viscous, found numerically",
            "P of the slow flow",
            "ideal behind a boundary layer",
            "Inertia of the equivalent body",
            "quasirigid 0.1.0",
            "9f86d081884c7d65",
            "System: rigid",
            "Columns of evolution.csv, 400 rows",
        ],
    );
    assert_balanced(&page);
    assert_drawable(&page);
}

/// The overview lists a few dissipators of any number; a table of more than one stands with the equations.
#[test]
fn dissipators_are_listed_once_and_tabled_where_they_are_several() {
    let mut record = crate::support::record(40, 600.0, 1e-4);
    let evolution = record.evolution.as_mut().unwrap();
    evolution.dissipation.clear();
    record.reduction.dissipation = [("tank".to_owned(), 1.0)].into();
    record.histories.iter_mut().for_each(|history| history.dissipation.clear());
    let one = page(&record);
    assert_eq!((one.matches("class=\"bar\"").count(), one.contains("Dissipator")), (1, false));
    assert_in_order(&one, &["Dissipation shares", "tank", "100\u{a0}%", "At the initial spin."]);
    record.reduction.dissipation.clear();
    assert!(!page(&record).contains("Dissipation shares"));
    record.reduction.dissipation = (0..20).map(|i| (format!("spring {i:02}"), 0.05)).collect();
    let page = page(&record);
    assert_eq!(page.matches("class=\"bar\"").count(), 4 + 12);
    assert_in_order(&page, &["spring 00", "spring 11", "and 8 more in record.json", "Degrees of"]);
}

/// 0.2 J lost of the 0.5·(1/2 − 1/4)·2² J between the spin about axis 1 and that about axis 3, at |K| = 2 N m s.
#[test]
fn proof_tells_each_order_and_what_was_not_reached() {
    let mut record = crate::support::record(40, 600.0, 1e-4);
    let page = page(&record);
    assert_in_order(
        &page,
        &[
            "Verification against the full system",
            "5 revolutions",
            "Not every order is reached",
            "2.010",
            "not reached",
        ],
    );
    assert_drawable(&page);
    record.verification = None;
    assert!(!quasirigid_report::page(&record).contains("Proof against"));
}

/// Times that are infinite are told as never, and an evolution without events claims none.
#[test]
fn evolution_without_end_is_told_in_words() {
    let mut record = crate::support::record(40, 600.0, 1e-4);
    let evolution = record.evolution.as_mut().unwrap();
    evolution.time = f64::INFINITY;
    evolution.time_range = Some([3e15, f64::INFINITY]);
    evolution.mode_start = "short-axis".into();
    [evolution.damping_time, evolution.growth_time] = [f64::INFINITY; 2];
    [evolution.separatrix_time, evolution.lingering] = [None; 2];
    evolution.resonances.clear();
    let page = page(&record);
    assert_in_order(
        &page,
        &[
            "End reached after",
            ">never<",
            "95.1\u{a0}Myr at the least",
            "short-axis<small> throughout",
            "passes a natural frequency on the way",
            "never",
            "never",
            "none: it does not come so near",
            "How it went",
        ],
    );
    assert!(!page.contains("separatrix</text>") && !page.contains("It reaches"));
    record.evolution.as_mut().unwrap().status = "failed".into();
    assert_in_order(
        &quasirigid_report::page(&record),
        &["<h2>Over many revolutions", "<strong>Failed.</strong> The target was reached. Dissipation"],
    );
    record.evolution = None;
    assert!(!quasirigid_report::page(&record).contains("many revolutions"));
}

/// The curve ends where the angular momentum leaves one axis, and begins anew where it circles the other.
#[test]
fn curve_is_broken_where_the_circled_axis_changes() {
    let mut record = crate::support::record(40, 600.0, 1e-4);
    let pieces = |record: &RunRecord| {
        let page = page(record);
        let (_, curve) = page.split_once("data-label=\"max\" d=\"").unwrap();
        curve.split('"').next().unwrap().matches('M').count()
    };
    assert_eq!(pieces(&record), 2);
    let evolution = record.evolution.as_mut().unwrap();
    evolution.columns.iter_mut().find(|column| column.name == "circled_axis").unwrap().values.fill(3.0);
    assert_eq!(pieces(&record), 1);
}

#[test]
fn loss_is_told_as_part_of_what_can_be_lost() {
    let mut record = crate::support::record(2, 1.0, 0.0);
    record.body.principal_moments = [2.0, 3.0, 4.0];
    record.histories[0].energy = 1.0;
    record.histories[0].dissipated = 0.2;
    column(&mut record, "momentum").fill(2.0);
    assert_in_order(
        &page(&record),
        &["Energy dissipated", ">0.2<", "40\u{a0}% of what it can lose at this |K|"],
    );
    record.histories[0].columns.clear();
    assert_in_order(&page(&record), &["Energy dissipated", "20\u{a0}% of the energy at the start"]);
}

#[test]
fn drift_is_called_small_up_to_one_percent_and_no_further() {
    let mut record = crate::support::record(2, 1.0, 0.0);
    record.histories[0].dissipated = 1.0;
    record.histories[0].energy_drift = -0.0099;
    assert!(page(&record).contains("0.99\u{a0}% of the dissipation: small"));
    record.histories[0].energy_drift = -0.0101;
    assert!(page(&record).contains("1.01\u{a0}% of the dissipation: too much"));
}

#[test]
fn every_column_and_every_axis_has_its_unit() {
    let record = crate::support::record(50, 60.0, 1e-4);
    let page = page(&record);
    for column in record.histories[0].columns.iter().chain(&record.evolution.as_ref().unwrap().columns) {
        let row = format!("<th scope=\"row\">{}</th><td class=\"word\">[{}]</td>", column.name, column.unit);
        assert!(page.contains(&row), "{row}");
    }
    assert_in_order(
        &page,
        &["ω [rad/s]</text>", "t [s]</text>", "energy [J]</text>", "t [s]</text>", "nutation [°]</text>"],
    );
    assert_eq!(
        page.matches("<th").count(),
        page.matches("<th scope=").count() + page.matches("<thead").count()
    );
}

#[test]
fn text_of_the_record_is_only_text() {
    let mut record = crate::support::record(3, 1.0, 0.0);
    let evil = "<b a=\"'&\"></script><script>x()</script>";
    record.model =
        ModelRecord { name: evil.into(), file: evil.into(), sha256: evil.into(), files: Vec::new() };
    record.notes = vec![evil.into()];
    record.body.coordinates = vec![evil.into()];
    record.validity.verdict = evil.into();
    record.validity.criteria[0].symbol = evil.into();
    record.histories[0].system = evil.into();
    let evolution = record.evolution.as_mut().unwrap();
    for text in
        [&mut evolution.sentence, &mut evolution.method, &mut evolution.status, &mut evolution.mode_start]
    {
        *text = evil.into();
    }
    evolution.resonances[0].coordinate = evil.into();
    evolution.columns[0].unit = evil.into();
    record.histories[0].columns[1].unit = evil.into();
    let page = page(&record);
    assert!(!page.contains("<b ") && page.matches("<script>").count() == 1);
    assert_balanced(&page);
}

#[test]
fn page_needs_nothing_from_elsewhere() {
    let page = page(&crate::support::record(30, 60.0, 1e-4));
    let page =
        page.replace("http://www.w3.org/2000/svg", "the name of SVG").replace("url(#", "a part of the page");
    for address in ["http://", "https://", "src=", "href=", "url(", "@import"] {
        assert!(!page.contains(address), "{address}");
    }
}

#[test]
fn verdict_is_told_in_words_and_shape() {
    let mut record = crate::support::without_histories();
    for (verdict, words) in [("holds", "Valid"), ("marginal", "Marginal"), ("fails", "Not valid")] {
        record.validity.overall = verdict.into();
        let page = page(&record);
        assert_in_order(&page, &["<h1>", "<svg class=\"icon", verdict, words, "<h2>Result"]);
    }
}

#[test]
fn early_end_is_told_before_the_numbers() {
    let mut record = crate::support::record(3, 1.0, 0.0);
    record.histories[0].status = "left validity".into();
    record.histories[0].message = "It spun too fast at 0.5 s.".into();
    assert_in_order(&page(&record), &["Ended early", "It spun too fast at 0.5 s.", "Spin, start"]);
}

#[test]
fn million_rows_stay_below_a_megabyte() {
    let page = page(&crate::support::record(1_000_000, 2e5, 2e-7));
    assert!(page.len() < 1_000_000, "{} bytes", page.len());
    assert!(page.contains("The history is long"));
    assert_drawable(&page);
}

#[test]
fn bodies_with_many_modes_stay_below_a_megabyte() {
    let mut record = crate::support::without_histories();
    record.evolution = Some(crate::support::secular::evolution(0.75));
    let few = page(&record).len();
    record.validity.frequencies = (1..=100_000).map(f64::from).collect();
    record.validity.decay_rates = record.validity.frequencies.clone();
    record.body.coordinates = (1..=100_000).map(|i| format!("node {i}")).collect();
    let mut evolution = crate::support::secular::evolution(0.75);
    evolution.harmonics = vec![evolution.harmonics[0].clone(); 100_000];
    evolution.resonances = vec![evolution.resonances[0].clone(); 100_000];
    record.evolution = Some(evolution);
    let page = page(&record);
    assert!(page.len() < few + 30_000, "{} {few}", page.len());
    assert!(page.contains("and 99988 more in record.json"));
}

/// Overdamped motions are no time constants of the body: the card leaves them out, the table has them in a line.
#[test]
fn overdamped_motions_are_folded() {
    let mut record = crate::support::record(40, 60.0, 1e-4);
    let spin = &mut record.steady_spins[0];
    let slack = ModeRecord {
        name: "vane z".into(),
        nutation: false,
        overdamped: true,
        frequency: 0.0,
        time_constant: Some(2.0),
        ..spin.modes[0].clone()
    };
    spin.modes
        .extend((0..3).map(|i| ModeRecord { time_constant: Some(2.0 + f64::from(i)), ..slack.clone() }));
    spin.modes[0] = ModeRecord { neutral: true, time_constant: None, ..spin.modes[0].clone() };
    let page = page(&record);
    assert_in_order(
        &page,
        &["neutral to rounding", "3 overdamped motions, with time constants of 2\u{a0}s to 4\u{a0}s"],
    );
    assert!(!page.contains("vane z"));
}

#[test]
fn what_is_missing_is_said() {
    let mut record = crate::support::without_histories();
    record.validity.T2 = None;
    record.validity.decay_rates.clear();
    let text = page(&record);
    assert!(text.contains("nothing was propagated") && text.contains("none: it does not decay"));
    let mut empty = crate::support::record(1, 1.0, 0.0);
    column(&mut empty, "t").clear();
    for columns in [empty.histories[0].columns.clone(), vec![]] {
        empty.histories[0].columns = columns;
        assert!(page(&empty).contains("The record has no data for this figure."));
    }
    [text, page(&empty)].iter().for_each(|page| assert_balanced(page));
}

#[test]
fn gaps_and_extremes_are_drawn_without_nonsense() {
    let mut record = crate::support::record(200, 60.0, 1e-4);
    column(&mut record, "wx")[50..60].fill(f64::NAN);
    column(&mut record, "wy").fill(1e300);
    column(&mut record, "wz")[3] = f64::INFINITY;
    column(&mut record, "dissipated")[7] = 1e-300;
    column(&mut record, "dissipated")[8] = 1e300;
    column(&mut record, "nutation_max").fill(f64::NAN);
    column(&mut record, "t")[100] = f64::NEG_INFINITY;
    let page = page(&record);
    assert_drawable(&page);
    assert_in_order(&page, &["[10³⁰⁰ rad/s]", "10³⁰⁰"]);
}
