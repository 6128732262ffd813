//! `[[appendage]]` from files of NASTRAN: `MEFFMASS` in OUTPUT2 and in a print, and external superelements in OUTPUT4 and as DMIG cards.

use std::fmt::Write;
use std::fs;
use std::path::{Path, PathBuf};

use quasirigid::elements::{Appendage, InertiaPoint};
use quasirigid_io::matrix::read_matrix;
use quasirigid_io::model::{Model, ModelError};
use tempfile::TempDir;

use super::{CARRIER, located};

fn data(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/data/sheets").join(name)
}

/// A model with an appendage of these files, which lie beside it.
fn of(files: &[(&str, Vec<u8>)], lines: &str) -> Result<Model, ModelError> {
    let folder = TempDir::new().expect("a folder");
    for (name, bytes) in files {
        fs::write(folder.path().join(name), bytes).expect("a file");
    }
    let text = format!("{CARRIER}[[appendage]]\nname = \"wing\"\nat = [1, 0, 0]\n{lines}");
    fs::write(folder.path().join("model.toml"), text).expect("a file");
    Model::read(&folder.path().join("model.toml"))
}

fn appendage(files: &[(&str, Vec<u8>)], lines: &str) -> (Appendage, String) {
    let model = of(files, lines).unwrap_or_else(|error| panic!("{error}"));
    assert_eq!(model.assembly.check(), []);
    (model.assembly.appendages[0].clone(), model.file_notes.join("\n"))
}

#[track_caller]
fn close(found: f64, expected: f64, tolerance: f64) {
    assert!((found - expected).abs() <= tolerance * expected.abs().max(1e-12), "{found} and not {expected}");
}

/// Sums over the modes of squares of participation factors, in the units of NASTRAN.
fn effective(appendage: &Appendage) -> [f64; 6] {
    let mut sums = [0.0; 6];
    for mode in &appendage.modes {
        for axis in 0..3 {
            sums[axis] += mode.translation[axis].powi(2);
            sums[3 + axis] += mode.rotation[axis].powi(2);
        }
    }
    sums
}

/// Masses, sums of effective masses and frequencies that NX Nastran printed beside (EFMASSS and LAMA of the same file, millimetres).
#[test]
fn effective_masses_in_output2_are_an_appendage() {
    let bytes = fs::read(data("meffmass.op2")).expect("a file");
    let lines = "file = \"a.op2\"\nlength_unit = \"mm\"\nmass_unit = \"t\"\ndamping_ratio = 0.01\n";
    let (found, notes) = appendage(&[("a.op2", bytes)], lines);
    close(found.mass, 5076.65, 1e-6);
    close(found.center_of_mass[0], 0.504_258 / 5.076_65 * 1.0, 1e-5);
    assert_eq!(found.inertia_about, InertiaPoint::Interface);
    for (axis, moment) in [0.0, 50.2915, 50.2915].into_iter().enumerate() {
        close(found.inertia[axis][axis], moment, 1e-5);
    }
    let hertz: Vec<f64> = found.modes.iter().map(|mode| mode.frequency / std::f64::consts::TAU).collect();
    for (found, expected) in hertz.iter().zip([89.560_745, 89.560_745, 1_044.759_64]) {
        close(*found, expected, 1e-6);
    }
    let sums = effective(&found);
    for (axis, expected) in [5056.30, 5043.89, 5043.89, 0.0, 50.2758, 50.2758].into_iter().enumerate() {
        assert!((sums[axis] - expected).abs() < 2e-6 * expected.max(1.0), "{axis}: {sums:?}");
    }
    // the sign that effective masses have lost: both modes turn about the base as they move across it
    for mode in &found.modes[..2] {
        let [_, y, z] = mode.translation;
        let [_, about_y, about_z] = mode.rotation;
        close(about_y / z, -0.099_838, 1e-4);
        close(about_z / y, 0.099_838, 1e-4);
        assert!((mode.damping_ratio - 0.01).abs() < 1e-15);
    }
    assert!(notes.contains("3 modes from 89.5607 Hz to 1044.7596 Hz"), "{notes}");
}

/// Tables as NX Nastran prints them, over two pages.
fn printed() -> String {
    let rigid = [
        "7.181204E+03 -9.947598E-13  3.552714E-15  2.095476E-09  1.628356E+07 -2.614887E+06",
        "-1.003614E-12  7.181204E+03 -2.664535E-14 -1.628356E+07 -1.789886E-09  2.294775E+05",
        "2.384281E-16 -3.117832E-14  7.181204E+03  2.614887E+06 -2.294775E+05  1.879708E-12",
        "1.780939E-09 -1.628356E+07  2.614887E+06  6.411031E+10 -3.117642E+08 -8.042679E+08",
        "1.628356E+07 -1.714506E-09 -2.294775E+05 -3.117642E+08  6.161225E+10 -7.747655E+09",
        "-2.614887E+06  2.294775E+05  7.283063E-13 -8.042679E+08 -7.747655E+09  1.019988E+10",
    ];
    let rigid: String = rigid.iter().map(|row| format!("                       *   {row} *\n")).collect();
    let page = "1                                  FEBRUARY   8, 2021  NX NASTRAN  5/ 5/15   PAGE    71\n\n";
    let heading = "    MODE     FREQUENCY               T1                T2                T3                R1                R2                R3\n     NO.\n\n";
    let fractions = "       1    1.774807E+00      5.767404E-01      5.767404E-01      3.274221E-04      3.274221E-04      9.995426E-07      9.995426E-07\n";
    format!(
        "{page}                                                     A-SET RIGID BODY MASS MATRIX\n                       ***      ***\n{rigid}\
         {page}                                                    MODAL EFFECTIVE MASS FRACTION\n\n{fractions}{page}\
                                                              MODAL PARTICIPATION FACTORS\n\n{heading}\
         \x20      1    1.774807E+00     -6.435597E+01      1.533390E+00      8.472260E-02     -4.848222E+03     -1.547691E+05      8.397727E+04\n\
         \x20      2    3.063645E+00     -1.224934E+00     -5.146723E+01      6.690259E+01      1.402317E+05     -1.205290E+04     -2.084745E+03\n\
         {page}{heading}\
         \x20      3    3.736549E+00     -1.281779E+01     -3.244333E+00      3.478839E+00     -2.027323E+02      1.067572E+05     -4.270757E+03\n\
         {page}                                                         MODAL EFFECTIVE MASS   \n\n{heading}\
         \x20      1    1.774807E+00      4.141691E+03      2.351284E+00      7.177919E-03      2.350525E+07      2.395347E+10      7.052181E+09\n\
         \x20      2    3.063645E+00      1.500462E+00      2.648875E+03      4.475957E+03      1.966493E+10      1.452724E+08      4.346163E+06\n\
         \x20      3    3.736549E+00      1.642958E+02      1.052570E+01      1.210232E+01      4.110038E+04      1.139709E+10      1.823937E+07\n\
         {page}                                                        MODAL EFFECTIVE WEIGHT  \n\n{heading}\
         \x20      1    1.774807E+00      9.0E+09      9.0E+09      9.0E+09      9.0E+09      9.0E+09      9.0E+09\n"
    )
}

#[test]
fn effective_masses_in_a_print_are_an_appendage() {
    let lines = "file = \"a.f06\"\nlength_unit = \"mm\"\n";
    let (found, _) = appendage(&[("a.f06", printed().into_bytes())], lines);
    close(found.mass, 7181.204, 1e-12);
    // c × of the rows: 1.628356e7 = m z, 2.614887e6 = m y, 2.294775e5 = m x, in millimetres
    for (axis, moment) in [229.4775, 2614.887, 16283.56].into_iter().enumerate() {
        close(found.center_of_mass[axis], moment / 7181.204, 1e-6);
    }
    close(found.inertia[1][2], -7747.655, 1e-6);
    close(found.modes[0].translation[0], -64.355_97, 2e-5);
    close(found.modes[2].rotation[1], 106.7572, 2e-5);
    close(found.modes[2].frequency, 3.736_549 * std::f64::consts::TAU, 1e-12);
    assert_eq!(found.modes.len(), 3);
    // shapes of another scale: factors of modes whose greatest displacement is one
    let other = printed().replace("-6.435597E+01      1.533390E+00      8.472260E-02     -4.848222E+03     -1.547691E+05      8.397727E+04",
        "-3.2177985E+01      0.766695E+00      4.236130E-02     -2.424111E+03     -0.7738455E+05      4.1988635E+04");
    let (scaled, _) = appendage(&[("a.f06", other.into_bytes())], lines);
    close(scaled.modes[0].rotation[2], found.modes[0].rotation[2], 1e-6);
}

fn superelement(lines: &str) -> (Appendage, String) {
    let files = ["outboard.op4", "outboard.pch"].map(|name| (name, fs::read(data(name)).expect("a file")));
    appendage(&files, &format!("file = \"outboard.op4\"\nnodes = \"outboard.pch\"\n{lines}"))
}

/// Mass, centre, radii of gyration, frequencies and shares of effective mass that pyYeti finds in the same matrices.
#[test]
fn an_external_superelement_is_an_appendage() {
    let (found, _) = superelement("");
    close(found.mass, 1.5904, 5e-5);
    for (axis, place) in [600.0 - 415.360_203, 150.0, 150.0].into_iter().enumerate() {
        close(found.center_of_mass[axis], place, 1e-8);
    }
    let c = found.center_of_mass;
    for (axis, radius) in [473.742_359_f64, 168.508_196, 486.443_472].into_iter().enumerate() {
        let arm = c.iter().enumerate().filter(|(other, _)| *other != axis).map(|(_, x)| x * x).sum::<f64>();
        close((found.inertia[axis][axis] / found.mass - arm).sqrt(), radius, 1e-7);
    }
    let shares =
        [(1.650, 0.0, 0.0, 0.0), (1.650, 11.86, 0.0, 0.0), (1.674, 0.0, 0.0, 0.0), (1.675, 0.0, 0.0, 12.24)];
    for (mode, (hertz, x, y, z)) in found.modes.iter().zip(shares) {
        assert!((mode.frequency / std::f64::consts::TAU - hertz).abs() < 6e-4);
        for (factor, share) in mode.translation.iter().zip([x, y, z]) {
            assert!((100.0 * factor * factor / found.mass - share).abs() < 0.006, "{factor}");
        }
    }
    let sums = effective(&found);
    for (axis, share) in [21.54, 87.57, 87.41].into_iter().enumerate() {
        assert!((100.0 * sums[axis] / found.mass - share).abs() < 0.006, "{sums:?}");
    }
    assert_eq!(found.modes.len(), 22);
}

/// A matrix as DMIG cards with large fields.
fn dmig(name: &str, matrix: &str, dofs: &[(u64, u8)]) -> String {
    let found = read_matrix(&data("outboard.op4"), Some(matrix)).expect("a matrix");
    let mut text = format!("DMIG    {name:<8}       0       6       2       0\n");
    for (row, column, value) in found.entries.iter().filter(|(row, column, _)| row >= column) {
        let ((g, c), (h, d)) = (dofs[*column], dofs[*row]);
        let number = format!("{value:.9E}").replace("E-", "D-").replace("E", "D");
        let number = if number.contains("D-") { number } else { number.replace('D', "D+") };
        writeln!(text, "DMIG*   {name:<16}{g:>16}{c:>16}\n*       {h:>16}{d:>16}{number:>16}").expect("text");
    }
    text
}

/// The same superelement as DMIG cards in one file with its points.
#[test]
fn a_superelement_of_dmig_cards_is_the_same() {
    let mut dofs: Vec<(u64, u8)> =
        [3, 11, 19, 27].iter().flat_map(|node| (1..=6).map(move |component| (*node, component))).collect();
    dofs.extend((1_995_001..=1_995_022).map(|point| (point, 0)));
    let grids = fs::read_to_string(data("outboard.pch")).expect("a file");
    let text = format!("{grids}{}{}", dmig("KAAX", "KXX", &dofs), dmig("MAAX", "MXX", &dofs));
    let (found, _) = appendage(&[("a.pch", text.into_bytes())], "file = \"a.pch\"\n");
    let (expected, _) = superelement("");
    close(found.mass, expected.mass, 1e-8);
    for (found, expected) in found.modes.iter().zip(&expected.modes) {
        close(found.frequency, expected.frequency, 1e-8);
        let size = expected.rotation.iter().fold(0.0, |most: f64, x| most.max(x.abs()));
        (0..3)
            .for_each(|k| assert!((found.rotation[k] - expected.rotation[k]).abs() < 1e-6 * size.max(1e-3)));
    }
}

/// Files that lack something, or of which something is given twice, are refused in words.
#[test]
fn files_that_are_no_sheet_are_refused() {
    let says = |files: &[(&str, Vec<u8>)], lines: &str| {
        let error = of(files, lines)
            .map(|model| format!("{:?}", model.assembly.appendages[0]))
            .expect_err("a refusal");
        located(&error).lines().next().unwrap_or_default().to_owned()
    };
    let op4 = fs::read(data("outboard.op4")).expect("a file");
    let pch = fs::read_to_string(data("outboard.pch")).expect("a file");
    insta::assert_snapshot!(says(&[("a.f06", printed().into_bytes())], "file = \"a.f06\"\nmass = 3\n"), @"model.toml:9:8: `mass` is in the `file`");
    let lacks = printed().replace("RIGID BODY", "RIGID");
    insta::assert_snapshot!(says(&[("a.f06", lacks.into_bytes())], "file = \"a.f06\"\n"), @"model.toml:8:8: `file`: a.f06: the print has participation factors without the rigid body mass matrix; ask for MEFFMASS(PRINT,ALL)");
    let apart = printed().replace("4.141691E+03", "4.181691E+03");
    insta::assert_snapshot!(says(&[("a.f06", apart.into_bytes())], "file = \"a.f06\"\n"), @"model.toml:8:8: `file`: a.f06: the effective masses are not the squares of the participation factors; are they of one run?");
    let moved = pch.replace("0.600000000E+03 0.300000000E+03", "0.600000000E+03 0.310000000E+03");
    let lines = "file = \"a.op4\"\nnodes = \"a.pch\"\n";
    insta::assert_snapshot!(says(&[("a.op4", op4.clone()), ("a.pch", moved.into_bytes())], lines), @"model.toml:8:8: `file`: a.op4: the stiffness resists rigid motions of the boundary: the structure is also held elsewhere, or `nodes` has other places");
    let fewer = pch.replace("      27  123456", "      27   12345");
    insta::assert_snapshot!(says(&[("a.op4", op4.clone()), ("a.pch", fewer.into_bytes())], lines), @"model.toml:8:8: `file`: a.op4: the rows of the matrices are not those of the points in `nodes`; give the .pch or .asm that EXTSEOUT wrote beside them");
    insta::assert_snapshot!(says(&[("a.op4", op4)], "file = \"a.op4\"\n"), @"model.toml:8:8: `file`: a.op4: the matrices stand without their points; give `nodes`, the .pch or .asm that EXTSEOUT wrote beside them");
}

/// Two masses on a line that move along it together, then against each other, with the effective mass of the first mode in the print.
fn of_modes(effective: &str) -> String {
    let row =
        |node: u64, x: f64| format!("        {node}      G      {x:.6E}   0.0   0.0   0.0   0.0   0.0\n");
    let vector = |mode: u64, first: f64, second: f64| {
        format!(
            "1\n      R E A L   E I G E N V E C T O R   N O .          {mode}\n{}{}",
            row(1, first),
            row(2, second)
        )
    };
    let text = format!(
        "      R E A L   E I G E N V A L U E S\n   1  1  1.0E+02  1.0E+01  1.591549E+00  3.0E+00  3.0E+02\n   2  2  4.0E+02  2.0E+01  3.183099E+00  6.0E+00  2.4E+03\n\
         {}{}1\n      MODAL EFFECTIVE MASS\n\n   1  1.591549E+00  {effective}  0.0  0.0  0.0  0.0  0.0\n   2  3.183099E+00  0.0  0.0  0.0  0.0  0.0  0.0\n",
        vector(1, 1.0, 1.0),
        vector(2, 1.0, -2.0)
    );
    let folder = TempDir::new().expect("a folder");
    let file = |name: &str, text: &str| fs::write(folder.path().join(name), text).expect("a file");
    file("a.f06", &text);
    file("a.csv", "1,0,0,0\n2,1,0,0\n");
    file("m.mtx", "%%MatrixMarket matrix array real general\n2 1\n2000\n1000\n");
    file(
        "model.toml",
        &format!(
            "{CARRIER}[[modes]]\nname = \"m\"\nnodes = \"a.csv\"\nmass = \"m.mtx\"\nshapes = \"a.f06\"\nfrequencies = {{ file = \"a.f06\" }}\nmass_unit = \"g\"\n"
        ),
    );
    let model = Model::read(&folder.path().join("model.toml")).unwrap_or_else(|error| panic!("{error}"));
    model.file_notes.join("\n")
}

/// Shapes with the masses that they were found with have the effective masses of the print.
#[test]
fn effective_masses_check_the_masses_of_modes() {
    // (2000 + 1000)² / (2000 + 1000) g
    let notes = of_modes("3.0E+03");
    assert!(notes.contains("effective masses are those of MEFFMASS within 0.00 % of the mass"), "{notes}");
    let notes = of_modes("2.0E+03");
    assert!(notes.contains("differ from those of MEFFMASS by up to 33.3 % of the mass"), "{notes}");
}
