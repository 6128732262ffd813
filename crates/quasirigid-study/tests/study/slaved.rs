//! Internal coordinates and forces in the reduced equations: paper (2.14) and (3.1) to (3.4).

use quasirigid_io::model::System;
use quasirigid_math::vec3::cross;
use quasirigid_study::Study;
use quasirigid_study::histories::History;
use quasirigid_study::settings::PartialRun;
use serde_json::Value;

use crate::support::{
    MODEL, ROOT, SPIN, column, difference, fixed, history, numbers, of_order, rotor, spinning, study, table,
    vector, whole_table,
};

type V = [f64; 3];

const OMEGA: V = [0.6, 0.35, 0.5];

/// A point and an appendage off every axis, stiff against the spin.
const BODY: &str = r#"
[carrier]
mass = 40.0
center_of_mass = [0.02, 0.1, 0.4]
inertia = [[9.0, 0.2, 0.0], [0.2, 13.0, -0.4], [0.0, -0.4, 16.0]]
[[point]]
name = "tip"
mass = 1.2
position = [0.8, 0.3, 0.9]
[[spring]]
from = "tip"
to = "carrier"
stiffness = [5000.0, 7000.0, 6000.0]
damping = [60.0, 70.0, 50.0]
[[hinged]]
name = "boom"
mass = 0.8
center_of_mass = [-0.9, -0.4, 0.6]
inertia = [0.1, 0.12, 0.15]
hinge = [-0.4, -0.1, 0.4]
axes = [[0.2, 1, 0], [0, 0.3, 1]]
stiffness = [1500, 1800]
damping = [16, 17]
"#;

/// Values of coordinates in a row of a table, whose columns have no quotation marks.
fn coordinates(study: &Study, history: &History, ending: &str, row: usize) -> Vec<f64> {
    let names = study.body.coordinates()[..study.body.elastic()].iter();
    let column = |name: &str| column(&history.columns, &format!("{}{ending}", name.replace('"', "")))[row];
    names.map(|coordinate| column(&coordinate.name)).collect()
}

/// The polynomials of `derive`, the columns of the reduced history, and the coordinates of the full system, which come from
/// three methods, agree to the order.
#[test]
fn displacements_of_derive_are_those_of_the_full_system() {
    let study = of_order(&(BODY.to_owned() + &spinning(OMEGA)), 5);
    let equations = study.derive().unwrap();
    let tight = PartialRun { tolerance: Some(1e-13), ..PartialRun::default() };
    let [full, reduced] = [System::Full, System::Reduced]
        .map(|system| history(&study, &whole_table(system, &[0.0, 3.0, 9.0]), tight.clone()));
    assert!(full.holds() && reduced.holds(), "{} {}", full.message, reduced.message);
    let names = |history: &History| history.columns.iter().map(|each| each.name.clone()).collect::<Vec<_>>();
    assert_eq!(names(&full), names(&reduced));
    assert_eq!(study.body.elastic(), 5);
    for row in 0..3 {
        let found = equations.reduced().q.value(vector(&full.columns, SPIN, row));
        let size = found.iter().fold(0.0_f64, |size, q| size.max(q.abs()));
        for (history, words) in [(&full, "full"), (&reduced, "reduced")] {
            for (q, other) in found.iter().zip(coordinates(&study, history, "", row)) {
                assert!((q - other).abs() < 1e-6 * size, "{words}, row {row}: {q} {other}, largest {size}");
            }
        }
        let rates = [&full, &reduced].map(|history| coordinates(&study, history, " rate", row));
        for (a, b) in rates[0].iter().zip(&rates[1]) {
            assert!((a - b).abs() < 1e-5 * size, "row {row}: rates {a} {b}");
        }
    }
    for axis in ["x", "y", "z"] {
        let [along, alone] = [format!("tip along {axis}"), format!("tip {axis}")];
        assert_eq!(column(&reduced.columns, &along), column(&reduced.columns, &alone));
    }
}

/// A reduced history under forces has its coordinates as well; rotors have speeds and no value.
#[test]
fn coordinates_under_forces_and_of_rotors() {
    let drag = "[[force]]\nkind = \"drag\"\non = \"tip\"\ncoefficient = 0.4\n";
    let rotor = rotor("disk", [0.0, 1.0, 0.0], 0.2, 3.0);
    let model = format!("{BODY}{drag}{rotor}{}velocity = [1, 0, 2]\n", spinning(OMEGA));
    let study = of_order(&model, 4);
    let [full, reduced] = [System::Full, System::Reduced].map(|system| {
        let found = history(&study, &whole_table(system, &[0.0, 4.0]), PartialRun::default());
        assert!(found.holds(), "{}", found.message);
        found.columns
    });
    let disk: Vec<&str> =
        reduced.iter().map(|column| &*column.name).filter(|name| name.starts_with("disk")).collect();
    assert!(disk.len() == 1 && disk[0].ends_with(" rate"), "{disk:?}");
    for name in ["tip x", "tip y", "tip z", disk[0]] {
        let [a, b] = [&full, &reduced].map(|columns| column(columns, name)[1]);
        assert!((a - b).abs() < 1e-3 * a.abs(), "{name}: {a} {b}");
    }
    let object: Value = serde_json::from_str(&of_order(&model, None).derive().unwrap().json()).unwrap();
    let rows = |key: &str| object[key][0]["value"].as_array().unwrap().len();
    assert_eq!((rows("displacements"), rows("rates")), (5, 1));
}

#[test]
fn text_lists_the_displacements() {
    let text = study(MODEL).derive().unwrap().text();
    assert!(text.contains("internal coordinates\n  q1   tip x, m\n"), "{text}");
    assert!(text.contains("displacements q1 q2 q3, degree 3\n"), "{text}");
}

/// `J ω̇ + ω × Jω = M* + μ` with the left side from the first moments of the full system, for each kind of support: `M*` alone
/// misses it, `M* + μ` meets it to the order.
#[test]
fn forces_stand_in_derive_as_the_full_system_feels_them() {
    let forces = "[[force]]\nkind = \"uniform-gravity\"\nacceleration = [0.3, -0.2, -3.1]\n[[force]]\nname = \"tether\"\nkind = \"expression\"\non = \"tip\"\nforce = [\"-0.9*vx + 3*sin(0.5*t)\", \"-2*y*exp(-0.1*z^2)\", \"5*cos(0.3*x)\"]\n";
    let driven = "[support]\nkind = \"prescribed\"\npoint = [0.3, 0.1, -0.4]\nacceleration = [\"0.5*cos(0.9*t)\", \"0.3*t\", \"-0.4*sin(0.7*t+0.2)\"]\n";
    for support in ["", driven, &fixed([0.3, 0.1, -0.4])] {
        let start = spinning(OMEGA) + "attitude = [0.5, -0.5, 0.1, 0.7]\n";
        let study = study(&format!("{BODY}{forces}{support}{start}"));
        let equations = study.derive().unwrap();
        let object: Value = serde_json::from_str(&equations.json()).unwrap();
        let acting = &object["forces"];
        assert!(acting["names"].as_array().unwrap().iter().any(|name| name == "tether"));
        let h = 0.01;
        let times: Vec<f64> = (0..7).map(|i| f64::from(i) * h).collect();
        let tight = PartialRun { tolerance: Some(1e-13), ..PartialRun::default() };
        let full = history(&study, &table(System::Full, &times), tight);
        assert!(full.holds(), "{}", full.message);
        // forward difference of sixth order
        let weights = [-147.0, 360.0, -450.0, 400.0, -225.0, 72.0, -10.0].map(|w: f64| w / (60.0 * h));
        let rate: V =
            SPIN.map(|name| column(&full.columns, name).iter().zip(weights).map(|(w, c)| w * c).sum());
        let omega = vector(&full.columns, SPIN, 0);
        let J = study.body.inertia();
        let (left, gyro) = (times_vector(J, rate), cross(omega, times_vector(J, omega)));
        let three = |value: &Value| -> V { numbers(value).try_into().unwrap() };
        let (moment, displaced) = (three(&acting["start"]["moment"]), &acting["start"]["displaced"]);
        let mu = three(&displaced["mu"]);
        let rest = [0, 1, 2].map(|i| left[i] + gyro[i] - moment[i]);
        let gap = difference(mu, rest);
        assert!(gap < 0.03, "{support:?}: mu {mu:?}, the full system {rest:?}, M* {moment:?}");
        assert!(difference(three(&displaced["moment_variation"]), mu) > 0.03, "mu is more than M1*");
        let text = equations.text();
        for words in ["J w' + w x Jw = M* + mu", "M1* = sum r x F*", "Without the forces:", "tether"] {
            assert!(text.contains(words), "{words}:\n{text}");
        }
        assert_eq!(text.contains("m* R0'' = F* + phi"), support.is_empty());
    }
}

#[test]
fn what_derive_leaves_out_under_forces_is_said() {
    let drag = "[[force]]\nname = \"air\"\nkind = \"spin-drag\"\ncoefficient = 0.1\n";
    let rotor = rotor("disk", [0.0, 1.0, 0.0], 0.2, 3.0);
    let start = spinning(OMEGA);
    let object = |study: &Study| -> Value { serde_json::from_str(&study.derive().unwrap().json()).unwrap() };
    let text = study(&format!("{BODY}{drag}")).derive().unwrap().text();
    assert!(text.contains("the model has no initial state"), "{text}");
    let loaded = study(&format!("{BODY}{drag}{rotor}{start}"));
    let equations = loaded.derive().unwrap();
    let text = equations.text();
    assert!(text.contains("the program has none in the paper's form") && text.contains("  M* "), "{text}");
    assert!(object(&loaded)["forces"]["start"]["displaced"].is_null());
    assert!(object(&study(&format!("{BODY}{start}")))["forces"].is_null());
    assert!(equations.latex().contains("M^\\ast + \\mu"), "{}", equations.latex());
}

/// `φ` of a body fixed at its centre of mass is that of the free body at the leading degrees; fixed elsewhere, it is not zero.
#[test]
fn a_held_body_has_the_force_of_its_displacements() {
    let free = study(BODY);
    let force = |study: &Study| -> V {
        study.derive().unwrap().reduced().phi.value([0.7, -0.4, 1.1]).try_into().unwrap()
    };
    let held = |point: V| force(&study(&format!("{BODY}{}", fixed(point))));
    let [a, b] = [held(free.body.center_of_mass()), force(&free)];
    assert!(difference(a, b) < 1e-9, "{a:?} {b:?}");
    let elsewhere = held([0.3, 0.1, -0.4]);
    assert!(elsewhere.iter().all(|f| f.abs() > 1e-9), "{elsewhere:?}");
}

/// Paper, (1.3): `r_i = Σ H_ij q_j` with full matrices, as in the guide, against (2.14) written out here.
#[test]
fn a_coordinate_may_move_many_points() {
    let model = "[carrier]\nmass = 30.0\ncenter_of_mass = [0, 0, 0]\ninertia = [4, 5, 6]\n[[modes]]\nname = \"see-saw\"\nnodes = \"seesaw-nodes.csv\"\nshapes = \"seesaw-shapes.mtx\"\nmass = \"seesaw-masses.mtx\"\nstiffness = \"seesaw-stiffness.mtx\"\ndamping = \"seesaw-damping.mtx\"\n[initial]\nangular_velocity = [0.7, -0.4, 1.1]\n";
    let beside = format!("{ROOT}/docs/guide/data/model.toml");
    let study = Study::read_from(beside.as_ref(), model.as_bytes(), None).unwrap();
    let masses = [0.5, 0.7];
    let (pole, J) = (study.body.pole(), study.body.inertia());
    let from_pole = |place: V| along(place, -1.0, pole);
    let places = [from_pole([0.8, 0.1, 0.3]), from_pole([-0.8, 0.1, 0.3])];
    let shapes = [[1.0, -1.0], [1.0, 1.0]];
    let rate = |omega: V| over(J, cross(times_vector(J, omega), omega));
    // every point moves along z
    let load = |omega: V| {
        [0, 1].map(|j| {
            let inertia = |i: usize| {
                let (turn, rho) = (rate(omega), places[i]);
                cross(omega, cross(omega, rho))[2] + cross(turn, rho)[2]
            };
            -(0..2).map(|i| masses[i] * shapes[j][i] * inertia(i)).sum::<f64>()
        })
    };
    let solved = |[x, y]: [f64; 2]| {
        let determinant = 300.0 * 500.0 - 40.0 * 40.0;
        [(500.0 * x - 40.0 * y) / determinant, (300.0 * y - 40.0 * x) / determinant]
    };
    let omega = [0.7, -0.4, 1.1];
    let h = 1e-4;
    let [after, before] = [h, -h].map(|h| load(along(omega, h, rate(omega))));
    let lag = solved([0, 1].map(|j| (after[j] - before[j]) / (2.0 * h)));
    let lag = solved([6.0 * lag[0] + lag[1], lag[0] + 8.0 * lag[1]]);
    let q = solved(load(omega));
    let columns = history(&study, &whole_table(System::Reduced, &[0.0]), PartialRun::default()).columns;
    for node in 0..2 {
        let of = |q: [f64; 2]| shapes[0][node] * q[0] + shapes[1][node] * q[1];
        let found = column(&columns, &format!("see-saw node {} along z", node + 1))[0];
        let expected = of(q) - of(lag);
        assert!((found - expected).abs() < 1e-7 * of(q).abs(), "{node}: {found} {expected}");
        assert!(of(lag).abs() > 1e-5 * of(q).abs(), "the damping shows");
    }
}

fn along(start: V, by: f64, direction: V) -> V {
    [0, 1, 2].map(|i| start[i] + by * direction[i])
}

fn times_vector(rows: [V; 3], v: V) -> V {
    rows.map(|row| row.iter().zip(v).map(|(entry, v)| entry * v).sum())
}

/// Cramer's rule.
fn over([a, b, c]: [V; 3], v: V) -> V {
    let triple = |a: V, b: V, c: V| cross(a, b).iter().zip(c).map(|(x, y)| x * y).sum::<f64>();
    let columns = [0, 1, 2].map(|i| [a[i], b[i], c[i]]);
    let whole = triple(columns[0], columns[1], columns[2]);
    [triple(v, columns[1], columns[2]), triple(columns[0], v, columns[2]), triple(columns[0], columns[1], v)]
        .map(|x| x / whole)
}
