//! Studies of many bodies: the same bytes whatever the threads, shards and kills; bad rows told, the rest answered.

use std::fs;
use std::path::Path;
use std::process::Stdio;
use std::time::Duration;

use quasirigid_io::table_file::{Cells, read_parquet};

use crate::support::{
    MODEL, files, folder_of_study, folder_with, names, one_line, program, ran_in, ran_with,
};

const STUDY: &str = "\
model = \"model.toml\"
seed = 7
samples = 12
sampling = \"latin-hypercube\"
part = 16
[vary]
\"spring.1.stiffness\" = { geometric = [\"100 N/m\", \"10 kN/m\"], count = 4 }
\"point.tip.mass\" = { log-normal = { median = 1.0, decades = 0.2 } }
\"initial.angular_velocity.3\" = { uniform = [\"0.1 rad/s\", \"0.2 rad/s\"] }
[answer]
quantities = [\"check.valid\", \"check.T1\", \"modes.nutation.time_constant\", \"simulate.wz\", \"check.verdict\"]
";

#[track_caller]
fn assert_same(one: &Path, other: &Path) {
    let [one, other] = [one, other].map(files);
    assert_eq!(one.keys().collect::<Vec<_>>(), other.keys().collect::<Vec<_>>());
    for (name, bytes) in &one {
        assert!(bytes == &other[name], "{name} differs");
    }
}

#[test]
fn threads_and_shards_give_the_same_bytes() {
    let folder = folder_of_study(STUDY);
    let ran = ran_in(folder.path(), "sweep study.toml -o one --threads 1");
    assert_eq!(ran.code, Some(0), "{ran:?}");
    assert!(one_line(&ran.stdout).contains("all 48 rows answered"), "{}", ran.stdout);
    assert_eq!(ran_in(folder.path(), "sweep study.toml -o four --threads 4").code, Some(0));
    for shard in [3, 1, 2] {
        let ran = ran_in(folder.path(), &format!("sweep study.toml -o shards --shard {shard}/3 --threads 1"));
        assert_eq!(ran.code, Some(0), "{ran:?}");
    }
    let one = folder.path().join("one");
    assert_same(&one, &folder.path().join("four"));
    assert_same(&one, &folder.path().join("shards"));
    let expected =
        ["model.toml", "parts", "report.html", "rows.csv", "study.toml", "summary.json", "sweep.json"];
    assert_eq!(names(&one), expected);
    assert_eq!(names(one.join("parts")), ["part-00000.parquet", "part-00001.parquet", "part-00002.parquet"]);
}

#[test]
fn row_alone_is_the_row_of_the_run_and_of_its_own_model() {
    let folder = folder_of_study(STUDY);
    assert_eq!(ran_in(folder.path(), "sweep study.toml -o out --quiet").code, Some(0));
    for row in [1u64, 18, 48] {
        let alone = ran_in(folder.path(), &format!("sweep study.toml --row {row} --json")).json();
        let part =
            read_parquet(&folder.path().join(format!("out/parts/part-{:05}.parquet", (row - 1) / 16)), None)
                .unwrap();
        fs::write(folder.path().join("row.toml"), alone["model"].as_str().unwrap()).unwrap();
        let check = ran_in(folder.path(), "check row.toml --json --quiet").json();
        for column in ["check.T1", "modes.nutation.time_constant", "simulate.wz"] {
            let Cells::Numbers(values) = &part.iter().find(|each| each.name == column).unwrap().cells else {
                panic!()
            };
            assert_eq!(
                alone["answers"][column].as_f64(),
                values[((row - 1) % 16) as usize],
                "{column} of row {row}"
            );
        }
        assert_eq!(alone["answers"]["check.T1"], check["T1"], "the command on the model of row {row}");
    }
    let none = ran_in(folder.path(), "sweep study.toml --row 49");
    assert!(none.refusal().contains("there is no row 49: the study has 48, from 1 to 48"), "{none:?}");
    let zero = ran_in(folder.path(), "sweep study.toml --row 0");
    assert!(one_line(zero.refusal()).contains("row 0 is now row 1"), "{zero:?}");
}

#[test]
fn killed_study_goes_on_to_the_same_bytes() {
    let study = STUDY.replace("samples = 12", "samples = 60");
    let folder = folder_of_study(&study);
    assert_eq!(ran_in(folder.path(), "sweep study.toml -o whole --quiet").code, Some(0));
    let mut torn = 0;
    for kill in 0..10u64 {
        let arguments = ["sweep", "study.toml", "-o", "killed", "--resume", "--threads", "2"];
        let mut child = program(folder.path())
            .args(arguments)
            .stdout(Stdio::null())
            .stderr(Stdio::null())
            .spawn()
            .unwrap();
        std::thread::sleep(Duration::from_millis(40 + 37 * (kill * 7 % 10)));
        child.kill().unwrap();
        child.wait().unwrap();
        torn += u32::from(
            folder.path().join("killed/sweep.json").exists()
                && !folder.path().join("killed/summary.json").exists(),
        );
    }
    // a kill between the end of a part and the end of its journal, which is rare
    fs::write(folder.path().join("killed/parts/part-00000.journal"), "0").unwrap();
    let ran = ran_in(folder.path(), "sweep study.toml -o killed --resume");
    assert_eq!(ran.code, Some(0), "{ran:?}");
    assert!(torn > 0, "no kill met a study in work");
    assert_same(&folder.path().join("whole"), &folder.path().join("killed"));
}

#[test]
fn bad_rows_of_a_table_are_told_and_the_rest_answered() {
    let folder = folder_of_study(
        "model = \"model.toml\"\n[table]\nfile = \"bodies.csv\"\ncolumns = { mass_g = { key = \"point.tip.mass\", unit = \"g\" } }\nkeep = [\"who\"]\n[answer]\nquantities = [\"check.T1\"]\n",
    );
    let mut table = "who,mass_g,carrier.mass\n".to_owned();
    for row in 0..60 {
        table.push_str(&match row {
            3 => "short,1\n".to_owned(),
            r if r % 4 == 1 => format!("bad{row},{},40\n", ["", "-5", "abc", "nan"][row / 4 % 4]),
            40 => "zero,1000,0\n".to_owned(),
            _ => format!("b{row},{},40\n", 500 + row),
        });
    }
    fs::write(folder.path().join("bodies.csv"), table).unwrap();
    let ran = ran_in(folder.path(), "sweep study.toml -o out --json");
    assert_eq!(ran.code, Some(1), "{ran:?}");
    let summary = ran.json();
    assert_eq!(
        (&summary["status"]["answered"], &summary["status"]["invalid"]),
        (&43.into(), &17.into()),
        "{summary:#}"
    );
    let reasons = summary["reasons"].as_array().unwrap();
    let first = |what: &str| {
        let found = reasons.iter().find(|reason| reason["example"].as_str().unwrap().contains(what));
        found.unwrap_or_else(|| panic!("{what}: {reasons:#?}"))["first_row"].clone()
    };
    assert_eq!(first("line 5 of the table has 2 values, but the header has 3"), 4);
    assert_eq!(first("row 2 of the table has no value in the column \"mass_g\""), 2);
    assert_eq!(first("\"abc\" is not a finite number"), 10);
    assert_eq!(first("\"nan\" is not a finite number"), 14);
    let csv = fs::read_to_string(folder.path().join("out/rows.csv")).unwrap();
    assert!(
        csv.starts_with("row,mass_g [g],carrier.mass,who,check.T1 [s],status,reason,note\n1,500.0,40.0,b0,"),
        "{csv}"
    );
}

#[test]
fn studies_that_cannot_be_are_refused_at_their_place() {
    let vary = |line: &str| {
        format!(
            "model = \"model.toml\"\nsamples = 3\n[vary]\n{line}\n[answer]\nquantities = [\"check.T1\"]\n"
        )
    };
    let asked = |quantity: &str| {
        format!(
            "model = \"model.toml\"\n[vary]\n\"run.order\" = {{ list = [1, 3] }}\n[answer]\nquantities = [{quantity:?}]\n"
        )
    };
    let cases = [
        (
            vary("\"point.tp.mass\" = { uniform = [1, 2] }"),
            "study.toml:4:",
            "there is no entry named \"tp\"; did you mean `tip`?",
        ),
        (
            vary("\"point.tip.mass\" = { uniform = [2, 1] }"),
            "study.toml:4:",
            "the first number must be below the second",
        ),
        (vary("\"point.tip.mass\" = { uniform = [\"1 m\", \"2 m\"] }"), "study.toml:4:", "a mass is needed"),
        (
            vary("\"point.tip.mass\" = { uniform = [\"1 kg\", \"2 m\"] }"),
            "study.toml:4:",
            "does not measure the same",
        ),
        (
            vary("\"point.tip.mass\" = { uniform = [\"1 kg\", 2] }"),
            "study.toml:4:",
            "a number without a unit beside",
        ),
        (
            vary("\"point.tip.mass\" = { normal = { mean = 1, deviation = 0 } }"),
            "study.toml:4:",
            "a standard deviation must be above zero",
        ),
        (
            vary("\"point.tip.mass\" = { normal = { mean = 1, deviation = 1, min = 99 } }"),
            "study.toml:4:",
            "more than 30 standard deviations",
        ),
        (
            vary("\"point.tip.mass\" = { geometric = [-1, 2], count = 3 }"),
            "study.toml:4:",
            "two numbers of one sign",
        ),
        (vary("\"point.tip.mass\" = { linear = [1, 2] }"), "study.toml:4:", "has no `count`"),
        (vary("\"point.tip.mass\" = { unifrm = [1, 2] }"), "study.toml:4:", "did you mean `uniform`?"),
        (vary("\"point.tip.mas\" = { uniform = [1, 2] }"), "study.toml:4:", "unknown key \"mas\""),
        (vary("\"run.order\" = { list = [] }"), "study.toml:4:", "the list is empty"),
        (asked("chek.T1"), "study.toml:5:", "did you mean `check`?"),
        (asked("check.T9"), "study.toml:5:", "there is no `T9`"),
        (asked("check.criteria"), "study.toml:5:", "is a list; name one of its entries"),
        (asked("modes.tipp.frequency"), "study.toml:5:", "there is no `tipp`"),
        (
            asked("check.T1").replace("seed", "sed").replace("[vary]", "sed = 3\n[vary]"),
            "study.toml:2:",
            "did you mean `seed`?",
        ),
        (
            vary("\"point.tip.mass\" = { uniform = [1, 2] }").replace("samples = 3\n", ""),
            "study.toml:3:",
            "has no `samples`",
        ),
        (
            vary("\"point.tip.mass\" = { uniform = [1, 2] }").replace("= 3", "= 70000\nsampling = \"sobol\""),
            "study.toml:2:",
            "at most 65536",
        ),
    ];
    for (study, place, said) in cases {
        let folder = folder_of_study(&study);
        let ran = ran_in(folder.path(), "sweep study.toml");
        assert_eq!(ran.code, Some(2), "{study}{}", ran.stderr);
        let text = one_line(&ran.stderr.replace('│', " "));
        assert!(text.contains(said), "{study}: {said}\n{}", ran.stderr);
        assert!(text.contains(place), "{study}: {place}\n{}", ran.stderr);
        assert_eq!(names(&folder), ["model.toml", "study.toml"], "nothing is written");
    }
}

#[test]
fn folder_of_something_else_is_left_alone() {
    let folder = folder_of_study(&STUDY.replace("samples = 12", "samples = 1"));
    let ran = |line: &str| ran_in(folder.path(), line);
    assert_eq!(ran("sweep study.toml -o out --quiet").code, Some(0));
    let before = files(&folder.path().join("out"));
    assert!(one_line(ran("sweep study.toml -o out").refusal()).contains("continue with --resume"));
    assert_eq!(
        ran("sweep study.toml -o out --resume --quiet").code,
        Some(0),
        "a study that is done goes on to its end"
    );
    let other = STUDY.replace("samples = 12", "samples = 2");
    fs::write(folder.path().join("study.toml"), other).unwrap();
    assert!(one_line(ran("sweep study.toml -o out --resume").refusal()).contains("holds another study"));
    fs::create_dir(folder.path().join("mine")).unwrap();
    fs::write(folder.path().join("mine/notes.txt"), "precious").unwrap();
    assert!(
        one_line(ran("sweep study.toml -o mine --resume").refusal()).contains("is not the folder of a study")
    );
    assert_eq!(names(folder.path().join("mine")), ["notes.txt"]);
    assert_eq!(files(&folder.path().join("out")), before);
}

#[test]
fn names_that_would_stand_twice_are_refused() {
    let study = |vary: &str| {
        format!(
            "model = \"model.toml\"\n{vary}[table]\nfile = \"t.csv\"\nkeep = [\"status\"]\n[answer]\nquantities = [\"check.T1\"]\n"
        )
    };
    let folder = folder_of_study(&study(""));
    fs::write(folder.path().join("t.csv"), "status,carrier.mass\ngood,40\n").unwrap();
    assert!(
        one_line(ran_in(folder.path(), "sweep study.toml").refusal()).contains("would be named \"status\"")
    );
    fs::write(folder.path().join("study.toml"), study("[vary]\n\"carrier.mass\" = { list = [40, 41] }\n"))
        .unwrap();
    assert!(
        one_line(ran_in(folder.path(), "sweep study.toml").refusal())
            .contains("given by the table and varied")
    );
    let deep = ran_in(folder.path(), "sweep study.toml -o none/out");
    assert_eq!(
        (deep.code, names(&folder)),
        (Some(2), vec!["model.toml".into(), "study.toml".into(), "t.csv".into()])
    );
}

const BRICK: &str = "\
[material.rock]
density = \"2 g/cm^3\"
shear = \"0.5 GPa\"
poisson = 0.25
rheology = { kind = \"quality-factor\", Q = 100 }
[[surface]]
name = \"brick\"
file = \"brick.obj\"
material = \"rock\"
degree = 2
[initial]
angular_velocity = [0.0, 0.001, 0.01]
";

/// Rows of two meshes never meet in one table, whether the model names the mesh, the study, or its table.
#[test]
fn study_of_a_changed_mesh_is_another() {
    let mesh = include_str!("../../../../docs/guide/data/brick.obj");
    let head = "model = \"model.toml\"\n[answer]\nquantities = [\"check.T3\"]\n";
    let studies = [
        "[vary]\n\"run.order\" = { list = [1] }\n",
        "[vary]\n\"surface.brick.file\" = { list = [\"other.obj\"] }\n",
        "[table]\nfile = \"table.csv\"\n",
    ];
    for study in studies {
        let folder = folder_with(BRICK);
        let put = |name: &str, text: &str| fs::write(folder.path().join(name), text).unwrap();
        put("study.toml", &format!("{head}{study}"));
        put("brick.obj", mesh);
        put("other.obj", mesh);
        put("table.csv", "surface.brick.file\nother.obj\n");
        let changed = if study.contains("order") { "brick.obj" } else { "other.obj" };
        let ran = ran_in(folder.path(), "sweep study.toml -o out --quiet");
        assert_eq!(ran.code, Some(0), "{ran:?}");
        assert_eq!(ran_in(folder.path(), "sweep study.toml -o out --resume --quiet").code, Some(0));
        put(changed, &format!("# another\n{mesh}"));
        let ran = ran_in(folder.path(), "sweep study.toml -o out --resume");
        assert_eq!(ran.code, Some(2), "{study}: {ran:?}");
        assert!(one_line(&ran.stderr).contains("a change of its model, its files or the program"), "{ran:?}");
    }
}

/// Two shapes under one name gave records that nothing told apart.
#[test]
fn record_names_the_files_of_its_model() {
    let mesh = include_str!("../../../../docs/guide/data/brick.obj");
    let folder = folder_with(BRICK);
    let files = |text: &str, place: &str| -> serde_json::Value {
        fs::write(folder.path().join("brick.obj"), text).unwrap();
        let ran = ran_in(folder.path(), &format!("run model.toml -o {place} --duration 60 -q"));
        assert!(ran.code < Some(2), "{ran:?}");
        let record = fs::read_to_string(folder.path().join(place).join("record.json")).unwrap();
        serde_json::from_str::<serde_json::Value>(&record).unwrap()["model"]["files"].clone()
    };
    let [one, other] = [files(mesh, "a"), files(&format!("# another\n{mesh}"), "b")];
    assert_eq!((&one[0]["name"], &one[0]["bytes"]), (&"brick.obj".into(), &mesh.len().into()));
    assert_eq!(one[0]["sha256"].as_str().unwrap().len(), 64);
    assert_ne!(one[0]["sha256"], other[0]["sha256"]);
}

/// A rock whose quality factor is uncertain by these lines.
fn uncertain(line: &str) -> String {
    format!(
        "[material.rock]\ndensity = 2000\nshear = \"0.5 GPa\"\npoisson = 0.25\nrheology = {{ kind = \"quality-factor\", Q = 100 }}\n\
         [[ellipsoid]]\nsemi_axes = [219.0, 151.0, 143.0]\nmaterial = \"rock\"\n\
         [initial]\nwobble = {{ angle = \"20 deg\", rate = \"1 rpm\", mode = \"short-axis\" }}\n[uncertainty]\n{line}\n"
    )
}

#[test]
fn uncertain_models_are_answered_on_request_and_refused_at_their_place() {
    let model = uncertain("\"material.rock.rheology.Q\" = { log-normal = { median = 100, decades = 0.5 } }");
    let found = ran_with(&model, "evolve model.toml --uncertainty-samples 8 --json --quiet").json();
    assert_eq!(found["uncertainty"]["answered"], 8);
    let told = "the key in [uncertainty] has its stated value; --uncertainty-samples, as 200, draws and gives intervals";
    let says = |line: &str| one_line(&ran_with(&model, line).stderr).contains(told);
    assert!(says("evolve model.toml") && !says("evolve model.toml --uncertainty-samples 8"));
    let certain = ran_with(MODEL, "evolve model.toml --uncertainty-samples 9");
    assert!(one_line(certain.refusal()).contains("has no [uncertainty]"));
    for (line, said) in [
        (
            "\"material.rock.rheology.q\" = { uniform = [1, 2] }\n\"materal.rock.density\" = { uniform = [1, 2] }",
            "did you mean `material`?",
        ),
        ("\"material.rock.density\" = { linear = [1, 2], count = 3 }", "it needs a distribution, not a grid"),
    ] {
        let ran = ran_with(&uncertain(line), "check model.toml");
        assert!(one_line(ran.refusal()).contains(said), "{ran:?}");
    }
}
