//! Orbits of central gravity that are no ellipses by their semi-major axis: flybys and tables of places. (F23), (F26)

use std::f64::consts::PI;

use quasirigid::model::force::{Conic, ForceLaw, Trajectory};
use quasirigid_io::model::Model;
use tempfile::TempDir;

use super::{CARRIER, POINT, read, refusal_of};

fn text(keys: &str) -> String {
    format!("[[force]]\nkind = \"central-gravity\"\norbit = {{ {keys} }}\n")
}

fn path(keys: &str) -> Trajectory {
    match read(&format!("{CARRIER}{POINT}{}", text(keys))).assembly.forces[0].law.clone() {
        ForceLaw::CentralGravity { orbit } => orbit,
        other => panic!("{other:?}"),
    }
}

fn conic(keys: &str) -> Conic {
    match path(keys) {
        Trajectory::Conic(conic) => conic,
        other => panic!("{other:?}"),
    }
}

fn refused(keys: &str) -> String {
    refusal_of(&text(keys))
}

const PERIAPSIS: &str = "body = \"Earth\", periapsis_distance = \"38000 km\"";
const MU: f64 = 3.986_004_418e14;

#[test]
fn flybys_are_read() {
    let turned = "inclination = \"90 deg\", node = 1, periapsis = \"-180 deg\", time_of_periapsis = \"2 d\"";
    let found = conic(&format!("{PERIAPSIS}, eccentricity = 4.25, {turned}"));
    let known = Conic {
        mu: MU,
        periapsis_distance: 3.8e7,
        eccentricity: 4.25,
        inclination: 0.5 * PI,
        raan: 1.0,
        argument_of_periapsis: -PI,
        time_of_periapsis: 172_800.0,
    };
    assert_eq!(found, known);
    // the speed far away, by the energy
    let fast = conic(&format!("{PERIAPSIS}, excess_speed = \"5.84 km/s\", time_of_periapsis = 0"));
    let energy = 0.5 * fast.greatest_speed().powi(2) - MU / 3.8e7;
    assert!((energy / (0.5 * 5840.0 * 5840.0) - 1.0).abs() < 1e-13, "{energy}");
    // a hyperbola by its negative axis and mean anomaly
    let far =
        conic("body = \"Earth\", semi_major_axis = \"-11860 km\", eccentricity = 4.23, mean_anomaly = -30");
    assert!((far.periapsis_distance / (1.186e7 * 3.23) - 1.0).abs() < 1e-15);
    let passed = 30.0 * (1.186e7f64.powi(3) / MU).sqrt();
    assert!((far.time_of_periapsis / passed - 1.0).abs() < 1e-14, "{}", far.time_of_periapsis);
    assert_eq!(conic(&format!("{PERIAPSIS}, eccentricity = 1, time_of_periapsis = 5")).eccentricity, 1.0);
}

/// An ellipse by its periapsis is that by its axis, unless it is narrow.
#[test]
fn ellipses_by_their_periapsis_are_read() {
    let Trajectory::Orbit(orbit) =
        path(&format!("{PERIAPSIS}, eccentricity = 0.6, time_of_periapsis = \"1 h\""))
    else {
        panic!("an ellipse")
    };
    assert!((orbit.semi_major_axis / 9.5e7 - 1.0).abs() < 1e-15);
    assert!((orbit.mean_anomaly + 3600.0 * (MU / 9.5e7f64.powi(3)).sqrt()).abs() < 1e-15);
    let narrow = conic(&format!("{PERIAPSIS}, eccentricity = 0.99999999, time_of_periapsis = \"1 h\""));
    assert_eq!((narrow.eccentricity, narrow.time_of_periapsis), (0.99999999, 3600.0));
}

#[test]
fn flybys_that_mean_nothing_are_refused() {
    for (keys, words) in [
        (format!("{PERIAPSIS}, time_of_periapsis = 1"), "has no `eccentricity`"),
        (format!("{PERIAPSIS}, eccentricity = 2"), "has no `time_of_periapsis`"),
        (
            format!("{PERIAPSIS}, eccentricity = 2, excess_speed = 1, time_of_periapsis = 1"),
            "gives the eccentricity already",
        ),
        (format!("{PERIAPSIS}, excess_speed = -1, time_of_periapsis = 1"), "`excess_speed`"),
        (
            format!("{PERIAPSIS}, semi_major_axis = -1, eccentricity = 2, time_of_periapsis = 1"),
            "give the semi-major axis already",
        ),
        (
            format!("{PERIAPSIS}, eccentricity = 2, mean_anomaly = 1, time_of_periapsis = 1"),
            "gives the mean anomaly already",
        ),
        (format!("{PERIAPSIS}, eccentricity = 1, mean_anomaly = 1"), "a parabola has no mean anomaly"),
        (
            format!("{PERIAPSIS}, eccentricity = 2, precession = \"J2\", time_of_periapsis = 1"),
            "is that of an ellipse",
        ),
        (
            "body = \"Earth\", periapsis_distance = 0, eccentricity = 2, time_of_periapsis = 1".into(),
            "positive",
        ),
        (
            "body = \"Earth\", semi_major_axis = \"-10000 km\", eccentricity = 0.5".into(),
            "no orbit of the eccentricity 0.5 has it",
        ),
        (
            "body = \"Earth\", semi_major_axis = \"10000 km\", eccentricity = 1.5, time_of_periapsis = 1"
                .into(),
            "no orbit of the eccentricity 1.5 has it",
        ),
    ] {
        let refusal = refused(&keys);
        assert!(refusal.contains(words), "{keys}\n{refusal}");
    }
    for (keys, words) in [
        (
            format!("{PERIAPSIS}, eccentricity = -0.1, time_of_periapsis = 1"),
            "no orbit has the eccentricity -0.1",
        ),
        (
            "body = \"Earth\", semi_major_axis = \"10000 km\", eccentricity = 1.5".into(),
            "no ellipse has the eccentricity 1.5",
        ),
    ] {
        let errors = read(&format!("{CARRIER}{POINT}{}", text(&keys))).assembly.check();
        assert!(errors.iter().any(|error| error.to_string().contains(words)), "{keys}: {errors:?}");
    }
}

/// Below the surface of a planet known by name, or of another by its radius; no radius is asked for.
#[test]
fn orbits_below_the_surface_are_refused() {
    let of = |body: &str, distance: &str, more: &str| {
        format!("{body}, periapsis_distance = {distance}, eccentricity = 3, time_of_periapsis = 1{more}")
    };
    let earth = "body = \"Earth\"";
    // kilometres without a unit
    let below = refused(&of(earth, "38000", ""));
    assert!(
        below.contains(
            "comes to 38.000000 km from the centre, below the surface, whose radius is 6371.008400 km"
        ),
        "{below}"
    );
    assert!(refused("body = \"Mars\", semi_major_axis = \"3000 km\"").contains("below the surface"));
    let other = "gravitational_parameter = 1e9";
    assert!(refused(&of(other, "\"3 km\"", ", planet_radius = \"4 km\"")).contains("radius is 4.000000 km"));
    conic(&of(other, "\"3 km\"", ""));
    conic(&of(other, "\"3 km\"", ", planet_radius = \"2 km\""));
    conic(&of(earth, "\"1000 km\"", ", planet_radius = 0"));
    let through_a_field = format!(
        "[[force]]\nkind = \"magnetic-dipole\"\nmoment = [0, 0, 1]\ndipole = [0, 0, 8e15]\norbit = {{ {} }}\n",
        of(earth, "\"38000 km\"", "")
    );
    let refusal = refusal_of(&through_a_field);
    assert!(refusal.contains("is that of an orbit under central gravity"), "{refusal}");
}

/// A path from a table `places.csv`, or the refusal.
fn tabled(csv: &str, more: &str) -> Result<Trajectory, String> {
    let folder = TempDir::new().unwrap();
    std::fs::write(folder.path().join("places.csv"), csv).unwrap();
    let keys = format!("body = \"Earth\", file = \"places.csv\"{more}");
    let model = format!("{CARRIER}{POINT}{}", text(&keys));
    match Model::parse(&folder.path().join("model.toml"), &model) {
        Ok(model) => match model.assembly.forces[0].law.clone() {
            ForceLaw::CentralGravity { orbit } => Ok(orbit),
            other => panic!("{other:?}"),
        },
        Err(error) => Err(error.to_string()),
    }
}

#[test]
fn tables_of_places_are_read() {
    let flyby =
        conic(&format!("{PERIAPSIS}, eccentricity = 4.25, inclination = 1, time_of_periapsis = \"1 h\""));
    let csv = |unit: f64, count: i32| {
        let row = |i: i32| {
            let t = 300.0 * f64::from(i);
            let [x, y, z] = flyby.at(t).place.map(|part: f64| part * unit);
            format!("{t},{x:e},{y:e},{z:e}\n")
        };
        format!("t,x,y,z\n{}", (0..count).map(row).collect::<String>())
    };
    let Ok(Trajectory::Table(table)) = tabled(&csv(1.0, 40), "") else { panic!("a table") };
    assert_eq!((table.times().len(), table.span(), table.mu()), (40, [0.0, 11_700.0], MU));
    let found: [f64; 3] = table.at(4444.0).place;
    let known: [f64; 3] = flyby.at(4444.0).place;
    assert!(found.iter().zip(known).all(|(a, b)| (a - b).abs() < 10.0), "{found:?} {known:?}");
    for (csv, more, words) in [
        (csv(1.0, 7), "", "it has 7 rows, and 8 or more are needed"),
        (csv(1e-3, 40), "", "below the surface"),
        (csv(1.0, 40), ", eccentricity = 2", "`eccentricity` beside the `file`"),
        (csv(1.0, 40), ", time_of_periapsis = 2", "`time_of_periapsis` beside the `file`"),
        (csv(1.0, 40).replace("t,x", "s,x"), "", "the first column is named \"s\""),
        (
            csv(1.0, 40).replace("t,x,y,z\n", "t,x,y,z\n300,1,2,3\n"),
            "",
            "row 2 is at 0 s, which is not after 300 s",
        ),
    ] {
        let refusal = tabled(&csv, more).unwrap_err();
        assert!(refusal.contains(words), "{refusal}");
    }
}
