//! Changed copies of a model: values by path, and paths that lead nowhere.

use quasirigid_io::model::{ChangeError, KeyValue, changed};

const MODEL: &str = "\
# a satellite
[carrier]
mass = 40.0 # kg
inertia = [9.0, 13.0, 16.0]

[material.rock]
rheology = { kind = \"quality-factor\", Q = 100 }

[material.\"dry sand\"]
density = 1500.0

[[spring]]
name = \"boom\"
stiffness = 600.0   # N/m

[[spring]]
stiffness = 1.0

[initial]
angular_velocity = [
    0.1, # x
    0.2,
    0.3,
]
";

fn made(path: &str, given: impl Into<KeyValue>) -> String {
    changed(MODEL, &[(path, given.into())]).unwrap()
}

fn refused(path: &str, given: impl Into<KeyValue>) -> String {
    changed(MODEL, &[(path, given.into())]).unwrap_err().to_string()
}

#[test]
fn one_value_changes_and_the_rest_of_the_text_stays() {
    for (path, given, [old, new]) in [
        ("spring.boom.stiffness", KeyValue::from("6 kN/m"), ["600.0 ", "\"6 kN/m\" "]),
        ("spring.2.stiffness", 2.5.into(), ["stiffness = 1.0", "stiffness = 2.5"]),
        ("material.rock.rheology.Q", 5.0.into(), ["Q = 100", "Q = 5.0"]),
        ("material.\"dry sand\".density", "2 g/cm^3".into(), ["1500.0", "\"2 g/cm^3\""]),
        ("carrier.inertia", vec![1.0, 2.0, 3.0].into(), ["[9.0, 13.0, 16.0]", "[1.0, 2.0, 3.0]"]),
        ("initial.angular_velocity.1", 7i64.into(), ["0.1, # x", "7, # x"]),
        (
            "carrier.mass",
            1e300.into(),
            ["40.0", &format!("{:?}", 1e300).replace("e300", &format!("{}.0", "0".repeat(300)))],
        ),
    ] {
        assert_eq!(made(path, given), MODEL.replacen(old, new, 1), "{path}");
    }
}

#[test]
fn new_keys_stand_in_tables_that_are_there_or_may_be_left_out() {
    assert!(made("spring.2.name", "x").contains("stiffness = 1.0\nname = \"x\"\n"));
    assert!(made("run.order", 5i64).ends_with("\n[run]\norder = 5\n"));
    let read: toml::Table = made("material.rock.rheology.range", vec![1.0, 2.0]).parse().unwrap();
    assert_eq!(
        read["material"]["rock"]["rheology"].to_string(),
        "{ Q = 100, kind = \"quality-factor\", range = [1.0, 2.0] }"
    );
}

#[test]
fn numbers_keep_every_bit() {
    for number in [0.1, 1.0 / 3.0, f64::MIN_POSITIVE, f64::MAX, 5e-324, -0.0, 1e22, 123_456_789.123_456_79] {
        let text = made("carrier.mass", number);
        let read: toml::Table = text.parse().unwrap();
        assert_eq!(read["carrier"]["mass"].as_float().unwrap().to_bits(), number.to_bits());
    }
}

#[test]
fn path_that_leads_nowhere_says_what_there_is() {
    for (path, said) in [
        (
            "sprng.boom.stiffness",
            "there is no `sprng`; did you mean `spring`? there is carrier, material, spring, initial",
        ),
        ("spring.bom.stiffness", "there is no entry named \"bom\"; did you mean `boom`? the names are boom"),
        ("spring.3.stiffness", "there is no entry 3: the list has 2, numbered from 1"),
        ("spring.0.stiffness", "there is no entry 0: the list has 2, numbered from 1"),
        ("spring.\"2\".stiffness", "there is no entry named \"2\"; the names are boom"),
        ("carrier.mass.2", "`2` stands below 40.0, float, which has no parts"),
        ("initial.angular_velocity.4", "there is no entry 4: the list has 3, numbered from 1"),
        (
            "initial.angular_velocity.x",
            "there is no entry named \"x\"; the 3 entries have no names; give a number from 1",
        ),
        ("spring", "`spring` is a list of 2 tables; name one of them and its key"),
        ("spring.boom", "`boom` is a table; name one of its keys"),
        ("material.rock", "`rock` is a table; name one of its keys"),
        ("material.rock.rheology", "`rheology` is a table; name one of its keys"),
        ("carrier.1", "there is no `1`; there is mass, inertia"),
    ] {
        assert_eq!(refused(path, 1.0), format!("`{path}`: {said}"));
    }
    for path in ["", ".", "a..b", "a b", "a.", "\"a", &"a.".repeat(600), &format!("a{}", ".a".repeat(20))] {
        assert!(refused(path, 1.0).contains("cannot be read"), "{path}: {}", refused(path, 1.0));
    }
}

#[test]
fn segment_at_fault_is_counted() {
    let error = changed(MODEL, &[("spring.bom.stiffness", 1.0.into())]).unwrap_err();
    assert!(matches!(error, ChangeError::Nowhere { segment: 1, .. }), "{error:?}");
}

#[test]
fn two_entries_of_one_name_need_a_number() {
    let text = "[[spring]]\nname = \"a\"\n[[spring]]\nname = \"a\"\n";
    let error = changed(text, &[("spring.a.stiffness", 1.0.into())]).unwrap_err();
    assert_eq!(
        error.to_string(),
        "`spring.a.stiffness`: entries 1 and 2 are both named \"a\"; give the number of one"
    );
    assert!(changed(text, &[("spring.2.stiffness", 1.0.into())]).is_ok());
}

#[test]
fn lists_of_inline_tables_and_dotted_keys_are_alike() {
    let text = "spring = [{ name = \"a\", stiffness = 1.0 }]\ncarrier.mass = 2.0\n";
    let both = changed(text, &[("spring.a.stiffness", 3.0.into()), ("carrier.mass", 4.0.into())]).unwrap();
    assert_eq!(both, "spring = [{ name = \"a\", stiffness = 3.0 }]\ncarrier.mass = 4.0\n");
}
