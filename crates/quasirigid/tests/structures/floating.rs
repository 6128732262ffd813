//! A body of beams that floats against the same body with its middle as a carrier: the frames differ, the vibrations not.

use nalgebra::{Matrix3, Vector3};
use quasirigid::elements::{
    Assembly, Frame, FrameNode, Member, Part, PartKind, PartReduction, SectionShape, TipMass,
};
use quasirigid::model::FlexibleBody;
use quasirigid_math::eigen::eigenvectors;

use super::common::turned_axes;
use super::spinning::{SHARE, steady};
use crate::support::linearised::linearised;
use crate::support::parts;

const MASS: f64 = 30.0;
const MIDDLE: [f64; 3] = [0.4, -0.7, 0.2];
const ARM: f64 = 2.0;

/// Inertia of the middle: the greatest about the third of its axes.
fn inertia() -> [[f64; 3]; 3] {
    let turned = turned_axes().matrix()
        * Matrix3::from_diagonal(&Vector3::new(3.0, 4.0, 5.5))
        * turned_axes().inverse();
    std::array::from_fn(|i| std::array::from_fn(|j| 0.5 * (turned[(i, j)] + turned[(j, i)])))
}

/// Two soft booms of unequal length along the first axis, and a short one along the second.
fn booms(masses: Vec<TipMass>, attached: Vec<usize>) -> Part {
    let place = |x: f64, y: f64| (Vector3::from(MIDDLE) + turned_axes() * Vector3::new(x, y, 0.0)).into();
    let node = |name: &str, position| FrameNode { name: name.to_owned(), position };
    let material = parts::elastic(2700.0, 70e9, 0.3);
    let member = |end: usize| Member {
        name: String::new(),
        ends: [0, end],
        section: SectionShape::Rectangle { height: 4e-3, width: 6e-3 },
        up: Some((turned_axes() * Vector3::z()).into()),
        material: material.clone(),
        elements: 6,
    };
    let kind = PartKind::Frame(Frame {
        nodes: vec![
            node("middle", MIDDLE),
            node("long", place(ARM, 0.0)),
            node("short", place(-0.8 * ARM, 0.0)),
            node("side", place(0.0, 0.7 * ARM)),
        ],
        members: vec![member(1), member(2), member(3)],
    });
    Part { name: "booms".to_owned(), kind, masses, attached, rayleigh: [0.0; 2] }
}

fn body(floats: bool) -> FlexibleBody {
    let (carrier, part) = if floats {
        let middle = TipMass { node: 0, mass: MASS, inertia: inertia() };
        (None, booms(vec![middle], Vec::new()))
    } else {
        let carrier = parts::carrier(MASS, MIDDLE, inertia());
        (Some(carrier), booms(Vec::new(), vec![0]))
    };
    let reduction = PartReduction { order: 5, modes: 12 };
    Assembly { carrier, parts: vec![part], reduction, ..Assembly::default() }.body().unwrap()
}

/// Frequencies about the steady spin, the lowest first.
fn frequencies(body: &FlexibleBody, spin: f64) -> Vec<f64> {
    let n = body.coordinates().len();
    let axis = quasirigid::model::Principal::compute(body.invariants().J).axes[2];
    let state = steady(body, axis.map(|entry| spin * entry));
    let A = body.mass_matrix();
    let momenta = (0..n).map(|j| 1e-3 * A.at(j, j));
    let sizes: Vec<f64> = [10.0; 3].into_iter().chain(momenta).chain(vec![1e-3; n]).collect();
    let (values, _) = eigenvectors(&linearised(body, &state, &sizes, SHARE)).unwrap();
    let mut found: Vec<f64> = values.iter().map(|[_, im]| *im).filter(|im| *im > 1e-6).collect();
    found.sort_by(f64::total_cmp);
    found
}

/// The booms stiffen by the spin as on a carrier, whose frame rotates against that of the whole by the bending of the booms. The difference
/// is of the third order in the displacements, which go with the square of the spin.
#[test]
fn a_frame_has_the_same_vibrations_floating_and_on_its_middle() {
    let (floating, carried) = (body(true), body(false));
    for spin in [0.5_f64, 3.0, 8.0] {
        let (found, expected) = (frequencies(&floating, spin), frequencies(&carried, spin));
        let errors = (0..8).map(|mode| (found[mode] / expected[mode] - 1.0).abs());
        let error = errors.fold(0.0, f64::max);
        println!("spin {spin}: {error:.1e}");
        assert!(error < 3e-8 * spin.powi(4) + 1e-6, "spin {spin}: {error:e}\n{found:?}\n{expected:?}");
    }
    let still = frequencies(&carried, 0.5);
    assert!(frequencies(&floating, 8.0)[1] > 1.1 * still[1], "the spin stiffens");
}
