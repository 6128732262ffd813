//! Internal coordinates and forces in the reduced equations: paper (2.14) and (3.1) to (3.4).

use crate::support::{MODEL, ROOT, Table, difference, folder_with, numbers, ran_in, ran_with};

const SPIN: [&str; 3] = ["wx", "wy", "wz"];

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

fn value(terms: &serde_json::Value, omega: [f64; 3]) -> Vec<f64> {
    let mut sum = Vec::new();
    for term in terms.as_array().unwrap() {
        let exponents: Vec<i32> = numbers(&term["exponents"]).iter().map(|e| *e as i32).collect();
        let monomial: f64 = (0..3).map(|axis| omega[axis].powi(exponents[axis])).product();
        let value = numbers(&term["value"]);
        sum.resize(value.len(), 0.0);
        sum.iter_mut().zip(value).for_each(|(sum, value)| *sum += monomial * value);
    }
    sum
}

/// The polynomials of `derive`, the columns of the reduced history, and the coordinates of the full system, which come from
/// three methods, agree to the order.
#[test]
fn displacements_of_derive_are_those_of_the_full_system() {
    let folder = folder_with(&format!("{BODY}[initial]\nangular_velocity = [0.6, 0.35, 0.5]\n"));
    let object = ran_in(folder.path(), "derive model.toml --json --order 5").json();
    let line = |system: &str| {
        let options = "--times 0,3,9 --coordinates --displacements --quiet --tolerance 1e-13 --order 5";
        let ran = ran_in(folder.path(), &format!("simulate model.toml --system {system} {options}"));
        assert_eq!(ran.code, Some(0), "{}", ran.stderr);
        Table::of(&ran.stdout)
    };
    let (full, reduced) = (line("full"), line("reduced"));
    assert_eq!(full.header, reduced.header);
    let coordinates: Vec<&str> =
        object["coordinates"].as_array().unwrap().iter().map(|c| c.as_str().unwrap()).collect();
    assert_eq!(coordinates.len(), 5);
    for row in 0..3 {
        let found = value(&object["displacements"], full.vector(SPIN, row));
        let all = |table: &Table, ending: &str| -> Vec<f64> {
            coordinates
                .iter()
                .map(|name| table.column(&format!("{}{ending}", name.replace('"', "")))[row])
                .collect()
        };
        let size = found.iter().fold(0.0_f64, |size, q| size.max(q.abs()));
        for (other, words) in [(all(&full, ""), "full"), (all(&reduced, ""), "reduced")] {
            for (q, other) in found.iter().zip(other) {
                assert!((q - other).abs() < 1e-6 * size, "{words}, row {row}: {q} {other}, largest {size}");
            }
        }
        for (a, b) in all(&full, " rate").iter().zip(all(&reduced, " rate")) {
            assert!((a - b).abs() < 1e-5 * size, "row {row}: rates {a} {b}");
        }
        for axis in ["x", "y", "z"] {
            assert_eq!(reduced.column(&format!("tip along {axis}")), reduced.column(&format!("tip {axis}")));
        }
    }
}

/// A reduced history under forces has its coordinates as well; rotors have speeds and no value.
#[test]
fn coordinates_under_forces_and_of_rotors() {
    let force = "[[force]]\nkind = \"drag\"\non = \"tip\"\ncoefficient = 0.4\n";
    let rotor = "[[rotor]]\nname = \"disk\"\naxis = [0, 1, 0]\ninertia = 0.2\nfriction = 3.0\n";
    let model =
        format!("{BODY}{force}{rotor}[initial]\nangular_velocity = [0.6, 0.35, 0.5]\nvelocity = [1, 0, 2]\n");
    let table = |system: &str| {
        let line =
            format!("simulate model.toml --system {system} --times 0,4 --coordinates --quiet --order 4");
        let ran = ran_with(&model, &line);
        assert_eq!(ran.code, Some(0), "{}", ran.stderr);
        Table::of(&ran.stdout)
    };
    let (full, reduced) = (table("full"), table("reduced"));
    for name in ["tip x", "tip y", "tip z"] {
        let (a, b) = (full.column(name)[1], reduced.column(name)[1]);
        assert!((a - b).abs() < 1e-3 * a.abs(), "{name}: {a} {b}");
    }
    let speeds: Vec<&String> = reduced.header.iter().filter(|name| name.starts_with("disk")).collect();
    assert!(speeds.len() == 1 && speeds[0].ends_with(" rate"), "{speeds:?}");
    let (a, b) = (full.column(speeds[0])[1], reduced.column(speeds[0])[1]);
    assert!((a - b).abs() < 1e-3 * a.abs(), "{a} {b}");
    let object = ran_with(&model, "derive model.toml --json").json();
    let omega = full.vector(SPIN, 0);
    assert_eq!((value(&object["displacements"], omega).len(), value(&object["rates"], omega).len()), (5, 1));
}

#[test]
fn text_lists_the_displacements() {
    let text = ran_with(MODEL, "derive model.toml").stdout;
    assert!(text.contains("internal coordinates\n  q1   tip x, m\n"), "{text}");
    assert!(text.contains("displacements q1 q2 q3, degree 3\n"), "{text}");
}

/// `J ω̇ + ω × Jω = M* + μ` with the left side from the first moments of the full system, for each kind of support: `M*` alone
/// misses it, `M* + μ` meets it to the order.
#[test]
fn forces_stand_in_derive_as_the_full_system_feels_them() {
    let forces = "[[force]]\nkind = \"uniform-gravity\"\nacceleration = [0.3, -0.2, -3.1]\n[[force]]\nname = \"tether\"\nkind = \"expression\"\non = \"tip\"\nforce = [\"-0.9*vx + 3*sin(0.5*t)\", \"-2*y*exp(-0.1*z^2)\", \"5*cos(0.3*x)\"]\n";
    let driven = "[support]\nkind = \"prescribed\"\npoint = [0.3, 0.1, -0.4]\nacceleration = [\"0.5*cos(0.9*t)\", \"0.3*t\", \"-0.4*sin(0.7*t+0.2)\"]\n";
    let fixed = "[support]\nkind = \"fixed-point\"\npoint = [0.3, 0.1, -0.4]\n";
    for support in ["", driven, fixed] {
        let initial = "[initial]\nangular_velocity = [0.6, 0.35, 0.5]\nattitude = [0.5, -0.5, 0.1, 0.7]\n";
        let folder = folder_with(&format!("{BODY}{forces}{support}{initial}"));
        let object = ran_in(folder.path(), "derive model.toml --json").json();
        let acting = &object["forces"];
        assert!(acting["names"].as_array().unwrap().iter().any(|name| name == "tether"));
        let h = 0.01;
        let list: Vec<String> = (0..7).map(|i| format!("{}", f64::from(i) * h)).collect();
        let line =
            format!("simulate model.toml --system full --quiet --tolerance 1e-13 --times {}", list.join(","));
        let ran = ran_in(folder.path(), &line);
        assert_eq!(ran.code, Some(0), "{}", ran.stderr);
        let table = Table::of(&ran.stdout);
        // forward difference of sixth order
        let weights = [-147.0, 360.0, -450.0, 400.0, -225.0, 72.0, -10.0].map(|w: f64| w / (60.0 * h));
        let rate: [f64; 3] =
            SPIN.map(|name| table.column(name).iter().zip(weights).map(|(w, c)| w * c).sum());
        let omega = table.vector(SPIN, 0);
        let J: Vec<V> = object["inertia"].as_array().unwrap().iter().map(three).collect();
        let (left, gyro) = (times(&J, rate), cross(omega, times(&J, omega)));
        let start = &acting["start"];
        let moment = three(&start["moment"]);
        let mu = three(&start["displaced"]["mu"]);
        let rest = [0, 1, 2].map(|i| left[i] + gyro[i] - moment[i]);
        let gap = difference(mu, rest);
        assert!(gap < 0.03, "{support:?}: mu {mu:?}, the full system {rest:?}, M* {moment:?}");
        let variation = three(&start["displaced"]["moment_variation"]);
        assert!(difference(variation, mu) > 0.03, "mu is more than M1*");
        let text = ran_in(folder.path(), "derive model.toml").stdout;
        for words in ["J w' + w x Jw = M* + mu", "M1* = sum r x F*", "Without the forces:", "tether"] {
            assert!(text.contains(words), "{words}:\n{text}");
        }
        assert_eq!(text.contains("m* R0'' = F* + phi"), support.is_empty());
    }
}

#[test]
fn what_derive_leaves_out_under_forces_is_said() {
    let drag = "[[force]]\nname = \"air\"\nkind = \"spin-drag\"\ncoefficient = 0.1\n";
    let rotor = "[[rotor]]\naxis = [0, 1, 0]\ninertia = 0.2\nfriction = 3.0\n";
    let start = "[initial]\nangular_velocity = [0.6, 0.35, 0.5]\n";
    let text = ran_with(&format!("{BODY}{drag}"), "derive model.toml").stdout;
    assert!(text.contains("the model has no initial one"), "{text}");
    let model = format!("{BODY}{drag}{rotor}{start}");
    let text = ran_with(&model, "derive model.toml").stdout;
    assert!(text.contains("the program has none in the paper's form") && text.contains("  M* "), "{text}");
    assert!(ran_with(&model, "derive model.toml --json").json()["forces"]["start"]["displaced"].is_null());
    assert!(ran_with(&format!("{BODY}{start}"), "derive model.toml --json").json()["forces"].is_null());
    let latex = ran_with(&model, "derive model.toml --format latex").stdout;
    assert!(latex.contains("M^\\ast + \\mu"), "{latex}");
}

/// `φ` of a body fixed at its centre of mass is that of the free body at the leading degrees; fixed elsewhere, it is not zero.
#[test]
fn a_held_body_has_the_force_of_its_displacements() {
    let fixed = |point: &str| format!("{BODY}[support]\nkind = \"fixed-point\"\npoint = {point}\n");
    let object = |model: &str| ran_with(model, "derive model.toml --json").json();
    let free = object(BODY);
    let center = &free["center_of_mass"];
    let held = object(&fixed(&center.to_string()));
    let omega = [0.7, -0.4, 1.1];
    let [a, b]: [[f64; 3]; 2] =
        [&held, &free].map(|object| value(&object["force"], omega).try_into().unwrap());
    assert!(difference(a, b) < 1e-9, "{a:?} {b:?}");
    let elsewhere = value(&object(&fixed("[0.3, 0.1, -0.4]"))["force"], omega);
    assert!(elsewhere.iter().all(|f| f.abs() > 1e-9), "{elsewhere:?}");
}

/// Paper, (1.3): `r_i = Σ H_ij q_j` with full matrices, as in the guide, against (2.14) written out here.
#[test]
fn a_coordinate_may_move_many_points() {
    let names = ["nodes.csv", "shapes.mtx", "masses.mtx", "stiffness.mtx", "damping.mtx"];
    let model = "[carrier]\nmass = 30.0\ncenter_of_mass = [0, 0, 0]\ninertia = [4, 5, 6]\n[[modes]]\nname = \"see-saw\"\nnodes = \"seesaw-nodes.csv\"\nshapes = \"seesaw-shapes.mtx\"\nmass = \"seesaw-masses.mtx\"\nstiffness = \"seesaw-stiffness.mtx\"\ndamping = \"seesaw-damping.mtx\"\n[initial]\nangular_velocity = [0.7, -0.4, 1.1]\n";
    let folder = folder_with(model);
    for name in names {
        let name = format!("seesaw-{name}");
        std::fs::copy(format!("{ROOT}/docs/guide/data/{name}"), folder.path().join(&name)).unwrap();
    }
    let object = ran_in(folder.path(), "derive model.toml --json").json();
    let masses = [0.5, 0.7];
    let pole = three(&object["pole"]);
    let J: Vec<V> = object["inertia"].as_array().unwrap().iter().map(three).collect();
    let from_pole = |place: V| along(place, -1.0, pole);
    let places = [from_pole([0.8, 0.1, 0.3]), from_pole([-0.8, 0.1, 0.3])];
    let shapes = [[1.0, -1.0], [1.0, 1.0]];
    let rate = |omega: V| over([J[0], J[1], J[2]], cross(times(&J, omega), omega));
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
    let table = ran_in(folder.path(), "simulate model.toml --times 0 --displacements --quiet").stdout;
    let table = Table::of(&table);
    for node in 0..2 {
        let of = |q: [f64; 2]| shapes[0][node] * q[0] + shapes[1][node] * q[1];
        let (found, expected) =
            (table.column(&format!("see-saw node {} along z", node + 1))[0], of(q) - of(lag));
        assert!((found - expected).abs() < 1e-7 * of(q).abs(), "{node}: {found} {expected}");
        assert!(of(lag).abs() > 1e-5 * of(q).abs(), "the damping shows");
    }
}

type V = [f64; 3];

fn three(value: &serde_json::Value) -> V {
    numbers(value).try_into().unwrap()
}

fn along(start: V, by: f64, direction: V) -> V {
    [0, 1, 2].map(|i| start[i] + by * direction[i])
}

fn cross(a: V, b: V) -> V {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

fn times(rows: &[V], v: V) -> V {
    [0, 1, 2].map(|i| rows[i].iter().zip(v).map(|(entry, v)| entry * v).sum())
}

/// Cramer's rule.
fn over([a, b, c]: [V; 3], v: V) -> V {
    let triple = |a: V, b: V, c: V| cross(a, b).iter().zip(c).map(|(x, y)| x * y).sum::<f64>();
    let columns = [0, 1, 2].map(|i| [a[i], b[i], c[i]]);
    let whole = triple(columns[0], columns[1], columns[2]);
    [triple(v, columns[1], columns[2]), triple(columns[0], v, columns[2]), triple(columns[0], columns[1], v)]
        .map(|x| x / whole)
}
