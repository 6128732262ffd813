//! A record written is the record read, and a damaged folder is refused by file and line.

use std::collections::BTreeMap;
use std::fs;
use std::io::ErrorKind;
use std::path::Path;

use proptest::array::uniform9;
use proptest::collection::{btree_map, vec};
use proptest::num::f64::{ANY, Any, NEGATIVE, NORMAL, POSITIVE, SUBNORMAL, ZERO};
use proptest::option;
use proptest::prelude::*;
use proptest::strategy::ValueTree;
use proptest::test_runner::{RngSeed, TestRunner};
use quasirigid_io::record::*;
use quasirigid_io::table_file::{TableError, read_bodies, read_parquet};
use tempfile::tempdir;

/// Numbers that JSON can write: every one that is finite, with its sign.
fn finite() -> Any {
    POSITIVE | NEGATIVE | NORMAL | SUBNORMAL | ZERO
}

prop_compose! {
    fn resolution()(
        degree in option::of(any::<usize>()), cells in option::of(any::<usize>()), error in option::of(finite()),
        sentence in ".*",
    ) -> ResolutionRecord {
        ResolutionRecord { degree, cells, error, sentence }
    }
}

prop_compose! {
    fn body()(
        mass in finite(), center_of_mass in [finite(); 3], pole in [finite(); 3], support in ".*",
        inertia in [[finite(); 3], [finite(); 3], [finite(); 3]], principal_moments in [finite(); 3],
        principal_axes in [[finite(); 3], [finite(); 3], [finite(); 3]], coordinates in vec(".*", 0..3),
        resolution in option::of(resolution()),
    ) -> BodyRecord {
        BodyRecord {
            mass, center_of_mass, pole, support, inertia, principal_moments, principal_axes, coordinates,
            resolution, kind: quasirigid_io::model::BodyKind::SmallBody,
        }
    }
}

prop_compose! {
    fn criterion()(
        name in ".*", symbol in ".*", value in finite(), limit in finite(), verdict in ".*", sentence in ".*",
    ) -> CriterionRecord {
        CriterionRecord { name, symbol, value, limit, verdict, sentence }
    }
}

prop_compose! {
    fn validity()(
        valid: bool, verdict in ".*", overall in ".*", T1 in finite(), T2 in option::of(finite()), T3 in finite(),
        frequencies in vec(finite(), 0..4), decay_rates in vec(finite(), 0..4), relaxations in vec(finite(), 0..4),
        criteria in vec(criterion(), 0..3),
    ) -> ValidityRecord {
        ValidityRecord { valid, verdict, overall, T1, T2, T3, frequencies, decay_rates, relaxations, criteria }
    }
}

prop_compose! {
    fn liquid()(
        name in ".*", mass in finite(), radius in finite(), viscosity in finite(), reynolds in finite(), P in [[finite(); 3], [finite(); 3], [finite(); 3]],
        errors in option::of([finite(); 3]),
        equivalent_inertia in option::of([[finite(); 3], [finite(); 3], [finite(); 3]]),
    ) -> LiquidRecord {
        LiquidRecord { name, mass, radius, viscosity, reynolds, P, errors, equivalent_inertia }
    }
}

prop_compose! {
    fn reduction()(
        order in 1usize..9, optimal_order in 1usize..9, residual in finite(), power in finite(), dissipation in shares(),
        sizes in vec((2usize..9, finite(), finite()), 0..4),
    ) -> ReductionRecord {
        let degrees = sizes
            .into_iter()
            .map(|(degree, size, relative)| DegreeRecord { degree, size, relative })
            .collect();
        ReductionRecord { order, optimal_order, residual, degrees, power, dissipation }
    }
}

fn shares() -> impl Strategy<Value = BTreeMap<String, f64>> {
    btree_map(".*", finite(), 0..3)
}

fn columns() -> impl Strategy<Value = Vec<Column>> {
    (0usize..4, 0usize..6).prop_flat_map(|(columns, rows)| {
        let column = ("[-a-z,\" ω=+;']{0,6}", ".*", vec(ANY, rows)).prop_map(|(name, unit, values)| Column {
            name,
            unit,
            values,
        });
        vec(column, columns)
    })
}

prop_compose! {
    fn history(system: &'static str)(
        form in ".*", method in ".*", status in ".*", message in ".*", steps: u64, rejected: u64,
        numbers in uniform9(finite()), columns in columns(), dissipation in shares(),
    ) -> HistoryRecord {
        let [tolerance, revolutions, energy, dissipated, work, energy_drift, left_out, load_ratio, momentum_drift] = numbers;
        HistoryRecord {
            system: system.into(), form, method, status, message, tolerance, steps, rejected, revolutions,
            energy, dissipated, dissipation, work, energy_drift, left_out, load_ratio, ringing: None, momentum_drift, rows: 0, columns,
            log: None,
        }
    }
}

prop_compose! {
    fn order()(
        p in 1usize..9, order in option::of(finite()), reached: bool, numbers in [vec(finite(), 0..4), vec(finite(), 0..4)],
    ) -> OrderRecord {
        let [epsilons, errors] = numbers;
        let (attitude, dissipated, dissipation) = (errors.clone(), epsilons.clone(), errors.clone());
        OrderRecord { p, form: "momentum".into(), order, expected: p + 1, reached, epsilons, errors, attitude, dissipated, dissipation }
    }
}

prop_compose! {
    fn average()(
        order in option::of(finite()), reached: bool, expected in 1usize..3, numbers in [vec(finite(), 0..4), vec(finite(), 0..4)],
    ) -> AverageRecord {
        let [epsilons, errors] = numbers;
        AverageRecord { epsilons, errors, order, expected, reached }
    }
}

prop_compose! {
    fn verification()(
        reached: bool, rotations in finite(), duration in finite(), orders in vec(order(), 0..3),
        average in option::of(average()), average_left_out in option::of(".*"),
    ) -> VerificationRecord {
        VerificationRecord { reached, rotations, duration, orders, average, average_left_out }
    }
}

prop_compose! {
    fn about_spin()(
        words in [".*", ".*", ".*", ".*"], holds: bool, spin in [finite(); 3], angular_momentum in [finite(); 3], degree in 1usize..12,
        range in finite(), share in finite(), start in option::of(finite()), resonances in vec(".*", 0..3),
        dissipators in vec(".*", 0..3), columns in columns(),
    ) -> AboutSpinRecord {
        let [sentence, axis, style, name] = words;
        let masters = vec![MasterRecord { name, decay_rate: range, frequency: share }];
        AboutSpinRecord {
            sentence, holds, axis, spin, angular_momentum, degree, style, masters, range, share, start, resonances, dissipators, columns,
        }
    }
}

prop_compose! {
    fn evolution()(
        words in [".*", ".*", ".*", ".*", ".*", ".*"], numbers in [finite(); 8], time_range in option::of([finite(); 2]),
        separatrix_time in option::of(finite()), lingering in option::of(finite()), columns in columns(),
        harmonics in vec((1usize..40, finite(), finite()), 0..3), resonances in vec((1usize..40, ".*", [finite(); 3]), 0..3),
        dissipation in shares(), road in ".*", verdict in ".*", time_error in option::of(finite()),
        estimates in vec((".*", finite(), finite()), 0..3), approach in option::of((1usize..9, ".*", [finite(); 3])), observed in [option::of([finite(); 5]), option::of([finite(); 5])],
        body in option::of([finite(); 5]),
    ) -> EvolutionRecord {
        let [sentence, method, status, message, mode_start, mode_end] = words;
        let [angular_momentum, ratio_start, ratio_end, time, revolutions, power, damping_time, growth_time] = numbers;
        let harmonic = |(number, frequency, share)| HarmonicRecord {
            number, frequency, share, dissipation: [("spring".to_owned(), share)].into(),
        };
        let mode = mode_end.clone();
        let [start, end] = observed.map(|numbers| numbers.map(|[rotation_period, precession_period, nutation_least, nutation_greatest, energy_ratio]| {
            ObservedRecord { rotation_period, precession_period, nutation_least, nutation_greatest, energy_ratio }
        }));
        let crossing = |(harmonic, coordinate, [frequency, ratio, share]): (usize, String, [f64; 3])| CrossingRecord {
            harmonic, frequency, coordinate, ratio, mode: mode.clone(), share,
        };
        let homogeneous = body.map(|[mass, radius, density, shear, quality]| HomogeneousRecord { mass, radius, density, shear, quality: Some(quality) });
        let estimate = |(source, least, greatest)| EstimateRecord { source, least, greatest };
        let approach = approach.map(|(harmonic, coordinate, [frequency, distance, ratio])| ApproachRecord {
            harmonic, frequency, coordinate, distance, ratio,
        });
        EvolutionRecord {
            approach, homogeneous,
            estimates: estimates.into_iter().map(estimate).collect(),
            harmonics: harmonics.into_iter().map(harmonic).collect(),
            resonances: resonances.into_iter().map(crossing).collect(),
            sentence, road, verdict, method, status, message, angular_momentum, mode_start, mode_end, ratio_start, ratio_end, start, end, time,
            time_error, time_range, revolutions, power, dissipation, separatrix_time, lingering, damping_time, growth_time, columns,
            not_known: vec![],
        }
    }
}

prop_compose! {
    fn mode()(
        name in ".*", [nutation, neutral, overdamped] in any::<[bool; 3]>(), numbers in [finite(); 5], time_constant in option::of(finite()), dissipation in shares(),
        moves in shares(),
    ) -> ModeRecord {
        let [decay_rate, frequency, damping_ratio, slow, fast] = numbers;
        let seen_from_outside = [slow, fast];
        ModeRecord {
            name, nutation, neutral, overdamped, decay_rate, rate_bound: None, frequency, time_constant, damping_ratio, seen_from_outside, moves, dissipation,
        }
    }
}

prop_compose! {
    fn steady_spin()(
        sentence in ".*", axis in ".*", spin in option::of([finite(); 3]), angular_momentum in option::of([finite(); 3]),
        energy in option::of(finite()), displacements in shares(), stable: bool, modes in vec(mode(), 0..3),
        slowest in option::of((finite(), option::of(0..9usize), any::<bool>())),
    ) -> SteadySpinRecord {
        let slowest =
            slowest.map(|(rate, missing, positive_energy)| SlowModesRecord { rate, missing, positive_energy });
        SteadySpinRecord { sentence, axis, spin, angular_momentum, energy, displacements, stable, modes, slowest }
    }
}

prop_compose! {
    fn scene()(
        name in ".*", radius in finite(), moments in [finite(), finite(), finite()],
        triangles in option::of(vec(any::<[u16; 3]>(), 0..3)), multiples in vec(any::<[i16; 3]>(), 1..4),
        numbers in vec(proptest::num::f32::NORMAL, 30),
        size in option::of(finite()), t in vec(finite(), 0..4), limit in prop_oneof![finite(), Just(f64::INFINITY)],
        values in vec(vec(finite(), 0..3), 0..3), rotor in 0usize..3, note in ".*",
    ) -> SceneRecord {
        let packed = |count: usize| Packed(numbers.iter().copied().take(count * t.len()).collect());
        let [attitude, omega, momentum, rotors] = [4, 3, 3, 3].map(packed);
        let dissipated = Packed(t.iter().map(|t| -t).collect());
        let vertices = multiples.len() as u16;
        let triangles = triangles.map(|corners| Packed(corners.into_flattened().into_iter().map(|corner| corner % vertices).collect()));
        let multiples = multiples.into_flattened();
        let term = TermRecord { degree: 2, stiffness: -1, damping: 1, values };
        let piece = PieceRecord {
            name: name.clone(),
            kind: note.clone(),
            vertices: VectorsRecord { unit: radius, values: Packed(multiples.clone()) },
            triangles,
            lines: None,
            size,
            fields: vec![FieldRecord { coordinate: 0, vectors: VectorsRecord { unit: -radius, values: Packed(multiples) } }],
            turning: Some(RotorAxisRecord { axis: moments, center: moments, rotor }),
        };
        let equations = EquationsRecord {
            order: 3, scalable: true, note, energy_gradient: vec![term.clone()], c: vec![term.clone()], T: vec![term.clone()], momentum: vec![term], energy: vec![],
            power: vec![], displacements: vec![], limits: vec![LimitRecord { holds: radius, fails: limit, stiffness: 0.5, damping: -1.0 }],
            start: StartRecord { momentum: moments, attitude: [1.0, 0.0, 0.0, 0.0], duration: radius },
        };
        SceneRecord {
            version: SCENE_VERSION, name: name.clone(), radius,
            coordinates: vec![CoordinateRecord { name, unit: "m".into() }],
            pieces: vec![piece],
            principal: PrincipalRecord { moments, axes: [moments; 3] },
            track: Some(TrackRecord {
                system: "full".into(), t: Packed(t), attitude, omega, momentum, q: None, rotors: Some(rotors), dissipated,
            }),
            spin: None,
            modes: vec![ShapeRecord {
                name: "nutation".into(), frequency: radius, rate: -radius, rotation: [[radius, 0.0]; 3], q: vec![[radius; 2]],
            }],
            equations: Some(equations),
        }
    }
}

prop_compose! {
    fn input_file()(name in ".*", bytes: u64, sha256 in ".*") -> InputFileRecord {
        InputFileRecord { name, bytes, sha256 }
    }
}

prop_compose! {
    fn record()(
        files in vec(input_file(), 0..3), version in ".*", name in ".*", file in ".*", sha256 in ".*", notes in vec(".*", 0..3),
        body in body(), liquids in vec(liquid(), 0..3), validity in validity(), reduction in reduction(),
        reduced in option::of(history("reduced")), rigid in option::of(history("rigid")),
        verification in option::of(verification()), evolution in option::of(evolution()),
        steady_spins in vec(steady_spin(), 0..3), scene in option::of(scene()), about_spin in option::of(about_spin()),
    ) -> RunRecord {
        RunRecord {
            scene,
            format: RECORD_FORMAT, version, model: ModelRecord { name, file, sha256, files }, inputs: None, notes, body, liquids, validity, steady_spins, campbell: None, about_spin,
            reduction,
            histories: reduced.into_iter().chain(rigid).collect(), verification, evolution,
        }
    }
}

/// A record with one history of two rows and an evolution of as many, to be damaged.
pub fn sample() -> RunRecord {
    let column = |name: &str, unit: &str, values: [f64; 2]| Column {
        name: name.into(),
        unit: unit.into(),
        values: values.into(),
    };
    RunRecord {
        scene: None,
        format: RECORD_FORMAT,
        version: "0.1.0".into(),
        model: ModelRecord {
            name: "boom".into(),
            file: "boom.toml".into(),
            sha256: "ab".into(),
            files: Vec::new(),
        },
        inputs: None,
        notes: vec![],
        body: BodyRecord {
            mass: 1.0,
            center_of_mass: [0.0; 3],
            pole: [0.0; 3],
            support: "free".into(),
            kind: quasirigid_io::model::BodyKind::SmallBody,
            inertia: [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]],
            principal_moments: [1.0; 3],
            principal_axes: [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]],
            coordinates: vec!["tip.x".into()],
            resolution: None,
        },
        liquids: vec![],
        steady_spins: vec![],
        campbell: None,
        about_spin: None,
        validity: ValidityRecord {
            valid: true,
            verdict: "The reduced equations hold.".into(),
            overall: "holds".into(),
            T1: f64::INFINITY,
            T2: None,
            T3: 0.1 + 0.2,
            frequencies: vec![5e-324],
            decay_rates: vec![],
            relaxations: vec![],
            criteria: vec![],
        },
        reduction: ReductionRecord {
            order: 3,
            optimal_order: 5,
            residual: f64::NAN,
            degrees: vec![],
            power: -0.0,
            dissipation: [("tank".to_owned(), f64::NAN)].into(),
        },
        histories: vec![HistoryRecord {
            system: "reduced".into(),
            form: "momentum form".into(),
            method: "explicit".into(),
            status: "finished".into(),
            message: String::new(),
            tolerance: 1e-10,
            steps: 2,
            rejected: 0,
            revolutions: 0.1,
            energy: 1.0,
            dissipated: 0.0,
            dissipation: BTreeMap::new(),
            work: 0.0,
            energy_drift: 0.0,
            left_out: 0.0,
            load_ratio: 0.0,
            ringing: None,
            momentum_drift: 0.0,
            rows: 0,
            log: None,
            columns: vec![column("t", "s", [0.0, 0.1 + 0.2]), column("wx", "rad/s", [f64::NAN, -1e300])],
        }],
        verification: None,
        evolution: Some(EvolutionRecord {
            sentence: "It never settles.".into(),
            road: "average".into(),
            verdict: String::new(),
            method: "strain energy".into(),
            status: "held".into(),
            message: "Ended at once.".into(),
            angular_momentum: 1.0,
            mode_start: "short-axis".into(),
            mode_end: "short-axis".into(),
            ratio_start: 0.9,
            ratio_end: 0.9,
            start: None,
            end: Some(ObservedRecord {
                rotation_period: f64::INFINITY,
                precession_period: 2.5,
                nutation_least: 0.0,
                nutation_greatest: -0.0,
                energy_ratio: 1.1,
            }),
            time: f64::INFINITY,
            time_error: Some(f64::NAN),
            time_range: Some([1.5, f64::INFINITY]),
            revolutions: f64::INFINITY,
            power: 0.0,
            dissipation: BTreeMap::new(),
            separatrix_time: None,
            lingering: None,
            damping_time: f64::INFINITY,
            growth_time: f64::NAN,
            not_known: vec!["growth_time".into()],
            estimates: vec![],
            homogeneous: None,
            harmonics: vec![],
            resonances: vec![],
            approach: None,
            columns: vec![column("t", "s", [0.0, f64::INFINITY]), column("power", "W", [0.0, -0.0])],
        }),
    }
}

/// Text that tells records apart by their bits: `Debug` prints different floats differently, and NaN like NaN.
fn bits(record: &RunRecord) -> String {
    format!("{record:?}")
}

fn written() -> tempfile::TempDir {
    let dir = tempdir().unwrap();
    sample().write(dir.path(), &[TableFormat::Csv]).unwrap();
    dir
}

/// Records of versions before the shares of dissipators were kept.
#[test]
fn record_without_shares_reads_with_none() {
    let dir = written();
    let path = dir.path().join("record.json");
    let mut object: serde_json::Value = serde_json::from_str(&fs::read_to_string(&path).unwrap()).unwrap();
    assert!(object["reduction"]["dissipation"]["tank"].is_null());
    for part in ["/reduction", "/histories/0", "/evolution"] {
        let part = object.pointer_mut(part).unwrap().as_object_mut().unwrap();
        assert!(part.remove("dissipation").is_some());
    }
    fs::write(&path, object.to_string()).unwrap();
    let read = RunRecord::read(dir.path()).unwrap();
    assert!(read.reduction.dissipation.is_empty() && read.histories[0].dissipation.is_empty());
}

fn refusal(dir: &Path) -> RecordError {
    RunRecord::read(dir).unwrap_err()
}

/// Records of versions before the layout had a number read as those of its first version; a later layout is refused by its number, whatever
/// else has changed in it.
#[test]
fn record_of_a_later_format_is_refused_in_words() {
    let dir = written();
    let path = dir.path().join("record.json");
    let mut object: serde_json::Value = serde_json::from_str(&fs::read_to_string(&path).unwrap()).unwrap();
    assert_eq!(object["format"], RECORD_FORMAT);
    let known = bits(&RunRecord::read(dir.path()).unwrap());
    object.as_object_mut().unwrap().remove("format");
    fs::write(&path, object.to_string()).unwrap();
    assert_eq!(bits(&RunRecord::read(dir.path()).unwrap()), known);
    fs::write(&path, r#"{ "body": 3, "format": 2 }"#).unwrap();
    let error = refusal(dir.path());
    assert_eq!(error, RecordError::Format { file: path.clone(), format: 2, known: RECORD_FORMAT });
    let said = error.to_string().replace(&path.display().to_string(), "record.json");
    assert_eq!(
        said,
        "record.json: record of format 2, and 1 is the last that this program reads; use the quasirigid that made the run"
    );
    fs::write(&path, r#"{ "body": 3, "format": 0 }"#).unwrap();
    assert!(
        matches!(refusal(dir.path()), RecordError::Format { format: 0, .. }),
        "there was never such a one"
    );
    fs::write(&path, r#"{ "body": 3, "format": 1 }"#).unwrap();
    assert!(matches!(refusal(dir.path()), RecordError::Json { .. }));
}

/// The number of a scene is looked at before its keys, as that of a record.
#[test]
fn scene_of_another_version_is_refused_in_words() {
    let dir = written();
    let path = dir.path().join("scene.json");
    for version in [0, SCENE_VERSION - 1, SCENE_VERSION + 1] {
        fs::write(&path, format!("{{ \"pieces\": {{}}, \"version\": {version} }}")).unwrap();
        assert_eq!(refusal(dir.path()), RecordError::SceneVersion { file: path.clone(), version });
    }
}

/// Change of a scene that was written.
type Damage = fn(&mut serde_json::Value);

/// A scene whose parts do not fit each other would be drawn from what is not there.
#[test]
fn scene_with_a_vertex_that_is_not_there_is_refused() {
    let scene = scene().new_tree(&mut TestRunner::deterministic()).unwrap().current();
    let dir = tempdir().unwrap();
    RunRecord { scene: Some(scene), ..sample() }.write(dir.path(), &[TableFormat::Csv]).unwrap();
    assert!(RunRecord::read(dir.path()).is_ok());
    let path = dir.path().join("scene.json");
    let good: serde_json::Value = serde_json::from_slice(&fs::read(&path).unwrap()).unwrap();
    let damages: [(&str, Damage); 5] = [
        ("the triangles of the piece", |scene| scene["pieces"][0]["triangles"] = "AAABAP//".into()),
        ("the lines of the piece", |scene| scene["pieces"][0]["lines"] = "AAABAP//".into()),
        ("the vertices of the piece", |scene| {
            scene["pieces"][0]["vertices"]["values"] = "AAABAAIAAAA=".into()
        }),
        ("the displacements of the piece", |scene| scene["pieces"][0]["fields"][0]["coordinate"] = 7.into()),
        ("the arrays of the history", |scene| scene["track"]["omega"] = "AAAAAA==".into()),
    ];
    for (part, damage) in damages {
        let mut scene = good.clone();
        damage(&mut scene);
        fs::write(&path, scene.to_string()).unwrap();
        let said = refusal(dir.path()).to_string();
        assert!(said.contains(part) && said.contains("do not fit the rest of the scene"), "{said}");
    }
}

proptest! {
    #![proptest_config(ProptestConfig { rng_seed: RngSeed::Fixed(1978), ..ProptestConfig::default() })]

    #[test]
    fn record_read_is_the_record_written(record in record()) {
        let dir = tempdir().unwrap();
        record.write(dir.path(), &[TableFormat::Csv]).unwrap();
        prop_assert_eq!(bits(&RunRecord::read(dir.path()).unwrap()), bits(&record));
    }

    #[test]
    fn damaged_files_are_refused_without_panic(damage: Vec<u8>, which in 0usize..3, at in 0usize..2000) {
        let dir = written();
        let file = dir.path().join(["record.json", "history-reduced.csv", "evolution.csv"][which]);
        let mut bytes = fs::read(&file).unwrap();
        let at = at % bytes.len();
        bytes.splice(at..(at + damage.len()).min(bytes.len()), damage);
        fs::write(&file, &bytes).unwrap();
        let _ = RunRecord::read(dir.path());
    }
}

#[test]
fn history_is_plain_csv_with_names_in_the_header() {
    let mut text = Vec::new();
    history_csv(&sample().histories[0].columns, &mut text).unwrap();
    assert_eq!(String::from_utf8(text).unwrap(), "t,wx\n0.0,NaN\n0.30000000000000004,-1e300\n");
}

/// A number of JSON is a number: no reader stumbles over a word.
#[test]
fn numbers_that_are_not_finite_are_null_in_json() {
    let dir = written();
    let text = fs::read_to_string(dir.path().join("record.json")).unwrap();
    assert!(text.contains(r#""T1": null"#) && text.contains(r#""residual": null"#), "{text}");
    assert!(!text.contains("inf\"") && !text.contains("NaN"), "{text}");
    assert!(text.contains(r#""power": -0.0"#) && !text.contains("-1e300"), "{text}");
}

/// `null` reads as infinity where a field can be infinite and the record does not list it as unknown; else as NaN, or none.
#[test]
fn null_reads_back_as_what_the_field_means() {
    let read = RunRecord::read(written().path()).unwrap();
    let infinite = |values: &[f64]| values.iter().all(|value| *value == f64::INFINITY);
    assert!(infinite(&[read.validity.T1]) && read.validity.T2.is_none());
    assert!(read.reduction.residual.is_nan() && read.reduction.dissipation["tank"].is_nan());
    let evolution = read.evolution.unwrap();
    assert!(infinite(&[evolution.time, evolution.revolutions, evolution.damping_time]));
    assert!(infinite(&[evolution.end.unwrap().rotation_period]));
    assert_eq!(evolution.time_range, Some([1.5, f64::INFINITY]));
    assert_eq!(evolution.time_error, None);
    assert!(evolution.growth_time.is_nan() && evolution.not_known == ["growth_time"]);
}

/// Records of versions that wrote words where JSON has no number.
#[test]
fn words_of_old_records_are_read() {
    let dir = written();
    let file = dir.path().join("record.json");
    let mut text = fs::read_to_string(&file).unwrap();
    let words = [
        ("T1", "inf"),
        ("residual", "NaN"),
        ("tank", "NaN"),
        ("damping_time", "-inf"),
        ("time_error", "NaN"),
    ];
    for (field, word) in words {
        let old = text.replace(&format!("\"{field}\": null"), &format!("\"{field}\": \"{word}\""));
        assert_ne!(old, text, "{field}");
        text = old;
    }
    fs::write(&file, text).unwrap();
    let read = RunRecord::read(dir.path()).unwrap();
    assert!(read.validity.T1 == f64::INFINITY && read.reduction.residual.is_nan());
    let evolution = read.evolution.unwrap();
    assert!(evolution.damping_time == f64::NEG_INFINITY && evolution.time_error.unwrap().is_nan());
}

#[test]
fn evolution_names_what_is_not_known() {
    let named = sample().evolution.unwrap().with_unknown_named();
    assert_eq!(named.not_known, ["growth_time"]);
    let refused = EvolutionRecord { time: f64::NAN, growth_time: 2.0, ..named }.with_unknown_named();
    assert_eq!(refused.not_known, ["time"]);
}

#[test]
fn nothing_is_written_into_a_folder_that_holds_something() {
    let dir = tempdir().unwrap();
    fs::write(dir.path().join("mine.txt"), "").unwrap();
    let error = sample().write(dir.path(), &[TableFormat::Csv]).unwrap_err();
    assert_eq!(error, RecordError::NotEmpty { folder: dir.path().into(), found: "mine.txt".into() });
    assert_eq!(fs::read_dir(dir.path()).unwrap().count(), 1);
}

#[test]
fn folder_must_exist() {
    let folder = tempdir().unwrap().path().join("none");
    assert_eq!(sample().write(&folder, &[TableFormat::Csv]).unwrap_err(), RecordError::NoFolder { folder });
}

#[test]
fn names_that_would_leave_the_folder_or_collide_are_refused_before_writing() {
    let dir = tempdir().unwrap();
    let mut record = sample();
    for system in ["../x", "", "a b"] {
        record.histories[0].system = system.into();
        let error = record.write(dir.path(), &[TableFormat::Csv]).unwrap_err();
        assert_eq!(error, RecordError::SystemName { system: system.into() });
    }
    let mut record = sample();
    record.histories.push(record.histories[0].clone());
    record.histories[1].system = "Reduced".into();
    let error = record.write(dir.path(), &[TableFormat::Csv]).unwrap_err();
    assert_eq!(error, RecordError::SameSystem { system: "Reduced".into() });
    assert_eq!(fs::read_dir(dir.path()).unwrap().count(), 0);
}

#[test]
fn columns_of_unequal_length_are_refused() {
    let mut record = sample();
    record.histories[0].columns[1].values.pop();
    let error = record.write(tempdir().unwrap().path(), &[TableFormat::Csv]).unwrap_err();
    assert!(matches!(&error, RecordError::Ragged { file, column, rows: 1, expected: 2 }
        if file == "history-reduced" && column == "wx"));
    let refused = history_csv(&record.histories[0].columns, Vec::new()).unwrap_err();
    assert_eq!(refused.kind(), ErrorKind::InvalidInput);
}

/// No file is written if a later table is wrong, although the history itself is sound.
#[test]
fn ragged_evolution_is_refused_before_writing() {
    let dir = tempdir().unwrap();
    let mut record = sample();
    record.evolution.as_mut().unwrap().columns[1].values.pop();
    let error = record.write(dir.path(), &[TableFormat::Csv]).unwrap_err();
    assert_eq!(
        error.to_string(),
        "evolution: column \"power\" has 1 rows, the first column 2; give all the same"
    );
    assert_eq!(fs::read_dir(dir.path()).unwrap().count(), 0);
}

#[test]
fn missing_file_is_named() {
    for name in ["history-reduced", "evolution"] {
        let dir = written();
        fs::remove_file(dir.path().join(format!("{name}.csv"))).unwrap();
        let missing = refusal(dir.path());
        assert!(matches!(&missing, RecordError::NoTable { table, .. } if table == name), "{missing}");
    }
}

#[test]
fn record_without_evolution_has_no_file_of_it_and_reads_back() {
    let dir = tempdir().unwrap();
    let record = RunRecord { evolution: None, ..sample() };
    record.write(dir.path(), &[TableFormat::Csv]).unwrap();
    assert!(!dir.path().join("evolution.csv").exists());
    let file = dir.path().join("record.json");
    let text = fs::read_to_string(&file).unwrap();
    let old = text.replace(",\n  \"evolution\": null", "");
    assert_ne!(old, text);
    fs::write(&file, old).unwrap();
    assert_eq!(bits(&RunRecord::read(dir.path()).unwrap()), bits(&record));
}

#[test]
fn infinite_times_of_the_evolution_read_back() {
    let read = RunRecord::read(written().path()).unwrap().evolution.unwrap();
    assert_eq!(read.time_range, Some([1.5, f64::INFINITY]));
    assert_eq!(read.columns[0].values, [0.0, f64::INFINITY]);
    assert!(read.columns[1].values[1].is_sign_negative());
}

#[test]
fn broken_rows_of_the_evolution_are_located() {
    let dir = written();
    let file = dir.path().join("evolution.csv");
    let with = |text: &str| {
        fs::write(&file, text).unwrap();
        refusal(dir.path())
    };
    assert!(matches!(with("t,turns\n1,2\n"), RecordError::Header { found, .. } if found == ["t", "turns"]));
    assert!(matches!(with("t,power\n1,2\n1"), RecordError::Width { file, line: 3, fields: 1, expected: 2 }
        if file.ends_with("evolution.csv")));
    assert!(matches!(with(""), RecordError::Header { found, .. } if found.is_empty()));
}

#[test]
fn broken_json_is_located() {
    let dir = written();
    let file = dir.path().join("record.json");
    let text = fs::read_to_string(&file).unwrap().replacen("\"T1\": null", "\"T1\": \"large\"", 1);
    fs::write(&file, text).unwrap();
    let error = refusal(dir.path());
    assert!(
        matches!(&error, RecordError::Json { line: 75, problem, .. }
        if problem == "invalid value: string \"large\", expected a number or null"),
        "{error}"
    );
}

#[test]
fn broken_rows_are_located() {
    let dir = written();
    let file = dir.path().join("history-reduced.csv");
    let with = |text: &str| {
        fs::write(&file, text).unwrap();
        refusal(dir.path())
    };
    assert!(matches!(with("t,wy\n1,2\n"), RecordError::Header { found, .. } if found == ["t", "wy"]));
    assert!(matches!(with("t,wx\n1,2\n1\n"), RecordError::Width { line: 3, fields: 1, expected: 2, .. }));
    assert!(matches!(
        with("t,wx\n1,2\n1,0x\n"),
        RecordError::NotANumber { line: 3, column, text, .. } if column == "wx" && text.to_string() == "0x"
    ));
    assert!(matches!(with(""), RecordError::Header { found, .. } if found.is_empty()));
}

/// Vectors come back to half a unit, the largest component exactly.
#[test]
fn packed_vectors_come_back() {
    let vectors = [[1.5, -0.25, 0.0], [1e-3, 0.7, -1.2]];
    let packed = VectorsRecord::pack(&vectors);
    for (back, vector) in packed.unpack().iter().zip(&vectors) {
        for (back, entry) in back.iter().zip(vector) {
            assert!((back - entry).abs() <= 0.5001 * packed.unit, "{back} {entry}");
        }
    }
    assert_eq!(packed.unpack()[0][0], 1.5);
    assert_eq!(VectorsRecord::pack(&[[0.0; 3]]).unpack(), [[0.0; 3]]);
    assert!(VectorsRecord::pack(&[]).unpack().is_empty());
}

/// A folder, a pipe nobody writes into, and a link to a device, in place of each file of a record and of a table of bodies: nothing is
/// waited for or read for ever.
#[cfg(unix)]
#[test]
fn nothing_but_files_is_read() {
    use std::os::unix::fs::symlink;
    use std::process::Command;

    let put: [&dyn Fn(&Path); 3] = [
        &|path| fs::create_dir(path).unwrap(),
        &|path| assert!(Command::new("mkfifo").arg(path).status().unwrap().success()),
        &|path| symlink("/dev/zero", path).unwrap(),
    ];
    for format in TableFormat::ALL {
        let ending = format.ending();
        for name in [
            "record.json".to_owned(),
            "scene.json".into(),
            format!("history-reduced.{ending}"),
            format!("evolution.{ending}"),
        ] {
            for put in put {
                let dir = tempfile::tempdir().unwrap();
                sample().write(dir.path(), &[format]).unwrap();
                let path = dir.path().join(&name);
                fs::remove_file(&path).unwrap_or(()); // not every record has a scene
                put(&path);
                assert_eq!(refusal(dir.path()), RecordError::NoFile { file: path });
            }
        }
    }
    for put in put {
        let path = tempfile::tempdir().unwrap().keep().join("bodies.csv");
        put(&path);
        assert!(matches!(read_bodies(&path), Err(TableError::NoFile { .. })));
        assert!(matches!(read_parquet(&path, None), Err(TableError::NoFile { .. })));
        fs::remove_dir_all(path.parent().unwrap()).unwrap();
    }
}
