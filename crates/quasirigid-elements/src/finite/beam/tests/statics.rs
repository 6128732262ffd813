//! Statics of beam elements: closed forms of a cantilever, rigid motions, rotations and units.
//! A cut changes nothing and six motions cost nothing: the two properties on which exact joints and the Tisserand frame rely.

use nalgebra::{Matrix3, Matrix6, Rotation3};
use proptest::prelude::*;

use super::*;

const ENDS: [[f64; 3]; 2] = [[0.3, -1.1, 0.7], [1.6, -0.2, 1.9]];
const ACROSS: [f64; 3] = [0.2, -0.9, 0.4];

fn thick() -> Section {
    SectionShape::Rectangle { height: 0.5, width: 0.3 }.section(0.3).unwrap()
}

/// Tip displacement and rotation by tip force and moment, in axes along the beam, `y` and `z`.
fn closed_form(section: &Section, L: f64) -> Matrix6<f64> {
    let BeamMaterial { young: E, shear: G, .. } = ALLOY;
    let (Iy, Iz) = (E * section.second_y, E * section.second_z);
    let mut f = Matrix6::zeros();
    f[(0, 0)] = L / (E * section.area);
    f[(3, 3)] = L / (G * section.torsion);
    f[(1, 1)] = L.powi(3) / (3.0 * Iz) + L / (G * section.shear_y);
    f[(2, 2)] = L.powi(3) / (3.0 * Iy) + L / (G * section.shear_z);
    (f[(1, 5)], f[(5, 1)]) = (L * L / (2.0 * Iz), L * L / (2.0 * Iz));
    (f[(2, 4)], f[(4, 2)]) = (-L * L / (2.0 * Iy), -L * L / (2.0 * Iy));
    (f[(4, 4)], f[(5, 5)]) = (L / Iy, L / Iz);
    f
}

#[test]
fn a_cantilever_bends_as_the_closed_form_says_whatever_its_cuts() {
    let section = SectionShape::General {
        area: 0.04,
        second_y: 5e-4,
        second_z: 3e-4,
        torsion: 2e-4,
        shear: Some([0.031, 0.023]),
    };
    for section in [thick(), section.section(0.2).unwrap(), thin(0.04, 0.1, 0.06)] {
        for cuts in [&[0.0, 1.0][..], &[0.0, 0.13, 0.55, 1.0]] {
            let chain = Chain::cut(ENDS, ACROSS, section, ALLOY, cuts);
            let axes = chain.beams[0].axes;
            let length = (Vector3::from(ENDS[1]) - Vector3::from(ENDS[0])).norm();
            let expected = closed_form(&section, length);
            let size = chain.size();
            for load in 0..6 {
                let mut force = DVector::zeros(size);
                let unit = axes.row(load % 3).transpose();
                force.fixed_rows_mut::<3>(size - 6 + 3 * (load / 3)).copy_from(&unit);
                let u = chain.clamped(&force);
                let tip = [size - 6, size - 3].map(|row| axes * u.fixed_rows::<3>(row));
                for answer in 0..6 {
                    let (found, wanted) = (tip[answer / 3][answer % 3], expected[(answer, load)]);
                    let scale = (expected[(answer, answer)] * expected[(load, load)]).sqrt();
                    // The rounding times the condition number of K, some 1e3.
                    assert!((found - wanted).abs() < 1e-12 * scale, "{answer} {load}: {found} {wanted}");
                }
            }
        }
    }
}

#[test]
fn moving_as_a_rigid_body_costs_nothing_and_only_that() {
    let beam = &Chain::even(ENDS, ACROSS, thick(), ALLOY, 1).beams[0];
    let stiffness = beam.stiffness();
    for axis in 0..3 {
        let unit = Vector3::ith(axis, 1.0);
        for u in [rigid(&beam.ends, unit, Vector3::zeros()), rigid(&beam.ends, Vector3::zeros(), unit)] {
            assert!((stiffness * own(&u, 0)).amax() < 1e-14 * stiffness.amax());
        }
    }
    let eigenvalues = stiffness.symmetric_eigenvalues();
    assert_eq!(eigenvalues.iter().filter(|value| **value > 1e-9 * eigenvalues.max()).count(), 6);
    assert!(eigenvalues.min() > -1e-14 * eigenvalues.max());
}

#[test]
fn turning_a_beam_turns_its_matrices() {
    let turn = Rotation3::from_euler_angles(0.7, -1.2, 2.1);
    let turned = |vector: [f64; 3]| -> [f64; 3] { (turn * Vector3::from(vector)).into() };
    let before = Beam::new(ENDS, Some(ACROSS), thick(), ALLOY).unwrap();
    let after = Beam::new(ENDS.map(turned), Some(turned(ACROSS)), thick(), ALLOY).unwrap();
    let mut all = Matrix12::zeros();
    (0..4).for_each(|i| all.fixed_view_mut::<3, 3>(3 * i, 3 * i).copy_from(turn.matrix()));
    let u = Vector12::from_fn(|i, _| (1.7 * i as f64).sin() * 1e-3);
    let force = [Vector3::new(1e5, -2e5, 3e5), Vector3::new(-4e5, 1e5, 2e5)];
    let moment = Vector3::new(3e4, -2e4, 5e4);
    let load = Load { force, moment };
    let turned = Load { force: force.map(|p| turn * p), moment: turn * moment };
    for (matrix, other) in [
        (before.stiffness(), after.stiffness()),
        (before.mass(), after.mass()),
        (before.geometric_under(&u, load), after.geometric_under(&(all * u), turned)),
    ] {
        assert!((all * matrix * all.transpose() - other).amax() < 1e-13 * matrix.amax());
        assert!((matrix - matrix.transpose()).amax() < 1e-15 * matrix.amax());
    }
}

#[test]
fn the_section_stands_as_it_is_told() {
    let beam = |ends: [[f64; 3]; 2], direction| Beam::new(ends, direction, thick(), ALLOY);
    let along = |to: [f64; 3]| [[0.0; 3], to];
    let rows = |to, direction| beam(along(to), direction).unwrap().axes;
    assert_eq!(rows([2.0, 0.0, 0.0], None), Matrix3::identity());
    let (x, y, z) = (Vector3::x().transpose(), Vector3::y().transpose(), Vector3::z().transpose());
    assert_eq!(rows([0.0, 3.0, 0.0], None), Matrix3::from_rows(&[y, x, -z]));
    assert_eq!(rows([0.0, 0.0, 1.0], Some([5.0, 0.0, 7.0])), Matrix3::from_rows(&[z, x, y]));
    let huge = rows([1.0, 0.0, 0.0], Some([1e300, 1e300, 0.0]));
    assert!((huge - Matrix3::identity()).amax() < 1e-15, "{huge}");
    for direction in [[0.0; 3], [f64::NAN; 3], [1.0, 1e-7, 0.0], [-3.0, 0.0, 0.0]] {
        let refused = beam(along([1.0, 0.0, 0.0]), Some(direction));
        assert!(matches!(refused, Err(super::super::BeamError::NoDirection { .. })), "{direction:?}");
    }
    assert!(beam(along([1.0, 0.0, 0.0]), Some([1.0, 1e-5, 0.0])).is_ok());
    for to in [[0.0; 3], [f64::INFINITY, 0.0, 0.0], [f64::NAN; 3]] {
        assert!(matches!(beam(along(to), None), Err(super::super::BeamError::NoLength { .. })));
    }
    assert!(beam([[1e6, 0.0, 0.0], [1e6 + 1e-9, 0.0, 0.0]], None).is_err(), "a distance of eight roundings");
    for material in [
        BeamMaterial { young: 0.0, ..ALLOY },
        BeamMaterial { shear: f64::NAN, ..ALLOY },
        BeamMaterial { density: -1.0, ..ALLOY },
    ] {
        assert!(Beam::new(ENDS, None, thick(), material).is_err());
    }
}

proptest! {
    /// Units of 10⁻⁹ to 10⁹ for length, moduli and densities: each entry of a matrix changes by its own power.
    #[test]
    fn matrices_do_not_know_the_units(length in -9..=9i32, pressure in -9..=9i32, density in -9..=9i32) {
        let [a, p, d] = [length, pressure, density].map(|power| 10f64.powi(power));
        let shape = |a: f64| SectionShape::IBeam { height: 0.4 * a, width: 0.3 * a, web: 0.02 * a, flange: 0.03 * a };
        let beam = |a: f64, p: f64, d: f64| {
            let material = BeamMaterial { young: ALLOY.young * p, shear: ALLOY.shear * p, density: ALLOY.density * d };
            let ends = ENDS.map(|end| end.map(|x| x * a));
            Beam::new(ends, Some(ACROSS), shape(a).section(0.3).unwrap(), material).unwrap()
        };
        let rotation = |i: usize| i32::from(i % 6 >= 3);
        let u = Vector12::from_fn(|i, _| (2.3 * i as f64).cos() * 1e-4);
        let scaled = Vector12::from_fn(|i, _| u[i] * a.powi(1 - rotation(i)));
        let (one, other) = (beam(1.0, 1.0, 1.0), beam(a, p, d));
        for (matrix, found, unit) in [
            (one.stiffness(), other.stiffness(), p * a),
            (one.mass(), other.mass(), d * a.powi(3)),
            (one.geometric(&u), other.geometric(&scaled), p * a),
        ] {
            for i in 0..12 {
                for j in 0..12 {
                    let power = a.powi(rotation(i) + rotation(j)) * unit;
                    let scale = (matrix[(i, i)] * matrix[(j, j)]).abs().sqrt().max(1e-6 * matrix.amax());
                    prop_assert!((found[(i, j)] / power - matrix[(i, j)]).abs() < 1e-11 * scale);
                }
            }
        }
    }
}
