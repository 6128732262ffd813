//! Model files: what is read from them, and how each mistake is refused.

use std::fmt::Write as _;
use std::path::Path;

use insta::assert_snapshot;
use proptest::prelude::*;
use quasirigid::elements::{
    Coefficient, ElementError, End, Field, HingeCoefficient, Law, Motion, Place, Problem,
};
use quasirigid::model::{InertiaError, Support};
use quasirigid_io::model::{FileProblem, Form, Model, ModelError};

const CARRIER: &str =
    "[carrier]\nmass = 40.0\ncenter_of_mass = [0, 0.1, 0]\ninertia = [9.0, 13.0, 16.0]\n";
const POINT: &str = "[[point]]\nname = \"tip\"\nmass = 1.0\nposition = [0.8, 0.3, 0.5]\n";
const HINGED: &str = "[[hinged]]\nname = \"boom\"\nmass = 2\ncenter_of_mass = [1, 0, 0]\ninertia = [0, 1, 1]\nhinge = [0.5, 0, 0]\n";

fn read(text: &str) -> Model {
    Model::parse(Path::new("model.toml"), text).unwrap_or_else(|error| panic!("{error}"))
}

/// How a text is refused.
fn refusal(text: &str) -> String {
    Model::parse(Path::new("model.toml"), text)
        .expect_err("a refusal")
        .to_string()
}

/// How a text after a good carrier and a good point is refused; it starts in line 9.
fn refusal_of(rest: &str) -> String {
    refusal(&format!("{CARRIER}{POINT}{rest}"))
}

/// How a spring between the point and the carrier with these further lines is refused; they start in line 12.
fn refusal_of_spring(lines: &str) -> String {
    refusal_of(&format!(
        "[[spring]]\nfrom = \"tip\"\nto = \"carrier\"\n{lines}"
    ))
}

mod reading {
    use super::*;

    #[test]
    fn a_full_model_is_read() {
        let model = read(
            r#"
[body]
name = "boom satellite"
[carrier]
mass = "88.184904873951 lb"
center_of_mass = [0, "10 cm", 0.0]
inertia = [[9.0, 0.5, 0], [0.5, 13.0, 0], [0, 0, 16.0]]
[[point]]
mass = 1
position = [0.8, 0.3, 0.5]
[[point]]
name = "slider"
mass = "500 g"
position = ["1 m", 0, "22 in"]
motion = { line = [1, 0, 0] }
[[spring]]
from = "point 1"
to = "carrier"
stiffness = "6 N/cm"
damping = 30
[[spring]]
from = "slider"
to = "point 1"
stiffness = [1, 2, 3]
damping = [[1, 0, 0], [0, 2, 0.5], [0, 0.5, 3]]
[[spring]]
from = "slider"
to = "carrier"
axial = true
anchor = [0.5, 0, 0]
stiffness = 7
[[hinged]]
name = "boom"
mass = 2.0
center_of_mass = [1.5, 0, 0]
inertia = [0, 0.3, 0.3]
hinge = [1, 0, 0]
axes = [[0, 1, 0], [0, 0, 1]]
stiffness = "0.565 N m/rad"
damping = ["0.01 N m s/rad", 0.02]
[support]
kind = "fixed-point"
point = [0, 0, -1]
[initial]
angular_velocity = ["750 rpm", 0.35, "3 deg/s"]
attitude = [0.6, 0, 0.8, 0]
displacements = "slow-manifold"
[run]
order = 5
duration = "2 h"
tolerance = 1e-10
samples = 1000
form = "momentum"
"#,
        );
        assert_eq!(model.name, "boom satellite");
        let body = &model.assembly;
        assert!((body.carrier.mass - 40.0).abs() < 1e-12); // 14 digits written
        assert_eq!(body.carrier.center_of_mass, [0.0, 0.1, 0.0]);
        assert_eq!(
            body.carrier.inertia,
            [[9.0, 0.5, 0.0], [0.5, 13.0, 0.0], [0.0, 0.0, 16.0]]
        );
        assert_eq!(body.points[0].name, "point 1");
        assert_eq!(body.points[0].motion, Motion::Free);
        assert_eq!(body.points[1].mass, 0.5);
        assert_eq!(body.points[1].position, [1.0, 0.0, 0.5588]);
        assert_eq!(body.points[1].motion, Motion::Line([1.0, 0.0, 0.0]));
        assert_eq!(
            (body.springs[0].from, body.springs[0].to),
            (End::Point(0), End::Carrier)
        );
        assert_eq!(
            (body.springs[1].from, body.springs[1].to),
            (End::Point(1), End::Point(0))
        );
        let [isotropic, full, axial] = [0, 1, 2].map(|index| body.springs[index].law);
        let (stiffness, damping) = (Coefficient::Isotropic(600.0), Coefficient::Isotropic(30.0));
        assert_eq!(isotropic, Law::Spatial { stiffness, damping });
        let stiffness = Coefficient::Diagonal([1.0, 2.0, 3.0]);
        let damping = Coefficient::Full([[1.0, 0.0, 0.0], [0.0, 2.0, 0.5], [0.0, 0.5, 3.0]]);
        assert_eq!(full, Law::Spatial { stiffness, damping });
        assert_eq!(
            axial,
            Law::Axial {
                stiffness: 7.0,
                damping: 0.0,
                anchor: Some([0.5, 0.0, 0.0])
            }
        );
        let boom = &body.hinged[0];
        assert_eq!(boom.axes, [[0.0, 1.0, 0.0], [0.0, 0.0, 1.0]]);
        assert_eq!(
            boom.inertia,
            [[0.0, 0.0, 0.0], [0.0, 0.3, 0.0], [0.0, 0.0, 0.3]]
        );
        assert_eq!(
            boom.stiffness,
            HingeCoefficient::PerAxis(vec![0.565, 0.565])
        );
        assert_eq!(boom.damping, HingeCoefficient::PerAxis(vec![0.01, 0.02]));
        assert_eq!(
            body.support,
            Support::FixedPoint {
                point: [0.0, 0.0, -1.0]
            }
        );
        assert_eq!(
            model.initial.angular_velocity.map(|[_, y, _]| y),
            Some(0.35)
        );
        assert_eq!(model.initial.attitude, [0.6, 0.0, 0.8, 0.0]);
        assert_eq!(
            (model.run.order, model.run.duration, model.run.samples),
            (5, Some(7200.0), Some(1000))
        );
        assert_eq!(
            (model.run.tolerance, model.run.form),
            (Some(1e-10), Some(Form::Momentum))
        );
        assert_eq!(model.notes, [""; 0]);
    }

    #[test]
    fn what_the_file_leaves_out_has_its_default() {
        let model = read(CARRIER);
        assert_eq!(model.name, "model");
        assert_eq!(model.assembly.support, Support::Free);
        assert_eq!(model.initial.angular_velocity, None);
        assert_eq!(model.initial.attitude, [1.0, 0.0, 0.0, 0.0]);
        assert_eq!(
            (model.run.order, model.run.duration, model.run.tolerance),
            (3, None, None)
        );
        // of CARRIER, by sha256sum
        assert_eq!(
            model.source.sha256,
            "0f1303cac9ec4982d910513c3b13aaebed50ec6616aa0ade1315747430b9b288"
        );
    }

    #[test]
    fn every_way_to_write_toml_is_understood() {
        let model = read(
            "carrier.mass = 0x28\ncarrier.center_of_mass = [0, +0.1, -0]\ncarrier.inertia = [9.0, 1_3, 16.0]\npoint = [{ mass = 1.0, position = [0, 0, 1] }]\r\n",
        );
        assert_eq!(model.assembly.carrier.mass, 40.0);
        assert_eq!(model.assembly.carrier.inertia[1][1], 13.0);
        assert_eq!(model.assembly.points.len(), 1);
        assert_eq!(
            read(&format!("\u{feff}{CARRIER}")).assembly.carrier.mass,
            40.0
        );
    }

    #[test]
    fn an_attitude_rounded_by_hand_is_normalised_with_a_note() {
        let model = read(&format!(
            "{CARRIER}[initial]\nattitude = [0.7071, 0, 0.7071, 0]\n"
        ));
        let norm: f64 = model
            .initial
            .attitude
            .iter()
            .map(|component| component * component)
            .sum();
        assert!((norm - 1.0).abs() < 1e-15);
        assert_snapshot!(model.notes.join("\n"), @"the initial attitude has the norm 0.9999904099540154; it was divided by it");
    }

    #[test]
    fn a_large_model_is_read_without_delay() {
        const COUNT: usize = 100_000;
        let mut text = CARRIER.to_owned();
        for index in 0..COUNT {
            write!(text, "[[point]]\nname = \"p{index}\"\nmass = 1.0\nposition = [{index}.5, 0.25, \"3 mm\"]\n").expect("memory");
            write!(
                text,
                "[[spring]]\nfrom = \"p{index}\"\nto = \"carrier\"\nstiffness = 600.0\n"
            )
            .expect("memory");
        }
        let start = std::time::Instant::now();
        let model = read(&text);
        assert_eq!(
            model.assembly.springs[COUNT - 1].from,
            End::Point(COUNT - 1)
        );
        // ten times what an unoptimised build on a busy machine needs; quadratic work takes minutes
        assert!(start.elapsed().as_secs() < 30, "{:?}", start.elapsed());
    }
}

mod files {
    use super::*;

    #[test]
    fn nonsense_is_refused_without_delay() {
        let start = std::time::Instant::now();
        let refused = refusal(&format!("#{}", " \u{1}".repeat(500_000)));
        assert_snapshot!(refused.lines().last().unwrap_or_default(), @"model.toml:1:201: there are more problems like these");
        // work that grows with the square of the length takes minutes
        assert!(start.elapsed().as_secs() < 10, "{:?}", start.elapsed());
    }

    #[test]
    fn a_file_that_cannot_be_read_is_refused() {
        let missing = Model::read(Path::new("no such folder/model.toml")).expect_err("a refusal");
        assert_snapshot!(missing, @"no such folder/model.toml: there is no such file");
        let folder = Model::read(Path::new("src")).expect_err("a refusal");
        assert_snapshot!(folder, @"src: this is a folder; give the model file inside it");
    }

    #[test]
    fn a_file_that_is_too_large_is_refused_unread() {
        let path =
            std::env::temp_dir().join(format!("quasirigid-large-{}.toml", std::process::id()));
        let file = std::fs::File::create(&path).expect("a temporary file");
        file.set_len(1 << 33).expect("a sparse file");
        let error = Model::read(&path).expect_err("a refusal");
        std::fs::remove_file(&path).expect("the temporary file");
        assert_eq!(
            error,
            ModelError::Unreadable {
                file: path,
                problem: FileProblem::TooLarge { limit: 1 << 28 }
            }
        );
    }

    #[test]
    fn a_file_is_read_from_disk_and_a_byte_that_is_no_text_is_located() {
        let path =
            std::env::temp_dir().join(format!("quasirigid-text-{}.toml", std::process::id()));
        std::fs::write(&path, CARRIER).expect("a temporary file");
        let model = Model::read(&path);
        std::fs::write(&path, b"[carrier]\nmass = \"40 \xff\"\n").expect("a temporary file");
        let error = Model::read(&path).expect_err("a refusal").to_string();
        std::fs::remove_file(&path).expect("the temporary file");
        assert_eq!(model.map(|model| model.assembly.carrier.mass), Ok(40.0));
        assert_snapshot!(error.replace(&*path.to_string_lossy(), "model.toml"), @r#"
        model.toml:2:12: the file is not UTF-8 text: the byte 0xFF cannot stand here
          a model file is a TOML text; save it with the encoding UTF-8
        "#);
    }

    #[test]
    fn an_empty_file_is_refused() {
        assert_snapshot!(refusal(" \n"), @r#"
        model.toml:1:1: the file is empty
          a model has at least a [carrier] with mass, center_of_mass and inertia
        "#);
        assert_snapshot!(refusal("# nothing yet\n"), @r#"
        model.toml:1:1: the file has comments but no model
          a model has at least a [carrier] with mass, center_of_mass and inertia
        "#);
    }

    #[test]
    fn what_is_not_toml_is_refused_where_it_stops_being_so() {
        assert_snapshot!(refusal("[carrier]\nmass = 40 kg # heavy\n"), @r#"
        model.toml:2:8: not valid TOML: string values must be quoted, expected literal string
          a number with its unit stands in quotes: "40 kg"
        "#);
        assert_snapshot!(refusal("[carrier\nmass = 40\n"), @"model.toml:1:9: not valid TOML: unclosed table, expected `]`");
        assert_snapshot!(refusal("[carrier]\nmass = 40\nmass = 41\n[carrier]\n"), @r#"
        model.toml:3:1: not valid TOML: duplicate key
        model.toml:4:2: not valid TOML: duplicate key
        "#);
        assert_snapshot!(refusal("[carrier]\nname = \"never closed\n"), @r#"model.toml:2:21: not valid TOML: invalid basic string, expected `"`"#);
        assert_snapshot!(refusal("[carrier]\ninertia = [1, 2, 3\n"), @"model.toml:2:19: not valid TOML: unclosed array, expected `]`");
    }

    #[test]
    fn nesting_without_end_is_refused() {
        let depth = 100_000;
        assert_snapshot!(refusal(&format!("a = {}", "[".repeat(depth))), @r#"
        model.toml:1:85: not valid TOML: cannot recurse further; max recursion depth met
        model.toml:1:100005: not valid TOML: unclosed array, expected `]`
        "#);
        assert_snapshot!(refusal(&format!("[{}a]", "a.".repeat(depth))), @r#"
        model.toml:1:2: a key with more than 16 parts
          the longest keys of a model have two, as in carrier.mass
        "#);
        assert_snapshot!(refusal(&format!("x = 1\nx = {{ {}a = 1 }}", "\"a,b\" . ".repeat(depth))), @r#"
        model.toml:2:6: a key with more than 16 parts
          the longest keys of a model have two, as in carrier.mass
        "#);
    }
}

mod keys {
    use super::*;

    #[test]
    fn an_unknown_key_is_refused_with_the_nearest_known_one() {
        assert_snapshot!(refusal_of_spring("stifness = 600.0\n"), @r#"
        model.toml:12:1: unknown key "stifness" in [[spring]]
          did you mean `stiffness`? the keys are from, to, stiffness, damping, axial, anchor
        "#);
        assert_snapshot!(refusal_of("[[points]]\nmass = 1\n"), @r#"
        model.toml:9:3: unknown key "points" in the file
          did you mean `point`? the keys are body, carrier, point, spring, hinged, support, initial, run
        "#);
        assert_snapshot!(refusal_of("[run]\ntemperature = 300\n"), @r#"
        model.toml:10:1: unknown key "temperature" in [run]
          the keys are order, duration, tolerance, samples, form
        "#);
    }

    #[test]
    fn a_missing_key_is_refused_at_its_table() {
        assert_snapshot!(refusal("[body]\nname = \"x\"\n"), @r#"
        model.toml:1:1: the file has no [carrier]
          add [carrier] with mass, center_of_mass and inertia: the rigid body that carries everything else
        "#);
        assert_snapshot!(refusal("[carrier]\n"), @r#"
        model.toml:1:1: [carrier] has no `mass`
          add a line such as: mass = 40.0
        model.toml:1:1: [carrier] has no `center_of_mass`
          add a line such as: center_of_mass = [0.0, 0.0, 0.0]
        model.toml:1:1: [carrier] has no `inertia`
          add a line such as: inertia = [9.0, 13.0, 16.0]
        "#);
        assert_snapshot!(refusal_of("[[point]]\n[[spring]]\n"), @r#"
        model.toml:9:1: [[point]] has no `mass`
          add a line such as: mass = 1.0
        model.toml:9:1: [[point]] has no `position`
          add a line such as: position = [0.8, 0.3, 0.5]
        model.toml:10:1: [[spring]] has no `from`
          add a line such as: from = "tip"
        model.toml:10:1: [[spring]] has no `to`
          add a line such as: to = "carrier"
        model.toml:10:1: [[spring]] has no `stiffness`
          add a line such as: stiffness = 600.0
        "#);
        assert_snapshot!(refusal_of("[support]\nkind = \"fixed-point\"\n[[hinged]]\n"), @r#"
        model.toml:9:1: [support] has no `point`
          add a line such as: point = [0.0, 0.0, 0.0]
        model.toml:11:1: [[hinged]] has no `mass`
          add a line such as: mass = 1.0
        model.toml:11:1: [[hinged]] has no `center_of_mass`
          add a line such as: center_of_mass = [1.5, 0.0, 0.0]
        model.toml:11:1: [[hinged]] has no `inertia`
          add a line such as: inertia = [0.0, 0.3, 0.3]
        model.toml:11:1: [[hinged]] has no `hinge`
          add a line such as: hinge = [1.0, 0.0, 0.0]
        model.toml:11:1: [[hinged]] has no `axes`
          add a line such as: axes = [[0, 0, 1]]
        model.toml:11:1: [[hinged]] has no `stiffness`
          add a line such as: stiffness = "0.565 N m/rad"
        "#);
    }

    #[test]
    fn a_part_of_the_format_that_is_not_supported_yet_is_named() {
        assert_snapshot!(refusal_of("[[beam]]\nlength = 3\n[material.rock]\ndensity = 2500\n"), @r#"
        model.toml:9:3: `[[beam]]` is part of the model format, but this version of quasirigid does not support it yet
        model.toml:11:2: `[material]` is part of the model format, but this version of quasirigid does not support it yet
        "#);
        assert_snapshot!(refusal_of("[run]\nevolve = { until = \"98% of I3\" }\nverify = { rotations = 5 }\n"), @r#"
        model.toml:10:1: `evolve` is part of the model format, but this version of quasirigid does not support it yet
        model.toml:11:1: `verify` is part of the model format, but this version of quasirigid does not support it yet
        "#);
        assert_snapshot!(refusal_of("[support]\nkind = \"prescribed\"\n"), @r#"
        model.toml:10:8: `kind` = "prescribed" is part of the model format, but this version of quasirigid does not support it yet
          write "free" or "fixed-point"
        "#);
        assert_snapshot!(refusal_of("[initial]\ndisplacements = \"rest\"\n"), @r#"
        model.toml:10:17: `displacements` = "rest" is part of the model format, but this version of quasirigid does not support it yet
          write "slow-manifold"
        "#);
        assert_snapshot!(refusal_of("[initial]\ndisplacements = [[0, 0, 1]]\n"), @r#"
        model.toml:10:17: `displacements` as numbers are not supported by this version of quasirigid
          write "slow-manifold"
        "#);
    }

    #[test]
    fn single_and_double_brackets_are_told_apart() {
        assert_snapshot!(refusal(&CARRIER.replace("[carrier]", "[[carrier]]")), @r#"
        model.toml:1:1: there is one [carrier], not a list of them
          write [carrier] once, with single brackets
        "#);
        assert_snapshot!(refusal(&format!("{CARRIER}[point]\nmass = 1\n")), @r#"
        model.toml:5:1: `point` is a list of tables, but a table stands here
          write [[point]], with double brackets, once for each
        "#);
        assert_snapshot!(refusal("carrier = 40.0\npoint = [1]\n"), @r#"
        model.toml:1:11: `carrier`: found a decimal number, expected a table
          write [carrier] with its keys below
        model.toml:2:10: `point`: found an integer, expected a table
          write [[point]] with its keys below
        "#);
    }

    #[test]
    fn every_mistake_is_reported_in_the_order_of_the_file() {
        assert_snapshot!(refusal("[run]\norder = 0\n[carrier]\nmass = 0\ninertia = 3\ncentre_of_mass = [0, 0, 0]\n"), @r#"
        model.toml:2:9: `order` is 0, but must be an integer from 1 to 12
          write an integer from 1 to 12
        model.toml:4:8: `mass` is 0 kg, but must be positive
          write a number in kg, or a text with its unit such as "12 lb"
        model.toml:5:11: `inertia`: found an integer, expected 3 principal values or a 3x3 matrix
          write [Jx, Jy, Jz] in kg m^2, or three rows of a symmetric matrix
        model.toml:6:1: unknown key "centre_of_mass" in [carrier]
          did you mean `center_of_mass`? the keys are mass, center_of_mass, inertia
        "#);
    }

    #[test]
    fn a_mistake_made_many_times_is_cut_short() {
        let many = "[[spring]]\nfrom = \"tip\"\nto = \"top\"\nstiffnes = 1\n".repeat(10_000);
        let report = refusal_of(&many);
        let locations = report
            .lines()
            .filter(|line| line.starts_with("model.toml:"))
            .count();
        assert_eq!(locations, 101);
        assert_snapshot!(report.lines().last().unwrap_or_default(), @"model.toml:408:1: there are more problems like these");
    }
}

mod values {
    use super::*;

    #[test]
    fn a_value_of_another_kind_is_refused() {
        assert_snapshot!(refusal(&CARRIER.replace("40.0", "[40.0]")), @r#"
        model.toml:2:8: `mass`: found an array of 1 value, expected a mass
          write a number in kg, or a text with its unit such as "12 lb"
        "#);
        assert_snapshot!(refusal(&CARRIER.replace("[0, 0.1, 0]", "\"0.1 m\"")), @r#"
        model.toml:3:18: `center_of_mass`: found a text, expected an array of 3 numbers
          write 3 numbers in brackets, with commas between them
        "#);
        assert_snapshot!(refusal(&CARRIER.replace("[0, 0.1, 0]", "[0, 0.1]")), @r#"
        model.toml:3:18: `center_of_mass`: found an array of 2 values, expected an array of 3 numbers
          write 3 numbers in brackets, with commas between them
        "#);
        assert_snapshot!(refusal(&CARRIER.replace("[0, 0.1, 0]", "[0, true, 1979-05-27]")), @r#"
        model.toml:3:22: `center_of_mass`: found true, expected a length
          write a number in m, or a text with its unit such as "22 in"
        model.toml:3:28: `center_of_mass`: found a date or time, expected a length
          write a number in m, or a text with its unit such as "22 in"
        "#);
        assert_snapshot!(refusal(&CARRIER.replace("[9.0, 13.0, 16.0]", "[9.0, [13.0], 16.0]")), @r#"
        model.toml:4:12: `inertia`: found a decimal number, expected an array of 3 numbers
          write 3 numbers in brackets, with commas between them
        model.toml:4:17: `inertia`: found an array of 1 value, expected an array of 3 numbers
          write 3 numbers in brackets, with commas between them
        model.toml:4:25: `inertia`: found a decimal number, expected an array of 3 numbers
          write 3 numbers in brackets, with commas between them
        "#);
        assert_snapshot!(refusal(&CARRIER.replace("[9.0, 13.0, 16.0]", "[9.0, 13.0]")), @r#"
        model.toml:4:11: `inertia`: found an array of 2 values, expected 3 principal values or a 3x3 matrix
          write [Jx, Jy, Jz] in kg m^2, or three rows of a symmetric matrix
        "#);
        assert_snapshot!(refusal(&POINT.replace("\"tip\"", "7")), @r#"
        model.toml:1:1: the file has no [carrier]
          add [carrier] with mass, center_of_mass and inertia: the rigid body that carries everything else
        model.toml:2:8: `name`: found an integer, expected a text
          write the name in quotes
        "#);
        assert_snapshot!(refusal(&POINT.replace("\"tip\"", "\"\"")), @r#"
        model.toml:1:1: the file has no [carrier]
          add [carrier] with mass, center_of_mass and inertia: the rigid body that carries everything else
        model.toml:2:8: `name` is empty
          write the name in quotes
        "#);
        assert_snapshot!(refusal_of_spring("stiffness = 600\naxial = \"yes\"\n"), @r#"
        model.toml:13:9: `axial`: found a text, expected true or false
          write true or false, without quotes
        "#);
        assert_snapshot!(refusal_of("[body]\nname = { first = 1 }\n"), @r#"
        model.toml:10:8: `name`: found a table, expected a text
          write the name in quotes
        "#);
    }

    #[test]
    fn a_number_that_is_not_finite_is_refused() {
        assert_snapshot!(refusal(&CARRIER.replace("40.0", "nan")), @r#"
        model.toml:2:8: `mass` is nan, which is not a finite number
          write a number in kg, or a text with its unit such as "12 lb"
        "#);
        assert_snapshot!(refusal(&CARRIER.replace("40.0", "-inf")), @r#"
        model.toml:2:8: `mass` is -inf, which is not a finite number
          write a number in kg, or a text with its unit such as "12 lb"
        "#);
        assert_snapshot!(refusal(&CARRIER.replace("40.0", "1e999")), @r#"
        model.toml:2:8: `mass` is 1e999, which is not a finite number
          write a number in kg, or a text with its unit such as "12 lb"
        "#);
        assert_snapshot!(refusal(&CARRIER.replace("40.0", "\"inf kg\"")), @r#"
        model.toml:2:8: `mass`: "inf kg" is not a finite number
          write a finite number
        "#);
        assert_snapshot!(refusal(&CARRIER.replace("40.0", &format!("0x{}", "f".repeat(40)))), @r#"
        model.toml:2:8: `mass` is 0xffffffffffffffffffffffffffffffffffffffff, which is not a finite number
          write a number in kg, or a text with its unit such as "12 lb"
        "#);
        assert_eq!(
            read(&CARRIER.replace("40.0", &"9".repeat(60)))
                .assembly
                .carrier
                .mass,
            1e60
        );
        assert_snapshot!(refusal(&CARRIER.replace("0.1", "nan")), @r#"
        model.toml:3:22: `center_of_mass` is nan, which is not a finite number
          write a number in m, or a text with its unit such as "22 in"
        "#);
    }

    #[test]
    fn a_mass_that_is_not_positive_is_refused() {
        assert_snapshot!(refusal(&CARRIER.replace("40.0", "0")), @r#"
        model.toml:2:8: `mass` is 0 kg, but must be positive
          write a number in kg, or a text with its unit such as "12 lb"
        "#);
        assert_snapshot!(refusal_of("[[point]]\nmass = \"-2 lb\"\nposition = [0, 0, 1]\n"), @r#"
        model.toml:10:8: `mass` is -0.90718474 kg, but must be positive
          write a number in kg, or a text with its unit such as "12 lb"
        "#);
    }

    #[test]
    fn a_wrong_unit_is_refused() {
        assert_snapshot!(refusal(&CARRIER.replace("40.0", "\"40 in\"")), @r#"
        model.toml:2:8: `mass`: "40 in" is a length, but a mass is needed
          write for example "12 lb", or a plain number in kg
        "#);
        assert_snapshot!(refusal(&CARRIER.replace("0.1", "\"0.1 metres\"")), @r#"
        model.toml:3:22: `center_of_mass`: there is no unit "metres"
          did you mean "m"?
        "#);
        assert_snapshot!(refusal_of_spring("stiffness = \"12.5 lb/in\"\n"), @r#"
        model.toml:12:13: `stiffness`: "12.5 lb/in" is a quantity in kg m^-1, but a stiffness is needed
          lb is the mass, lbf the force; write for example "12.5 lbf/in", or a plain number in N/m
        "#);
        assert_snapshot!(refusal_of("[initial]\nangular_velocity = [\"3 Hz\", 0, \"12\"]\n"), @r#"
        model.toml:10:21: `angular_velocity`: "3 Hz" may mean turns or radians per second
          write rev/s or rad/s
        model.toml:10:32: `angular_velocity`: "12" is a text without a unit
          add the unit, or write 12 without the quotes for 12 rad/s
        "#);
        assert_snapshot!(refusal_of("[run]\nduration = \"2 days ago\"\n"), @r#"
        model.toml:10:12: `duration`: there is no unit "days"
          did you mean "d"?
        "#);
    }

    #[test]
    fn columns_are_counted_in_characters() {
        assert_snapshot!(refusal("carrier = { \"größe\" = 1, mass = \"ω kg\" }\n"), @r#"
        model.toml:1:11: [carrier] has no `center_of_mass`
          add a line such as: center_of_mass = [0.0, 0.0, 0.0]
        model.toml:1:11: [carrier] has no `inertia`
          add a line such as: inertia = [9.0, 13.0, 16.0]
        model.toml:1:13: unknown key "größe" in [carrier]
          the keys are mass, center_of_mass, inertia
        model.toml:1:33: `mass`: "ω kg" is not a decimal number with a unit
          write for example "12 lb", or a plain number in kg
        "#);
    }
}

mod elements {
    use super::*;

    #[test]
    fn an_unknown_name_is_refused_with_those_there_are() {
        assert_snapshot!(refusal_of("[[spring]]\nfrom = \"tpi\"\nto = \"ground\"\nstiffness = 1\n"), @r#"
        model.toml:10:8: there is no point "tpi"
          did you mean "tip"? there are carrier, tip
        model.toml:11:6: there is no point "ground"
          there are carrier, tip
        "#);
        assert_snapshot!(refusal(&format!("{CARRIER}[[spring]]\nfrom = \"tip\"\nto = \"carrier\"\nstiffness = 1\n")), @r#"
        model.toml:6:8: there is no point "tip"
          the file has no [[point]]; a spring joins points and the carrier
        "#);
        let spring = "[[spring]]\nfrom = \"boom\"\nto = \"tip\"\nstiffness = 1\n";
        assert_snapshot!(refusal_of(&format!("{HINGED}axes = [[0, 0, 1]]\nstiffness = 3\n{spring}")), @r#"
        model.toml:18:8: "boom" is a hinged appendage, but a spring joins points and the carrier
          give the hinge its own `stiffness` instead
        "#);
    }

    #[test]
    fn a_long_list_of_names_is_cut_short() {
        let points: String = (0..5000)
            .map(|index| {
                format!("[[point]]\nname = \"p{index}\"\nmass = 1\nposition = [0, 0, 1]\n")
            })
            .collect();
        let spring = "[[spring]]\nfrom = \"p4\"\nto = \"carier\"\nstiffness = 1\n";
        assert_snapshot!(refusal(&format!("{CARRIER}{points}{spring}")), @r#"
        model.toml:20007:6: there is no point "carier"
          did you mean "carrier"? there are carrier, p0, p1, p2, p3, p4, p5, p6, p7, p8, …
        "#);
    }

    #[test]
    fn a_name_given_twice_is_refused_at_both_places() {
        assert_snapshot!(refusal_of(POINT), @r#"
        model.toml:10:8: the name "tip" is used twice; it stands first in line 6
          give each element its own name
        "#);
        assert_snapshot!(refusal_of(&POINT.replace("tip", "carrier")), @r#"
        model.toml:10:8: the name "carrier" is that of the carrier
          choose another name
        "#);
        let unnamed = POINT.replace("name = \"tip\"\n", "");
        assert_snapshot!(refusal(&format!("{CARRIER}{}{unnamed}", POINT.replace("tip", "point 2"))), @r#"
        model.toml:9:1: the name "point 2" is used twice; it stands first in line 6
          give each element its own name
        "#);
        let boom = HINGED.replace("boom", "tip");
        assert_snapshot!(refusal_of(&format!("{boom}axes = [[0, 0, 1]]\nstiffness = 3\n")), @r#"
        model.toml:10:8: the name "tip" is used twice; it stands first in line 6
          give each element its own name
        "#);
    }

    #[test]
    fn a_spring_from_an_end_to_itself_is_refused() {
        assert_snapshot!(refusal_of("[[spring]]\nfrom = \"tip\"\nto = \"tip\"\nstiffness = 1\n"), @r#"
        model.toml:11:6: both ends of the spring are the same
          a spring joins two points, or a point and the carrier
        "#);
        assert_snapshot!(refusal_of("[[spring]]\nfrom = \"carrier\"\nto = \"carrier\"\nstiffness = 1\n"), @r#"
        model.toml:11:6: both ends of the spring are the same
          a spring joins two points, or a point and the carrier
        "#);
    }

    #[test]
    fn an_axial_spring_has_one_stiffness_and_alone_an_anchor() {
        assert_snapshot!(refusal_of_spring("axial = true\nstiffness = [1, 2, 3]\ndamping = [[1]]\n"), @r#"
        model.toml:13:13: `stiffness`: found an array of 3 values, expected one number, since the spring is axial
          write one number: an axial spring acts only along the line that joins its ends
        model.toml:14:11: `damping`: found an array of 1 value, expected one number, since the spring is axial
          write one number: an axial spring acts only along the line that joins its ends
        "#);
        assert_snapshot!(refusal_of_spring("stiffness = 1\nanchor = [0, 0, 1]\n"), @r#"
        model.toml:13:10: `anchor` is the carrier's end of an axial spring, and this spring is not axial
          add axial = true, or leave it out
        "#);
    }

    #[test]
    fn a_negative_stiffness_or_damping_is_refused() {
        assert_snapshot!(refusal_of_spring("stiffness = -600\ndamping = [1, \"-2 N s/m\", 3]\n"), @r#"
        model.toml:12:13: `stiffness` is -600 N/m, but must be zero or positive
          a positive value resists the motion, as every spring and dashpot does
        model.toml:13:15: `damping` is -2 N s/m, but must be zero or positive
          a positive value resists the motion, as every spring and dashpot does
        "#);
        assert_snapshot!(refusal_of(&format!("{HINGED}axes = [[0, 0, 1]]\nstiffness = -3\ndamping = [-1]\n")), @r#"
        model.toml:16:13: `stiffness` is -3 N m/rad, but must be zero or positive
          a positive value resists the motion, as every spring and dashpot does
        model.toml:17:12: `damping` is -1 N m s/rad, but must be zero or positive
          a positive value resists the motion, as every spring and dashpot does
        "#);
    }

    #[test]
    fn a_stiffness_of_another_shape_is_refused() {
        assert_snapshot!(refusal_of_spring("stiffness = [1, 2]\ndamping = [[1, 0, 0], [0, 1, 0], [0, 0]]\n"), @r#"
        model.toml:12:13: `stiffness`: found an array of 2 values, expected a number, 3 numbers or a 3x3 matrix
          write k, [kx, ky, kz] or three rows of a symmetric matrix
        model.toml:13:34: `damping`: found an array of 2 values, expected an array of 3 numbers
          write 3 numbers in brackets, with commas between them
        "#);
        assert_snapshot!(refusal_of_spring("stiffness = { x = 1 }\n"), @r#"
        model.toml:12:13: `stiffness`: found a table, expected a stiffness
          write a number in N/m, or a text with its unit such as "12.5 lbf/in"
        "#);
    }

    #[test]
    fn a_motion_is_free_or_along_one_line_or_in_one_plane() {
        assert_snapshot!(refusal_of("[[point]]\nmass = 1\nposition = [0, 0, 1]\nmotion = \"fixed\"\n"), @r#"
        model.toml:12:10: `motion`: found a text, expected "free", a line or a plane
          write "free", { line = [1, 0, 0] } or { plane = [0, 0, 1] }
        "#);
        assert_snapshot!(refusal_of("[[point]]\nmass = 1\nposition = [0, 0, 1]\nmotion = 3\n"), @r#"
        model.toml:12:10: `motion`: found an integer, expected "free", a line or a plane
          write "free", { line = [1, 0, 0] } or { plane = [0, 0, 1] }
        "#);
        assert_snapshot!(refusal_of("[[point]]\nmass = 1\nposition = [0, 0, 1]\nmotion = { lines = [0, 0, 1] }\n"), @r#"
        model.toml:12:10: `motion` needs either a line or a plane
          write "free", { line = [1, 0, 0] } or { plane = [0, 0, 1] }
        model.toml:12:12: unknown key "lines" in `motion`
          did you mean `line`? the keys are line, plane
        "#);
        assert_snapshot!(refusal_of("[[point]]\nmass = 1\nposition = [0, 0, 1]\nmotion = { line = [0, 0, \"1 m\"] }\n"), @r#"
        model.toml:12:26: `line`: "1 m" is a length, but a plain number is needed
          write a number without quotes
        "#);
    }

    #[test]
    fn hinge_axes_are_a_list_of_directions() {
        assert_snapshot!(refusal_of(&format!("{HINGED}axes = [0, 0, 1]\nstiffness = 3\n")), @r#"
        model.toml:15:8: `axes`: found an array of 3 values, expected a list of axes, each an array of 3 numbers
          write for example [[0, 0, 1]] for one axis along z
        "#);
        assert_snapshot!(refusal_of(&format!("{HINGED}axes = [[0, 0]]\nstiffness = \"3 N/m\"\n")), @r#"
        model.toml:15:9: `axes`: found an array of 2 values, expected an array of 3 numbers
          write 3 numbers in brackets, with commas between them
        model.toml:16:13: `stiffness`: "3 N/m" is a stiffness, but a rotational stiffness is needed
          write for example "0.565 N m/rad", or a plain number in N m/rad
        "#);
    }

    #[test]
    fn a_hinge_can_have_a_stiffness_matrix() {
        let model = read(&format!(
            "{CARRIER}{HINGED}axes = [[0, 1, 0], [0, 0, 1]]\nstiffness = [[3, 1], [1, \"4 N m/rad\"]]\n"
        ));
        assert_eq!(
            model.assembly.hinged[0].stiffness,
            HingeCoefficient::Full(vec![vec![3.0, 1.0], vec![1.0, 4.0]])
        );
        assert_eq!(
            model.assembly.hinged[0].damping,
            HingeCoefficient::PerAxis(vec![0.0, 0.0])
        );
    }

    #[test]
    fn a_free_body_has_no_fixed_point() {
        assert_snapshot!(refusal_of("[support]\nkind = \"free\"\npoint = [0, 0, 0]\n"), @r#"
        model.toml:11:9: a free body has no fixed `point`
          leave it out, or write kind = "fixed-point"
        "#);
        assert_snapshot!(refusal_of("[support]\nkind = \"pinned\"\n"), @r#"
        model.toml:10:8: `kind` cannot be "pinned"
          write "free" or "fixed-point"
        "#);
    }
}

mod settings {
    use super::*;

    #[test]
    fn an_attitude_is_a_unit_quaternion() {
        assert_snapshot!(refusal_of("[initial]\nattitude = [1, 0, 0, 1]\n"), @r#"
        model.toml:10:12: `attitude` has the norm 1.4142135623730951, but an attitude is a unit quaternion
          write four numbers, scalar first, whose squares add up to 1
        "#);
        assert_snapshot!(refusal_of("[initial]\nattitude = [0, 0, 0, 0]\n"), @r#"
        model.toml:10:12: `attitude` has the norm 0, but an attitude is a unit quaternion
          write four numbers, scalar first, whose squares add up to 1
        "#);
        assert_snapshot!(refusal_of("[initial]\nattitude = [1, 0, 0]\n"), @r#"
        model.toml:10:12: `attitude`: found an array of 3 values, expected an array of 4 numbers
          write 4 numbers in brackets, with commas between them
        "#);
    }

    #[test]
    fn settings_out_of_range_are_refused() {
        assert_snapshot!(refusal_of("[run]\norder = 13\nduration = 0\ntolerance = 0.5\nsamples = 1\nform = \"quick\"\n"), @r#"
        model.toml:10:9: `order` is 13, but must be an integer from 1 to 12
          write an integer from 1 to 12
        model.toml:11:12: `duration` is 0 s, but must be positive
          write a number in s, or a text with its unit such as "2 h"
        model.toml:12:13: `tolerance` is 5e-1, but must lie between 1e-15 and 1e-2
          write for example tolerance = 1e-9
        model.toml:13:11: `samples` is 1, but must be an integer from 2 to 10000000
          write an integer from 2 to 10000000
        model.toml:14:8: `form` cannot be "quick"
          write "momentum" or "paper"
        "#);
        assert_snapshot!(refusal_of("[run]\norder = 3.0\ntolerance = 1e-15\nsamples = 10_000_001\n"), @r#"
        model.toml:10:9: `order`: found a decimal number, expected an integer from 1 to 12
          write an integer from 1 to 12
        model.toml:11:13: `tolerance` is 1e-15, but must lie between 1e-15 and 1e-2
          write for example tolerance = 1e-9
        model.toml:12:11: `samples` is 10000001, but must be an integer from 2 to 10000000
          write an integer from 2 to 10000000
        "#);
        let run = read(&format!("{CARRIER}[run]\norder = 12\ntolerance = 1.1e-15\nsamples = 10_000_000\nform = \"paper\"\n")).run;
        assert_eq!(
            (run.order, run.samples, run.form),
            (12, Some(10_000_000), Some(Form::Paper))
        );
    }
}

mod physics {
    use super::*;

    fn diagnosis(model: &Model, place: Place, field: Field, problem: Problem) -> String {
        model
            .diagnose(&ElementError {
                place,
                field,
                problem,
            })
            .to_string()
    }

    fn model() -> Model {
        let spring = "[[spring]]\nfrom = \"tip\"\nto = \"carrier\"\nstiffness = 600.0\n";
        read(&format!(
            "{CARRIER}{POINT}{spring}{HINGED}axes = [[0, 0, 1]]\nstiffness = 3\n"
        ))
    }

    #[test]
    fn a_law_of_mechanics_is_cited_at_the_value_that_breaks_it() {
        let model = model();
        let impossible = Problem::Inertia(InertiaError::Impossible {
            moments: [1.0, 2.0, 4.0],
        });
        assert_snapshot!(diagnosis(&model, Place::Carrier, Field::Inertia, impossible), @r#"
        model.toml:4:11: `inertia` of the carrier: no body has the principal moments of inertia [1.0, 2.0, 4.0] kg m^2: none may be negative, or exceed the sum of the other two
          check the units and the signs of the products of inertia; the tensor is about the element's own centre of mass
        "#);
        let indefinite = Problem::Indefinite { eigenvalue: -2.5 };
        assert_snapshot!(diagnosis(&model, Place::Spring(0), Field::Stiffness, indefinite), @r#"
        model.toml:12:13: `stiffness` of spring 1: the smallest eigenvalue is -2.5e0; a spring or dashpot must not give energy
          check the signs; the eigenvalues of the matrix must be zero or positive
        "#);
        let mechanism = Problem::Mechanism {
            coordinates: "tip.x, tip.y".to_owned(),
        };
        assert_snapshot!(diagnosis(&model, Place::Point(0), Field::Position, mechanism), @r#"
        model.toml:8:12: a mechanism: no spring resists the motion of tip.x, tip.y
          add a spring that resists it, or leave the point less freedom: motion = { line = [x, y, z] }
        "#);
        let massless = Problem::MasslessAxis { axis: 1 };
        assert_snapshot!(diagnosis(&model, Place::Hinged(0), Field::Axes, massless), @r#"
        model.toml:19:8: `axes` of appendage "boom": turning about axis 1 moves no mass; leave that axis out
          or give the appendage an inertia about it
        "#);
    }

    #[test]
    fn a_value_the_file_leaves_out_is_diagnosed_at_its_table() {
        let model = model();
        assert_snapshot!(diagnosis(&model, Place::Point(0), Field::Motion, Problem::ZeroDirection), @r#"
        model.toml:5:1: `motion` of point "tip": a direction of zero length
          write a direction such as [0, 0, 1]; its length does not matter
        "#);
        let moments = [0.0, 0.0, 1.0];
        let no_inertia = Problem::NoInertia {
            moments,
            support: Support::Free,
        };
        assert_snapshot!(diagnosis(&model, Place::Support, Field::FixedPoint, no_inertia), @r#"
        model.toml:1:1: the whole body has no inertia about some axis (principal moments [0.0, 0.0, 1.0] kg m^2)
          check the masses and the inertia of the carrier
        "#);
    }

    #[test]
    fn several_errors_stand_in_the_order_of_the_file() {
        let error = |place, field| ElementError {
            place,
            field,
            problem: Problem::NotFinite { value: f64::NAN },
        };
        let errors = [
            error(Place::Hinged(0), Field::Mass),
            error(Place::Carrier, Field::Mass),
        ];
        let ModelError::Invalid { diagnostics, model } = model().diagnose_all(&errors) else {
            panic!("a listing");
        };
        assert_eq!(
            diagnostics
                .iter()
                .map(|diagnostic| diagnostic.position(&model.text))
                .collect::<Vec<_>>(),
            [(2, 8), (15, 8)]
        );
        assert_eq!(&model.text[diagnostics[0].span.clone()], "40.0");
    }
}

proptest! {
    /// A good model with some of its text replaced is read or refused with places inside the text.
    #[test]
    fn no_mutation_makes_it_panic(start in 0usize..700, length in 0usize..12, patch in "([a-z0-9]|[\\[\\]={}.,\"'#\n -]|é){0,12}") {
        let spring = "[[spring]]\nfrom = \"tip\"\nto = \"carrier\"\nstiffness = \"6 N/cm\"\ndamping = [1, 2, 3]\n";
        let hinge = "axes = [[0, 0, 1]]\nstiffness = [[3]]\n";
        let rest = "[support]\nkind = \"free\"\n[initial]\nangular_velocity = [1, \"2 rpm\", 3]\n[run]\norder = 3\n";
        let mut text = format!("{CARRIER}{POINT}motion = {{ line = [1, 0, 0] }}\n{spring}{HINGED}{hinge}{rest}");
        let start = start.min(text.len());
        text.replace_range(start..(start + length).min(text.len()), &patch);
        if let Err(error) = Model::parse(Path::new("model.toml"), &text) {
            prop_assert!(error.to_string().starts_with("model.toml:"));
            let ModelError::Invalid { diagnostics, .. } = error else { return Err(TestCaseError::fail("readable")) };
            prop_assert!(diagnostics.iter().all(|diagnostic| text.get(diagnostic.span.clone()).is_some()));
        }
    }

    #[test]
    fn no_text_makes_it_panic(text in "(\\PC|\n|\\[\\[?(point|spring|carrier)\\]\\]?\n){0,40}") {
        let _ = Model::parse(Path::new("model.toml"), &text);
    }
}
