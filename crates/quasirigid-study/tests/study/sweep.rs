//! Rows of studies beside the commands that they stand for, and intervals of uncertain models.

use std::path::Path;

use quasirigid_io::model::{System, Target};
use quasirigid_study::sweep::{Cell, RowAnswer, Status, Sweep};

use crate::support::{MODEL, column, ellipsoid, evolved, example, follow, one_line, study, until, wobbling};

/// Study of a model by its lists of values, with quantities and further lines.
fn sweep(model: &str, vary: &str, quantities: &str, more: &str) -> Sweep {
    let text =
        format!("model = \"model.toml\"\n[vary]\n{vary}\n[answer]\nquantities = [{quantities}]\n{more}");
    Sweep::parse(Path::new("study.toml"), &text, Some(model), &mut ()).unwrap()
}

fn answer(sweep: &Sweep, row: u64, name: &str) -> Cell {
    let place = sweep.outputs.iter().position(|output| output.name == name).unwrap();
    sweep.answer(row).unwrap().outputs[place].clone()
}

/// The spin, by `simulate`, and the wobble, by `evolve`, of one row beside the histories and evolutions themselves.
#[test]
fn states_at_times_and_refused_evolutions() {
    let quantities = "\"simulate.wx\", \"evolve.time\", \"evolve.status\"";
    let sweep =
        sweep(MODEL, "\"run.order\" = { list = [1, 3] }", quantities, "times = [\"10 s\", \"1 min\"]\n");
    assert_eq!(sweep.rows(), 2);
    let alone = study(MODEL);
    let history = follow(&alone, System::Reduced, &[10.0, 60.0]);
    for (time, expected) in ["10 s", "1 min"].iter().zip(column(&history.columns, "wx")) {
        let found = answer(&sweep, 1, &format!("simulate.wx at {time}"));
        assert_eq!(found, Cell::Number(*expected));
    }
    let evolved = evolved(&alone, |_| {}).record;
    let finished = evolved.status == "finished";
    let row = sweep.answer(1).unwrap();
    assert_eq!(row.status == Status::Answered, finished, "{row:#?}");
    assert_eq!(answer(&sweep, 1, "evolve.time") == Cell::Missing, !finished || !evolved.time.is_finite());
    assert_eq!(answer(&sweep, 1, "evolve.status"), Cell::Text(evolved.status));
}

/// A time that is known to a few per cent says so in its row.
#[test]
fn coarse_times_are_noted() {
    let equal = "0.9746428571428571, 0.9746428571428571";
    let model = example("axial-mass").replace(equal, "0.9746428571428571, 0.93");
    let error = 100.0 * evolved(&study(&model), |_| {}).record.time_error.unwrap();
    let sweep = sweep(&model, "\"run.order\" = { list = [3] }", "\"evolve.time\"", "");
    let RowAnswer { status, note, .. } = sweep.answer(0).unwrap();
    assert_eq!(status, Status::Answered);
    assert!(error > 1.0 && note.contains(&format!("the time of evolve is good to {error:.2} %")), "{note}");
}

/// What may not hold of the model of a row stands in its note, as before the answer of the command.
#[test]
fn doubts_about_a_model_stand_in_its_rows() {
    let sweep =
        sweep(&example("two-tanks"), "\"tank.1.fill\" = { list = [0.3, 0.4] }", "\"modes.stable\"", "");
    for row in 0..2 {
        let RowAnswer { status, note, .. } = sweep.answer(row).unwrap();
        assert_eq!(status, Status::Answered);
        assert!(note.starts_with("MAY NOT HOLD: Coriolis forces"), "{note}");
    }
}

/// A spring too soft for the reduced equations gives no states, in a row as in a history.
#[test]
fn states_of_equations_that_do_not_hold_are_refused() {
    let vary = "\"spring.1.stiffness\" = { list = [600.0, 0.05] }";
    let sweep = sweep(MODEL, vary, "\"simulate.wx\"", "");
    let [stiff, soft] = [0, 1].map(|row| {
        let alone = follow(&study(&sweep.model_text(row).unwrap()), System::Reduced, &[0.0, 60.0]);
        (sweep.answer(row).unwrap(), alone)
    });
    assert!(stiff.0.status == Status::Answered && stiff.1.holds());
    assert!(matches!(stiff.0.outputs[..], [Cell::Number(_)]));
    assert!(soft.0.status == Status::Refused && !soft.1.holds());
    assert_eq!(soft.0.outputs, [Cell::Missing]);
    let reason = &soft.0.reason;
    assert!(reason.starts_with("The reduced equations DO NOT HOLD"), "{reason}");
    assert!(soft.1.reason().unwrap().contains(reason.as_str()), "{reason} {:?}", soft.1.reason());
}

/// The time of an evolution is proportional to Q, so that its quantiles are those of Q, to one of 64 intervals of equal probability.
#[test]
fn intervals_of_the_time_are_those_of_the_quality_factor() {
    let rheology = "kind = \"quality-factor\", Q = 100";
    let rock = ellipsoid("[219.0, 151.0, 143.0]", [2000.0, 0.25], "shear = \"0.5 GPa\"", rheology)
        + &wobbling("20 deg", "1 rpm", "short-axis")
        + &until("5 deg");
    let uncertain =
        "[uncertainty]\n\"material.rock.rheology.Q\" = { log-normal = { median = 100, decades = 0.5 } }\n";
    let study = study(&(rock.clone() + uncertain));
    let time = evolved(&study, |asked| asked.until = Some(Target::Wobble(5f64.to_radians()))).record.time;
    let found = study.uncertainty(64, &mut ()).unwrap().unwrap();
    let interval = &found.intervals[0];
    assert_eq!((&*interval.name, found.answered), ("time", 64));
    // at the median an interval of 1/64 is 0.0156/0.399 standard deviations wide, at 16 % 0.0156/0.242, each 0.5 decades
    assert!((interval.median / time).log10().abs() < 0.020, "{} {time}", interval.median);
    for (end, sign) in [(0, -1.0), (1, 1.0)] {
        let decades = (interval.interval_68[end] / time).log10();
        assert!((decades - sign * 0.5 * 0.994_458).abs() < 0.032, "{decades}"); // z of 84 %
    }
    let rho = found.correlations[0].rho.unwrap();
    assert!((rho - 1.0).abs() < 1e-12, "{rho}");
    let certain = crate::support::study(&rock).uncertainty(9, &mut ()).unwrap_err().to_string();
    assert!(one_line(&certain).contains("has no [uncertainty]"), "{certain}");
}
