//! Voxels with densities of their own: sums over cells, a closed form, the same body of several materials, and refusals.

use std::f64::consts::PI;
use std::fs;

use quasirigid_io::model::{Model, ModelError};
use tempfile::TempDir;

use super::same::assert_same;
use super::voxels::npy;
use super::{located, written};

const ROCK: &str = "[material.rock]\ndensity = 2500\nyoung = \"40 GPa\"\npoisson = 0.2\n";

/// A model of voxels in a NumPy array of doubles, whose three indices are along x, y, z.
fn of(sizes: [usize; 3], value: impl Fn([usize; 3]) -> f64, lines: &str) -> Result<Model, ModelError> {
    let places = (0..sizes[0] * sizes[1] * sizes[2])
        .map(|at| [at / (sizes[1] * sizes[2]), at / sizes[2] % sizes[1], at % sizes[2]]);
    let bytes: Vec<u8> = places.flat_map(|place| value(place).to_le_bytes()).collect();
    let folder = TempDir::new().expect("a folder");
    fs::write(folder.path().join("a.npy"), npy("<f8", sizes, &bytes)).expect("a file");
    let text = format!("{ROCK}[[solid]]\nname = \"s\"\nfile = \"a.npy\"\n{lines}");
    fs::write(folder.path().join("model.toml"), text).expect("a file");
    Model::read(&folder.path().join("model.toml"))
}

struct Whole {
    mass: f64,
    center: [f64; 3],
    inertia: [[f64; 3]; 3],
}

fn whole(model: &Model) -> Whole {
    let body = model.assembly.body().unwrap_or_else(|error| panic!("{}", model.diagnose(&error)));
    Whole { mass: body.invariants().mass, center: body.center_of_mass(), inertia: body.inertia() }
}

/// Mass, centre and inertia of voxels of three unequal sides are the sums over cells, each with the density of its grey value.
#[test]
fn the_inertia_is_the_sum_over_densities() {
    let (sizes, sides) = ([4, 3, 5], [2e-3, 3e-3, 0.5e-3]);
    let grey = |[i, j, k]: [usize; 3]| -900.0 + 137.0 * ((7 * i + 5 * j + 3 * k) % 19) as f64;
    let lines = "voxel = [\"2 mm\", \"3 mm\", \"0.5 mm\"]\nmaterial = \"rock\"\nthreshold = -600\n\
                 densities = [[-1000, 0], [0, \"1 g/cm^3\"], [1000, \"1600 kg/m^3\"]]\nposition = [0.1, -0.2, 0.05]\n";
    let model = of(sizes, grey, lines).unwrap_or_else(|error| panic!("{error}"));
    let found = whole(&model);
    let (mut mass, mut first, mut second, mut cells) = (0.0, [0.0; 3], [[0.0; 3]; 3], 0);
    for at in 0..60 {
        let place = [at / 15, at / 5 % 3, at % 5];
        let value = grey(place);
        if value < -600.0 {
            continue;
        }
        cells += 1;
        let density = if value < 0.0 { 1000.0 + value } else { 1000.0 + 0.6 * value };
        let own = density * sides.iter().product::<f64>();
        let center: [f64; 3] =
            std::array::from_fn(|k| [0.1, -0.2, 0.05][k] + (place[k] as f64 + 0.5) * sides[k]);
        mass += own;
        for i in 0..3 {
            first[i] += own * center[i];
            for j in 0..3 {
                let within = if i == j { sides[i] * sides[i] / 12.0 } else { 0.0 };
                second[i][j] += own * (center[i] * center[j] + within);
            }
        }
    }
    assert!((found.mass / mass - 1.0).abs() < 1e-12, "{} and not {mass}", found.mass);
    let center = first.map(|sum| sum / mass);
    for k in 0..3 {
        assert!((found.center[k] - center[k]).abs() < 1e-12, "{:?} and not {center:?}", found.center);
    }
    let about = |i: usize, j: usize| second[i][j] - mass * center[i] * center[j];
    let trace: f64 = (0..3).map(|i| about(i, i)).sum();
    for i in 0..3 {
        for j in 0..3 {
            let expected = if i == j { trace } else { 0.0 } - about(i, j);
            assert!((found.inertia[i][j] - expected).abs() < 1e-9 * trace, "{i}{j}");
        }
    }
    let notes = model.file_notes.join("\n");
    assert!(notes.contains(&format!("{cells} of 60 voxels")) && notes.contains("densities are "), "{notes}");
}

/// A ball of radius 1 mm whose density falls from `ρ₀` to `(1 − a) ρ₀` on its way out: `m = 4π ρ₀ R³ (1/3 − a/4)` and
/// `J = (8π/3) ρ₀ R⁵ (1/5 − a/6)`; cells on its rim have the share that is inside, by smaller cubes. Finer voxels come closer.
#[test]
fn a_ball_of_linear_density_has_its_inertia() {
    let (rho, fall, radius) = (3000.0, 0.6, 1e-3);
    let error = |count: usize| {
        let side = 2.0 / count as f64;
        let density = |place: [usize; 3]| {
            let parts = 4;
            let all = (0..parts * parts * parts).map(|part: usize| {
                let at = [part / 16, part / 4 % 4, part % 4];
                let square: f64 = (0..3)
                    .map(|k| (-1.0 + side * (place[k] as f64 + (at[k] as f64 + 0.5) / parts as f64)).powi(2))
                    .sum();
                if square < 1.0 { 1.0 - fall * square.sqrt() } else { 0.0 }
            });
            rho * all.sum::<f64>() / 64.0
        };
        let lines = format!("voxel = {:?}\nmaterial = \"rock\"\ndensities = \"kg/m^3\"\n", side * radius);
        let found = whole(&of([count; 3], density, &lines).unwrap_or_else(|error| panic!("{error}")));
        let mass = 4.0 * PI * rho * radius.powi(3) * (1.0 / 3.0 - fall / 4.0);
        let moment = 8.0 / 3.0 * PI * rho * radius.powi(5) * (0.2 - fall / 6.0);
        for k in 0..3 {
            assert!((found.center[k] - radius).abs() < 1e-12, "{:?}", found.center);
        }
        [found.mass / mass - 1.0, found.inertia[0][0] / moment - 1.0].map(f64::abs)
    };
    let (coarse, fine) = (error(5), error(11));
    assert!(fine[0] < 0.003 && fine[1] < 0.04, "{fine:?}");
    assert!(fine[1] < 0.3 * coarse[1], "{fine:?} after {coarse:?}");
}

/// Moduli that follow the square of the density are those of two materials.
#[test]
fn a_power_of_the_density_is_a_material_for_each() {
    let sizes = [5, 2, 2];
    let light = |[i, j, _]: [usize; 3]| (i + j) % 2 == 0;
    let lines = "voxel = \"1 cm\"\n[reduction]\nmodes = 4\n";
    let graded = format!("material = \"rock\"\ndensities = \"g/cm^3\"\nstiffness_exponent = 2\n{lines}");
    let graded = of(sizes, |place| if light(place) { 2.0 } else { 2.5 }, &graded);
    let two = "[material.soft]\ndensity = 2000\nyoung = \"25.6 GPa\"\npoisson = 0.2\n";
    let labels = format!("materials = {{ \"value=1\" = \"rock\", \"value=2\" = \"soft\" }}\n{lines}{two}");
    let labels = of(sizes, |place| if light(place) { 2.0 } else { 1.0 }, &labels);
    let [graded, labels] = [graded, labels].map(|model| model.unwrap_or_else(|error| panic!("{error}")));
    assert_same(&graded, &labels, 1e-9);
    let notes = graded.file_notes.join("\n");
    assert!(notes.contains("0.640000 to 1.000000 times"), "{notes}");
}

/// Densities that are none, a scale that is none, and densities of cells that are no voxels are refused in words.
#[test]
fn densities_that_are_none_are_refused() {
    let says = |lines: &str| {
        let lines = format!("voxel = 0.1\nmaterial = \"rock\"\n{lines}");
        located(&of([2, 1, 1], |[i, ..]| i as f64 - 0.5, &lines).expect_err("a refusal"))
    };
    let first = |text: String| text.lines().next().unwrap_or_default().to_owned();
    insta::assert_snapshot!(first(says("densities = \"kg/m^3\"\nthreshold = -1\n")), @"model.toml:7:8: `file`: a.npy: the voxel [0, 0, 0], whose value is -0.5, has a density of -0.5 kg/m³; raise `threshold`, or correct `densities`");
    insta::assert_snapshot!(first(says("densities = [[0, 1000]]\n")), @"model.toml:10:13: `densities` need two grey values or more, the least first");
    insta::assert_snapshot!(first(says("densities = [[1, 0], [0, 1000]]\n")), @"model.toml:10:13: `densities` need two grey values or more, the least first");
    insta::assert_snapshot!(first(says("densities = \"kg\"\n")), @r#"model.toml:10:13: `densities`: "kg" is not a decimal number with a unit"#);
    insta::assert_snapshot!(first(says("threshold = 0\nstiffness_exponent = 2\n")), @"model.toml:11:22: `stiffness_exponent` is a power of `densities`");
    insta::assert_snapshot!(first(says("densities = [[-0.5, 0.001], [0.5, 3000]]\nstiffness_exponent = 9\nthreshold = -1\n")), @"model.toml:11:22: the moduli of the voxels are 2.621e-58 to 5.160e0 times the material's");
    let cells = "*NODE\n1,0,0,0\n2,1,0,0\n3,0,1,0\n4,0,0,1\n*ELEMENT, TYPE=C3D4\n1,1,2,3,4\n";
    let text = format!(
        "{ROCK}[[solid]]\nname = \"s\"\nfile = \"a.inp\"\nmaterial = \"rock\"\ndensities = \"kg/m^3\"\n"
    );
    let error = written(&[("a.inp", cells.to_owned())], &text).expect_err("a refusal");
    insta::assert_snapshot!(first(located(&error)), @"model.toml:7:8: `file`: a.inp: `densities` are for voxels, and this is a mesh of cells; give its cells a `material`");
}
