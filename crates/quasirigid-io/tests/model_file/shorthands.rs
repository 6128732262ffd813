//! Shorthands of small bodies: `mu_Q`, `diameter` with `axis_ratios` or `moment_ratios`, `SAM` and `LAM`, hours as `hr`.

use quasirigid::elements::Material;
use quasirigid::model::Rheology;

use super::{read, refusal};

fn body(material: &str, shape: &str) -> String {
    format!(
        "[material.rock]\ndensity = 2000\npoisson = 0.25\n{material}\n[[ellipsoid]]\n{shape}\nmaterial = \"rock\"\n"
    )
}

const SHAPE: &str = "semi_axes = [3, 2, 1]";

/// The sphere of equal volume: 4π/3 abc = 4π/3 (D/2)³, and the ratios as given.
#[test]
fn diameter_is_that_of_the_sphere_of_equal_volume() {
    let model = read(&body("young = 1e9", "diameter = \"2 km\"\naxis_ratios = [3, 1.5, 0.75]"));
    let [a, b, c] = model.assembly.ellipsoids[0].semi_axes;
    assert!((a * b * c / 1e9 - 1.0).abs() < 1e-14);
    assert!((a / b - 2.0).abs() < 1e-14 && (b / c - 2.0).abs() < 1e-14);
    let twice =
        refusal(&body("young = 1e9", "diameter = 2000\naxis_ratios = [1, 1, 1]\nsemi_axes = [3, 2, 1]"));
    assert!(twice.contains("`axis_ratios` follow from `semi_axes`"), "{twice}");
    let ratios = refusal(&body("young = 1e9", &format!("{SHAPE}\naxis_ratios = [1, 1, 1]")));
    assert!(ratios.contains("`axis_ratios` follow from `semi_axes`"), "{ratios}");
    let size = refusal(&body("young = 1e9", &format!("{SHAPE}\ndiameter = 2")));
    assert!(size.contains("`diameter` follows from `semi_axes`"), "{size}");
    assert!(refusal(&body("young = 1e9", "axis_ratios = [1, 1, 1]")).contains("has no `diameter`"));
    assert!(refusal(&body("young = 1e9", "diameter = 2000")).contains("has no `axis_ratios`"));
    assert!(
        refusal(&body("young = 1e9", "diameter = 2000\naxis_ratios = [1, 0, 1]"))
            .contains("must be positive")
    );
}

/// The body has the moments of inertia in these ratios, by the inertia that the assembly computes.
#[test]
fn ratios_of_the_moments_are_those_of_the_body() {
    let model = read(&body("young = 1e9", "diameter = \"2 km\"\nmoment_ratios = [1.5, 4.6, 5]"));
    let [a, b, c] = model.assembly.ellipsoids[0].semi_axes;
    assert!((a * b * c / 1e9 - 1.0).abs() < 1e-14);
    let J = model.assembly.body().expect("a body").inertia();
    let ratios = [J[0][0] / J[2][2] / 0.3, J[1][1] / J[2][2] / 0.92];
    assert!(ratios.iter().all(|ratio| (ratio - 1.0).abs() < 1e-12), "{ratios:?}");
    let flat = refusal(&body("young = 1e9", "diameter = 2\nmoment_ratios = [1, 1, 2]"));
    assert!(flat.contains("the greatest is not below the sum of the others"), "{flat}");
    let twice =
        refusal(&body("young = 1e9", "diameter = 2\nmoment_ratios = [1, 1, 1]\naxis_ratios = [1, 1, 1]"));
    assert!(twice.contains("`moment_ratios` follow from `axis_ratios`"), "{twice}");
}

#[test]
fn modes_have_short_names() {
    let start = |mode: &str| {
        let line = format!("[initial]\nwobble = {{ angle = 0.1, rate = 1, mode = \"{mode}\" }}\n");
        read(&(body("young = 1e9", SHAPE) + &line)).initial.rotation
    };
    assert_eq!(start("SAM"), start("short-axis"));
    assert_eq!(start("LAM"), start("long-axis"));
    assert_ne!(start("SAM"), start("LAM"));
}

fn rock(text: &str) -> (Material, Vec<String>) {
    let model = read(text);
    (model.assembly.ellipsoids[0].material.clone(), model.notes)
}

#[test]
fn product_of_rigidity_and_quality_gives_the_rigidity() {
    let (material, notes) =
        rock(&body("mu_Q = \"5 GPa\"\nrheology = { kind = \"quality-factor\", Q = 50 }", SHAPE));
    assert!((material.shear() / 1e8 - 1.0).abs() < 1e-15 && notes.is_empty(), "{material:?} {notes:?}");
    let (material, notes) = rock(&body("mu_Q = 5e9", SHAPE));
    assert_eq!(material.rheology, Rheology::QualityFactor { factor: 100.0 });
    assert!((material.shear() / 5e7 - 1.0).abs() < 1e-15);
    assert!(notes.iter().any(|note| note.contains("so Q = 100 is taken")), "{notes:?}");
    for (lines, said) in [
        ("mu_Q = 5e9\nyoung = 1e9", "`young` follows from `mu_Q` and `Q`"),
        ("mu_Q = 5e9\nrheology = { kind = \"maxwell\", time = 3 }", "this rheology has none"),
        ("mu_Q = -5e9", "must be positive"),
        ("mu_Q = \"5 m\"", "a pressure is needed"),
    ] {
        let found = refusal(&body(lines, SHAPE));
        assert!(
            found.contains(said) || said == "a pressure is needed" && found.contains("pressure"),
            "{found}"
        );
    }
}

#[test]
fn hours_are_written_in_two_ways() {
    use quasirigid_io::units::{Dimension, quantity};
    assert_eq!(quantity("2 hr", Dimension::TIME), Ok(7200.0));
    assert_eq!(quantity("3 kyr", Dimension::TIME), quantity("3000 yr", Dimension::TIME));
}
