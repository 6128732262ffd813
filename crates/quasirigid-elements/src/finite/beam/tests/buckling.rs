//! Loads that make a beam buckle: each tests other internal forces in the geometric stiffness.

use std::f64::consts::PI;

use super::*;

const ENDS: [[f64; 3]; 2] = [[0.3, -1.1, 0.7], [1.6, -0.2, 1.9]];

fn length() -> f64 {
    (Vector3::from(ENDS[1]) - Vector3::from(ENDS[0])).norm()
}

/// Least multiple of a load on the last node (in axes along the beam, `y` and `z`) at which a clamped beam buckles, with these coordinates
/// of its last node fixed.
fn critical(section: Section, count: usize, load: [f64; 6], held: usize) -> f64 {
    let chain = Chain::even(ENDS, [0.2, -0.9, 0.4], section, ALLOY, count);
    let (axes, size) = (chain.beams[0].axes, chain.size());
    let mut force = DVector::zeros(size);
    for (row, part) in [(size - 6, &load[..3]), (size - 3, &load[3..])] {
        force.fixed_rows_mut::<3>(row).copy_from(&(axes.transpose() * Vector3::from_column_slice(part)));
    }
    let u = chain.clamped(&force);
    let kept: Vec<usize> = (6..size - held).collect();
    let K = part(&chain.sum(Beam::stiffness), &kept);
    let G = part(&chain.sum_by_place(|i, beam| beam.geometric(&own(&u, i))), &kept);
    let (values, _) = eigen(&-G, &K);
    1.0 / values[values.len() - 1]
}

fn push(along: f64, z: f64) -> [f64; 6] {
    [-along, 0.0, z, 0.0, 0.0, 0.0]
}

#[test]
fn a_slender_column_buckles_at_eulers_load() {
    let section = thin(0.01, 0.02, 0.013);
    let euler = PI.powi(2) * ALLOY.young * section.second_z / (4.0 * length().powi(2));
    let errors = [1, 2, 4, 8].map(|count| critical(section, count, push(1.0, 0.0), 0) / euler - 1.0);
    // One cubic element by hand: 45x² − 52x + 4 = 0 for x = PL²/30EI.
    let one = 30.0 * (52.0 - (52.0_f64.powi(2) - 16.0 * 45.0).sqrt()) / 90.0;
    assert!((errors[0] - (4.0 * one / PI.powi(2) - 1.0)).abs() < 1e-9, "{errors:?}");
    assert!(orders(&errors).iter().all(|order| (3.8..4.3).contains(order)), "{errors:?}");
}

#[test]
fn a_column_that_shears_buckles_at_haringx_s_load() {
    let (area, second) = (0.01, 2e-6);
    let shape = |shear| SectionShape::General {
        area,
        second_y: 2.0 * second,
        second_z: second,
        torsion: second,
        shear,
    };
    let soft = 1e-5;
    let section = shape(Some([soft, 1.0])).section(0.3).unwrap();
    let euler = PI.powi(2) * ALLOY.young * second / (4.0 * length().powi(2));
    let shear = ALLOY.shear * soft;
    let haringx = 0.5 * shear * ((1.0 + 4.0 * euler / shear).sqrt() - 1.0);
    assert!(haringx < 0.85 * euler, "shear shows");
    let errors = [4, 8, 16].map(|count| critical(section, count, push(1.0, 0.0), 0) / haringx - 1.0);
    assert!(errors[2] < 2e-4 && orders(&errors).iter().all(|order| (1.9..2.1).contains(order)), "{errors:?}");
}

#[test]
fn a_strip_under_a_force_at_its_tip_tips_over() {
    // Michell and Prandtl: P = 4.0126 √(EI_z GJ)/L² where the strip is high, so that it does not sink before.
    let section =
        SectionShape::General { area: 0.01, second_y: 1.0, second_z: 1e-7, torsion: 3e-7, shear: None };
    let section = section.section(0.3).unwrap();
    let stiff = (ALLOY.young * section.second_z * ALLOY.shear * section.torsion).sqrt();
    let michell = 4.012_6 * stiff / length().powi(2);
    let errors = [4, 8, 16].map(|count| critical(section, count, push(0.0, 1.0), 0) / michell - 1.0);
    // The twist runs evenly along an element: second order.
    assert!(errors[2] < 1e-3 && orders(&errors).iter().all(|order| (1.9..2.1).contains(order)), "{errors:?}");
}

#[test]
fn a_shaft_clamped_at_both_ends_buckles_under_torque() {
    // Greenhill: T L/EI = 2 x, tan x = x, where both ends keep their direction and place.
    let section = thin(0.01, 0.013, 0.013);
    let greenhill = 2.0 * 4.493_409_457_909 * ALLOY.young * section.second_z / length();
    let mut load = [0.0; 6];
    load[3] = 1.0;
    let errors = [4, 8, 16].map(|count| critical(section, count, load, 6) / greenhill - 1.0);
    assert!(errors[2] < 2e-4 && orders(&errors).iter().all(|order| (3.7..4.1).contains(order)), "{errors:?}");
}
