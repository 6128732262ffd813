//! Laminated solids of NASTRAN and materials that are not the same in every direction: the same body as its plies meshed one by one.

use quasirigid_io::model::Model;

use super::same::assert_same;
use super::{located, written};

const MODEL: &str = "[[deck]]\nname = \"d\"\nfile = \"a.bdf\"\nlength_unit = \"mm\"\nmass_unit = \"t\"\n[reduction]\nmodes = 6\n";

fn read(deck: &str) -> Model {
    written(&[("a.bdf", deck.to_owned())], MODEL).unwrap_or_else(|error| panic!("{error}"))
}

/// Corner of a skewed grid of 3 by 2 by 5 levels; cells are leaning, so that nothing is along an axis.
fn place(i: usize, j: usize, level: f64) -> [f64; 3] {
    let (x, y) = (10.0 * i as f64, 12.0 * j as f64);
    [x + 0.3 * y + 0.4 * level, y - 0.05 * x, level * (1.0 + 0.01 * x)]
}

const LEVELS: [f64; 4] = [0.0, 1.5, 4.5, 6.0];

fn number(i: usize, j: usize, level: usize) -> usize {
    1 + i + 3 * j + 6 * level
}

fn grids(levels: &[usize]) -> String {
    let mut text = String::new();
    for level in levels {
        for j in 0..2 {
            for i in 0..3 {
                let [x, y, z] = place(i, j, LEVELS[*level]);
                text += &format!("GRID,{},,{x:.9},{y:.9},{z:.9}\n", number(i, j, *level));
            }
        }
    }
    text
}

const MATERIALS: &str =
    "MAT11,1,130000.,9800.,8000.,0.3,0.25,0.4,5600.\n,5000.,3700.,1.6-9\nMAT1,2,70000.,,0.3,2.7-9\n";
/// A system turned about z, in which the fibres count from x.
const SYSTEM: &str = "CORD2R,7,,0.,0.,0.,0.,0.,1.\n,0.8,0.6,0.\n";
const PCOMPS: &str = "PCOMPS,5,7,13\n,1,1,0.75,30.\n,2,2,1.5,0.\n,3,1,0.75,-60.\n";

/// Corners of a hexahedron between two levels.
fn corners(i: usize, low: usize, high: usize) -> Vec<usize> {
    let face = |level: usize| {
        [number(i, 0, level), number(i + 1, 0, level), number(i + 1, 1, level), number(i, 1, level)]
    };
    [face(low), face(high)].concat()
}

fn card(name: &str, label: usize, property: usize, nodes: &[usize]) -> String {
    let nodes: Vec<String> = nodes.iter().map(ToString::to_string).collect();
    let (first, rest) = nodes.split_at(nodes.len().min(6));
    format!("{name},{label},{property},{}\n,{}\n", first.join(","), rest.join(","))
}

/// Axes of the plies meshed one by one: a system for each angle, of each cell, whose normals differ.
fn meshed(order: impl Fn(usize, usize) -> Vec<usize>) -> String {
    let mut text = format!("BEGIN BULK\n{}{MATERIALS}", grids(&[0, 1, 2, 3]));
    for i in 0..2 {
        let at = |k: usize, level: f64| place(i + [0, 1, 1, 0][k], [0, 0, 1, 1][k], level);
        let half = |k: usize| [0, 1, 2].map(|axis| 0.5 * (at(k, 0.0)[axis] + at(k, 6.0)[axis]));
        let side = |a: usize, b: usize| [0, 1, 2].map(|axis| half(b)[axis] - half(a)[axis]);
        let unit = |v: [f64; 3]| v.map(|x| x / v.iter().map(|x| x * x).sum::<f64>().sqrt());
        let cross = |a: [f64; 3], b: [f64; 3]| {
            [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
        };
        let normal = unit(cross(side(0, 2), side(1, 3)));
        let along: f64 = [0.8, 0.6, 0.0].iter().zip(normal).map(|(a, b)| a * b).sum();
        let x = unit([0.8 - along * normal[0], 0.6 - along * normal[1], -along * normal[2]]);
        let y = cross(normal, x);
        for (ply, (angle, material)) in [(30.0_f64, 1), (0.0, 2), (-60.0, 1)].into_iter().enumerate() {
            let (sin, cos) = angle.to_radians().sin_cos();
            let own: Vec<f64> = (0..3).map(|axis| cos * x[axis] + sin * y[axis]).collect();
            let label = 10 * (i + 1) + ply;
            let [nx, ny, nz] = normal;
            text += &format!(
                "CORD2R,{label},,0.,0.,0.,{nx:.12},{ny:.12},{nz:.12}\n,{:.12},{:.12},{:.12}\nPSOLID,{label},{material},{label}\n",
                own[0], own[1], own[2]
            );
            text += &card("CHEXA", label, label, &order(i, ply));
        }
    }
    text + "ENDDATA\n"
}

fn laminated(order: impl Fn(Vec<usize>) -> Vec<usize>) -> String {
    let mut text = format!("BEGIN BULK\n{}{MATERIALS}{SYSTEM}{PCOMPS}", grids(&[0, 3]));
    for i in 0..2 {
        text += &card("CHEXA", i + 1, 5, &order(corners(i, 0, 3)));
    }
    text + "ENDDATA\n"
}

/// Whichever way its corners are numbered, a laminate is its plies from the bottom of the stack, stretched to the thickness.
#[test]
fn a_laminated_solid_is_its_plies() {
    let expected = read(&meshed(|i, ply| corners(i, ply, ply + 1)));
    let orders: [fn(Vec<usize>) -> Vec<usize>; 5] = [
        |c| c,
        // on its side, and upside down
        |c| [0, 3, 7, 4, 1, 2, 6, 5].map(|at| c[at]).to_vec(),
        |c| [4, 7, 6, 5, 0, 3, 2, 1].map(|at| c[at]).to_vec(),
        |c| [1, 0, 4, 5, 2, 3, 7, 6].map(|at| c[at]).to_vec(),
        // inside out
        |c| [4, 5, 6, 7, 0, 1, 2, 3].map(|at| c[at]).to_vec(),
    ];
    for order in orders {
        let found = read(&laminated(order));
        assert_same(&found, &expected, 1e-7);
        let notes = found.file_notes.join("\n");
        assert!(
            notes.contains("divided into a cell for each ply (2)") && notes.contains("stretched"),
            "{notes}"
        );
    }
}

/// The plies of two wedges are those of the wedges meshed one by one, and a stack along another axis of the system is the same stack.
#[test]
fn laminated_wedges_and_turned_systems_are_the_same() {
    let wedges = |low: usize, high: usize| {
        [[0, 1, 3], [1, 2, 3]].map(|three| {
            let c = corners(0, low, high);
            three.iter().map(|at| c[*at]).chain(three.iter().map(|at| c[*at + 4])).collect::<Vec<_>>()
        })
    };
    let head = |levels: &[usize]| {
        format!("BEGIN BULK\n{}MAT1,2,70000.,,0.3,2.7-9\nMAT1,3,7000.,,0.2,1.2-9\n", grids(levels))
    };
    let mut plies = format!("{}PSOLID,1,2\nPSOLID,2,3\nPSOLID,3,2\n", head(&[0, 1, 2, 3]));
    let mut whole = format!("{}PCOMPS,5\n,1,2,1.5\n,2,3,3.\n,3,2,1.5\n", head(&[0, 3]));
    for (at, nodes) in wedges(0, 3).iter().enumerate() {
        whole += &card("CPENTA", at + 1, 5, nodes);
        for ply in 0..3 {
            plies += &card("CPENTA", 10 * (at + 1) + ply, ply + 1, &wedges(ply, ply + 1)[at]);
        }
    }
    assert_same(&read(&(whole + "ENDDATA\n")), &read(&(plies + "ENDDATA\n")), 1e-6);
    // axes 3, 1, 2 of a system in place of 1, 2, 3
    let turned = laminated(|c| c)
        .replace(SYSTEM, "CORD2R,7,,0.,0.,0.,0.8,0.6,0.\n,-0.6,0.8,0.\n")
        .replace("PCOMPS,5,7,13", "PCOMPS,5,7,32");
    assert_same(&read(&turned), &read(&laminated(|c| c)), 1e-9);
}

/// One material by MAT11, MATORT and MAT9, whose moduli are the inverse of the compliances.
#[test]
fn a_material_is_the_same_on_each_card() {
    let (e, nu, g) = ([130_000.0, 9800.0, 8000.0], [0.3, 0.25, 0.4], [5600.0, 5000.0, 3700.0]);
    let s = inverse([
        [1.0 / e[0], -nu[0] / e[0], -nu[1] / e[0]],
        [-nu[0] / e[0], 1.0 / e[1], -nu[2] / e[1]],
        [-nu[1] / e[0], -nu[2] / e[1], 1.0 / e[2]],
    ]);
    let field = |x: f64| format!("{x:.10E}");
    let mat9 = format!(
        "MAT9,1,{},{},{},,,,{}\n,{},,,,{},,,\n,{},,,{},,{},1.6-9\n",
        field(s[0][0]),
        field(s[0][1]),
        field(s[0][2]),
        field(s[1][1]),
        field(s[1][2]),
        field(s[2][2]),
        field(g[0]),
        field(g[2]),
        field(g[1])
    );
    let ort =
        format!("MATORT,1,130000.,9800.,8000.,0.3,0.4,{},1.6-9\n,5600.,3700.,5000.\n", 0.25 * e[2] / e[0]);
    let deck = |material: &str| {
        let grids = grids(&[0, 3]);
        format!(
            "BEGIN BULK\n{grids}{material}{SYSTEM}PSOLID,5,1,7\n{}ENDDATA\n",
            card("CHEXA", 1, 5, &corners(0, 0, 3))
        )
    };
    let expected = read(&deck("MAT11,1,130000.,9800.,8000.,0.3,0.25,0.4,5600.\n,5000.,3700.,1.6-9\n"));
    assert_same(&read(&deck(&mat9)), &expected, 1e-7);
    assert_same(&read(&deck(&ort)), &expected, 1e-7);
    let coupled = deck(&mat9.replace(",,,,", ",500.,,,"));
    let error = written(&[("a.bdf", coupled)], MODEL).expect_err("a refusal");
    insta::assert_snapshot!(located(&error).lines().next().unwrap_or_default(), @"model.toml:3:8: `file`: a.bdf:14: the material 1 has no three planes of symmetry in its axes; turn CORDM to them, or give MAT11");
}

fn inverse(a: [[f64; 3]; 3]) -> [[f64; 3]; 3] {
    let minor = |i: usize, j: usize| {
        let [p, q, r, s] = [(i + 1) % 3, (i + 2) % 3, (j + 1) % 3, (j + 2) % 3];
        a[p][r] * a[q][s] - a[p][s] * a[q][r]
    };
    let whole: f64 = (0..3).map(|j| a[0][j] * minor(0, j)).sum();
    std::array::from_fn(|i| std::array::from_fn(|j| minor(j, i) / whole))
}

/// Beside an undivided solid, the points between plies follow their edge: a laminate of one material is then that material's own solid when all
/// of its edges are such.
#[test]
fn a_laminate_beside_another_solid_is_tied_to_it() {
    let deck = |property: &str, second: usize| {
        let mut text =
            format!("BEGIN BULK\n{}MAT1,2,70000.,,0.3,2.7-9\nPSOLID,4,2\n{property}", grids(&[0, 3]));
        text += &card("CHEXA", 1, 4, &corners(0, 0, 3));
        text += &card("CHEXA", 2, second, &corners(1, 0, 3));
        text + "ENDDATA\n"
    };
    let tied = read(&deck("PCOMPS,5\n,1,2,2.\n,2,2,4.\n", 5));
    let notes = tied.file_notes.join("\n");
    assert!(
        notes.contains("points between plies follow the ends of an edge that another cell has undivided (2)"),
        "{notes}"
    );
    let plain = read(&deck("", 4));
    let [a, b] = [&tied, &plain].map(|model| model.assembly.body().unwrap());
    assert!((a.invariants().mass / b.invariants().mass - 1.0).abs() < 1e-12);
    let [a, b] = [a, b].map(|body| quasirigid::reduction::frequencies(&body).unwrap());
    // plies have more motions, and the points between them fewer
    assert!((a[0] / b[0] - 1.0).abs() < 0.05, "{a:?} {b:?}");
    let refused = deck("PCOMPS,5,0,31\n,1,2,2.\n", 5);
    let error = written(
        &[(
            "a.bdf",
            refused.replace(
                &card("CHEXA", 2, 5, &corners(1, 0, 3)),
                &format!(
                    "CTETRA,2,5,{},{},{},{}\n",
                    number(1, 0, 0),
                    number(2, 0, 0),
                    number(2, 1, 0),
                    number(1, 0, 3)
                ),
            ),
        )],
        MODEL,
    )
    .expect_err("a refusal");
    insta::assert_snapshot!(located(&error).lines().next().unwrap_or_default(), @"model.toml:3:8: `file`: a.bdf:20: the laminated solid 2 is no CHEXA of 8 or CPENTA of 6 points with edges along the stack; mesh its plies, or correct PSDIR and CORDM of PCOMPS");
}
