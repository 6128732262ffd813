//! References for what a model uses: elements, materials, liquids, forces, and the questions of its `[run]`.
//! A paper that rests on a computation should name the methods behind it, and nobody remembers them all: the table here says which
//! keys of the bibliography belong to which capability.
//! Keys: docs/references.bib; the equations themselves name them in docs/theory.

use quasirigid::elements::{ApplicationPoint, CavityShape, PartKind};
use quasirigid::model::Rheology;
use quasirigid::model::control::Controller;
use quasirigid::model::force::{ForceLaw, MagneticField};
use quasirigid_io::model::{Model, System};

const BIBLIOGRAPHY: &str = include_str!("../../../docs/references.bib");

/// The reduction itself, and why a slow manifold exists.
const REDUCTION: &[&str] = &["chernousko1978", "carr1981"];
const BEAMS: &[&str] =
    &["kane1987", "przemieniecki1968", "friedman1993", "cowper1966", "eldarwish1965", "simo1985"];
const SHELLS: &[&str] = &[
    "kane1987",
    "dvorkin1984",
    "batoz1980",
    "felippa2003",
    "belytschko1991",
    "flanagan1981",
    "hughes1989",
    "jones1999",
];
const SOLIDS: &[&str] = &["kane1987", "taylor1976", "hughes1980", "walkington2000"];
const MATRICES: &[&str] = &["kane1987"];
const MODES: &[&str] = &["kane1987", "craig1968"];
const SHEETS: &[&str] = &["likins1970"];
const NETWORKS: &[&str] = &["quillen2019", "steele2014"];
const ELLIPSOIDS: &[&str] = &["breiter2012"];
const SURFACES: &[&str] = &["labelle2007", "baerentzen2005", "freudenthal1942", "walkington2000"];
const LIQUIDS: &[&str] = &["zhukovsky1885", "chernousko1968"];
const SLOSH: &[&str] = &["abramson1966", "dodge2000", "bernardi1999"];
/// Friction in curved and straight tubes.
const TUBES: &[&str] = &["white1929", "ito1959", "haaland1983"];
const BALLS: &[&str] = &["poincare1910", "greenspan1968"];
const CYLINDERS: &[&str] = &["stewartson1959", "greenspan1968", "bernardi1999"];
const REVOLUTIONS: &[&str] = &["bernardi1999"];
const STOKES: &[&str] = &["taylor1973", "cahouet1988", "zienkiewicz1992"];
const CREEP: &[&str] = &["andrade1910"];
const ORBITS: &[&str] = &["battin1999", "hughes1986"];
const EDDY_CURRENTS: &[&str] = &["ortiz2015", "landau1984"];
/// Pressure and recoil of light on facets, and its mean torque.
const SUNLIGHT: &[&str] = &["rubincam2000"];
const FIELDS_ON_ORBITS: &[&str] = &["battin1999"];
/// The coefficients of the main field of the Earth, and how its harmonics are computed.
const MAIN_FIELD: &[&str] = &["igrf14", "cunningham1970"];
const WHEELS: &[&str] = &["hughes1986"];
const HISTORIES: &[&str] = &["hairer1993"];
const FULL_SYSTEM: &[&str] = &["hairer1993", "hairer1999"];
const EVOLUTION: &[&str] = &["bulirsch1965", "neishtadt1991", "magnus1954", "saad1986"];
const DAMPING_TIMES: &[&str] = &["burns1973", "harris1994", "breiter2012"];

/// Keys of the references of a model, each once: the reduction first, then in the order of the table.
///
/// ```
/// use std::path::Path;
/// use quasirigid_io::model::Model;
///
/// # fn main() -> Result<(), quasirigid_io::model::ModelError> {
/// # let file = Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/../../examples/three-masses/model.toml"));
/// let keys = quasirigid_study::cite::keys(&Model::read(file)?);
/// assert_eq!(keys[0], "chernousko1978");
/// # Ok(())
/// # }
/// ```
#[must_use]
pub fn keys(model: &Model) -> Vec<&'static str> {
    let mut keys: Vec<&str> = Vec::new();
    for (uses, references) in capabilities(model) {
        let new = references.iter().filter(|_| uses);
        for key in new {
            if !keys.contains(key) {
                keys.push(key);
            }
        }
    }
    keys
}

/// BibTeX entries of the references of a model.
#[must_use]
pub fn bibtex(model: &Model) -> String {
    let entries: Vec<&str> = keys(model).into_iter().filter_map(entry).collect();
    entries.join("\n\n") + "\n"
}

/// Whether a model uses a capability, with the references of the capability.
fn capabilities(model: &Model) -> Vec<(bool, &'static [&'static str])> {
    let Model { assembly, run, source, .. } = model;
    let part = |of: fn(&PartKind) -> bool| assembly.parts.iter().any(|part| of(&part.kind));
    let cavity = |of: fn(&CavityShape) -> bool| assembly.cavities.iter().any(|cavity| of(&cavity.shape));
    let mut owned = assembly.clone();
    let rheologies: Vec<&Rheology> = owned.rheologies_mut().map(|(_, rheology)| &*rheology).collect();
    let material = |of: fn(&Rheology) -> bool| rheologies.iter().any(|rheology| of(rheology));
    // Only the secular evolution counts the losses of these materials.
    let evolves = run.evolve.is_some()
        || material(|rheology| !matches!(rheology, Rheology::Elastic | Rheology::KelvinVoigt { .. }));
    let full = run.verify.is_some() || run.systems.as_ref().is_some_and(|all| all.contains(&System::Full));
    let law = |of: fn(&ForceLaw<ApplicationPoint>) -> bool| {
        assembly.forces.iter().any(|force| of(force.law.timed().0))
    };
    let sensed =
        assembly.magnetic_field.as_ref().filter(|_| assembly.controllers.iter().any(Controller::is_magnetic));
    let fields =
        || assembly.forces.iter().filter_map(|force| force.law.timed().0.magnetic_field()).chain(sensed);
    let in_field = |of: fn(&MagneticField) -> bool| fields().any(of);
    let network = source.text.lines().any(|line| line.trim_start().starts_with("[[network]]"));
    vec![
        (true, REDUCTION),
        (part(|kind| matches!(kind, PartKind::Frame(_) | PartKind::Mixed(_))), BEAMS),
        (part(|kind| matches!(kind, PartKind::Panel(_) | PartKind::Mixed(_))), SHELLS),
        (part(|kind| matches!(kind, PartKind::Solid(_) | PartKind::Mixed(_))), SOLIDS),
        (part(|kind| matches!(kind, PartKind::Matrices(_))), MATRICES),
        (part(|kind| matches!(kind, PartKind::Modes(_))), MODES),
        (!assembly.appendages.is_empty(), SHEETS),
        (network, NETWORKS),
        (!assembly.ellipsoids.is_empty(), ELLIPSOIDS),
        (!assembly.surfaces.is_empty(), SURFACES),
        (!assembly.cavities.is_empty(), LIQUIDS),
        (!assembly.tanks.is_empty(), SLOSH),
        (!assembly.tubes.is_empty(), TUBES),
        (cavity(|shape| matches!(shape, CavityShape::Ellipsoid { .. })), BALLS),
        (cavity(|shape| matches!(shape, CavityShape::Cylinder { .. })), CYLINDERS),
        (
            cavity(|shape| matches!(shape, CavityShape::Annulus { .. } | CavityShape::Ring { .. })),
            REVOLUTIONS,
        ),
        (
            cavity(|shape| {
                matches!(shape, CavityShape::Cuboid { .. } | CavityShape::Shell { .. } | CavityShape::Mesh(_))
            }),
            STOKES,
        ),
        (material(|rheology| matches!(rheology, Rheology::Andrade { .. })), CREEP),
        (law(|law| matches!(law, ForceLaw::CentralGravity { .. })), ORBITS),
        (law(|law| matches!(law, ForceLaw::EddyCurrent { .. })), EDDY_CURRENTS),
        (law(|law| matches!(law, ForceLaw::Sunlight { .. })), SUNLIGHT),
        (in_field(|field| field.orbit().is_some()), FIELDS_ON_ORBITS),
        (in_field(|field| matches!(field, MagneticField::Earth { .. })), MAIN_FIELD),
        (!assembly.wheels.is_empty() || !assembly.rotors.is_empty(), WHEELS),
        (true, HISTORIES),
        (full, FULL_SYSTEM),
        (evolves, EVOLUTION),
        (evolves && material(|rheology| matches!(rheology, Rheology::QualityFactor { .. })), DAMPING_TIMES),
    ]
}

/// The entry of a key in the bibliography.
fn entry(key: &str) -> Option<&'static str> {
    let starts = BIBLIOGRAPHY.match_indices("\n@").map(|(at, _)| at + 1);
    starts
        .map(|at| {
            let rest = &BIBLIOGRAPHY[at..];
            let end = rest[1..].find("\n@").map_or(rest.len(), |end| end + 1);
            rest[..end].trim_end()
        })
        .find(|entry| {
            let head = entry.lines().next().unwrap_or_default();
            head.split_once('{').is_some_and(|(_, name)| name.trim_end_matches(',') == key)
        })
}

#[cfg(test)]
mod tests {
    use std::path::Path;

    use super::*;

    fn cited(example: &str) -> Vec<&'static str> {
        let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../examples").join(example);
        keys(&Model::read(&file.join("model.toml")).unwrap())
    }

    #[test]
    fn every_key_of_the_table_has_an_entry() {
        let model = Model::parse(
            Path::new("x"),
            "[carrier]\nmass = 1\ncenter_of_mass = [0, 0, 0]\ninertia = [1, 1, 1]\n",
        );
        for (_, keys) in capabilities(&model.unwrap()) {
            for key in keys {
                let found = entry(key).unwrap_or_default();
                assert!(
                    found.starts_with('@') && found.contains(key) && found.ends_with('}'),
                    "{key}: {found}"
                );
                assert_eq!(found.matches("\n@").count(), 0, "{found}");
            }
        }
    }

    /// Currents name their law, an orbit Kepler's, and the main field the source of its coefficients, also where it acts at times.
    #[test]
    fn magnetic_fields_name_their_sources() {
        let cited = |field: &str| {
            let text = format!(
                "[carrier]\nmass = 1\ncenter_of_mass = [0, 0, 0]\ninertia = [1, 1, 1]\n[[force]]\nname = \"f\"\n{field}\n"
            );
            keys(&Model::parse(Path::new("x"), &text).unwrap())
        };
        let orbit = "orbit = { body = \"Earth\", semi_major_axis = \"7000 km\" }";
        let earth = format!("igrf = {{ epoch = \"2024-03-01\" }}\n{orbit}");
        let own = |keys: &[&str]| {
            let all = ["ortiz2015", "battin1999", "igrf14", "cunningham1970"];
            all.map(|key| keys.contains(&key))
        };
        let currents = "kind = \"eddy-current\"\ntensor = 1\n";
        let dipole = "kind = \"magnetic-dipole\"\nmoment = [1, 0, 0]\n";
        assert_eq!(own(&cited(&format!("{currents}field = [0, 0, 1]"))), [true, false, false, false]);
        assert_eq!(
            own(&cited(&format!("{dipole}dipole = [0, 0, 7.8e15]\n{orbit}"))),
            [false, true, false, false]
        );
        assert_eq!(own(&cited(&format!("{currents}{earth}"))), [true; 4]);
        let common = format!("{dipole}[magnetic_field]\n{earth}");
        assert_eq!(own(&cited(&common)), [false, true, true, true]);
        assert_eq!(
            own(&cited(&format!("{currents}field = [0, 0, 1]\n[magnetic_field]\n{earth}"))),
            [true, false, false, false]
        );
        let coils = format!(
            "{dipole}field = [0, 0, 1]\n[magnetic_field]\n{earth}\n[[controller]]\nkind = \"b-dot\"\ngain = 1\n"
        );
        assert_eq!(own(&cited(&coils)), [false, true, true, true]);
        let windows = "during = [[\"1 s\", \"2 s\"]]";
        assert_eq!(own(&cited(&format!("{dipole}{earth}\n{windows}"))), [false, true, true, true]);
    }

    #[test]
    fn a_model_cites_what_it_uses_and_no_more() {
        assert_eq!(cited("three-masses")[..2], ["chernousko1978", "carr1981"]);
        for (example, uses, others) in [
            (
                "apophis",
                &["breiter2012", "burns1973", "bulirsch1965"][..],
                &["kane1987", "zhukovsky1885"][..],
            ),
            ("solar-panels", &["kane1987", "dvorkin1984"], &["cowper1966", "breiter2012"]),
            ("spherical-tank", &["zhukovsky1885", "poincare1910"], &["stewartson1959", "taylor1973"]),
            ("quillen-network", &["quillen2019"], &["breiter2012"]),
            ("gravity-gradient", &["hughes1986"], &["zhukovsky1885"]),
        ] {
            let keys = cited(example);
            assert!(uses.iter().all(|key| keys.contains(key)), "{example}: {keys:?}");
            assert!(others.iter().all(|key| !keys.contains(key)), "{example}: {keys:?}");
        }
    }
}
